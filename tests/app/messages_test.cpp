// What the program says besides its answers.

#include "workplace.hpp"

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
