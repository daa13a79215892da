// The suite that tells what the plugin interface costs: functions by hand draw what the snippet draws.
#include <core/base/error.hpp>
#include <core/bench/interface.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <string>

using namespace elvis;

namespace {

std::string generator(const char* shape, int geometry_order, int order) {
    return R"({"generator":1,"mesh":"waves","field":"waves","elements":3,"shape":")" + std::string(shape) +
           R"(","geometry_order":)" + std::to_string(geometry_order) + R"(,"order":)" + std::to_string(order) + "}";
}

} // namespace

TEST_CASE("the suite interface compares the snippet with functions by hand that draw the same") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    const Device device("");
    const auto volume = [&](const char* shape, int geometry_order, int order) {
        const std::string name = shape + std::to_string(geometry_order) + std::to_string(order);
        generated_volume(registry, folder, name, generator(shape, geometry_order, order));
        return (folder.path() / (name + ".h5")).string();
    };
    for (const char* shape : {"hexahedron", "prism"}) {
        INFO(shape);
        const InterfaceResult result = bench_interface(device, registry, folder, {volume(shape, 1, 2), 64, 3});
        CHECK(result.hit_pixels > 500);
        // Rounding only: it may put a pixel that lies within it of a face into the neighbour.
        CHECK(result.other_pixels <= result.hit_pixels / 500);
        CHECK(result.largest_difference < 1e-5);
        CHECK(result.plugin.least > 0);
        CHECK(result.by_hand.least > 0);
        CHECK(result.plugin.median >= result.plugin.least);
        CHECK(result.ratio > 0);
        CHECK(result.by_hand_newton_steps > result.hit_pixels / 2);
    }
    CHECK_THROWS_WITH(bench_interface(device, registry, folder, {volume("tetrahedron", 1, 2), 64, 1}),
                      Catch::Contains("hexahedra"));
    CHECK_THROWS_WITH(bench_interface(device, registry, folder, {volume("hexahedron", 1, 3), 64, 1}),
                      Catch::Contains("orders"));
}
