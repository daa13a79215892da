// Files of transfer functions: our own and ParaView's.

#include "fixture.hpp"

#include <core/scene/color/transfer.hpp>

#include <cmath>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;

namespace {

TransferFunction read(const std::string& text) {
    const TemporaryFolder folder;
    return read_transfer_file(folder.write("transfer.json", text));
}

/** One line that names the file. */
std::string fault(const std::string& text) {
    const std::string error = error_of([&] { read(text); });
    CHECK_THAT(error, Contains("transfer.json"));
    CHECK(error.find('\n') == std::string::npos);
    return error;
}

/** As ParaView exports presets; `more` stands behind the colours. */
std::string paraview(const std::string& more, const std::string& space = "RGB") {
    return R"([{"ColorSpace": ")" + space +
           R"(", "Creator": "someone", "DefaultMap": true, "Name": "levels", "NanColor": [1, 1, 0],
        "RGBPoints": [-1, 0, 0, 1, 0, 1, 1, 1, 3, 1, 0, 0])" +
           more + "}]";
}

} // namespace

TEST_CASE("A file of our own is read as it is") {
    const TransferFunction transfer =
        read(R"({"color": [[0, 1, 0, 0], [0.5, 0, 0.25, 1]], "density": [[-1, 0], [0.5, 2], [0.5, 3]]})");
    REQUIRE(transfer.color.size() == 2);
    CHECK(transfer.color[1].value == 0.5);
    CHECK(transfer.color[1].rgb == std::array<double, 3>{0, 0.25, 1});
    REQUIRE(transfer.density.size() == 3);
    CHECK((transfer.density[2].value == 0.5 && transfer.density[2].density == 3));
}

TEST_CASE("What is wrong with a file of our own is said in one line") {
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]]})"), Contains("'density' is missing"));
    CHECK_THAT(fault(R"({"colour": [[0, 1, 0, 0]], "density": [[0, 1]]})"),
               Contains("'colour' is unknown; the nearest known key is 'color'"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]], "density": []})"), Contains("'density' is empty"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]], "density": 3})"), Contains("'density' must be a list of lists"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0]], "density": [[0, 1]]})"),
               Contains("'color[0]' is [0,1,0], where a list of 4 numbers"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0], [1, 1, 0, 2]], "density": [[0, 1]]})"),
               Contains("'color[1]' is 2; it must be at least 0, at most 1"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]], "density": [[0, 1], [1, 1], [2, -1]]})"),
               Contains("'density[2]' is -1; it must be at least 0"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]], "density": [[0, "1"]]})"), Contains("'density[0]' is \"1\", where a number"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]], "density": [[0, 1e999]]})"), Contains("1e999"));
    CHECK_THAT(fault(R"({"color": [[0, 1, 0, 0]], "density": [[1, 1], [0.5, 1]]})"),
               Contains("'density[1]' has the value 0.5 after 1; values must ascend"));
    CHECK_THAT(fault("{\"color\": [[0, 1, 0, 0]],\n \"density\": [[0, nan]]}"),
               Contains("transfer.json:2:") && Contains("is not JSON"));
    CHECK_THAT(fault("[]"), Contains("RGBPoints"));
    CHECK_THAT(fault("7"), Contains("must be an object"));
    CHECK_THAT(fault(""), Contains("cannot be read, or is empty"));
    CHECK_THAT(fault("<ColorMap/>"), Contains("is XML"));
    CHECK_THAT(error_of([] { read_transfer_file("nowhere.json"); }), Contains("nowhere.json") && Contains("cannot be read"));
}

TEST_CASE("ParaView's opacity is over the unit distance, its values are the field's") {
    const TransferFunction transfer = read(paraview(R"(, "Points": [-1, 0, 0.5, 0, 1, 0.5, 0.5, 0, 3, 1, 0.5, 0],
                                                        "ScalarOpacityUnitDistance": 0.2)"));
    REQUIRE(transfer.color.size() == 3);
    CHECK(transfer.color[2].value == 3);
    CHECK(transfer.color[2].rgb == std::array<double, 3>{1, 0, 0});
    CHECK(transfer.density.front().value == -1);
    CHECK(transfer.density.front().density == 0);
    const double largest = -std::log(1e-6) / 0.2;
    CHECK(transfer.density.back().density == Approx(largest));
    for (double value = -1; value < 3; value += 0.01) {
        const double opacity = std::min(0.25 * (value + 1), 1 - 1e-6);
        REQUIRE(std::abs(density_at(transfer, value) + std::log(1 - opacity) / 0.2) < 1.01e-4 * largest);
    }
    CHECK(density_at(transfer, 1) == Approx(std::log(2) / 0.2).epsilon(1e-14));
    // Constant beyond.
    CHECK(density_at(transfer, 9) == transfer.density.back().density);
    // Without unit distance it is 1.
    CHECK(read(paraview(R"(, "Points": [0, 0.5, 0.5, 0])")).density.front().density == Approx(std::log(2)));
    // One map need not be in a list.
    const std::string list = paraview(R"(, "Points": [0, 0.5, 0.5, 0])");
    CHECK(read(list.substr(1, list.size() - 2)).density.size() == 1);
}

TEST_CASE("ParaView's colours are interpolated in their space") {
    const std::string points = R"(, "Points": [0, 0.5, 0.5, 0])";
    CHECK(read(paraview(points, "Lab")).color.size() > 10);
    const TransferFunction step = read(paraview(points, "Step"));
    CHECK(color_at(step, -0.5, 2) == 1);
    CHECK(color_at(step, -0.5, 0) == 0);
    CHECK(color_at(step, 2, 1) == 1);
}

TEST_CASE("What is wrong with a file of ParaView's is said in one line") {
    CHECK_THAT(fault(paraview("")), Contains("no list Points") && Contains("color_map"));
    CHECK_THAT(fault(paraview(R"(, "Points": null)")), Contains("no list Points"));
    CHECK_THAT(fault(paraview(R"(, "Points": [0, 0.5, 0.5])")), Contains("3 numbers") && Contains("groups of four"));
    CHECK_THAT(fault(paraview(R"(, "Points": [0, 0.5, 0.5, 0, 1, 1.5, 0.5, 0])")), Contains("Points[5], an opacity, is 1.5"));
    CHECK_THAT(fault(paraview(R"(, "Points": [0, 0.5, -1, 0])")), Contains("Points[2], a midpoint, is -1"));
    CHECK_THAT(fault(paraview(R"(, "Points": [0, 0.5, 0.5, "x"])")), Contains("Points[3], a sharpness, is \"x\""));
    CHECK_THAT(fault(paraview(R"(, "Points": [1, 0.5, 0.5, 0, 0, 1, 0.5, 0])")),
               Contains("Points[4] is 0, less than the value before"));
    const std::string points = R"(, "Points": [0, 0.5, 0.5, 0])";
    CHECK_THAT(fault(paraview(points + R"(, "ScalarOpacityUnitDistance": 0)")), Contains("it must be above 0"));
    CHECK_THAT(fault(paraview(points + R"(, "ScalarOpacityUnitDistance": "1")")), Contains("where a number is expected"));
    CHECK_THAT(fault(paraview(points + R"(, "UseLogScale": 1)")), Contains("UseLogScale"));
    CHECK(read(paraview(points + R"(, "UseLogScale": 0)")).color.size() == 3);
    CHECK_THAT(fault(paraview(points, "CMYK")), Contains("'CMYK' is unknown"));
    CHECK_THAT(fault(R"([{"RGBPoints": [0, 0, 0, 1], "ColorSpace": 3, "Points": [0, 0.5, 0.5, 0]}])"),
               Contains("'3' is unknown"));
    CHECK_THAT(fault(R"([{"RGBPoints": [0, 0, 0, 2], "Points": [0, 0.5, 0.5, 0]}])"), Contains("outside 0 to 1"));
}
