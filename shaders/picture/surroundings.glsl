// What a pixel, and the pixels around it, tell of the surface that it shows. The kernel brings core_size, core_marks, core_samples
// and core_normals.

#include "picture/tangent_square.glsl"

// How far neighbours may lie from the tangent plane of a smooth surface, relative to their distance, and to twice that at which their
// rays meet the plane: seen edge on, what lies far in front is near the plane, too.
#define CORE_SMOOTH elvis_real(0.1LF)

elvis_vec3 core_shown_normal(uint pixel) {
    return CORE_REAL3(core_normals, 3u * pixel);
}

// Where the pixel's ray meets the surface: the parameter, and the tangent plane.
elvis_real core_shown_t(uint pixel, core_cut_ray ray) {
    return CORE_SAMPLE_DEPTH(core_samples, pixel) / length(ray.direction) - core_reference.w;
}

core_tangent core_shown_tangent(uint pixel, core_cut_ray ray) {
    return core_tangent(ray.base + core_shown_t(pixel, ray) * ray.direction, core_shown_normal(pixel));
}

// The square of the distance from `tangent.point` at which a ray meets the plane; zero if it does not. `base`: relative to that point.
elvis_real core_square_to_plane(core_tangent tangent, elvis_vec3 base, elvis_vec3 ray) {
    const elvis_real slope = dot(tangent.normal, ray), t = -dot(tangent.normal, base) / slope;
    const elvis_vec3 point = base + t * ray;
    return slope < elvis_real(0) && t + core_reference.w > elvis_real(0) ? dot(point, point) : elvis_real(0);
}

struct core_surroundings {
    // Every neighbour sees a point near the tangent plane.
    bool is_smooth;
    // A neighbour sees a point in front of that plane: something may hide a part of the pixel.
    bool may_be_hidden;
#if !CORE_ON_FACES
    // How fast normals turn from here to those neighbours that are near the plane.
    elvis_real turning;
#endif
};

core_surroundings core_look_around(uvec2 place, uint pixel, bool is_pixel, core_tangent tangent) {
    core_surroundings around;
    around.is_smooth = true;
    around.may_be_hidden = false;
    elvis_real turning = elvis_real(0);
    const core_cut_ray own = core_cut_ray_at(elvis_real(place.x), elvis_real(place.y));
    const elvis_vec3 own_base = own.base - tangent.point, direction = own.direction;
    const ivec2 last = ivec2(core_size) - 1;
    for (uint i = 0u; i < (is_pixel ? 8u : 0u); ++i) {
        const uint k = i < 4u ? i : i + 1u;
        // Beyond the picture's edge, a pixel that is asked anyway.
        const ivec2 there = clamp(ivec2(place) + ivec2(int(k % 3u) - 1, int(k / 3u) - 1), ivec2(0), last);
        const uint other = uint(there.y) * core_size.x + uint(there.x);
        const bool is_seen = core_marks[other].owner != 0u;
        const elvis_real right = elvis_real(there.x - int(place.x)), below = elvis_real(there.y - int(place.y));
        const elvis_vec3 ray = direction + right * core_direction_column.xyz + below * core_direction_row.xyz;
        const elvis_real t = CORE_SAMPLE_DEPTH(core_samples, other) / length(ray) - core_reference.w;
        const elvis_vec3 base = own_base + right * core_base_column.xyz + below * core_base_row.xyz, to_other = base + t * ray;
        const elvis_real height = dot(tangent.normal, to_other), square = dot(to_other, to_other);
        const elvis_real expected = elvis_real(4) * core_square_to_plane(tangent, base, ray);
        const bool is_far = height * height > CORE_SMOOTH * CORE_SMOOTH * min(square, expected);
        const bool is_near = is_seen && !is_far;
        around.is_smooth = around.is_smooth && (other == pixel || is_near);
        around.may_be_hidden = around.may_be_hidden || (other != pixel && is_seen && is_far && height > elvis_real(0));
#if !CORE_ON_FACES
        const elvis_real turned = length(core_shown_normal(other) - tangent.normal) / sqrt(square);
        turning = other != pixel && is_near ? max(turning, turned) : turning;
#endif
    }
#if !CORE_ON_FACES
    around.turning = turning;
#endif
    return around;
}

elvis_real core_farthest_square(core_cut_square square, elvis_vec3 point) {
    const elvis_vec3 d0 = square.corner0 - point, d1 = square.corner1 - point, d2 = square.corner2 - point, d3 = square.corner3 - point;
    return max(max(dot(d0, d0), dot(d1, d1)), max(dot(d2, d2), dot(d3, d3)));
}

// Whether the surface may end in the pixel because it is too near to the eye to be seen. `square`: of the pixel on the tangent plane. Twice
// that is room for what the surface departs from the plane; where it is not known, the surface is seen edge on, and its depth may vary by
// half.
bool core_may_end_near(uint pixel, core_cut_square square, core_tangent tangent) {
    const elvis_real depth = CORE_SAMPLE_DEPTH(core_samples, pixel);
    const elvis_real reach = square.all_hit ? elvis_real(2) * sqrt(core_farthest_square(square, tangent.point)) : elvis_real(0.5LF) * depth;
    return depth - min(reach, elvis_real(0.5LF) * depth) <= core_near.x;
}

#if !CORE_ON_FACES
// A bound by which the surface could turn this much (in radians) in a pixel tells less than the neighbours do.
#define CORE_LOOSE elvis_real(0.1LF)

struct core_departure {
    // Along the oblique ray.
    elvis_real distance;
    // It rests on normals of neighbours.
    bool is_estimated;
};

// How far along a ray a surface with normal curvatures of `bend` at most may be from its tangent plane at a point p, where the ray meets
// the plane at the distance d from p: at the point that the ray meets, at the distance s from the plane's, the surface is off the plane
// by
//
//     s cosine <= bend / 2 (d^2 + 2 d s + s^2),
//
// as the point is at most d + s from p. Beyond all numbers where the ray may miss the surface.
elvis_real core_departure_along(elvis_real bend, elvis_real d, elvis_real cosine) {
    const elvis_real turn = bend * d, room = cosine - turn, square = room * room - turn * turn;
    const bool is_bounded = room > elvis_real(0) && square > elvis_real(0);
    return is_bounded ? turn * d / (room + sqrt(max(square, elvis_real(0)))) : bend > elvis_real(0) ? CORE_FAR : elvis_real(0);
}

// What the surface may depart from its tangent plane in a square of the picture, of this half of a side. Triangles are flat but not
// together: what normals of neighbours tell counts, too. Twice that stands for a bending that is not known, or, unless `takes_loose`,
// known by a loose bound alone.
core_departure core_departure_in(core_cut_square square, core_tangent tangent, core_cut_ray ray, elvis_real half_size,
                                 elvis_real bending, elvis_real turning, bool takes_loose) {
    // Of all rays in the square.
    const elvis_vec3 next = core_direction_column.xyz, below = core_direction_row.xyz;
    const elvis_real fall = -dot(tangent.normal, ray.direction) -
                            half_size * (abs(dot(tangent.normal, next)) + abs(dot(tangent.normal, below)));
    const elvis_real cosine = fall / (length(ray.direction) + half_size * (length(next) + length(below)));
    const elvis_real farthest = core_farthest_square(square, tangent.point);
    const bool is_loose = bending * bending * farthest > CORE_LOOSE * CORE_LOOSE && elvis_real(2) * turning < bending;
    core_departure departure;
    departure.is_estimated = bending >= CORE_FAR || (is_loose && !takes_loose);
    const elvis_real bend = departure.is_estimated ? elvis_real(2) * turning : max(bending, turning);
    departure.distance = core_departure_along(bend, sqrt(farthest), max(cosine, elvis_real(1e-6LF)));
    return departure;
}
#endif
