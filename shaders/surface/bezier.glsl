// Meshes of bicubic Bezier patches. The ray meets a patch x(u, v) where its two coordinates across the ray vanish: two bicubic
// polynomials, whose control points are those of x, projected.
//
// A square of a patch's parameters is left out if its projected control points, whose hull holds it, lie on one side of the ray. They are
// judged in coordinates in which it is nearly the unit square (the mean derivatives at its corners are the unit vectors), so that the
// hull's box is tight. There the derivatives' control points bound how far the Jacobian J is from the identity I: with |J - I| < 1/2 in the
// maximum norm the map is one to one (its mean values are regular) and Newton's method finds the only zero or shows that there is none.
// Otherwise the square is halved in u and v, down to CORE_BEZIER_LEVELS; what is left then lies where the ray touches the surface, or where
// the patch is degenerate, and is undecided. (See T. Nishita, T. Sederberg, M. Kakimoto, "Ray tracing trimmed rational surface patches",
// 1990; A. Neumaier, Interval Methods for Systems of Equations, 1990.)
//
// Rows: xyz: reference point minus the origin of control points and hierarchy.
//
// Buffers: core_patches, 16 points each, v running first; core_nodes.

#include "surface/descent.glsl"

// Iterations of one pixel: see cut_surface/locate.glsl.
#define CORE_WORK_LIMIT 3000u
// Halvings of one patch. Beyond, squares are below what single precision tells apart.
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

// That of the square from (u, v) with sides h.
core_net core_subnet(core_net net, elvis_real u, elvis_real v, elvis_real h) {
    const elvis_real u_high = u + h, v_high = v + h;
    const elvis_vec4 u0 = core_bernstein(u), u1 = core_blossom(u, u, u_high);
    const elvis_vec4 u2 = core_blossom(u, u_high, u_high), u3 = core_bernstein(u_high);
    const elvis_vec4 v0 = core_bernstein(v), v1 = core_blossom(v, v, v_high);
    const elvis_vec4 v2 = core_blossom(v, v_high, v_high), v3 = core_bernstein(v_high);
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

// The ray is the third axis.
struct core_ray_frame {
    // Of the ray, where control points are counted from.
    elvis_vec3 origin;
    elvis_vec3 across_x, across_y, along;
    // Length of the ray's direction.
    elvis_real stretch;
};

core_ray_frame core_ray_frame_of(core_surface_ray ray) {
    core_ray_frame frame;
    frame.origin = ray.origin + CORE_SHAPE(0).xyz;
    frame.stretch = length(ray.direction);
    frame.along = ray.direction / frame.stretch;
    const elvis_vec3 other = abs(frame.along.x) < elvis_real(0.5LF) ? elvis_vec3(1, 0, 0) : elvis_vec3(0, 1, 0);
    frame.across_x = normalize(cross(frame.along, other));
    frame.across_y = cross(frame.along, frame.across_x);
    return frame;
}

// A patch in the ray's frame, and how far rounding moves a point across the ray.
struct core_bezier_patch {
    core_net x, y, z;
    elvis_real off;
};

void core_fetch_column(uint index, uint first, core_ray_frame frame, out elvis_vec4 x, out elvis_vec4 y, out elvis_vec4 z) {
    const elvis_vec4 r0 = elvis_fetch4_core_patches(index, first), r1 = elvis_fetch4_core_patches(index, first + 1u);
    const elvis_vec4 r2 = elvis_fetch4_core_patches(index, first + 2u);
    const elvis_vec3 p0 = r0.xyz - frame.origin, p1 = elvis_vec3(r0.w, r1.xy) - frame.origin;
    const elvis_vec3 p2 = elvis_vec3(r1.zw, r2.x) - frame.origin, p3 = r2.yzw - frame.origin;
    x = elvis_vec4(dot(p0, frame.across_x), dot(p1, frame.across_x), dot(p2, frame.across_x), dot(p3, frame.across_x));
    y = elvis_vec4(dot(p0, frame.across_y), dot(p1, frame.across_y), dot(p2, frame.across_y), dot(p3, frame.across_y));
    z = elvis_vec4(dot(p0, frame.along), dot(p1, frame.along), dot(p2, frame.along), dot(p3, frame.along));
}

core_bezier_patch core_fetch_patch(uint index, core_ray_frame frame, elvis_real noise) {
    core_bezier_patch surface;
    core_fetch_column(index, 0u, frame, surface.x.c0, surface.y.c0, surface.z.c0);
    core_fetch_column(index, 3u, frame, surface.x.c1, surface.y.c1, surface.z.c1);
    core_fetch_column(index, 6u, frame, surface.x.c2, surface.y.c2, surface.z.c2);
    core_fetch_column(index, 9u, frame, surface.x.c3, surface.y.c3, surface.z.c3);
    surface.off = elvis_real(2) * noise +
                 elvis_real(16) * CORE_ROUNDOFF * (core_net_size(surface.x) + core_net_size(surface.y) + core_net_size(surface.z));
    return surface;
}

// The square of a patch that is looked at.
struct core_bezier_square {
    uint level, column, row;
};

// The square's coordinates across the ray, (s, r), in which it is nearly the unit square, and how far rounding moves them. Where there are
// none the ray's own.
struct core_unit_square {
    core_net s, r;
    elvis_real off_s, off_r;
    bool is_regular;
};

core_unit_square core_unit_square_of(core_net x, core_net y, elvis_real off) {
    const elvis_real half_one = elvis_real(0.5LF);
    const elvis_real xu = half_one * (x.c3.x - x.c0.x + x.c3.w - x.c0.w), xv = half_one * (x.c0.w - x.c0.x + x.c3.w - x.c3.x);
    const elvis_real yu = half_one * (y.c3.x - y.c0.x + y.c3.w - y.c0.w), yv = half_one * (y.c0.w - y.c0.x + y.c3.w - y.c3.x);
    const elvis_real determinant = xu * yv - xv * yu;
    const elvis_real scale = (abs(xu) + abs(yu)) * (abs(xv) + abs(yv));
    core_unit_square unit;
    unit.is_regular = abs(determinant) > elvis_real(1e-4LF) * scale;
    const elvis_real inverse = unit.is_regular ? elvis_real(1) / determinant : elvis_real(0);
    unit.s = core_net_combine(unit.is_regular ? yv * inverse : elvis_real(1), x, unit.is_regular ? -xv * inverse : elvis_real(0), y);
    unit.r = core_net_combine(unit.is_regular ? -yu * inverse : elvis_real(0), x, unit.is_regular ? xu * inverse : elvis_real(1), y);
    unit.off_s = unit.is_regular ? off * (abs(yv) + abs(xv)) * abs(inverse) : off;
    unit.off_r = unit.is_regular ? off * (abs(yu) + abs(xu)) * abs(inverse) : off;
    return unit;
}

struct core_bezier_verdict {
    // The ray misses the square; it meets it at most once; neither is known, and rounding decides.
    bool is_missed, is_simple, is_lost;
};

core_bezier_verdict core_judge_square(core_unit_square unit, uint level) {
    const elvis_real one = elvis_real(1), zero = elvis_real(0);
    core_bezier_verdict verdict;
    verdict.is_missed = core_net_least(unit.s) > unit.off_s || core_net_most(unit.s) < -unit.off_s ||
                        core_net_least(unit.r) > unit.off_r || core_net_most(unit.r) < -unit.off_r;
    const elvis_real deviation = max(core_net_deviation_u(unit.s, one) + core_net_deviation_v(unit.s, zero),
                                     core_net_deviation_u(unit.r, zero) + core_net_deviation_v(unit.r, one));
    verdict.is_simple = unit.is_regular && deviation < elvis_real(0.5LF);
    // Too small for the digits at hand.
    const bool is_small = max(unit.off_s, unit.off_r) > elvis_real(0.05LF) && unit.is_regular;
    verdict.is_lost = !verdict.is_simple && (level >= CORE_BEZIER_LEVELS || is_small);
    return verdict;
}

// The zero of (s, r) by Newton's method.
struct core_bezier_root {
    // In the square, which is [0, 1]^2.
    elvis_real a, b;
    bool is_root, is_clear;
};

core_bezier_root core_bezier_newton(core_unit_square unit, bool is_wanted) {
    const elvis_real half_one = elvis_real(0.5LF);
    core_bezier_root root;
    root.a = root.b = half_one;
    elvis_real last_step = elvis_real(1);
    uint step = 0u;
    while (step < (is_wanted ? CORE_BEZIER_STEPS : 0u)) {
        const elvis_vec4 wu = core_bernstein(root.a), wv = core_bernstein(root.b);
        const elvis_vec4 du = core_bernstein_derivative(root.a), dv = core_bernstein_derivative(root.b);
        const elvis_real fs = core_net_value(unit.s, wu, wv), fr = core_net_value(unit.r, wu, wv);
        const elvis_real su = core_net_value(unit.s, du, wv), sv = core_net_value(unit.s, wu, dv);
        const elvis_real ru = core_net_value(unit.r, du, wv), rv = core_net_value(unit.r, wu, dv);
        const elvis_real det = su * rv - sv * ru;
        const elvis_real step_a = (sv * fr - rv * fs) / det, step_b = (ru * fs - su * fr) / det;
        root.a = clamp(root.a + step_a, elvis_real(-0.25LF), elvis_real(1.25LF));
        root.b = clamp(root.b + step_b, elvis_real(-0.25LF), elvis_real(1.25LF));
        last_step = max(abs(step_a), abs(step_b));
        step = last_step <= half_one * max(unit.off_s, unit.off_r) ? CORE_BEZIER_STEPS : step + 1u;
    }
    // |J^-1| <= 2 makes an error of parameters from one of values.
    const elvis_real tolerance = elvis_real(4) * max(unit.off_s, unit.off_r);
    const elvis_real excess = max(abs(root.a - half_one), abs(root.b - half_one)) - half_one;
    root.is_root = last_step <= elvis_real(1e-2LF) && excess <= tolerance;
    root.is_clear = excess <= -tolerance;
    return root;
}

// A point of a patch: where along the ray it is, the normal there in the ray's frame, and the error of t.
struct core_bezier_point {
    elvis_real t, error;
    elvis_vec3 normal;
};

core_bezier_point core_bezier_point_at(core_bezier_patch surface, elvis_real u, elvis_real v, elvis_real stretch) {
    const elvis_vec4 wu = core_bernstein(u), wv = core_bernstein(v), du = core_bernstein_derivative(u), dv = core_bernstein_derivative(v);
    core_bezier_point point;
    point.t = core_net_value(surface.z, wu, wv) / stretch;
    const elvis_vec3 tangent_u =
        elvis_vec3(core_net_value(surface.x, du, wv), core_net_value(surface.y, du, wv), core_net_value(surface.z, du, wv));
    const elvis_vec3 tangent_v =
        elvis_vec3(core_net_value(surface.x, wu, dv), core_net_value(surface.y, wu, dv), core_net_value(surface.z, wu, dv));
    point.normal = cross(tangent_u, tangent_v);
    const elvis_real size = core_norm1(point.normal);
    point.error = surface.off * size / max(abs(point.normal.z), elvis_real(1e-30LF) * size) / stretch;
    return point;
}

// To the first quarter of the square, or to the next square: in both directions counted like the digits of a number. Returns whether the
// patch is done with.
bool core_next_square(bool is_active, bool goes_down, inout core_bezier_square square) {
    square.column = goes_down ? 2u * square.column : square.column;
    square.row = goes_down ? 2u * square.row : square.row;
    square.level += goes_down ? 1u : 0u;
    bool is_going_up = is_active && !goes_down;
    while (is_going_up && square.level > 0u) {
        const bool to_right = (square.column & 1u) == 0u, to_left = !to_right && (square.row & 1u) == 0u;
        square.row = to_left ? square.row + 1u : square.row;
        square.column = to_right ? square.column + 1u : to_left ? square.column - 1u : square.column;
        is_going_up = !to_right && !to_left;
        square.column = is_going_up ? square.column / 2u : square.column;
        square.row = is_going_up ? square.row / 2u : square.row;
        square.level -= is_going_up ? 1u : 0u;
    }
    return is_going_up;
}

// Looks at a square. `touch_t`: the nearest place where rounding decides. Returns whether the patch is done with.
bool core_consider_square(uint index, bool is_active, core_surface_ray ray, core_ray_frame frame, inout core_bezier_square square,
                          inout elvis_real touch_t, inout core_votes votes, inout core_hit best) {
    const core_bezier_patch surface = core_fetch_patch(index, frame, ray.noise);
    const elvis_real h = elvis_real(1) / elvis_real(1u << square.level);
    const elvis_real u_low = h * elvis_real(square.column), v_low = h * elvis_real(square.row);
    const core_unit_square unit =
        core_unit_square_of(core_subnet(surface.x, u_low, v_low, h), core_subnet(surface.y, u_low, v_low, h), surface.off);
    const core_bezier_verdict verdict = core_judge_square(unit, square.level);
    const bool is_open = is_active && !verdict.is_missed;
    const core_bezier_root root = core_bezier_newton(unit, is_open && verdict.is_simple);
    const core_bezier_point point = core_bezier_point_at(surface, u_low + h * root.a, v_low + h * root.b, frame.stretch);
    const bool is_ahead = point.t > ray.from && point.t < ray.to;
    const bool counts = is_open && verdict.is_simple && root.is_root && core_is_counted(ray, point.t, point.error, best);
    const bool is_better = core_vote(votes, best, point.t, point.error, true, root.is_clear, point.normal.z < elvis_real(0), counts);
    const elvis_vec3 in_world = point.normal.x * frame.across_x + point.normal.y * frame.across_y + point.normal.z * frame.along;
    core_take_hit(is_better, point.t, point.error, in_world, CORE_FAR, best);
    // What touches the ray, or may.
    touch_t = is_open && verdict.is_lost && is_ahead && point.t > ray.after ? min(touch_t, point.t) : touch_t;
    return core_next_square(is_active, is_open && !verdict.is_simple && !verdict.is_lost, square);
}

core_hit core_next_hit(core_surface_ray ray) {
    core_hit best = core_no_hit();
    const core_ray_frame frame = core_ray_frame_of(ray);
    const core_box_ray box_ray = core_make_box_ray(ray, frame.origin, CORE_SHAPE(0).xyz);
    core_stack[0] = 0u;
    uint stack_size = ray.from < ray.to ? 1u : 0u;
    uint index = CORE_NO_NODE, work = 0u;
    core_bezier_square square = core_bezier_square(0u, 0u, 0u);
    core_votes votes = core_no_votes();
    elvis_real touch_t = CORE_FAR;
    while ((index != CORE_NO_NODE || stack_size > 0u) && work < CORE_WORK_LIMIT) {
        work += 1u;
        while (index == CORE_NO_NODE && stack_size > 0u) {
            index = core_next_item(box_ray, float(best.t + best.error), stack_size);
            square = core_bezier_square(0u, 0u, 0u);
            if (index != CORE_NO_NODE || stack_size == 0u) {
                break;
            }
        }
        const bool is_active = index != CORE_NO_NODE;
        const bool is_done = core_consider_square(is_active ? index : 0u, is_active, ray, frame, square, touch_t, votes, best);
        index = is_done ? CORE_NO_NODE : index;
        if (index == CORE_NO_NODE && stack_size == 0u) {
            break;
        }
    }
    best.is_undecided = best.is_undecided || core_is_undecided(votes, best) || touch_t <= best.t + best.error && touch_t < CORE_FAR;
    best.is_cut_short = index != CORE_NO_NODE || stack_size > 0u;
    return best;
}
