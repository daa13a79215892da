// Where the rays of a square of the picture can meet a quadric: a span of the middle ray around the point where the quadric's function f
// is extreme along it, and how far the other rays run from that span.
//
// Along the ray, with s counted from that point, f = c + b s + a s^2. Another ray of the square is at most h = h0 + |s| h1 away at
// the same s. With |q| the largest of the quadric's coefficients, f is steeper there by no more than g0 + 2 |q| |d| |s| and bends
// by |q|, so that on all rays
//
//     f >= c + b s + a s^2 - (g0 + 2 |q| |d| |s|) h - |q| h^2 = C - B |s| + A |s|^2,
//
// if a > 0. Beyond the larger root, or everywhere if there is none, f is positive: nothing is met. With the opposite signs it is an
// upper bound: where that is negative, nothing is met, either, and all rays have met the quadric before. The front is met where f
// falls, at s <= B / (2 A).
//
// Where all rays of the square meet the quadric's front, the front is a square of its own near the tangent plane at one of its points
// p. At a point y of that plane, f(y) = f(p) + q(y - p); where f falls along the ray there by at least B, the front is at most
// 2 |f(y)| / B away along the ray, since a > 0.

#include "surface/quadric.glsl"
#include "picture/tangent_square.glsl"

struct core_quadric_span {
    // Relative to the reference point.
    elvis_vec3 from, to;
    // How far points of the other rays may be from it, in each coordinate.
    elvis_real width;
    bool is_known, is_absent;
    // All rays meet the front, and what they meet behind it is hidden; the front's parameter on the middle ray.
    bool is_split;
    elvis_real front;
};

// Rounding of the point with this parameter, on the ray through a square's middle.
elvis_real core_quadric_noise(core_picture_square place, core_cut_ray ray, elvis_real t) {
    const core_cut_column along = core_cut_begin(place.column);
    const elvis_vec3 terms = (along.size + abs((place.row - along.row0) * along.base_row)).xyz + abs(t * ray.direction);
    return elvis_real(8) * CORE_ROUNDOFF * max(max(terms.x, terms.y), terms.z);
}

// `is_front`: only the front of the quadric counts, which hides its back.
core_quadric_span core_quadric_span_at(core_picture_square place, bool is_front) {
    const elvis_real half_size = place.half_size;
    const core_cut_ray ray = core_cut_ray_at(place.column, place.row);
    const elvis_vec3 base = ray.base, direction = ray.direction;
    const elvis_mat3 to_world = elvis_mat3(CORE_SHAPE(0).xyz, CORE_SHAPE(1).xyz, CORE_SHAPE(2).xyz);
    const elvis_vec3 shifted = base - CORE_SHAPE(3).xyz;
    // Nearest to the anchor first, so that little is lost.
    const elvis_real nearest = -dot(shifted, direction) / dot(direction, direction);
    const elvis_vec3 start = (shifted + nearest * direction) * to_world, local = direction * to_world;
    const elvis_vec3 q = elvis_vec3(CORE_SHAPE(0).w, CORE_SHAPE(1).w, CORE_SHAPE(2).w);
    const elvis_real a = dot(q * local, local), largest = elvis_real(0.5LF) * CORE_SHAPE(4).w;
    const elvis_real slope = dot(elvis_real(2) * q * start + CORE_SHAPE(4).xyz, local);
    const elvis_real t0 = nearest + (a > elvis_real(0) ? -slope / (elvis_real(2) * a) : elvis_real(0));
    const elvis_real noise = core_quadric_noise(place, ray, t0);
    const core_quadric_point middle = core_quadric_at(start + (t0 - nearest) * local, local, elvis_real(0), noise);

    const elvis_real h1 = half_size * (length(core_direction_column.xyz) + length(core_direction_row.xyz));
    const elvis_real h0 = half_size * (length(core_base_column.xyz + t0 * core_direction_column.xyz) +
                                       length(core_base_row.xyz + t0 * core_direction_row.xyz)) + noise;
    const elvis_real g0 = length(middle.gradient), g1 = elvis_real(2) * largest * length(local);
    const elvis_real up = elvis_real(1) + elvis_real(64) * CORE_ROUNDOFF;
    const elvis_real c = middle.value - up * (g0 * h0 + largest * h0 * h0 + elvis_real(2) * middle.error);
    const elvis_real b = up * (abs(middle.slope) + g0 * h1 + g1 * h0 + elvis_real(2) * largest * h0 * h1);
    const elvis_real high = a * (elvis_real(1) - elvis_real(64) * CORE_ROUNDOFF) - up * (g1 * h1 + largest * h1 * h1);
    const elvis_real discriminant = b * b - elvis_real(4) * high * c;
    const elvis_real reach = (b + sqrt(max(discriminant, elvis_real(0)))) / (elvis_real(2) * high) * up;

    core_quadric_span quadric_span;
    quadric_span.is_known = high > elvis_real(0) && core_is_finite(reach);
    const elvis_real least = elvis_real(64) * CORE_ROUNDOFF * (b * b + abs(elvis_real(4) * high * c));
    quadric_span.is_absent = quadric_span.is_known && discriminant < -least;
    quadric_span.from = base + (t0 - reach) * direction;
    const elvis_real highest = middle.value + up * (g0 * h0 + largest * h0 * h0 + elvis_real(2) * middle.error);
    const elvis_real steepest = a * up + up * (g1 * h1 + largest * h1 * h1);
    const elvis_real root = sqrt(max(b * b - elvis_real(4) * steepest * highest, elvis_real(0)));
    const elvis_real room = elvis_real(-2) * highest / (up * (b + root));
    quadric_span.is_split = quadric_span.is_known && is_front && highest < elvis_real(0) && core_is_finite(room);
    // The front is before where f is least on its ray.
    const elvis_real least_within = up * (b + elvis_real(8) * CORE_ROUNDOFF * g0 * length(local)) / (elvis_real(2) * high);
    quadric_span.to = base + (t0 + (quadric_span.is_split ? -room : is_front ? min(least_within, reach) : reach)) * direction;
    const elvis_real middle_root = sqrt(max(middle.slope * middle.slope - elvis_real(4) * a * middle.value, elvis_real(0)));
    quadric_span.front = t0 - (quadric_span.is_split ? (middle.slope + middle_root) / (elvis_real(2) * a) : elvis_real(0));
    quadric_span.width = h0 + reach * h1 + noise;
    return quadric_span;
}

// The front that a square of the picture shows, flat but for `departure` along the rays.
struct core_front {
    core_tangent tangent;
    core_cut_square square;
    elvis_real departure;
    bool is_known;
};

core_front core_quadric_front(core_picture_square place, core_quadric_span quadric_span) {
    const elvis_real half_size = place.half_size;
    const core_cut_ray ray = core_cut_ray_at(place.column, place.row);
    const elvis_vec3 direction = ray.direction;
    const elvis_mat3 to_world = elvis_mat3(CORE_SHAPE(0).xyz, CORE_SHAPE(1).xyz, CORE_SHAPE(2).xyz);
    const elvis_real noise = core_quadric_noise(place, ray, quadric_span.front);
    core_front front;
    front.tangent.point = ray.base + quadric_span.front * direction;
    const core_quadric_point there = core_quadric_at((front.tangent.point - CORE_SHAPE(3).xyz) * to_world, direction * to_world,
                                                     elvis_real(0), noise);
    const elvis_real steepness = length(there.gradient), largest = elvis_real(0.5LF) * CORE_SHAPE(4).w;
    front.tangent.normal = to_world * (there.gradient / max(steepness, elvis_real(1e-30LF)));
    front.square = core_tangent_square(front.tangent, place);
    const elvis_vec3 d0 = front.square.corner0 - front.tangent.point, d1 = front.square.corner1 - front.tangent.point;
    const elvis_vec3 d2 = front.square.corner2 - front.tangent.point, d3 = front.square.corner3 - front.tangent.point;
    const elvis_real square_radius = max(max(dot(d0, d0), dot(d1, d1)), max(dot(d2, d2), dot(d3, d3)));
    const elvis_vec3 next = core_direction_column.xyz, below = core_direction_row.xyz;
    const elvis_real stretch = length(direction) + half_size * (length(next) + length(below));
    const elvis_real least_fall = -dot(front.tangent.normal, direction) -
                                  half_size * (abs(dot(front.tangent.normal, next)) + abs(dot(front.tangent.normal, below)));
    const elvis_real fall = steepness * least_fall - elvis_real(2) * largest * sqrt(square_radius) * stretch;
    const elvis_real most = largest * square_radius + abs(there.value) + elvis_real(2) * there.error;
    const elvis_real up = elvis_real(1) + elvis_real(64) * CORE_ROUNDOFF;
    front.departure = up * elvis_real(2) * most / fall * stretch + noise;
    front.is_known = quadric_span.is_split && front.square.all_hit && fall > elvis_real(0) && core_is_finite(front.departure);
    return front;
}

// Whether a point that a ray meets is on the side where the ray comes in.
bool core_is_quadric_front(elvis_real column, elvis_real row, elvis_vec3 point) {
    const elvis_vec3 direction = core_cut_ray_at(column, row).direction;
    const elvis_mat3 to_world = elvis_mat3(CORE_SHAPE(0).xyz, CORE_SHAPE(1).xyz, CORE_SHAPE(2).xyz);
    const elvis_vec3 local = direction * to_world;
    return core_quadric_at((point - CORE_SHAPE(3).xyz) * to_world, local, elvis_real(0), elvis_real(0)).slope < elvis_real(0);
}
