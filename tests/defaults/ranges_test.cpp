/*
 * Sampled ranges, for plugins that give none, and extrema from refined samples, for those that evaluate on the device alone.
 */
#include "points.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/render/field/sampled_range.hpp>

#include <catch2/catch.hpp>

#include <iostream>

using namespace elvis;

TEST_CASE("the sampled range of a field without ranges is close to the true one, and inside it") {
    const RuntimeVolume volume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
    REQUIRE_FALSE(volume.has_field_ranges());
    DeviceVolume on_device(test::validated_device(), volume, Precision::float64, nullptr);
    // One Gaussian of height 2 and a wave of amplitude 1, both with their extremes inside the box. Samples lie 1/9 apart: the
    // maximum of a Gaussian of width 0.7 is missed by at most 2 (3 (1/18)^2) / 0.7^2 = 0.04.
    on_device.select(volume.field_index("mixed"), 0, {0, 0, 0});
    const std::vector<FieldRange> ranges = ranges_from_samples(test::validated_device(), volume, on_device, 3);
    REQUIRE(ranges.size() == 3);
    std::cout << "sampled ranges: wave [" << ranges[0].lower << ", " << ranges[0].upper << "] of [-1, 1], bump up to "
              << ranges[1].upper << " of 2\n";
    CHECK(ranges[0].lower >= -1);
    CHECK(ranges[0].lower < -0.995);
    CHECK(ranges[0].upper <= 1);
    CHECK(ranges[0].upper > 0.995);
    CHECK(ranges[1].lower >= 0);
    CHECK(ranges[1].upper <= 2);
    CHECK(ranges[1].upper > 1.96);
}

TEST_CASE("refined samples find the extrema of a field that is known on the device alone") {
    const RuntimeVolume volume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
    REQUIRE_FALSE(volume.has_evaluation());
    const bool is_single = GENERATE(true, false);
    DeviceVolume on_device(test::validated_device(), volume, is_single ? Precision::float32 : Precision::float64, nullptr);
    on_device.select(volume.field_index("mixed"), 0, {0, 0, 0});
    const auto extrema_of = [&](int component) {
        return extrema_from_samples(test::validated_device(), volume, on_device, component, 3);
    };
    // Samples are 3^-9 of an element apart in the end, and the field is flat there.
    const double tolerance = is_single ? 2e-6 : 1e-8;
    const FieldExtrema wave = extrema_of(0), bump = extrema_of(1);
    std::cout << "refined samples: wave [" << wave.minimum.value << ", " << wave.maximum.value << "], bump up to "
              << bump.maximum.value - 2 << " of 2\n";
    CHECK(wave.minimum.value == Approx(-1).margin(tolerance));
    CHECK(wave.maximum.value == Approx(1).margin(tolerance));
    CHECK(bump.maximum.value == Approx(2).margin(tolerance));
    CHECK(bump.certainty == ELVIS_ESTIMATED);

    // A magnitude is no less than its components where they are largest.
    const FieldExtrema magnitude = extrema_of(-1);
    CHECK(magnitude.maximum.value >= 2 - tolerance);
    CHECK(magnitude.maximum.value <= std::sqrt(6.0) * 2);
    CHECK(magnitude.minimum.value >= 0);
}
