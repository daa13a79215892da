// The error of a prediction of Newton's method that started from a point of the element (or face) at distance d from the solution
// is at most C d^2, where the curvature C is half the Lipschitz constant of the Jacobian, relative to the Jacobian: all in the
// maximum norm of reference coordinates (the remainder of Newton's method; e.g. J. Stoer, R. Bulirsch, Introduction to Numerical
// Analysis, theorem 5.3.2). C is bounded for each element when a volume is opened (core/volume/element/mapping_curvature.hpp), or
// measured where that cannot be (element/linearize.comp).

#ifndef CORE_PREDICTION
#define CORE_PREDICTION

#define CORE_UNKNOWN_CURVATURE elvis_real(1e9LF)

// Bound of the error of a prediction, from the length of the step that led to it.
elvis_real core_prediction_error(elvis_real curvature, elvis_real step) {
    // d is at most step + C d^2, and no two points are farther apart than 2.
    const elvis_real discriminant = elvis_real(1) - elvis_real(4) * curvature * step;
    const elvis_real near = elvis_real(2) * step / (elvis_real(1) + sqrt(max(discriminant, elvis_real(0))));
    const elvis_real d = discriminant > elvis_real(0) ? min(near, elvis_real(2)) : elvis_real(2);
    return curvature * d * d;
}

// Bound of d for any solution no farther than `farthest` from where the step began. There may be others than the near one:
// d <= step + C d^2 holds from the second root on, too.
elvis_real core_prediction_distance_within(elvis_real curvature, elvis_real step, elvis_real farthest) {
    const elvis_real discriminant = elvis_real(1) - elvis_real(4) * curvature * step;
    // The roots are 2 step over this, and this over 2 C.
    const elvis_real root_sum = elvis_real(1) + sqrt(max(discriminant, elvis_real(0)));
    const bool is_near = discriminant > elvis_real(0) && root_sum > elvis_real(2) * curvature * farthest;
    return is_near ? min(elvis_real(2) * step / root_sum, farthest) : farthest;
}

// Of that, as core_prediction_error.
elvis_real core_prediction_error_within(elvis_real curvature, elvis_real step, elvis_real farthest) {
    const elvis_real d = core_prediction_distance_within(curvature, step, farthest);
    return curvature * d * d;
}

#endif
