// Volumes that have the fields of others beside their own: what expressions of both are, and how scenes say it.

#include "some_volume.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::convert_to;
using test::opened;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

std::string box(int order, const char* field = "waves", int n_steps = 1) {
    return R"({"generator": 1, "mesh": "box", "shape": "mixed", "elements": [4, 2, 2], "order": )" + std::to_string(order) +
           R"(, "fields": [")" + field + R"("], "time_steps": )" + std::to_string(n_steps) + "}";
}

} // namespace

TEST_CASE("The difference of two solutions is one of polynomials: values, extrema and integrals are certain") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data fine = opened(library, folder, "fine.h5", box(6));
    const data coarse = opened(library, folder, "coarse.h5", box(3));
    const data both = fine.join({{"coarse", &coarse}});
    double largest = 0, largest_value = 0;
    for (int i = 0; i < 200; ++i) {
        const auto at = [i](int step) { return std::fmod(i * step * 0.0137, 1.9) - 0.95; };
        const std::vector<double> x{at(7), at(11), at(17)};
        const double expected = fine.probe(x, {"waves"}).values[0] - coarse.probe(x, {"waves"}).values[0];
        for (const char* const text :
             {"waves - coarse.waves", "-(coarse.waves - waves)", "waves/2 - coarse.waves/2 + waves/2 - coarse.waves/2"}) {
            largest = std::max(largest, std::abs(both.probe(x, {text}).values[0] - expected));
        }
        largest_value = std::max(largest_value, std::abs(expected));
    }
    std::cout << "largest error of a difference: " << largest << ", of " << largest_value << '\n';
    CHECK(largest < 1e-13);
    const elvis_range range = both.range("waves - coarse.waves");
    CHECK(range.certainty == ELVIS_CERTIFIED);
    CHECK(range.maximum >= largest_value);
    CHECK(range.maximum < 0.5);
    auto square = detail::sized<elvis_integration>();
    square.field = "(waves - coarse.waves)^2";
    const elvis_integral integral = both.integrate(square);
    CHECK(integral.is_exact != 0);
    CHECK(integral.value > 0);
    CHECK(integral.value < 8 * largest_value * largest_value);
}

TEST_CASE("A scene joins volumes: an isosurface of the difference of two times is where the closed form says") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    // At time t the field is (1 + t) r^2: from one time to the next it grows by r^2.
    convert_to(library, folder, "volume.h5", box(2, "sphere", 3));
    const std::string file = folder.path("volume.h5");
    scene shown = library.make_scene();
    const nlohmann::json volume = {{"path", file},
                                   {"time_step", 2},
                                   {"joined", {{{"name", "before"}, {"time_step", 1}}, {{"name", "same"}, {"path", file}}}}};
    shown.set("/volume", volume.dump());
    shown.set("/precision", "\"float64\"");
    shown.set("/image/size", "[64, 48]");
    shown.set("/camera", R"({"eye": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0]})");
    shown.set("/surfaces/-",
              R"json({"type": "isosurface", "values": [0.49], "field": "sphere - before.sphere + 0 * same.sphere"})json");
    const picture drawn = shown.open_volume().render(shown);
    const auto depths = drawn.read<double>(ELVIS_CHANNEL_DEPTH);
    double nearest = 10;
    std::size_t n_hits = 0;
    for (const double depth : depths) {
        nearest = std::isfinite(depth) && depth > 0 ? std::min(nearest, depth) : nearest;
        n_hits += std::isfinite(depth) && depth > 0 ? 1 : 0;
    }
    std::cout << "nearest point of the sphere at depth " << nearest << ", " << n_hits << " pixels\n";
    CHECK(n_hits > 50);
    CHECK(nearest == Approx(4.3).margin(5e-3));
    CHECK(nearest >= 4.3 - 1e-9);
    // The scene says again what it has read.
    CHECK(nlohmann::json::parse(shown.text(folder.path("")))["volume"]["joined"].size() == 2);
}

TEST_CASE("What cannot be joined is an error that names the volume") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = opened(library, folder, "one.h5", box(2));
    const data other =
        opened(library, folder, "other.h5", R"({"generator": 1, "mesh": "box", "elements": [3, 2, 2], "field": "sphere"})");
    // Of other elements: found by place.
    CHECK(volume.join({{"other", &other}}).info().n_fields == 2);
    CHECK_THROWS_WITH(volume.join({{"no name", &volume}}), Catch::Contains("is no name"));
    CHECK_THROWS_WITH(volume.join({{"late", &volume, 7}}), Catch::Contains("no time step 7"));
    CHECK(volume.join({}).info().n_fields == volume.info().n_fields);
}
