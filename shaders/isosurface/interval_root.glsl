// The candidate of an interval, the root of its line: whether the field crosses the isovalue there, and where.
//
// The kernel brings isosurface/interval_bounds.glsl.

// Error of the unit normal that is left.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_NORMAL_ERROR elvis_real(2e-13LF)
#else
#define CORE_NORMAL_ERROR elvis_real(1e-6LF)
#endif
// Steps to the root that are small whatever is known of derivatives.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_LAST_STEP elvis_real(1e-6LF)
#else
#define CORE_LAST_STEP elvis_real(2e-3LF)
#endif

struct core_root {
    // The field surely takes the isovalue around it, and once only.
    bool is_proven;
    // Another step would not make it more exact; so little does the line leave out in the interval.
    bool is_exact, is_mostly_rounding;
    // In the element, as far as rounding allows, and in spite of it.
    bool is_inside, is_surely_inside;
    elvis_vec3 xi;
    // Of the field in the world, there.
    elvis_vec3 gradient;
    // Bound of the isosurface's curvature.
    elvis_real bend;
};

core_root core_root_of(const core_evaluation evaluation, const core_interval_search search) {
    const core_ray_interval interval = evaluation.interval;
    const core_linear_root candidate = evaluation.candidate;
    const core_frame frame = evaluation.frame;
    core_root root;
    // In [low, high] the field is within the error of the line, and surely keeps the sign of its slope: it crosses at most once. It does
    // cross if both s +- half_width lie there, since it is on different sides of the isovalue at these. If one of them lies beyond a face,
    // where nothing bounds the field, the crossing is at the line's root but for rounding and what the line leaves out at the root, and
    // counts if that lies in the element: is_inside, and is_surely_inside.
    root.is_proven = interval.is_known && candidate.s - candidate.half_width >= -evaluation.reach &&
                     candidate.s + candidate.half_width <= evaluation.reach &&
                     evaluation.turn < abs(interval.slope);
    const elvis_vec3 to_root = interval.q + candidate.s * interval.w;
    const elvis_real distance = core_max_norm(to_root);
    root.xi = evaluation.xi + to_root;
    root.gradient = core_to_world(frame, evaluation.slope);
    // At least the spectral norm of J^-1: the square root of the largest sums of rows and columns.
    const elvis_vec3 columns = abs(frame.row0) + abs(frame.row1) + abs(frame.row2);
    const elvis_real rows = max(max(core_model_norm1(frame.row0), core_model_norm1(frame.row1)), core_model_norm1(frame.row2));
    const elvis_real inverse_size = sqrt(core_max_norm(columns) * rows);
    const elvis_real size = length(root.gradient);
    root.bend = inverse_size * inverse_size * evaluation.bend / size;
    // From xi to the root the gradient changes by this much at most, and the line's root is wrong by half the product.
    const elvis_real change = evaluation.bend * distance;
    root.is_mostly_rounding = evaluation.bend * interval.radius * interval.radius <= interval.error;
    // Beside a face the half width decides, and must not be what the line leaves out elsewhere.
    const bool is_beside_face = candidate.s - candidate.half_width < interval.low || candidate.s + candidate.half_width > interval.high;
    root.is_exact = (distance <= CORE_LAST_STEP && change * inverse_size <= CORE_NORMAL_ERROR * size &&
                     change * distance * evaluation.speed <= CORE_NORMAL_ERROR * abs(interval.slope) &&
                     (root.is_mostly_rounding || !is_beside_face)) ||
                    distance <= core_max_norm(frame.xi_error) ||
                    // Nothing more is to be had.
                    (root.is_mostly_rounding &&
                     distance <= (search.moves < 3u ? elvis_real(0.03LF) : elvis_real(1)) * evaluation.speed * candidate.half_width);
    // Rounding moves the root along the ray, by a fraction of its bound, in each of the elements that share a face; and so does what the
    // line leaves out.
    const elvis_real excess = core_excess(root.xi.x, root.xi.y, root.xi.z);
    const elvis_real along_ray =
        evaluation.speed * (elvis_real(0.25LF) * candidate.half_width + elvis_real(0.5LF) * change * distance / abs(interval.slope));
    root.is_inside = excess <= CORE_CONSTRAINT_NORM * (elvis_real(2) * interval.beyond + along_ray);
    root.is_surely_inside = excess <= -CORE_CONSTRAINT_NORM * (interval.beyond + along_ray);
#if ELVIS_HAS_INSIDE
    const core_inside own = evaluation.own;
    const elvis_real own_excess = own.value + dot(own.slope, to_root), own_size = core_model_norm1(own.slope);
    const elvis_real own_error = own.rounding + core_inside_bend(own, distance);
    root.is_inside = root.is_inside && own_excess <= own_size * (elvis_real(2) * interval.beyond + along_ray) + own_error;
    root.is_surely_inside = root.is_surely_inside && own_excess <= -own_size * (interval.beyond + along_ray) - own_error;
#endif
    return root;
}
