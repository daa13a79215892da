/*
 * Sampled ranges, for plugins that give none.
 */
#include "points.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/render/field_range.hpp>

#include <catch2/catch.hpp>

#include <iostream>

using namespace elvis;

TEST_CASE("the sampled range of a field without ranges is close to the true one, and inside it") {
    const RuntimeVolume volume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
    REQUIRE_FALSE(volume.has_field_ranges());
    DeviceVolume on_device(test::device(), volume, Precision::float64, nullptr);
    // One Gaussian of height 2 and a wave of amplitude 1, both with their extremes inside the box. Samples lie 1/9 apart: the
    // maximum of a Gaussian of width 0.7 is missed by at most 2 (3 (1/18)^2) / 0.7^2 = 0.04.
    on_device.select(volume.field_index("mixed"), 0, {0, 0, 0});
    const std::vector<FieldRange> ranges = ranges_from_samples(test::device(), volume, on_device, 3);
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
