#include <core/segment/colleague.hpp>

#include <Eigen/Eigenvalues>

namespace elvis::segment {

std::vector<double> roots_by_colleague(const Polynomial<double>& chebyshev, double value) {
    Polynomial<double> p = chebyshev;
    p[0] -= value;
    double largest = 0;
    for (const double c : p.c) {
        largest = std::max(largest, std::abs(c));
    }
    int n = p.degree;
    while (n > 0 && std::abs(p[n]) <= roundoff<double> * largest) {
        --n;
    }
    if (n == 0) {
        return {};
    }
    // x T_k = (T_{k+1} + T_{|k-1|}) / 2, transposed to be of upper Hessenberg form.
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (int k = 0; k + 1 < n; ++k) {
        matrix(k + 1, k) = k == 0 ? 1 : 0.5;
        matrix(k, k + 1) = 0.5;
    }
    for (int k = 0; k < n; ++k) {
        matrix(k, n - 1) -= (n == 1 ? 1 : 0.5) * p[k] / p[n];
    }
    std::vector<double> roots;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, false);
    // What rounding moves a root at an end.
    const double slack = 16 * n * roundoff<double>;
    for (const std::complex<double>& eigenvalue : solver.eigenvalues()) {
        const double t = 0.5 * (1 + eigenvalue.real());
        if (eigenvalue.imag() == 0 && t >= -slack && t <= 1 + slack) {
            roots.push_back(std::clamp(t, 0.0, 1.0));
        }
    }
    std::sort(roots.begin(), roots.end());
    return roots;
}

} // namespace elvis::segment
