#include <core/volume/element/bend_form.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Eigenvalues are raised to this share of the largest one: forms stay invertible, and single precision does not lose them. */
constexpr double least_share = 1e-4;
/** For rounding, that of entries to single precision, too. */
constexpr double form_margin = 1 + 1e-5;
/** Of the trace of G, to each of its eigenvalues: more than what single precision loses of N(u)^2. */
constexpr double lost_share = 4e-6;
/** Forms change little after so many steps. */
constexpr int n_steps = 2;

Eigen::Matrix3d matrix_of(const SymmetricMatrix& h) {
    Eigen::Matrix3d matrix;
    matrix << h[0], h[1], h[2], h[1], h[3], h[4], h[2], h[4], h[5];
    return matrix;
}

SymmetricMatrix entries_of(const Eigen::Matrix3d& m) { return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}; }

/** The square root of a symmetric matrix without negative eigenvalues, or of its inverse. */
Eigen::Matrix3d root_of(const Eigen::Matrix3d& matrix, bool of_inverse) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
    const Eigen::Vector3d& values = solver.eigenvalues();
    const Eigen::Array3d roots = values.cwiseMax(least_share * values.maxCoeff()).cwiseSqrt();
    return solver.eigenvectors() * (of_inverse ? roots.inverse() : roots).matrix().asDiagonal() *
           solver.eigenvectors().transpose();
}

/** D^2x(S u, S v) of one of the hessians: a column for each pair of directions. */
Eigen::Matrix<double, 3, 9> seen_through(const Eigen::Matrix3d& s, const MappingHessian& hessian) {
    Eigen::Matrix<double, 3, 9> seen;
    for (int i = 0; i < 3; ++i) {
        const Eigen::Matrix3d h = s.transpose() * matrix_of(hessian[static_cast<std::size_t>(i)]) * s;
        seen.row(i) = Eigen::Map<const Eigen::RowVectorXd>(h.data(), 9);
    }
    return seen;
}

/** The mean of the squares of all components' second derivatives, seen through S. */
Eigen::Matrix3d mean_square(const Eigen::Matrix3d& s, std::span<const MappingHessian> hessians) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const MappingHessian& hessian : hessians) {
        for (const SymmetricMatrix& component : hessian) {
            const Eigen::Matrix3d h = s.transpose() * matrix_of(component) * s;
            sum += h * h / static_cast<double>(hessians.size());
        }
    }
    return sum;
}

} // namespace

/**
 * With G = R^T R, begun as J, and S = R^-1, the second derivatives D^2x(S ., S .) of a single symmetric component H would be
 * bounded by the root of H^2. So R becomes the fourth root of the mean square, times R. Then E is the sum of t t^T over columns
 * t of D^2x(S ., S .): p . t(u, v) is at most sqrt(p E p) |u| |v| by Cauchy and Schwarz. Of several hessians it is the mean,
 * times the largest eigenvalue of the others relative to it.
 */
BendForm bend_form_of(std::span<const MappingHessian> hessians, const std::array<double, 9>& jacobian) {
    Eigen::Matrix3d r = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(jacobian.data());
    for (int step = 0; step < n_steps; ++step) {
        const Eigen::Matrix3d square = mean_square(r.inverse(), hessians);
        if (!square.allFinite() || square.isZero(0)) {
            return {};
        }
        r = root_of(root_of(square, false), false) * r;
    }
    const Eigen::Matrix3d s = r.inverse();
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
    for (const MappingHessian& hessian : hessians) {
        const Eigen::Matrix<double, 3, 9> seen = seen_through(s, hessian);
        mean += seen * seen.transpose() / static_cast<double>(hessians.size());
    }
    if (!mean.allFinite() || mean.isZero(0)) {
        return {};
    }
    const Eigen::Matrix3d root = root_of(mean, false), to_unit = root_of(mean, true);
    double most = 0;
    for (const MappingHessian& hessian : hessians) {
        const Eigen::Matrix<double, 3, 9> seen = to_unit * seen_through(s, hessian);
        most = std::max(most, (seen * seen.transpose()).norm());
    }
    const Eigen::Matrix3d lengths = r.transpose() * r;
    return {entries_of(form_margin * lengths + lost_share * lengths.trace() * Eigen::Matrix3d::Identity()),
            entries_of(form_margin * most * (root * root))};
}

} // namespace elvis
