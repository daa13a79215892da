/*
 * Estimated bounds of derivatives, for plugins that give none.
 */
#include "../defaults/bound_rows.hpp"
#include "../defaults/checked_snippet.hpp"

#include <core/plugin_host/plugin.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::Point;

namespace {

/** Largest H, L and F at sampled points of each element: second derivatives from differences of gradients in float64. */
std::vector<std::array<double, 3>> sampled(const DeviceVolume& data, std::uint32_t n_elements) {
    constexpr double h = 1e-3;
    const auto xis = test::points_in(ELVIS_SHAPE_HEXAHEDRON, 60, true);
    std::vector<test::CheckPoint> points;
    for (std::uint32_t element = 0; element < n_elements; ++element) {
        for (const Point& xi : xis) {
            for (std::size_t k = 0; k < 4; ++k) {
                Point moved = xi;
                if (k > 0) {
                    moved[k - 1] += moved[k - 1] > 0 ? -h : h;
                }
                points.push_back({moved, element, 0});
            }
        }
    }
    const auto results = test::check_snippet(data.instance(0), Precision::float64, points);
    std::vector<std::array<double, 3>> largest(n_elements);
    for (std::size_t i = 0; i < points.size(); i += 4) {
        double bend = 0, slope = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            slope += std::abs(results[i].gradient[d]);
            for (std::size_t k = 1; k < 4; ++k) {
                bend += std::abs(results[i + k].gradient[d] - results[i].gradient[d]) / h;
            }
        }
        auto& of_element = largest[points[i].element];
        of_element[0] = std::max(of_element[0], bend);
        of_element[1] = std::max(of_element[1], slope);
        of_element[2] = std::max(of_element[2], std::abs(results[i].value));
    }
    return largest;
}

} // namespace

TEST_CASE("estimated bounds hold what is sampled elsewhere, are labelled, and are not much larger") {
    const RuntimeVolume volume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
    REQUIRE_FALSE(volume.has_derivative_bounds());
    const auto n_elements = static_cast<std::uint32_t>(volume.n_elements());
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        for (std::uint32_t field = 0; field < 3; ++field) {
            DeviceVolume exact(test::validated_device(), volume, Precision::float64, nullptr);
            exact.select(field, 0, {0});
            const auto wanted = sampled(exact, n_elements);
            DeviceVolume data(test::validated_device(), volume, precision, nullptr);
            data.select(field, 0, {0});
            data.provide_derivative_bounds();
            const auto rows = test::bound_rows(test::validated_device(), data, 0, n_elements, 1);
            std::array<double, 3> least{1e300, 1e300, 1e300}, largest{};
            for (std::size_t element = 0; element < n_elements; ++element) {
                CHECK(rows[element][3] == 1);
                for (std::size_t i = 0; i < 3; ++i) {
                    least[i] = std::min(least[i], rows[element][i] / wanted[element][i]);
                    largest[i] = std::max(largest[i], rows[element][i] / wanted[element][i]);
                }
            }
            std::cout << "estimated bounds over sampled maxima, field " << volume.fields()[field].name
                      << (precision == Precision::float64 ? ", float64" : ", float32") << ": H " << least[0] << " to "
                      << largest[0] << ", L " << least[1] << " to " << largest[1] << ", F " << least[2] << " to " << largest[2]
                      << "\n";
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(least[i] > 1);
                CHECK(largest[i] < 4);
            }
        }
    }
}

TEST_CASE("bounds are those of the selected field, whatever was selected before") {
    const RuntimeVolume volume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
    const auto n_elements = static_cast<std::uint32_t>(volume.n_elements());
    const auto rows_of = [&](DeviceVolume& data, std::uint32_t field) {
        data.select(field, 0, std::vector<double>(volume.fields()[field].n_components, 0.0));
        data.provide_derivative_bounds();
        data.provide_derivative_bounds();
        return test::bound_rows(test::validated_device(), data, 0, n_elements, volume.fields()[field].n_components);
    };
    DeviceVolume one(test::validated_device(), volume, Precision::float32, nullptr);
    const auto first = rows_of(one, 0);
    const auto vector = rows_of(one, 3);
    CHECK(vector.size() == 3 * first.size());
    // Component 1 of the vector is the Gaussian of field 1.
    DeviceVolume other(test::validated_device(), volume, Precision::float32, nullptr);
    const auto second = rows_of(other, 1);
    for (std::size_t element = 0; element < n_elements; ++element) {
        CHECK(vector[3 * element + 1][1] == Approx(second[element][1]).epsilon(1e-3));
    }
    CHECK(rows_of(one, 0) == first);
    CHECK(first != second);
}
