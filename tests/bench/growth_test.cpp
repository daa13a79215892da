// The suites growth and goals at sizes that take seconds.
#include <core/bench/goals.hpp>
#include <core/bench/growth.hpp>
#include <core/convert/convert.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>

using namespace elvis;

TEST_CASE("a pixel costs hardly more where there are more elements, nor does a coefficient take more memory") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    const Device device("");
    GrowthOptions options;
    options.elements_a_side = {4, 8, 16};
    options.orders = {2};
    options.size = 96;
    std::map<std::string, std::vector<GrowthRow>> pictures;
    bench_growth(device, registry, folder, options, [&](const GrowthRow& row) { pictures[row.picture].push_back(row); });
    REQUIRE(pictures.size() == 2);
    for (const auto& [name, rows] : pictures) {
        INFO(name);
        REQUIRE(rows.size() == options.elements_a_side.size());
        for (const GrowthRow& row : rows) {
            CHECK(row.hit_pixels > 1000);
            CHECK(row.nanoseconds_a_pixel > 0);
            CHECK(row.n_coefficients == row.n_elements * (27 + 3 * 8));
            // In single precision each takes four bytes, and hierarchies and pictures come on top.
            CHECK(row.device_bytes_a_coefficient() > 4);
        }
        CHECK(rows.front().n_elements == 64);
        CHECK(rows.back().n_elements == 4096);
        // 64 times the elements: counts are the same on every machine, times are not.
        CHECK(rows.back().evaluations_a_pixel < 2 * rows.front().evaluations_a_pixel);
        CHECK(rows.back().newton_steps_a_pixel < 2 * rows.front().newton_steps_a_pixel + 1);
        CHECK(rows.back().device_bytes_a_coefficient() < rows.front().device_bytes_a_coefficient());
    }
}

TEST_CASE("pictures that have a goal are timed by the device's own clock") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    const Device device("");
    const std::string volume = (folder.path() / "canister.h5").string();
    const std::string source = test::data_file("elvis/bulletH1P2.dat");
    convert(SourceVolume(registry.converter_for(source), {source}), volume, {}, {});
    std::vector<GoalRow> rows;
    bench_goals(device, registry, volume, 180, [&](const GoalRow& row) { rows.push_back(row); });
    REQUIRE(rows.size() == 2);
    CHECK(rows[0].name == "cut plane");
    CHECK(rows[0].width == 180);
    CHECK(rows[0].height == 80);
    CHECK(rows[0].goal_milliseconds == 0.25);
    CHECK(rows[0].covered_pixels > 180 * 80 / 2);
    CHECK(rows[1].name == "volume");
    CHECK(rows[1].width == 172);
    CHECK(rows[1].height == 86);
    CHECK(rows[1].goal_milliseconds == 20);
    CHECK(rows[1].covered_pixels > 1000);
    for (const GoalRow& row : rows) {
        INFO(row.name);
        REQUIRE(row.device_milliseconds); // Lavapipe has a clock, as GPUs do.
        CHECK(*row.device_milliseconds > 0);
        // The device works while the host waits; a quarter more for clocks that differ.
        CHECK(*row.device_milliseconds < 1.25 * row.wall_milliseconds);
    }
}
