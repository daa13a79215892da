// What is looked at of elements when a volume goes to the device.
#include <tests/support/device.hpp>
#include <tests/support/error_of.hpp>

#include <core/plugin_host/plugin.hpp>
#include <core/volume/device_volume.hpp>

#include <catch2/catch.hpp>

namespace elvis {
namespace {

void upload(const std::string& options, Precision precision) {
    const RuntimeVolume volume(Plugin::load(ELVIS_FIXTURES "/sampled.so"), "a.cube", options);
    DeviceVolume data(test::device(), volume, precision, nullptr);
    data.select(0, 0, {0});
}

} // namespace

TEST_CASE("an element that reaches beyond the plugin's bounds is an error, not a hole") {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        CHECK_NOTHROW(upload("{}", precision));
        CHECK_THAT(test::error_of([&] { upload("{\"trouble\": \"narrow-bounds\"}", precision); }),
                   Catch::Contains("a.cube") && Catch::Contains("element 0") && Catch::Contains("get_bounds"));
    }
}

} // namespace elvis
