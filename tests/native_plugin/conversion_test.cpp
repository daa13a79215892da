/*
 * The device coefficients describe the same function as the native ones.
 */
#include "spaces.hpp"

#include <elvis/native/conversion.hpp>

#include <Eigen/Dense>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

namespace {

using namespace elvis;
using native::device::Conversion;
using native::device::DeviceSpace;

/** Sum over the device basis, by its definition in collapsed coordinates; coefficients in the order of the record. */
double evaluate_device(const DeviceSpace& space, const std::vector<double>& coefficients, const native::Point& eta) {
    double sum = 0;
    std::size_t i = 0;
    const auto add = [&](int p, int q, int r) {
        sum += coefficients[i++] * space.a(p, eta[0]) * space.b(p, q, eta[1]) * space.c(p, q, r, eta[2]);
    };
    if (space.shape == native::Shape::hexahedron) {
        for (int r = 0; r <= space.r_max; ++r)
            for (int q = 0; q <= space.q_max; ++q)
                for (int p = 0; p <= space.p_max; ++p)
                    add(p, q, r);
    } else if (space.shape == native::Shape::prism) {
        for (int q = 0; q <= space.q_max; ++q)
            for (int p = 0; p <= space.p_max; ++p)
                for (int r = 0; r < space.n_r(p, q); ++r)
                    add(p, q, r);
    } else {
        for (int p = 0; p <= space.p_max; ++p)
            for (int q = 0; q < space.n_q(p); ++q)
                for (int r = 0; r < space.n_r(p, q); ++r)
                    add(p, q, r);
    }
    REQUIRE(i == coefficients.size());
    return sum;
}

/** Largest difference between native and device value over random functions and points, relative to the largest value. */
double conversion_error(const native::Space& space, test::Random& random) {
    const Conversion conversion(space);
    double error = 0;
    double scale = 0;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const std::vector<double> native_coefficients = random.numbers(native::n_modes(space));
        std::vector<double> device_coefficients(native_coefficients.size());
        conversion.apply(native_coefficients, device_coefficients);
        for (int i = 0; i < 20; ++i) {
            const native::Point xi = random.point(space.shape);
            const double expected = native::evaluate(space, native_coefficients, xi);
            const double actual =
                evaluate_device(conversion.device_space(), device_coefficients, native::collapse(space.shape, xi));
            error = std::max(error, std::abs(actual - expected));
            scale = std::max(scale, std::abs(expected));
        }
    }
    return error / scale;
}

} // namespace

TEST_CASE("device coefficients give the native function in every basis") {
    test::Random random(1);
    for (const std::uint32_t order : {0u, 1u, 2u, 3u, 4u, 6u, 8u, 11u, 14u}) {
        double largest = 0;
        for (const native::Space& space : test::spaces_of_order(order)) {
            INFO(test::describe(space));
            const double error = conversion_error(space, random);
            // Round-off of the native evaluation of random functions grows with the order: 1e-15 times some hundreds.
            CHECK(error < 2e-13);
            largest = std::max(largest, error);
        }
        std::cout << "conversion, order " << order << ": largest relative error " << largest << "\n";
    }
}

TEST_CASE("device coefficients give the native function where orders differ between directions") {
    test::Random random(2);
    for (const native::Space& space : test::spaces_of_mixed_order()) {
        INFO(test::describe(space));
        CHECK(conversion_error(space, random) < 2e-13);
    }
}

TEST_CASE("a constant is the first device coefficient alone") {
    for (const native::Space& space : test::spaces_of_order(3)) {
        INFO(test::describe(space));
        // The native coefficients of 1, by solving at random points.
        const auto n = static_cast<Eigen::Index>(native::n_modes(space));
        test::Random random(3);
        Eigen::MatrixXd values(2 * n, n);
        std::vector<double> modes(native::n_modes(space));
        for (Eigen::Index i = 0; i < 2 * n; ++i) {
            native::evaluate_modes(space, random.point(space.shape), modes);
            values.row(i) = Eigen::Map<const Eigen::RowVectorXd>(modes.data(), n);
        }
        const Eigen::VectorXd one = values.colPivHouseholderQr().solve(Eigen::VectorXd::Ones(2 * n));
        std::vector<double> device(native::n_modes(space));
        Conversion(space).apply(std::span(one.data(), modes.size()), device);
        CHECK(device[0] == Approx(1).epsilon(1e-11));
        for (std::size_t i = 1; i < device.size(); ++i)
            CHECK(std::abs(device[i]) < 1e-11);
    }
}

// From order 2: the 5 modes of a linear pyramid take two rows whatever one does.
TEST_CASE("padding of device records stays within the promised memory") {
    const auto ratio = [](native::Shape shape, std::uint32_t order, std::size_t width) {
        const native::Space space{shape, native::Basis::modified, {order, order, order}};
        const DeviceSpace device(space);
        return static_cast<double>(4 * device.n_rows(width)) / static_cast<double>(width * native::n_modes(space));
    };
    using native::Shape;
    for (const std::size_t width : {1u, 3u}) {
        for (std::uint32_t order = 2; order <= 14; ++order) {
            INFO("order " << order << ", width " << width);
            std::cout << "padding, order " << order << ", " << width << " numbers a mode: hexahedron "
                      << ratio(Shape::hexahedron, order, width) << ", prism " << ratio(Shape::prism, order, width)
                      << ", pyramid " << ratio(Shape::pyramid, order, width) << ", tetrahedron "
                      << ratio(Shape::tetrahedron, order, width) << "\n";
            for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron})
                CHECK(ratio(shape, order, width) <= 1.35);
        }
    }
}
