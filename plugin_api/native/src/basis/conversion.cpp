#include <elvis/native/conversion.hpp>

#include "matrix.hpp"
#include "projector.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace elvis::native::device {
namespace {

using native::Basis;
using native::Point;
using native::Shape;
using native::Space;

/** Values of chosen native modes at chosen reference points: entry (point, mode). */
Matrix sample_modes(const Space& space, const std::vector<Point>& points, const std::vector<std::size_t>& modes) {
    Matrix result(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(modes.size()));
    std::vector<double> values(native::n_modes(space));
    for (std::size_t i = 0; i < points.size(); ++i) {
        native::evaluate_modes(space, points[i], values);
        for (std::size_t m = 0; m < modes.size(); ++m)
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(m)) = values[modes[m]];
    }
    return result;
}

/** All n, n + stride, ...: the modes along one axis of a tensor product. */
std::vector<std::size_t> along(std::size_t count, std::size_t stride) {
    std::vector<std::size_t> modes(count);
    for (std::size_t i = 0; i < count; ++i)
        modes[i] = i * stride;
    return modes;
}

/** Matrix from the modes sampled along one collapsed direction, through the corner (-1,-1,-1), to the device factors there. */
template <class Factor> Matrix axis_matrix(const Space& space, std::size_t direction, std::size_t stride, Factor factor) {
    const std::size_t n = space.order[direction] + 1;
    const GaussPoints nodes(n);
    std::vector<Point> points;
    for (const double node : nodes.points) {
        Point eta{-1, -1, native::dimension(space.shape) == 2 ? 0.0 : -1.0};
        eta[direction] = node;
        points.push_back(native::expand(space.shape, eta));
    }
    return fit_matrix(nodes, n, factor) * sample_modes(space, points, along(n, stride));
}

/** Value of the first mode at the corner (-1,-1,-1), where the first functions of all directions do not vanish. */
double corner_value(const Space& space) {
    std::vector<double> values(native::n_modes(space));
    native::evaluate_modes(space, {-1, -1, -1}, values);
    return values[0];
}

/** Matrix for the chosen native modes from their values on the projector's grid of points, in the plane xi2 = -1 for prisms; a
 * triangle's second direction is the projector's third. */
Matrix projected_matrix(const Space& space, const Projector& projector, const std::vector<std::size_t>& modes) {
    std::vector<Point> points;
    for (const Point& eta : projector.grid())
        points.push_back(native::expand(space.shape, space.shape == Shape::triangle ? Point{eta[0], eta[2], 0} : eta));
    const Matrix samples = sample_modes(space, points, modes);
    Matrix result(static_cast<Eigen::Index>(modes.size()), static_cast<Eigen::Index>(modes.size()));
    std::vector<double> values(points.size());
    std::vector<double> coefficients(modes.size());
    for (Eigen::Index mode = 0; mode < samples.cols(); ++mode) {
        for (std::size_t i = 0; i < points.size(); ++i)
            values[i] = samples(static_cast<Eigen::Index>(i), mode);
        projector.project(values, coefficients);
        for (std::size_t i = 0; i < coefficients.size(); ++i)
            result(static_cast<Eigen::Index>(i), mode) = coefficients[i];
    }
    return result;
}

/** Prism: native modes (p, q, r) lie p outermost, r fastest, r <= R - p. Entry [q][pr] of the array. */
std::vector<std::size_t> gather_prism(const DeviceSpace& device) {
    const auto n_q = static_cast<std::size_t>(device.n_q(0));
    std::vector<std::size_t> gather;
    for (std::size_t q = 0; q < n_q; ++q) {
        std::size_t first = 0;
        for (int p = 0; p <= device.p_max; ++p) {
            const auto n_r = static_cast<std::size_t>(device.n_r(p, 0));
            for (std::size_t r = 0; r < n_r; ++r)
                gather.push_back(first + q * n_r + r);
            first += n_q * n_r;
        }
    }
    return gather;
}

} // namespace

/** Square matrices for the axes 0 (fastest), 1 and 2 of the array. */
struct Conversion::Axes : std::array<Matrix, 3> {};

Conversion::Conversion(const Space& space) : m_device(space), m_gather(native::n_modes(space)) {
    assert(m_device.n_modes() == m_gather.size());
    std::iota(m_gather.begin(), m_gather.end(), std::size_t{0});
    m_axes = std::make_shared<const Axes>(build_axes(space, m_device, m_gather));
    find_native_one();
}

Conversion::Axes Conversion::build_axes(const Space& space, const DeviceSpace& device, std::vector<std::size_t>& gather) {
    Axes axes{{Matrix::Identity(1, 1), Matrix::Identity(1, 1), Matrix::Identity(1, 1)}};
    if (gather.size() == 1)
        return axes;
    const std::size_t n_p = space.order[0] + 1;
    const std::size_t n_q = space.order[1] + 1;
    const std::size_t n_r = space.order[2] + 1;
    const auto a = [&device](std::size_t p, double eta) { return device.a(static_cast<int>(p), eta); };
    const auto b = [&device](std::size_t q, double eta) { return device.b(0, static_cast<int>(q), eta); };
    const auto c = [&device](std::size_t r, double eta) { return device.c(0, 0, static_cast<int>(r), eta); };
    if (space.shape == Shape::quadrilateral) {
        axes[0] = axis_matrix(space, 0, 1, a) / corner_value(space);
        axes[1] = axis_matrix(space, 1, n_p, b);
    } else if (space.shape == Shape::triangle) {
        axes[0] = projected_matrix(space, Projector(device, space.order[1]), gather);
    } else if (space.shape == Shape::hexahedron) {
        static_cast<std::array<Matrix, 3>&>(axes) = {axis_matrix(space, 0, 1, a), axis_matrix(space, 1, n_p, b),
                                                     axis_matrix(space, 2, n_p * n_q, c)};
        // The three lines each carry the other directions' first functions at the corner: their product is too large twice.
        axes[0] /= std::pow(corner_value(space), 2);
    } else if (space.shape == Shape::pyramid && space.basis == Basis::tensor) {
        static_cast<std::array<Matrix, 3>&>(axes) = {axis_matrix(space, 2, 1, c), axis_matrix(space, 1, n_r, b),
                                                     axis_matrix(space, 0, n_q * n_r, a)};
        axes[0] /= std::pow(corner_value(space), 2);
    } else if (space.shape == Shape::prism) {
        gather = gather_prism(device);
        DeviceSpace triangle = device;
        triangle.q_max = 0;
        const std::vector<std::size_t> modes(gather.begin(), gather.begin() + static_cast<std::ptrdiff_t>(triangle.n_modes()));
        axes[0] = projected_matrix(space, Projector(triangle, space.order[2]), modes) / corner_value(space);
        axes[1] = axis_matrix(space, 1, n_r, b);
    } else {
        axes[0] = projected_matrix(space, Projector(device, native::collapsed_order(space)[2]), gather);
    }
    return axes;
}

void Conversion::find_native_one() {
    // The first device function is 1: the first columns of the inverses. Bases with vertex modes have whole numbers there.
    std::array<Eigen::VectorXd, 3> along_axis;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Matrix& matrix = (*m_axes)[axis];
        along_axis[axis] = matrix.partialPivLu().solve(Eigen::VectorXd::Unit(matrix.rows(), 0));
        for (double& entry : along_axis[axis])
            entry = std::abs(entry - std::round(entry)) < 1e-12 ? std::round(entry) : entry;
    }
    m_native_one.resize(m_gather.size());
    std::size_t i = 0;
    for (const double third : along_axis[2])
        for (const double second : along_axis[1])
            for (const double first : along_axis[0])
                m_native_one[m_gather[i++]] = third * second * first;
}

void Conversion::apply(std::span<const double> native_coefficients, std::span<double> device_coefficients) const {
    using Eigen::Index;
    assert(native_coefficients.size() == n_native() && device_coefficients.size() == n_native());
    const Index n_0 = (*m_axes)[0].rows();
    const Index n_1 = (*m_axes)[1].rows();
    const Index n_2 = (*m_axes)[2].rows();
    thread_local std::vector<double> first;
    thread_local std::vector<double> second;
    first.resize(m_gather.size());
    second.resize(m_gather.size());
    for (std::size_t i = 0; i < m_gather.size(); ++i)
        first[i] = native_coefficients[m_gather[i]];
    // One mode in a direction is the constant 1 in every basis but for the scale, which the first axis holds.
    Eigen::Map<Matrix>(second.data(), n_2 * n_1, n_0).noalias() =
        Eigen::Map<const Matrix>(first.data(), n_2 * n_1, n_0) * (*m_axes)[0].transpose();
    if (n_1 > 1) {
        for (Index k = 0; k < n_2; ++k)
            Eigen::Map<Matrix>(first.data() + k * n_1 * n_0, n_1, n_0).noalias() =
                (*m_axes)[1] * Eigen::Map<const Matrix>(second.data() + k * n_1 * n_0, n_1, n_0);
        first.swap(second);
    }
    if (n_2 > 1) {
        Eigen::Map<Matrix>(first.data(), n_2, n_1 * n_0).noalias() =
            (*m_axes)[2] * Eigen::Map<const Matrix>(second.data(), n_2, n_1 * n_0);
        first.swap(second);
    }
    std::copy(second.begin(), second.end(), device_coefficients.begin());
}

void clean_apex(const DeviceSpace& space, std::span<const double> coefficients, std::span<double> modes) {
    if (space.shape != native::Shape::pyramid || space.basis != native::Basis::tensor)
        return;
    double largest = 0;
    for (const double coefficient : coefficients)
        largest = std::max(largest, std::abs(coefficient));
    const auto stride = static_cast<std::size_t>(space.n_r(0, 0));
    for (std::size_t i = stride; i < modes.size(); i += stride)
        if (std::abs(modes[i]) < 1e-12 * largest)
            modes[i] = 0;
}

} // namespace elvis::native::device
