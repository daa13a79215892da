// Streamlines in pictures and as arrays.

#include "some_volume.hpp"

#include <elvis/answers.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

constexpr const char* flow_box =
    R"({"generator": 1, "mesh": "box", "shape": "mixed", "elements": [4, 2, 2], "field": "sphere"})";

scene with_surface(const context& library, const std::string& surface, const std::string& precision) {
    scene shown = library.make_scene();
    shown.set("/image/size", "[120, 90]");
    shown.set("/precision", "\"" + precision + "\"");
    shown.set("/camera", R"({"eye": [1.5, -4, 2], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 30})");
    shown.set("/surfaces/-", surface);
    return shown;
}

} // namespace

TEST_CASE("The tube about a straight streamline is a cylinder") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow_box));
    for (const auto& [precision, tolerance] : {std::pair{"float32", 2e-5}, std::pair{"float64", 1e-11}}) {
        const picture tube = volume.render(with_surface(
            library, R"s({"type": "streamlines", "flow": "grad(x)", "seeds": [[0.1, 0.05, 0.1]], "radius": 0.1})s", precision));
        const picture pipe = volume.render(with_surface(
            library, R"({"type": "cylinder", "from": [-1, 0.05, 0.1], "to": [1, 0.05, 0.1], "radius": 0.1, "capped": false})",
            precision));
        const std::vector<double> of_tube = tube.read<double>(ELVIS_CHANNEL_DEPTH),
                                  of_pipe = pipe.read<double>(ELVIS_CHANNEL_DEPTH);
        std::size_t n_both = 0, n_one = 0;
        double largest = 0;
        for (std::size_t pixel = 0; pixel < of_tube.size(); ++pixel) {
            const bool has_tube = std::isfinite(of_tube[pixel]), has_pipe = std::isfinite(of_pipe[pixel]);
            n_both += has_tube && has_pipe ? 1 : 0;
            n_one += has_tube != has_pipe ? 1 : 0;
            largest = has_tube && has_pipe ? std::max(largest, std::abs(of_tube[pixel] - of_pipe[pixel])) : largest;
        }
        std::cout << precision << ": " << n_both << " pixels of both, " << n_one << " of one, depths differ by " << largest
                  << '\n';
        CHECK(n_both > 400);
        // Balls close the tube at the ends, where the cylinder is open and shows its inside.
        CHECK(n_one < 20);
        CHECK(largest < tolerance + 0.25 * static_cast<double>(n_one));
        CHECK(tube.info().n_undecided_pixels < 10);
    }
}

TEST_CASE("The ribbon about the axis of a rotation is a helicoid") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume =
        library.open(convert(library, folder, R"({"generator": 1, "mesh": "box", "elements": [3, 3, 3], "field": "sphere"})"));
    for (const auto& [precision, tolerance] : {std::pair{"float32", 2e-4}, std::pair{"float64", 2e-4}}) {
        // It lies along y at the seed, and turns by a radian in a length of 0.4.
        const picture ribbon = volume.render(with_surface(
            library, R"s({"type": "streamlines", "flow": "0.4 * grad(x) + y * grad(z) - z * grad(y)", "seeds": [[0, 0, 0]],
                          "ribbon_width": 0.8})s",
            precision));
        scene formula =
            with_surface(library, R"s({"type": "implicit", "expression": "z*cos(x/0.4) - y*sin(x/0.4)"})s", precision);
        const picture helicoid = volume.render(formula);
        const std::vector<double> of_ribbon = ribbon.read<double>(ELVIS_CHANNEL_DEPTH),
                                  of_helicoid = helicoid.read<double>(ELVIS_CHANNEL_DEPTH);
        std::size_t n_ribbon = 0, n_both = 0;
        double largest = 0;
        for (std::size_t pixel = 0; pixel < of_ribbon.size(); ++pixel) {
            // The helicoid goes on beyond the ribbon, and hides parts of it.
            const bool is_behind = std::isfinite(of_ribbon[pixel]) && of_ribbon[pixel] > of_helicoid[pixel] + 0.01;
            n_ribbon += std::isfinite(of_ribbon[pixel]) ? 1 : 0;
            if (std::isfinite(of_ribbon[pixel]) && !is_behind) {
                ++n_both;
                largest = std::max(largest, std::abs(of_ribbon[pixel] - of_helicoid[pixel]));
            }
        }
        std::cout << precision << ": " << n_ribbon << " pixels of the ribbon, " << n_both << " not hidden, depths differ by "
                  << largest << "; " << ribbon.info().n_undecided_pixels << " undecided\n";
        CHECK(n_both > 500);
        CHECK(largest < tolerance);
        CHECK(ribbon.info().n_undecided_pixels < 20);
    }
}

TEST_CASE("Streamlines from a grid are drawn, and colours of another field are on them") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow_box));
    scene shown = with_surface(library, R"s({"type": "streamlines", "flow": "x*grad(y) - y*grad(x)", "seed_grid": 3,
                                              "radius": 0.03, "length": 5, "field": "sphere"})s",
                               "float32");
    const picture drawn = volume.render(shown);
    CHECK(drawn.info().n_hit_pixels > 500);
    // The same lines, from what was kept.
    CHECK(volume.render(shown).read<double>(ELVIS_CHANNEL_COLOR) == drawn.read<double>(ELVIS_CHANNEL_COLOR));
    CHECK_THROWS_WITH(volume.render(with_surface(library, R"({"type": "streamlines", "flow": "sphere"})", "float32")),
                      Catch::Contains("sphere"));
    CHECK_THROWS_WITH(with_surface(library, R"({"type": "streamlines"})", "float32"), Catch::Contains("flow"));
    // None of them has a line.
    scene none = with_surface(library, R"s({"type": "streamlines", "flow": "grad(x)", "seeds": [[5, 5, 5]]})s", "float32");
    CHECK(volume.render(none).info().n_hit_pixels == 0);
}

TEST_CASE("Seeds on a line, on a plane and in the volume are the points that they stand for") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow_box));
    const auto depths = [&](const std::string& seeds) {
        scene shown = with_surface(
            library, R"({"type": "plane", "plane": [0, 0, 1, 0], "name": "cut", "visible": false, "clip": [[0, 1, 0, -0.2]]})",
            "float64");
        shown.set("/surfaces/-",
                  R"s({"type": "streamlines", "flow": "grad(x)", "length": 0.3, "radius": 0.03, )s" + seeds + "}");
        return volume.render(shown).read<double>(ELVIS_CHANNEL_DEPTH);
    };
    const auto same = [](const std::vector<double>& one, const std::vector<double>& other) {
        // The bounds' middle is 0 but for rounding.
        const auto are_equal = [](double a, double b) { return std::abs(a - b) < 1e-9 || (std::isnan(a) && std::isnan(b)); };
        return std::ranges::count_if(one, [](double depth) { return std::isfinite(depth); }) > 10 &&
               std::ranges::equal(one, other, are_equal);
    };
    CHECK(same(depths(R"("seed_line": [[-0.5, 0, 0], [0.5, 0, 0.5]], "seed_count": 3)"),
               depths(R"("seeds": [[-0.5, 0, 0], [0, 0, 0.25], [0.5, 0, 0.5]])")));
    // What is clipped away with the plane has none. The lattice goes through the middle of the bounds.
    CHECK(same(depths(R"("on": "cut", "spacing": 0.7)"), depths(R"("seeds": [[-0.7, 0.7, 0], [0, 0.7, 0], [0.7, 0.7, 0]])")));
    CHECK(same(depths(R"("spacing": 1.5)"), depths(R"("seeds": [[0, 0, 0]])")));
    CHECK_THROWS_WITH(depths(R"("on": "nothing")"),
                      Catch::Contains("there is no surface named 'nothing' on which they could begin"));
    CHECK_THROWS_WITH(depths(R"("on": "cut", "seed_grid": 3)"), Catch::Contains("means nothing beside"));
    scene shown = with_surface(library, R"({"type": "boundary", "name": "all", "visible": false})", "float32");
    shown.set("/surfaces/-",
              R"s({"type": "streamlines", "flow": "x*grad(y) - y*grad(x)", "on": "all", "spacing": 0.5, "radius": 0.02})s");
    CHECK(volume.render(shown).info().n_hit_pixels > 500);
}

TEST_CASE("Lines of a scene with a displacement are those of the displaced volume") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(
        library, folder, R"({"generator": 1, "mesh": "box", "elements": [2, 2, 2], "fields": ["sphere", "taylor-green"]})"));
    scene shown =
        with_surface(library, R"s({"type": "streamlines", "flow": "grad(x)", "seeds": [[0.1, 0.2, 0.3]]})s", "float32");
    const traced undisplaced = volume.trace(shown, 0);
    shown.set("/warp", R"({"field": "velocity", "factor": 0.2})");
    const traced lines = volume.trace(shown, 0, {"sphere"});
    auto how = detail::sized<elvis_warp>();
    how.field = "velocity";
    how.factor = 0.2;
    const std::vector<double> seed{0.1, 0.2, 0.3};
    const elvis_string field = "sphere";
    auto wanted = detail::sized<elvis_tracing>();
    wanted.field = "grad(x)";
    wanted.seeds = seed.data();
    wanted.n_seeds = 1;
    wanted.fields = &field;
    wanted.n_fields = 1;
    const traced displaced = volume.warp(how).trace(wanted);
    CHECK(lines.positions == displaced.positions);
    CHECK(lines.values == displaced.values);
    CHECK(lines.positions != undisplaced.positions);
}

TEST_CASE("Streamlines come as arrays, with values at their points") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder, flow_box));
    const std::vector<double> seeds{0.1, 0.2, 0.3, 7, 0, 0, -0.4, 0.5, 0.6};
    const elvis_string fields[] = {"sphere", "2 * x"};
    auto wanted = detail::sized<elvis_tracing>();
    wanted.field = "grad(x)";
    wanted.seeds = seeds.data();
    wanted.n_seeds = 3;
    wanted.n_fields = 2;
    wanted.fields = fields;
    const traced lines = volume.trace(wanted);
    REQUIRE(lines.first.size() == 4);
    CHECK(lines.first[1] == lines.first[2]);
    CHECK(lines.ends[1] == ELVIS_LINE_NO_ELEMENT);
    CHECK(lines.ends[0] == ELVIS_LINE_LEFT_VOLUME);
    for (std::size_t point = 0; point < lines.times.size(); ++point) {
        const double* const x = &lines.positions[3 * point];
        CHECK(lines.values[2 * point] == Approx(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).margin(1e-12));
        CHECK(lines.values[2 * point + 1] == Approx(2 * x[0]).margin(1e-12));
    }
    scene shown = with_surface(library, R"({"type": "boundary"})", "float32");
    shown.set("/surfaces/-", R"s({"type": "streamlines", "flow": "grad(x)",
                                  "seeds": [[0.1, 0.2, 0.3], [7, 0, 0], [-0.4, 0.5, 0.6]]})s");
    const traced of_scene = volume.trace(shown, 1, {"sphere", "2 * x"});
    CHECK(of_scene.positions == lines.positions);
    CHECK(of_scene.values == lines.values);
    CHECK_THROWS_WITH(volume.trace(shown, 0), Catch::Contains("surface: 0 is not the index of streamlines or pathlines"));
    CHECK_THROWS_WITH(volume.trace(shown, 2), Catch::Contains("surface: 2 is not"));
    wanted.direction = 3;
    CHECK_THROWS_WITH(volume.trace(wanted), Catch::Contains("direction"));
    // Points and, behind them, nine on a plane.
    wanted.direction = ELVIS_LINE_FORWARD;
    wanted.seed_surface = R"({"type": "plane", "plane": [1, 0, 0, -0.1]})";
    wanted.seed_spacing = 0.7;
    const traced more = volume.trace(wanted);
    REQUIRE(more.first.size() == 13);
    for (std::size_t line = 3; line < 12; ++line) {
        CHECK(more.positions[3 * more.first[line]] == Approx(0.1).margin(1e-12));
    }
    wanted.seed_surface = R"({"type": "wireframe", "name": "wires"})";
    CHECK_THROWS_WITH(volume.trace(wanted), Catch::Contains("seeds: cannot lie on 'wires'"));
    wanted.seed_surface = R"({"type": "plain"})";
    CHECK_THROWS_WITH(volume.trace(wanted), Catch::Contains("plain"));
}
