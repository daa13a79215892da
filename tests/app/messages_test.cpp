// What the program says besides its answers.

#include "workplace.hpp"

#include <nlohmann/json.hpp>

using namespace elvis::test;

TEST_CASE("Colours of a field that is constant but for rounding span more than that, and a warning says so") {
    const Workplace place;
    const std::string rest = " --cut-plane 0,0,1,0.1 --size 32x32 -o x.png";
    for (const char* precision : {"float32", "float64"}) {
        INFO(precision);
        const Outcome constant =
            place.run("render ball.h5 --field 'sin(x)^2 + cos(x)^2' --precision " + std::string(precision) + rest);
        INFO(constant.err);
        CHECK(constant.status == 0);
        CHECK_THAT(constant.err, Catch::Contains("sin(x)^2 + cos(x)^2 is constant but for rounding: 1 "));
        const Outcome varying = place.run("render ball.h5 --field 'sphere + x' --precision " + std::string(precision) + rest);
        CHECK_THAT(varying.err, !Catch::Contains("constant but for rounding"));
    }
    CHECK_THAT(place.run("render ball.h5 --field 'laplacian(sphere)'" + rest).err,
               Catch::Contains("constant but for rounding: 6 "));
    CHECK_THAT(place.run("render ball.h5 --field 'laplacian(sphere)' --range 5,7" + rest).err,
               !Catch::Contains("constant but for rounding"));
}

TEST_CASE("Help of render names the colour maps, and info says what is unknown in words") {
    const Workplace place;
    const std::string help = place.run("render --help").out;
    for (const char* word : {"viridis", "coolwarm", "gray"}) {
        CHECK_THAT(help, Catch::Contains(word));
    }
    const std::string info = place.run("info ball.h5").out;
    INFO(info);
    CHECK_THAT(info, Catch::Contains("field sphere: 1 component, "));
    CHECK_THAT(info, !Catch::Contains("null"));
}

TEST_CASE("Info tells the values that a field takes, and what encloses them") {
    const Workplace place;
    const std::string data = data_file("mfem/poisson-fichera-q3-p5");
    REQUIRE(place.run("convert '" + data + "/mesh.mesh' '" + data + "/sol.gf' -o fichera.h5").status == 0);
    const auto field = nlohmann::json::parse(place.run("info fichera.h5 --json").out)["fields"][0];
    // The solution of a Poisson problem with load 1 and value 0 on the boundary.
    const double lower = field["range_by_component"][0][0], upper = field["range_by_component"][0][1];
    CHECK(lower == Approx(0).margin(1e-3 * 0.14908));
    CHECK(upper == Approx(0.14908).epsilon(1e-3));
    CHECK(field["range_certainty"] == "certified");
    const auto& maximum = field["extrema_by_component"][0]["maximum"];
    CHECK(maximum["bound"] >= upper);
    CHECK(maximum["bound"] <= upper + 1e-3 * (upper - lower));
    const std::string x = maximum["x"].dump();
    const auto probed = nlohmann::json::parse(place.run("probe fichera.h5 --json --point " + x.substr(1, x.size() - 2)).out);
    CHECK(probed["points"][0]["fields"]["sol"][0].get<double>() == Approx(upper).epsilon(1e-9));
    // The elements' bounds are wider.
    CHECK(field["enclosure_by_component"][0][1] > 1.5 * upper);
    CHECK(field["enclosure_certainty"] == "certified");
    CHECK_THAT(place.run("info fichera.h5").out, Catch::Contains("enclosed by the elements' bounds"));
}

TEST_CASE("Ranges of fields that only the device evaluates reach the closed forms' extrema, and are called sampled") {
    const Workplace place;
    const auto check = [&](const std::string& volume, std::size_t field, double minimum, double maximum) {
        const auto info = nlohmann::json::parse(place.run("info '" ELVIS_SOURCES "/plugins/" + volume + "' --json").out);
        const auto& found = info["fields"][field];
        CAPTURE(volume, field);
        CHECK(found["range_certainty"] == "sampled");
        CHECK(found["range_by_component"][0][0].get<double>() == Approx(minimum).margin(1e-3 * (maximum - minimum)));
        CHECK(found["range_by_component"][0][1].get<double>() == Approx(maximum).margin(1e-3 * (maximum - minimum)));
    };
    check("analytic/samples/twisted_box.txt", 0, -1.25, 1.25);
    check("analytic/samples/twisted_box.txt", 1, 0, 2);
    check("cut_cells/samples/ball.cut", 0, 0, 0.64);
}

TEST_CASE("A boundary on which the field hardly changes is cut open by default, another one is not") {
    const Workplace place;
    const auto picture = [&](const std::string& options) {
        REQUIRE(place.run("render ball.h5 --size 64x48 -o x.png " + options).status == 0);
        return place.read("x.png");
    };
    // The square of the distance from the middle is 1 on the boundary of the ball.
    CHECK(picture("") != picture("--boundary"));
    CHECK(picture("--field velocity") == picture("--field velocity --boundary"));
}
