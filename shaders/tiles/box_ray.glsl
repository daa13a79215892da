// Rays, one by one: where they start, and where they meet boxes of a hierarchy. The kernel brings tiles/hierarchy.glsl.

struct core_ray {
    // Relative to the reference point (of rays that are given, the hierarchies' origin), and in the hierarchy's coordinates.
    elvis_vec3 origin, direction;
    vec3 box_origin;
    // Size of the coordinates that box_origin is made of.
    float far;
    // Crossings are looked for from least_t on, and count only if t > counts_from + widths_behind x the crossing's error.
    elvis_real least_t, counts_from, widths_behind;
    elvis_real error;
};

// Whether rounding decides that a crossing is as far from the eye as those that count.
bool core_is_at_start(core_ray ray, elvis_real t, elvis_real slack) {
    return ray.widths_behind == elvis_real(0) && abs(t - ray.counts_from) <= slack;
}

// Least and greatest t at which the ray may be in the box; the least is above the greatest if it misses it.
vec2 core_box_span(core_node node, vec3 origin, vec3 direction, float far) {
    const vec3 inverse = 1.0 / mix(direction, vec3(1e-30), lessThan(abs(direction), vec3(1e-30)));
    const float tolerance = 16.0 * CORE_FLOAT_ROUNDOFF * far;
    const vec3 a = (node.lower - tolerance - origin) * inverse;
    const vec3 b = (node.upper + tolerance - origin) * inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-5 * (abs(enter) + abs(leave));
    return vec2(enter - slack, leave + slack);
}
vec2 core_box_span(core_node node, core_ray ray) {
    return core_box_span(node, ray.box_origin, vec3(ray.direction), ray.far);
}

// Least t at which the ray may be in the box; more than anything if it misses it.
float core_box_entry(core_node node, core_ray ray) {
    const vec2 span = core_box_span(node, ray);
    return span.x <= span.y && span.y >= float(ray.least_t) ? span.x : 3.3e38;
}
