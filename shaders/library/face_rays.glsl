// Rays of pixels against faces: one step of Newton's method, and what is known of the nearest crossing.
//
// The kernel brings library/cut_frame.glsl, library/hierarchy.glsl, library/face_frame.glsl, library/face_patch.glsl,
// library/face_point.glsl, and the buffer core_faces: local element, local face, number, misfit of the polynomial.

#define CORE_NO_FACE 0xffffffffu

struct core_ray {
    // Relative to the reference point, and in the hierarchy's coordinates.
    elvis_vec3 origin, direction;
    vec3 box_origin;
    // Size of the coordinates that box_origin is made of.
    float far;
    // Of points in front of the eye, or behind the last crossing, and by how many times a crossing's rounding they must be.
    elvis_real least_t, widths_behind;
    elvis_real error;
};

core_ray core_pixel_ray(core_cut_column along, elvis_real row) {
    const elvis_real down = row - along.row0;
    core_ray ray;
    ray.origin = (along.base + down * along.base_row).xyz;
    ray.direction = (along.direction + down * along.direction_row).xyz;
    ray.least_t = -along.reference_distance;
    ray.widths_behind = elvis_real(0);
    const elvis_vec3 size = (along.size + abs(down * along.base_row)).xyz;
    ray.error = elvis_real(4) * CORE_ROUNDOFF * max(max(size.x, size.y), size.z);
    ray.box_origin = vec3(ray.origin + core_reference_in_hierarchy.xyz);
    const vec3 far = vec3(size) + abs(vec3(core_reference_in_hierarchy.xyz));
    ray.far = max(max(far.x, far.y), far.z);
    return ray;
}

// Least t at which the ray may be in the box; more than anything if it misses it.
float core_box_entry(core_node node, core_ray ray) {
    const vec3 direction = vec3(ray.direction);
    const vec3 inverse = 1.0 / mix(direction, vec3(1e-30), lessThan(abs(direction), vec3(1e-30)));
    const float tolerance = 16.0 * CORE_FLOAT_ROUNDOFF * ray.far;
    const vec3 a = (node.lower - tolerance - ray.box_origin) * inverse;
    const vec3 b = (node.upper + tolerance - ray.box_origin) * inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-5 * (abs(enter) + abs(leave));
    return enter <= leave + slack && leave + slack >= float(ray.least_t) ? enter - slack : 3.3e38;
}

struct core_face_step {
    bool is_regular;
    elvis_real t, step_u, step_v;
    // Of (u, v), from rounding; and twice that of t.
    elvis_real error, width;
    // normal = x_u cross x_v; row_u, row_v give (u, v) from positions, seen along the ray.
    elvis_vec3 normal, row_u, row_v;
    elvis_real across;
};

// t from the tangent plane, and the step in it.
core_face_step core_face_newton(core_face_point point, elvis_vec3 shift, core_ray ray, elvis_real misfit) {
    const elvis_vec3 origin = shift + ray.origin;
    core_face_step s;
    s.normal = cross(point.along_u, point.along_v);
    s.across = dot(s.normal, ray.direction);
    const elvis_real least = elvis_real(64) * CORE_ROUNDOFF;
    // The squares of both sides: less work than their lengths.
    s.is_regular = s.across * s.across > least * least * dot(s.normal, s.normal) * dot(ray.direction, ray.direction);
    const elvis_real inverse = s.is_regular ? elvis_real(1) / s.across : elvis_real(0);
    s.t = dot(s.normal, point.x - origin) * inverse;
    const elvis_vec3 left = origin + s.t * ray.direction - point.x;
    s.row_u = inverse * cross(point.along_v, ray.direction);
    s.row_v = inverse * cross(ray.direction, point.along_u);
    s.step_u = dot(s.row_u, left);
    s.step_v = dot(s.row_v, left);
    // Rounding of positions, and what the inverse makes of it.
    const elvis_vec3 terms = abs(shift) + abs(point.along_u) + abs(point.along_v) + abs(point.x) + abs(s.t * ray.direction);
    const elvis_vec3 noise = elvis_vec3(ray.error + misfit) + elvis_real(4) * CORE_ROUNDOFF * terms;
    s.error = max(dot(abs(s.row_u), noise), dot(abs(s.row_v), noise)) + elvis_real(4) * CORE_ROUNDOFF;
    s.width = elvis_real(4) * abs(inverse) * dot(abs(s.normal), noise);
    return s;
}

// The nearest crossing so far.
struct core_nearest {
    uint face, number, patch_index, key;
    elvis_real u, v, t, slack;
    // Where the next pixel of the column meets the face, to first order.
    elvis_real next_u, next_v;
    bool is_on_edge;
    uint n_candidates;
};

core_nearest core_nothing_yet() {
    core_nearest nearest;
    nearest.face = nearest.number = nearest.patch_index = CORE_NO_FACE;
    nearest.key = 0u;
    nearest.u = nearest.v = nearest.slack = nearest.next_u = nearest.next_v = elvis_real(0);
    nearest.t = elvis_real(3.0e38LF);
    nearest.is_on_edge = false;
    nearest.n_candidates = 0u;
    return nearest;
}

// Takes a crossing if it is before the nearest, or the same within rounding and goes before it: of two faces that coincide, that
// of the element on the viewer's side; on an edge, the face that the ray meets less obliquely, because its error is smaller; of
// equals, the lower number.
void core_take_crossing(inout core_nearest nearest, bool is_hit, uint face, uint number, uint patch_index, uint key, elvis_real u,
                        elvis_real v, bool is_on_edge, core_face_step s, elvis_vec3 motion) {
    const bool is_same = abs(s.t - nearest.t) <= max(s.width, nearest.slack);
    const bool is_number_lower = number < nearest.number || (number == nearest.number && face < nearest.face);
    const bool is_lower = key != nearest.key ? key < nearest.key
                                             : s.width < elvis_real(0.5LF) * nearest.slack ||
                                                   (is_number_lower && s.width <= elvis_real(2) * nearest.slack);
    const bool is_better = is_hit && (is_same ? is_lower : s.t < nearest.t);
    const bool is_other = is_hit && is_same && face != nearest.face;
    nearest.n_candidates = is_hit && !is_same && s.t < nearest.t ? 1u : nearest.n_candidates + (is_other ? 1u : 0u);
    nearest.face = is_better ? face : nearest.face;
    nearest.number = is_better ? number : nearest.number;
    nearest.patch_index = is_better ? patch_index : nearest.patch_index;
    nearest.key = is_better ? key : nearest.key;
    nearest.u = is_better ? u : nearest.u;
    nearest.v = is_better ? v : nearest.v;
    nearest.t = is_better ? s.t : nearest.t;
    nearest.slack = is_better ? s.width : nearest.slack;
    nearest.is_on_edge = is_better ? is_on_edge : nearest.is_on_edge;
    nearest.next_u = is_better ? u + dot(s.row_u, motion) : nearest.next_u;
    nearest.next_v = is_better ? v + dot(s.row_v, motion) : nearest.next_v;
}

elvis_real core_face_excess(elvis_real u, elvis_real v, uint square_word) {
    return (square_word & CORE_FACE_IS_TRIANGLE) != 0u ? max(max(-u, -v) - elvis_real(1), u + v)
                                                       : max(abs(u), abs(v)) - elvis_real(1);
}

// 1 if the ray enters the element here and the one that it leaves is drawn, too: that one, on the viewer's side, goes first.
uint core_partner_key(uint square_word, elvis_real across) {
    const bool leaves = (across > elvis_real(0)) == ((square_word & CORE_FACE_IS_OUTWARD) != 0u);
    return (square_word & CORE_FACE_HAS_PARTNER) != 0u && !leaves ? 1u : 0u;
}
