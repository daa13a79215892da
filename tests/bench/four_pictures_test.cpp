// The suite of four pictures of any volume, small.
#include <core/bench/four_pictures.hpp>
#include <core/bench/waves.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace elvis;

TEST_CASE("the suite of four pictures draws each of them, and something is seen") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    const Device device("");
    generated_volume(
        registry, folder, "cube",
        R"({"generator":1,"mesh":"waves","field":"waves","elements":2,"shape":"hexahedron","geometry_order":1,"order":2})");
    std::vector<PictureRow> rows;
    bench_four_pictures(device, registry, (folder.path() / "cube.h5").string(), 64,
                        [&](const PictureRow& row) { rows.push_back(row); });
    REQUIRE(rows.size() == 4);
    const char* const names[] = {"slice", "boundary", "isosurface", "volume"};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        INFO(names[i]);
        CHECK(rows[i].name == names[i]);
        CHECK(rows[i].size == (i < 2 ? 64u : 32u));
        // The bounds' sphere fits the picture; the slice goes through its middle.
        CHECK(rows[i].covered_pixels > std::uint64_t{rows[i].size} * rows[i].size / 10);
        CHECK(rows[i].covered_pixels < std::uint64_t{rows[i].size} * rows[i].size);
        CHECK(rows[i].counts.field_evaluations > 0);
        CHECK(rows[i].milliseconds > 0);
    }
}
