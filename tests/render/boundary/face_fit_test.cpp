// Faces that are polynomials are found to be such in double precision, whatever their order.

#include <core/volume/boundary/face_fit.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <vector>

namespace {

/** A bent face of the order: coordinates of about 1. */
std::vector<double> bent_face(std::span<const double> points, std::size_t n_points, bool is_triangle, int order) {
    std::vector<double> positions;
    for (std::size_t k = 0; k < n_points; ++k) {
        const double* uv = points.data() + 2 * (k + (is_triangle ? n_points : 0));
        const double slant = 0.6 * uv[0] + 0.3 * uv[1];
        positions.insert(positions.end(), {uv[0], uv[1] - 0.2 * std::pow(slant, order), 0.3 * std::pow(slant - 0.1, order)});
    }
    return positions;
}

} // namespace

TEST_CASE(
    "Polynomials of orders 1 to 10 go through the points of a face within some roundings, as quadrilaterals and triangles") {
    for (int order = 1; order <= 10; ++order) {
        const elvis::FaceFit fit(order);
        for (const bool is_triangle : {false, true}) {
            const std::vector<double> positions = bent_face(fit.points(), fit.n_points(), is_triangle, order);
            std::vector<double> coefficients(3 * fit.n_coefficients());
            const double misfit = fit.fit(is_triangle, positions, coefficients);
            std::printf("order %d, %s: %.1e\n", order, is_triangle ? "triangle" : "quadrilateral", misfit);
            CHECK(misfit < 32 * 0x1p-53);
        }
    }
}
