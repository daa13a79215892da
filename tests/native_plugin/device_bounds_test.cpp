/*
 * The bounds that kernels see of native fields: certified where the plugin can tell, else estimated, and labelled.
 */
#include "../defaults/bound_rows.hpp"
#include "volume_fixture.hpp"

#include <core/volume/field/weighted_derivatives.hpp>
#include <tests/support/device.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::ClassPlan;
using test::TestVolume;

namespace {

/** Largest sum of slopes and size less the offset at random points, by the CPU. */
std::array<double, 2> sample(const RuntimeVolume& volume, std::uint32_t field, std::uint64_t element, native::Shape shape,
                             double offset) {
    test::Random random(3);
    std::vector<double> points;
    // At the apex of a curved pyramid the Jacobian depends on the direction: slopes of what it transforms have no bound there.
    const bool has_wild_apex = shape == native::Shape::pyramid && volume.fields()[field].transform != ELVIS_TRANSFORM_NONE;
    while (points.size() < 600) {
        const native::Point xi = random.point(shape);
        if (has_wild_apex && xi[2] > 0.7)
            continue;
        points.insert(points.end(), xi.begin(), xi.end());
    }
    const std::size_t n_components = volume.fields()[field].n_components;
    std::vector<double> values(200 * n_components), gradients(600 * n_components);
    volume.evaluate_field(field, 0, element, points, values, gradients);
    std::array<double, 2> largest{};
    for (std::size_t i = 0; i < values.size(); i += n_components) {
        largest[0] =
            std::max(largest[0], std::abs(gradients[3 * i]) + std::abs(gradients[3 * i + 1]) + std::abs(gradients[3 * i + 2]));
        largest[1] = std::max(largest[1], std::abs(values[i] - offset));
    }
    return largest;
}

} // namespace

TEST_CASE("bounds on the device are certified where there are any, else estimated, and hold") {
    std::vector<ClassPlan> classes;
    for (const native::Space& space : test::spaces_of_order(2))
        classes.push_back({space, {space, space}});
    const TestVolume file(classes,
                          {{"f", "", 1, native::Continuity::discontinuous, {}, std::nan("")},
                           {"u", "", 3, native::Continuity::discontinuous, native::Transform::covariant, std::nan("")}});
    const RuntimeVolume volume = file.open();
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        DeviceVolume data(test::validated_device(), volume, precision, nullptr);
        for (std::uint32_t field = 0; field < (precision == Precision::float64 ? 1u : 2u); ++field) {
            const std::uint32_t n_components = volume.fields()[field].n_components;
            data.select(field, 0, std::vector<double>(n_components, 0.25));
            data.provide_derivative_bounds();
            for (std::uint32_t i = 0; i < classes.size(); ++i) {
                INFO(test::describe(classes[i].geometry));
                const auto rows = test::bound_rows(test::validated_device(), data, i, 3, n_components);
                const bool is_bounded = field == 0;
                for (std::size_t element = 0; element < 3; ++element) {
                    const auto& row = rows[element * n_components];
                    CHECK(row[3] == (is_bounded ? 0 : 1));
                    const auto sampled =
                        sample(volume, field, file.first_element(i) + element, classes[i].geometry.shape, data.field_offset(0));
                    CHECK(row[1] >= sampled[0]);
                    CHECK(row[2] >= sampled[1]);
                    CHECK(row[0] < 1e6);
                    if (is_bounded) {
                        DerivativeBounds bound;
                        (void)read_weighted_derivatives(volume, i, field, 0, file.first_element(i) + element, 1,
                                                        std::span(&bound, 1));
                        // Rounded up.
                        CHECK(row[0] >= bound.second);
                        CHECK(row[0] <= bound.second * (1 + 1e-6));
                        CHECK(row[1] >= bound.first);
                    }
                }
            }
        }
    }
    CHECK(test::validated_device().validation_messages().empty());
}
