// Meshes of bicubic Bezier patches. The ray meets a patch x(u, v) where its two coordinates across the ray vanish: two bicubic
// polynomials, whose control points are those of x, projected.
//
// A part of a patch is left out if its projected control points, whose hull holds it, lie on one side of the ray. They are judged in
// coordinates in which the part is nearly the unit square (the mean derivatives at its corners are the unit vectors), so that the hull's
// box is tight. There the derivatives' control points bound how far the Jacobian J is from the identity I: with |J - I| < 1/2 in the
// maximum norm the map is one to one (its mean values are regular) and Newton's method finds the only zero or shows that there is none.
// Otherwise the part is halved in u and v, down to CORE_BEZIER_LEVELS; what is left then lies where the ray touches the surface, or where
// the patch is degenerate, and is undecided. (See T. Nishita, T. Sederberg, M. Kakimoto, "Ray tracing trimmed rational surface patches",
// 1990; A. Neumaier, Interval Methods for Systems of Equations, 1990.)
//
// Rows: xyz: reference point minus the origin of control points and hierarchy.
//
// Buffers: core_patches, 16 points each, v running first; core_nodes.

#include "cut_surface/surface_descent.glsl"

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 3000u
// Halvings of one patch. Beyond, parts are below what single precision tells apart.
#define CORE_BEZIER_LEVELS 10u
#define CORE_BEZIER_STEPS 8u

// Weights of four control points in the blossom at (x, y, z).
elvis_vec4 core_blossom(elvis_real x, elvis_real y, elvis_real z) {
    const elvis_real a = elvis_real(1) - x, b = elvis_real(1) - y, c = elvis_real(1) - z;
    return elvis_vec4(a * b * c, x * b * c + a * y * c + a * b * z, x * y * c + x * b * z + a * y * z, x * y * z);
}

elvis_vec4 core_bernstein(elvis_real x) { return core_blossom(x, x, x); }
elvis_vec4 core_bernstein_derivative(elvis_real x) {
    const elvis_real a = elvis_real(1) - x;
    return elvis_real(3) * elvis_vec4(-a * a, a * a - elvis_real(2) * x * a, elvis_real(2) * x * a - x * x, x * x);
}

// One coordinate of a patch's control points: a column for each u, its components for v.
struct core_net {
    elvis_vec4 c0, c1, c2, c3;
};

core_net core_subnet(core_net net, elvis_vec4 u0, elvis_vec4 u1, elvis_vec4 u2, elvis_vec4 u3, elvis_vec4 v0, elvis_vec4 v1,
                       elvis_vec4 v2, elvis_vec4 v3) {
    const elvis_vec4 a = u0.x * net.c0 + u0.y * net.c1 + u0.z * net.c2 + u0.w * net.c3;
    const elvis_vec4 b = u1.x * net.c0 + u1.y * net.c1 + u1.z * net.c2 + u1.w * net.c3;
    const elvis_vec4 c = u2.x * net.c0 + u2.y * net.c1 + u2.z * net.c2 + u2.w * net.c3;
    const elvis_vec4 d = u3.x * net.c0 + u3.y * net.c1 + u3.z * net.c2 + u3.w * net.c3;
    return core_net(elvis_vec4(dot(a, v0), dot(a, v1), dot(a, v2), dot(a, v3)), elvis_vec4(dot(b, v0), dot(b, v1), dot(b, v2), dot(b, v3)),
                    elvis_vec4(dot(c, v0), dot(c, v1), dot(c, v2), dot(c, v3)), elvis_vec4(dot(d, v0), dot(d, v1), dot(d, v2), dot(d, v3)));
}

elvis_real core_net_value(core_net net, elvis_vec4 u, elvis_vec4 v) {
    return dot(u.x * net.c0 + u.y * net.c1 + u.z * net.c2 + u.w * net.c3, v);
}

core_net core_net_combine(elvis_real a, core_net p, elvis_real b, core_net q) {
    return core_net(a * p.c0 + b * q.c0, a * p.c1 + b * q.c1, a * p.c2 + b * q.c2, a * p.c3 + b * q.c3);
}

elvis_real core_least(elvis_vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
elvis_real core_most(elvis_vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }
elvis_real core_net_least(core_net net) { return core_least(min(min(net.c0, net.c1), min(net.c2, net.c3))); }
elvis_real core_net_most(core_net net) { return core_most(max(max(net.c0, net.c1), max(net.c2, net.c3))); }
elvis_real core_net_size(core_net net) { return max(-core_net_least(net), core_net_most(net)); }

// Largest distance of the derivative by u from a number; by v.
elvis_real core_net_deviation_u(core_net net, elvis_real from) {
    const elvis_vec4 a = abs(elvis_real(3) * (net.c1 - net.c0) - from), b = abs(elvis_real(3) * (net.c2 - net.c1) - from);
    const elvis_vec4 c = abs(elvis_real(3) * (net.c3 - net.c2) - from);
    return core_most(max(max(a, b), c));
}
elvis_real core_net_deviation_v(core_net net, elvis_real from) {
    const elvis_vec3 a = abs(elvis_real(3) * (net.c0.yzw - net.c0.xyz) - from), b = abs(elvis_real(3) * (net.c1.yzw - net.c1.xyz) - from);
    const elvis_vec3 c = abs(elvis_real(3) * (net.c2.yzw - net.c2.xyz) - from), d = abs(elvis_real(3) * (net.c3.yzw - net.c3.xyz) - from);
    const elvis_vec3 most = max(max(a, b), max(c, d));
    return max(max(most.x, most.y), most.z);
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const elvis_vec3 origin = ray.origin + CORE_SHAPE(0).xyz;
    const elvis_real stretch = length(ray.direction);
    // The ray's frame.
    const elvis_vec3 along = ray.direction / stretch;
    const elvis_vec3 other = abs(along.x) < elvis_real(0.5LF) ? elvis_vec3(1, 0, 0) : elvis_vec3(0, 1, 0);
    const elvis_vec3 across_x = normalize(cross(along, other)), across_y = cross(along, across_x);
    const core_box_ray box_ray = core_make_box_ray(ray, origin, CORE_SHAPE(0).xyz);

    uint stack[CORE_STACK_SIZE];
    stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint item = CORE_NO_NODE, work = 0u;
    // The part of the patch at hand.
    uint level = 0u, part_u = 0u, part_v = 0u;
    core_votes votes = core_no_votes();
    elvis_real touch_t = CORE_FAR;
    while ((item != CORE_NO_NODE || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (item == CORE_NO_NODE && stack_size > 0u) {
            stack_size -= 1u;
            const core_node node = core_fetch_node(stack[stack_size]);
            const float farthest = float(best.t + best.error);
            const bool is_met = core_box_entry(node, box_ray, farthest) < 3e38;
            item = is_met && node.is_leaf ? node.child : CORE_NO_NODE;
            if (is_met && !node.is_leaf) {
                const float first = core_box_entry(core_fetch_node(node.child), box_ray, farthest);
                const float second = core_box_entry(core_fetch_node(node.child + 1u), box_ray, farthest);
                stack[stack_size] = node.child + (second < first ? 0u : 1u);
                stack[stack_size + 1u] = node.child + (second < first ? 1u : 0u);
                stack_size += 2u;
            }
            level = part_u = part_v = 0u;
            if (item != CORE_NO_NODE || stack_size == 0u) {
                break;
            }
        }
        const bool is_active = item != CORE_NO_NODE;
        const uint safe = is_active ? item : 0u;

        // Control points in the ray's frame.
        core_net x, y, z;
#define CORE_COLUMN(column, first)                                                                                                        \
    {                                                                                                                                     \
        const elvis_vec4 r0 = elvis_fetch4_core_patches(safe, first), r1 = elvis_fetch4_core_patches(safe, first + 1u);                   \
        const elvis_vec4 r2 = elvis_fetch4_core_patches(safe, first + 2u);                                                                \
        const elvis_vec3 p0 = r0.xyz - origin, p1 = elvis_vec3(r0.w, r1.xy) - origin;                                                     \
        const elvis_vec3 p2 = elvis_vec3(r1.zw, r2.x) - origin, p3 = r2.yzw - origin;                                                     \
        x.column = elvis_vec4(dot(p0, across_x), dot(p1, across_x), dot(p2, across_x), dot(p3, across_x));                                \
        y.column = elvis_vec4(dot(p0, across_y), dot(p1, across_y), dot(p2, across_y), dot(p3, across_y));                                \
        z.column = elvis_vec4(dot(p0, along), dot(p1, along), dot(p2, along), dot(p3, along));                                            \
    }
        CORE_COLUMN(c0, 0u)
        CORE_COLUMN(c1, 3u)
        CORE_COLUMN(c2, 6u)
        CORE_COLUMN(c3, 9u)
#undef CORE_COLUMN
        // How far rounding moves a point across the ray.
        const elvis_real off = elvis_real(2) * ray.noise + elvis_real(16) * CORE_ROUNDOFF * (core_net_size(x) + core_net_size(y) + core_net_size(z));

        const elvis_real h = elvis_real(1) / elvis_real(1u << level);
        const elvis_real u_low = h * elvis_real(part_u), v_low = h * elvis_real(part_v);
        const elvis_real u_high = u_low + h, v_high = v_low + h;
        const elvis_vec4 u0 = core_bernstein(u_low), u1 = core_blossom(u_low, u_low, u_high), u2 = core_blossom(u_low, u_high, u_high);
        const elvis_vec4 u3 = core_bernstein(u_high), v0 = core_bernstein(v_low), v1 = core_blossom(v_low, v_low, v_high);
        const elvis_vec4 v2 = core_blossom(v_low, v_high, v_high), v3 = core_bernstein(v_high);
        const core_net part_x = core_subnet(x, u0, u1, u2, u3, v0, v1, v2, v3), part_y = core_subnet(y, u0, u1, u2, u3, v0, v1, v2, v3);

        // Coordinates in which the part is nearly the unit square.
        const elvis_real half_one = elvis_real(0.5LF);
        const elvis_real xu = half_one * (part_x.c3.x - part_x.c0.x + part_x.c3.w - part_x.c0.w);
        const elvis_real xv = half_one * (part_x.c0.w - part_x.c0.x + part_x.c3.w - part_x.c3.x);
        const elvis_real yu = half_one * (part_y.c3.x - part_y.c0.x + part_y.c3.w - part_y.c0.w);
        const elvis_real yv = half_one * (part_y.c0.w - part_y.c0.x + part_y.c3.w - part_y.c3.x);
        const elvis_real determinant = xu * yv - xv * yu;
        const elvis_real scale = (abs(xu) + abs(yu)) * (abs(xv) + abs(yv));
        const bool is_regular = abs(determinant) > elvis_real(1e-4LF) * scale;
        const elvis_real inverse = is_regular ? elvis_real(1) / determinant : elvis_real(0);
        // Where they are not known, the ray's own do.
        const core_net s = core_net_combine(is_regular ? yv * inverse : elvis_real(1), part_x, is_regular ? -xv * inverse : elvis_real(0), part_y);
        const core_net r = core_net_combine(is_regular ? -yu * inverse : elvis_real(0), part_x, is_regular ? xu * inverse : elvis_real(1), part_y);
        const elvis_real off_s = is_regular ? off * (abs(yv) + abs(xv)) * abs(inverse) : off;
        const elvis_real off_r = is_regular ? off * (abs(yu) + abs(xu)) * abs(inverse) : off;
        const bool is_missed = core_net_least(s) > off_s || core_net_most(s) < -off_s || core_net_least(r) > off_r || core_net_most(r) < -off_r;
        const elvis_real one = elvis_real(1), zero = elvis_real(0);
        const elvis_real deviation = max(core_net_deviation_u(s, one) + core_net_deviation_v(s, zero),
                                         core_net_deviation_u(r, zero) + core_net_deviation_v(r, one));
        const bool is_simple = is_regular && deviation < half_one;
        const bool is_last = level >= CORE_BEZIER_LEVELS;
        // Too small for the digits at hand: rounding decides everything.
        const bool is_lost = !is_simple && (is_last || max(off_s, off_r) > elvis_real(0.05LF) && is_regular);

        elvis_real a = half_one, b = half_one, last_step = one;
        uint step = 0u;
        while (step < (is_active && is_simple && !is_missed ? CORE_BEZIER_STEPS : 0u)) {
            const elvis_vec4 wu = core_bernstein(a), wv = core_bernstein(b), du = core_bernstein_derivative(a), dv = core_bernstein_derivative(b);
            const elvis_real fs = core_net_value(s, wu, wv), fr = core_net_value(r, wu, wv);
            const elvis_real su = core_net_value(s, du, wv), sv = core_net_value(s, wu, dv);
            const elvis_real ru = core_net_value(r, du, wv), rv = core_net_value(r, wu, dv);
            const elvis_real det = su * rv - sv * ru;
            const elvis_real step_a = (sv * fr - rv * fs) / det, step_b = (ru * fs - su * fr) / det;
            a = clamp(a + step_a, elvis_real(-0.25LF), elvis_real(1.25LF));
            b = clamp(b + step_b, elvis_real(-0.25LF), elvis_real(1.25LF));
            last_step = max(abs(step_a), abs(step_b));
            step = last_step <= half_one * max(off_s, off_r) ? CORE_BEZIER_STEPS : step + 1u;
        }
        // |J^-1| <= 2 turns the error of values into one of parameters.
        const elvis_real tolerance = elvis_real(4) * max(off_s, off_r);
        const elvis_real excess = max(abs(a - half_one), abs(b - half_one)) - half_one;
        const bool has_root = is_simple && last_step <= elvis_real(1e-2LF) && excess <= tolerance;

        const elvis_real u = u_low + h * a, v = v_low + h * b;
        const elvis_vec4 wu = core_bernstein(u), wv = core_bernstein(v), du = core_bernstein_derivative(u), dv = core_bernstein_derivative(v);
        const elvis_real t = core_net_value(z, wu, wv) / stretch;
        const elvis_vec3 tangent_u = elvis_vec3(core_net_value(x, du, wv), core_net_value(y, du, wv), core_net_value(z, du, wv));
        const elvis_vec3 tangent_v = elvis_vec3(core_net_value(x, wu, dv), core_net_value(y, wu, dv), core_net_value(z, wu, dv));
        const elvis_vec3 normal = cross(tangent_u, tangent_v);
        const elvis_real error = off * core_norm1(normal) / max(abs(normal.z), elvis_real(1e-30LF) * core_norm1(normal)) / stretch;
        const bool counts = is_active && !is_missed && has_root && t > ray.from && t < ray.to && t - elvis_real(2) * error > ray.after;
        const bool is_better = core_vote(votes, best, t, error, true, excess <= -tolerance, normal.z < zero, counts);
        const elvis_vec3 in_world = normal.x * across_x + normal.y * across_y + normal.z * along;
        best.t = is_better ? t : best.t;
        best.error = is_better ? error : best.error;
        best.normal_x = is_better ? in_world.x : best.normal_x;
        best.normal_y = is_better ? in_world.y : best.normal_y;
        best.normal_z = is_better ? in_world.z : best.normal_z;
        best.bending = is_better ? CORE_FAR : best.bending;
        best.is_hit = best.is_hit || is_better;
        // What touches the ray, or may.
        const bool touches = is_active && !is_missed && is_lost && t > ray.from && t < ray.to && t > ray.after;
        touch_t = touches ? min(touch_t, t) : touch_t;

        // Down, or on to the next part: in both directions counted like the digits of a number.
        const bool goes_down = is_active && !is_missed && !is_simple && !is_lost;
        part_u = goes_down ? 2u * part_u : part_u;
        part_v = goes_down ? 2u * part_v : part_v;
        level += goes_down ? 1u : 0u;
        bool is_going_up = is_active && !goes_down;
        while (is_going_up && level > 0u) {
            const bool to_right = (part_u & 1u) == 0u, to_left = !to_right && (part_v & 1u) == 0u;
            part_v = to_left ? part_v + 1u : part_v;
            part_u = to_right ? part_u + 1u : to_left ? part_u - 1u : part_u;
            is_going_up = !to_right && !to_left;
            part_u = is_going_up ? part_u / 2u : part_u;
            part_v = is_going_up ? part_v / 2u : part_v;
            level -= is_going_up ? 1u : 0u;
        }
        item = is_going_up ? CORE_NO_NODE : item;
        if (item == CORE_NO_NODE && stack_size == 0u) {
            break;
        }
    }
    best.is_undecided = core_is_undecided(votes, best) || touch_t <= best.t + best.error && touch_t < CORE_FAR;
    best.is_cut_short = item != CORE_NO_NODE || stack_size > 0u;
    return best;
}
