// The NURBS plugin as a user meets it: exact circles, reproduction of coordinates, every visualization, the conformance checks.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

using namespace elvis::test;

namespace {

const std::string pipe_file = NURBS_SAMPLES "/pipe.nurbs";

/** A straight quarter of a pipe with radii 1 and 2, one span: x = r cos a, y = r sin a exactly. */
std::string quarter_annulus() {
    std::ostringstream text;
    text << std::setprecision(17)
         << "elvis-nurbs 1\nfield square 1\npatch\ndegree 2 1 1\nknots 6 0 0 0 1 1 1\nknots 4 0 0 1 1\n"
         << "knots 4 0 0 1 1\npoints\n";
    for (const double z : {0.0, 1.0}) {
        for (const double r : {1.0, 2.0}) {
            text << r << " 0 " << z << " 1 0\n"
                 << r << " " << r << " " << z << " " << std::sqrt(0.5) << " 0\n0 " << r << " " << z << " 1 0\n";
        }
    }
    return text.str();
}

nlohmann::json probe(const ProgramFolder& place, const std::string& file, const std::vector<std::array<double, 3>>& points) {
    std::ostringstream text;
    text << std::setprecision(17);
    for (const auto& x : points) {
        text << x[0] << " " << x[1] << " " << x[2] << "\n";
    }
    place.write("points.txt", text.str());
    const Outcome probed = place.run("probe '" + file + "' --points points.txt --json");
    INFO(probed.err);
    REQUIRE(probed.status == 0);
    return nlohmann::json::parse(probed.out)["points"];
}

} // namespace

TEST_CASE("Circular arcs are circles") {
    const ProgramFolder place;
    place.write("annulus.nurbs", quarter_annulus());
    std::vector<std::array<double, 3>> points;
    for (int i = 1; i < 40; ++i) {
        const double a = std::acos(0.0) * i / 40;
        for (const double r : {1 - 1e-9, 1 + 1e-9, 2 - 1e-9, 2 + 1e-9}) {
            points.push_back({r * std::cos(a), r * std::sin(a), 0.4});
        }
    }
    const auto found = probe(place, place.path("annulus.nurbs"), points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        INFO(i);
        const bool is_inside = i % 4 == 1 || i % 4 == 2;
        CHECK(found[i]["element"].is_null() == !is_inside);
    }
}

TEST_CASE("A field with the coordinate's coefficients is the coordinate, derivatives included") {
    const ProgramFolder place;
    std::vector<std::array<double, 3>> points;
    for (int i = 0; i < 200; ++i) {
        points.push_back({0.1 * (i % 20), 0.25 * (i / 20 % 10), 0.02 * i});
    }
    int n_inside = 0;
    for (const auto& point : probe(place, pipe_file, points)) {
        if (!point["element"].is_null()) {
            ++n_inside;
            CHECK(std::abs(point["fields"]["x"][0].get<double>() - point["x"][0].get<double>()) < 1e-12);
            const auto& gradient = point["gradients"]["x"][0];
            CHECK(std::abs(gradient[0].get<double>() - 1) < 1e-10);
            CHECK(std::abs(gradient[1].get<double>()) < 1e-10);
            CHECK(std::abs(gradient[2].get<double>()) < 1e-10);
        }
    }
    CHECK(n_inside > 20);
}

TEST_CASE("Every visualization draws a NURBS volume") {
    const ProgramFolder place;
    place.write("transfer.json", R"({"color": [[290, 0, 0, 1], [320, 1, 0, 0]], "density": [[290, 0], [320, 2]]})");
    for (const char* options :
         {"--cut-plane 0,0,1,-1.5 --contours 300,305 --mesh-lines", "--boundary --contours 300,310 --mesh-lines",
          "--isosurface 305", "--volume transfer.json", "--boundary --field \"norm(grad(temperature))\""}) {
        INFO(options);
        const Outcome drawn =
            place.run("render '" + pipe_file + "' " + options + " --size 48x48 -o out.png --stats stats.json");
        INFO(drawn.err);
        REQUIRE(drawn.status == 0);
        const auto counts = nlohmann::json::parse(place.read("stats.json"))["counts"];
        CHECK(counts["newton_failures"] == 0);
        CHECK(counts["nan_pixels"] == 0);
    }
}

TEST_CASE("The NURBS plugin passes the conformance checks") {
    const Outcome checked = ProgramFolder().run("check-plugin '" NURBS_PLUGIN "' --volume '" + pipe_file + "'");
    INFO(checked.out);
    CHECK(checked.status == 0);
}

TEST_CASE("Files with mistakes are refused with their line") {
    const ProgramFolder place;
    const std::string good = quarter_annulus();
    const auto damaged = [&](const std::string& what, const std::string& by) {
        std::string text = good;
        text.replace(text.find(what), what.size(), by);
        return text;
    };
    const std::pair<std::string, std::string> cases[] = {
        {damaged("knots 6 0 0 0 1 1 1", "knots 6 0 0 0 1 1 0"), "line 5: knots must ascend"},
        {damaged("knots 6 0 0 0 1 1 1", "knots 6 0 0 1 1 1 1"), "line 5"},
        {damaged("knots 6", "knots 600000"), "line 5: the number of knots lies outside"},
        {damaged("degree 2", "degree 9"), "line 4: a degree lies outside 1..8"},
        {damaged("1 0 0 1 0", "1 0 0 0 0"), "line 9: a weight must be positive"},
        {damaged("1 0 0 1 0", "1 0 0 nan 0"), "line 9: a number of a control point is expected"},
        {good + "5\n", "is neither 'field' nor 'patch'"},
    };
    for (const auto& [text, message] : cases) {
        place.write("bad.nurbs", text);
        const Outcome refused = place.run("info bad.nurbs");
        CHECK(refused.status == 1);
        INFO(refused.err);
        CHECK(refused.err.find(message) != std::string::npos);
    }
}
