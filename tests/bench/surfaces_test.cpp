// The suite of surfaces at a size that takes a second.
#include <core/bench/surfaces.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <set>

using namespace elvis;

TEST_CASE("the suite of surfaces measures what it says and writes it down") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    const Device device("");
    SurfacesOptions options;
    options.elements_a_side = 2;
    options.order = 2;
    options.size = 64;
    options.sizes = {32, 64};
    options.orders = {2};
    options.elements = {2, 3};
    options.contour_elements_a_side = 2;
    options.contour_orders = {2};
    options.most_subdivisions = 4;
    std::size_t n_reported = 0;
    const auto rows = bench_surfaces(device, registry, folder, options, 500, [&](const SurfacesRow&) { ++n_reported; });
    CHECK(n_reported == rows.size());
    std::set<std::string> series, surfaces;
    std::uint64_t before = 0;
    int n_curves = 0;
    for (const SurfacesRow& row : rows) {
        INFO(row.series << ", " << row.surface);
        series.insert(row.series);
        surfaces.insert(row.surface);
        CHECK(row.hit_pixels > 0);
        CHECK(row.device_bytes >= row.memory.field_bytes + row.memory.geometry_bytes + row.memory.hierarchy_bytes);
        CHECK((row.contour_pixels > 0) == (row.surface == "plane, 10 contours"));
        if (row.series == "subdivisions") {
            if (row.subdivisions == 0) {
                before = row.undecided_pixels;
                n_curves += 1;
            }
            CHECK(row.undecided_pixels <= before);
            before = row.undecided_pixels;
        }
    }
    CHECK(n_curves == 2);
    CHECK(series == std::set<std::string>{"subdivisions", "size", "order", "elements"});
    CHECK(surfaces.size() == 7);

    const std::filesystem::path output = folder.path() / "plots";
    write_surfaces(output, rows);
    std::ifstream file(output / "surfaces.csv");
    std::size_t n_lines = 0;
    for (std::string line; std::getline(file, line); ++n_lines) {
    }
    CHECK(n_lines == rows.size() + 1);
    for (const char* name : {"undecided-by-subdivisions", "time-by-subdivisions", "time-by-size", "time-by-order",
                             "time-by-elements", "memory-by-size", "memory-by-order", "memory-by-elements"}) {
        CHECK(std::filesystem::file_size(output / (std::string(name) + ".svg")) > 1000);
    }
}
