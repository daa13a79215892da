// Commands that answer in numbers: sample, integrate, extrema.
#include "workplace.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace elvis::test {

namespace {

using nlohmann::json;

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream words(line + ",");
        for (std::string word; std::getline(words, word, ',');) {
            rows.back().push_back(word);
        }
    }
    return rows;
}

} // namespace

TEST_CASE("samples along a line are the field's, and what lies outside is empty") {
    const Workplace place;
    const Outcome done =
        place.run("sample ball.h5 --line -2,0.1,0.2 2,0.1,0.2 --count 401 --field sphere --gradients -o line.csv");
    INFO(done.err);
    REQUIRE(done.status == 0);
    CHECK_THAT(done.out, Catch::Contains("401 points written to line.csv") && Catch::Contains("elements begin or end at"));
    const auto rows = rows_of(place.read("line.csv"));
    REQUIRE(rows.size() == 402);
    CHECK_THAT(place.read("line.csv"),
               Catch::StartsWith("arc_length,x,y,z,element,sphere,\"d(sphere,x)\",\"d(sphere,y)\",\"d(sphere,z)\"\n"));
    double largest = 0;
    std::size_t n_inside = 0;
    for (std::size_t row = 1; row < rows.size(); ++row) {
        const double x = std::stod(rows[row][1]), square = x * x + 0.05;
        // The curved boundary is the ball's but for its order.
        CHECK((rows[row][5].empty() == (square > 1) || std::abs(square - 1) < 0.05));
        if (!rows[row][5].empty()) {
            largest =
                std::max({largest, std::abs(std::stod(rows[row][5]) - square), std::abs(std::stod(rows[row][6]) - 2 * x)});
            ++n_inside;
        }
    }
    INFO("largest error " << largest);
    CHECK(largest < 1e-11);
    CHECK(n_inside > 190);
    CHECK(place.run("sample ball.h5 --line -2,0.1,0.2 2,0.1,0.2 -o line.svg").status == 0);
    CHECK_THAT(place.read("line.svg"), Catch::Contains("velocity[1]") && Catch::Contains("polyline"));
}

TEST_CASE("grids, planes and files of points have all that was asked for") {
    const Workplace place;
    REQUIRE(place.run("sample ball.h5 --grid 5x4x3 -o grid.vti").status == 0);
    CHECK_THAT(place.read("grid.vti"),
               Catch::Contains("WholeExtent=\"0 4 0 3 0 2\"") && Catch::Contains("Name=\"velocity\" NumberOfComponents=\"3\""));
    REQUIRE(place.run("sample ball.h5 --cut-plane 0,0,2,-0.4 --size 7x5 --field x --field z -o plane.csv").status == 0);
    const auto rows = rows_of(place.read("plane.csv"));
    REQUIRE(rows.size() == 36);
    for (std::size_t row = 1; row < rows.size(); ++row) {
        CHECK(std::stod(rows[row][2]) == Approx(0.2).margin(1e-14));
        CHECK((rows[row][5].empty() || std::stod(rows[row][5]) == Approx(0.2).margin(1e-13)));
    }
    place.write("points.txt", "# two points\n0.1 0.2 0.3\n\n0.4, 0.1, -0.2 # the second\n");
    REQUIRE(place.run("sample ball.h5 --points points.txt --field sphere -o points.npz").status == 0);
    const std::string archive = place.read("points.npz");
    CHECK(archive.starts_with("PK\x03\x04"));
    CHECK_THAT(archive, Catch::Contains("sphere.npy") && Catch::Contains("'shape': (2,)"));
    REQUIRE(place.run("sample ball.h5 --polyline points.txt --count 3 -o points.h5").status == 0);
    CHECK_THAT(place.read("points.h5"), Catch::Contains("break_element_before"));
}

TEST_CASE("integrals and extrema are printed as JSON") {
    const Workplace place;
    const Outcome done = place.run("integrate ball.h5 --field sphere");
    INFO(done.err);
    REQUIRE(done.status == 0);
    const json whole = json::parse(done.out);
    CHECK(whole.at("value").get<double>() == Approx(4 * std::numbers::pi / 5).epsilon(0.01));
    CHECK(whole.at("exact") == true);
    CHECK(whole.at("converged") == true);
    const json surface = json::parse(place.run("integrate ball.h5 --isosurface 0.25 --field sphere").out);
    CHECK(surface.at("measure").get<double>() == Approx(std::numbers::pi).epsilon(1e-8));
    CHECK(surface.at("value").get<double>() == Approx(std::numbers::pi / 4).epsilon(1e-8));
    const json flux = json::parse(place.run("integrate ball.h5 --boundary sphere --flux --field \"grad(sphere)\"").out);
    CHECK(flux.at("value").get<double>() == Approx(6 * whole.at("measure").get<double>()).epsilon(1e-9));

    const json extrema = json::parse(place.run("extrema ball.h5 --field sphere").out);
    CHECK(extrema.at("certainty") == "certified");
    CHECK(extrema.at("minimum").at("value").get<double>() == Approx(0).margin(1e-3));
    CHECK(extrema.at("maximum").at("interval")[0].get<double>() <= extrema.at("maximum").at("interval")[1].get<double>());
    CHECK(extrema.at("maximum").at("position").size() == 3);
    CHECK(json::parse(place.run("extrema ball.h5 --field \"sphere^2\"").out).at("certainty") == "sampled");
}

TEST_CASE("what cannot be answered is said, and no file is left") {
    const Workplace place;
    const auto fails = [&](const std::string& arguments, int status, const std::string& text) {
        const Outcome outcome = place.run(arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.status == status);
        CHECK_THAT(outcome.err, Catch::Contains(text));
    };
    fails("sample ball.h5 -o a.csv", 2, "takes one of --line");
    fails("sample ball.h5 --line 0,0,0 0,0,0 -o a.csv", 2, "two points that differ");
    fails("sample ball.h5 --line 0,0,0 1,0 -o a.csv", 2, "--line");
    fails("sample ball.h5 --line 0,0,0 1,0,0 -o a.vti", 2, "--grid");
    fails("sample ball.h5 --grid 4x4x4 -o a.svg", 2, "--line");
    fails("sample ball.h5 --grid 4 -o a.csv", 2, "4");
    fails("sample ball.h5 --grid 4x0x4 -o a.csv", 2, "4x0x4");
    fails("sample ball.h5 --cut-plane 0,0,0,1 -o a.csv", 2, "length zero");
    fails("sample ball.h5 --cut-plane 0,0,1,9 -o a.csv", 2, "does not meet");
    fails("sample ball.h5 --line 0,0,0 1,0,0 --field speed -o a.csv", 1, "speed");
    fails("sample ball.h5 --line 0,0,0 1,0,0 -o missing/a.csv", 1, "missing/a.csv");
    fails("sample ball.h5 --points nothing.txt -o a.csv", 1, "nothing.txt");
    place.write("bad.txt", "0 0 0\n1 2\n");
    fails("sample ball.h5 --points bad.txt -o a.csv", 1, "bad.txt:2");
    fails("integrate ball.h5 --boundary --isosurface 0.1", 2, "takes one of");
    fails("integrate ball.h5 --isosurface 0.1", 2, "--isosurface-field");
    fails("integrate ball.h5 --flux --boundary", 2, "needs --field");
    fails("integrate ball.h5 --flux --field velocity", 1, "not through a volume");
    fails("integrate ball.h5 --boundary wall", 1, "wall");
    fails("integrate ball.h5 --time-step 4", 1, "time step");
    fails("extrema ball.h5 --field nothing", 1, "nothing");
    CHECK_FALSE(fs::exists(place.path("a.csv")));
}

} // namespace elvis::test
