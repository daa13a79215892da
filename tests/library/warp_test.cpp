// Displaced volumes: where their points are, what they measure, and how scenes show them.

#include "some_volume.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

/** All four shapes, with a velocity and a pressure, continuous and polynomial, at two time steps. */
constexpr const char* flow = R"({"generator": 1, "mesh": "box", "shape": "mixed", "elements": [4, 2, 2], "order": 3,
    "fields": ["taylor-green"], "time_steps": 2})";

elvis_warp by(const char* field, double factor, std::uint32_t time_step = 0) {
    auto warp = detail::sized<elvis_warp>();
    warp.field = field;
    warp.factor = factor;
    warp.time_step = time_step;
    return warp;
}

elvis_integral integral(const data& volume, const char* field, elvis_domain domain = ELVIS_DOMAIN_VOLUME) {
    auto wanted = detail::sized<elvis_integration>();
    wanted.field = field;
    wanted.domain = domain;
    wanted.is_flux = domain == ELVIS_DOMAIN_BOUNDARY ? 1 : 0;
    return volume.integrate(wanted);
}

std::vector<double> colors(const picture& drawn) { return drawn.read<double>(ELVIS_CHANNEL_COLOR); }

scene lit_boundary(const context& library) {
    scene shown = library.make_scene();
    shown.set("/image/size", "[80, 60]");
    shown.set("/field", "\"pressure\"");
    shown.set("/surfaces/-", R"({"type": "boundary"})");
    shown.set("/lighting", "\"default\"");
    shown.set("/camera", R"({"eye": [4, 3, 2.5], "look_at": [0, 0, 0], "up": [0, 0, 1]})");
    return shown;
}

} // namespace

TEST_CASE("A displaced volume measures what the determinant of its displacement says") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow));
    const data warped = volume.warp(by("velocity", 0.3));
    // det(I + 0.3 grad u), whose third row is that of z.
    const char* const determinant = "(1 + 0.3 * grad(velocity)[0][0]) * ((1 + 0.3 * grad(velocity)[1][1]) * "
                                    "(1 + 0.3 * grad(velocity)[2][2]) - 0.09 * grad(velocity)[1][2] * grad(velocity)[2][1]) - "
                                    "0.3 * grad(velocity)[0][1] * (0.3 * grad(velocity)[1][0] * (1 + 0.3 * "
                                    "grad(velocity)[2][2]) - 0.09 * grad(velocity)[1][2] * grad(velocity)[2][0]) + "
                                    "0.3 * grad(velocity)[0][2] * (0.09 * grad(velocity)[1][0] * grad(velocity)[2][1] - 0.3 * "
                                    "(1 + 0.3 * grad(velocity)[1][1]) * grad(velocity)[2][0])";
    const double expected = integral(volume, determinant).value, measured = integral(warped, "1").value;
    const double by_boundary = integral(warped, "y * grad(y)", ELVIS_DOMAIN_BOUNDARY).value;
    std::cout << "volume of the displaced box: " << measured << ", by the determinant " << expected - measured
              << " more, by its boundary " << by_boundary - measured << " more\n";
    CHECK(std::abs(measured - 8) > 0.01);
    CHECK(measured == Approx(expected).epsilon(1e-12));
    CHECK(measured == Approx(by_boundary).epsilon(1e-12));
}

TEST_CASE("Fields go along with the points of a displaced volume") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow));
    const data warped = volume.warp(by("velocity", 0.4, 1));
    double largest = 0;
    for (int i = 0; i < 200; ++i) {
        const auto at = [i](int step) { return std::fmod(i * step * 0.0137, 1.9) - 0.95; };
        std::vector<double> x{at(7), at(11), at(17)};
        const probed before = volume.probe(x, {"velocity", "pressure"}, 1);
        for (std::size_t d = 0; d < 3; ++d) {
            x[d] += 0.4 * before.values[d];
        }
        const probed after = warped.probe(x, {"velocity", "pressure"}, 1);
        REQUIRE(after.elements[0] >= 0);
        for (std::size_t value = 0; value < 4; ++value) {
            largest = std::max(largest, std::abs(after.values[value] - before.values[value]));
        }
    }
    std::cout << "largest difference of a value at a displaced point: " << largest << '\n';
    CHECK(largest < 1e-12);
}

TEST_CASE("A scene with a warp shows the displaced volume, at its time step, and phases turn the displacement around") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const std::string file = convert(library, folder, flow);
    const data volume = library.open(file);
    scene shown = lit_boundary(library);
    const std::vector<double> straight = colors(volume.render(shown));
    const std::vector<double> displaced = colors(volume.warp(by("velocity", 0.3)).render(shown));
    const std::vector<double> opposite = colors(volume.warp(by("velocity", -0.3)).render(shown));
    shown.set("/warp", R"({"field": "velocity", "factor": 0.3})");
    CHECK(colors(volume.render(shown)) == displaced);
    CHECK(displaced != straight);
    shown.set("/animation", R"({"phases": 2})");
    const animation phases = volume.animate(shown);
    REQUIRE(phases.info().n_frames == 2);
    CHECK(colors(phases.render(0)) == displaced);
    CHECK(colors(phases.render(1)) == opposite);
    shown.remove("/animation");

    shown.set("/volume", nlohmann::json{{"path", file}, {"time_step", 1}}.dump());
    scene still = lit_boundary(library);
    still.set("/volume", nlohmann::json{{"path", file}, {"time_step", 1}}.dump());
    const std::vector<double> later = colors(volume.warp(by("velocity", 0.3, 1)).render(still));
    CHECK(colors(volume.render(shown)) == later);
    shown.set("/animation", R"({"time_steps": "all"})");
    const animation steps = volume.animate(shown);
    REQUIRE(steps.info().n_frames == 2);
    CHECK(colors(steps.render(1)) != colors(steps.render(0)));
}

TEST_CASE(
    "Undeformed edges beside a displaced volume are those of the volume that is not displaced, hidden by what is before them") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow));
    const char* const wires = R"({"type": "wireframe", "color": [1, 0, 0], "width": 3, "undeformed": true})";
    scene shown = lit_boundary(library);
    shown.set("/precision", "\"float64\"");
    shown.remove("/lighting");
    shown.set("/surfaces", std::string("[") + wires + "]");
    shown.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, 100]})"); // Nothing: edges alone come with the boundary.
    const picture straight = volume.render(shown), displaced = volume.warp(by("velocity", 0.3)).render(shown);
    CHECK(colors(displaced) == colors(straight));
    CHECK(displaced.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS) == straight.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS));
    const std::vector<double> edges = displaced.read<double>(ELVIS_CHANNEL_DEPTH);
    shown.set("/surfaces/0/undeformed", "false");
    CHECK(colors(volume.render(shown)) == colors(straight));
    shown.set("/warp", R"({"field": "velocity", "factor": 0.3})");
    CHECK(colors(volume.render(shown)) != colors(straight));

    // With what the scene shows without surfaces: the boundary, displaced.
    shown.set("/surfaces", std::string("[") + wires + "]");
    const picture both = volume.render(shown);
    shown.remove("/surfaces");
    const std::vector<double> faces = volume.render(shown).read<double>(ELVIS_CHANNEL_DEPTH), color = colors(both);
    std::size_t n_seen = 0, n_hidden = 0, n_wrong = 0;
    for (std::size_t pixel = 0; pixel < faces.size(); ++pixel) {
        const bool is_edge = std::isfinite(edges[pixel]), is_hidden = is_edge && faces[pixel] < edges[pixel];
        const bool is_red = color[4 * pixel] == 1 && color[4 * pixel + 1] == 0 && color[4 * pixel + 2] == 0;
        n_seen += is_red;
        n_hidden += is_hidden;
        n_wrong += is_red != (is_edge && !is_hidden);
    }
    std::cout << "undeformed edges: " << n_seen << " pixels, " << n_hidden << " hidden\n";
    CHECK(n_seen > 200);
    CHECK(n_hidden > 20);
    CHECK(n_wrong == 0);
}

TEST_CASE("A warp that cannot be is refused, and the volume stays as it is") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow));
    CHECK_THROWS_WITH(volume.warp(by("velocitty", 1)), Catch::Contains("velocity"));
    CHECK_THROWS_WITH(volume.warp(by("pressure", 1)), Catch::Contains("one (a height)") || Catch::Contains("has three"));
    CHECK_THROWS_WITH(volume.warp(by("velocity", 1, 2)), Catch::Contains("2 time steps"));
    CHECK_THROWS_WITH(volume.warp(by("velocity", std::nan(""))), Catch::Contains("finite"));
    scene shown = lit_boundary(library);
    CHECK_THROWS_WITH(shown.set("/animation", R"({"phases": 2})"), Catch::Contains("warp"));
    CHECK_THROWS_WITH(shown.set("/warp", R"({"factor": 2})"), Catch::Contains("field"));
    CHECK(integral(volume, "1").value == Approx(8).epsilon(1e-13));
}
