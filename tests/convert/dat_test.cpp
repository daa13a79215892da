// Files of the original ElVis: real ones convert exactly, wrong ones are refused at the byte.
#include "dat_writer.hpp"
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>

#include <cmath>
#include <cstdio>
#include <limits>

using namespace elvis;
using Catch::Contains;

namespace {

const std::vector<std::array<double, 3>> unit_prism{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}};

std::string failure(const std::string& bytes) {
    const TemporaryFolder folder;
    try {
        open_dat(folder.write("wrong.dat", bytes));
    } catch (const Error& error) {
        return error.what();
    }
    return "no failure";
}

double sample(const SourceVolume& source, const native::Point& xi) {
    std::array<double, 1> value;
    source.sample(0, 0, xi, value);
    return value[0];
}

} // namespace

TEST_CASE("the rotating canister converts exactly and is not smoothed", "[convert][data]") {
    const ConvertedVolume volume(open_dat(elvis::test::data_file("elvis/bulletH1P2.dat")));
    const ConvertReport& report = volume.report();
    const FieldReport& field = report.fields.at(0);
    std::printf("canister: residual %.1e, geometry %.1e, largest jump %.2e\n", field.residual, report.geometry_residual,
                field.max_jump);
    CHECK(report.elements.at("hexahedron") == 5040);
    CHECK(report.elements.at("prism") == 696);
    CHECK(field.name == "density");
    CHECK(field.exact);
    CHECK(field.residual <= 1e-12);
    CHECK(report.geometry_exact);
    CHECK(report.n_faces == 17448);
    CHECK(report.n_unknown_faces == 0);
    // Face by face: continuous where the corners' copies agree; jumps at the 48 faces whose copies differ by up to 2.9e-6.
    CHECK(field.max_jump > 1e-6);
    CHECK(field.max_jump < 2e-5);
    CHECK(field.continuity == ELVIS_CONTINUITY_DISCONTINUOUS);
    std::array<double, 3> lower{9, 9, 99}, upper{-9, -9, -99};
    for (std::uint64_t element = 0; element < volume.n_elements(); ++element)
        for (int corner = 0; corner < native::n_corners(volume.shape(element)); ++corner) {
            const auto x = volume.position(element, native::corner(volume.shape(element), corner));
            for (std::size_t d = 0; d < 3; ++d) {
                lower[d] = std::min(lower[d], x[d]);
                upper[d] = std::max(upper[d], x[d]);
            }
        }
    const std::array<double, 6> box{-1, -1, 0, 1, 1, 18.4};
    for (std::size_t d = 0; d < 3; ++d) {
        CHECK(lower[d] == Approx(box[d]).margin(1e-9));
        CHECK(upper[d] == Approx(box[3 + d]).margin(1e-9));
    }
}

TEST_CASE("the sinc box converts exactly", "[convert][data]") {
    const ConvertedVolume volume(open_dat(elvis::test::data_file("elvis/raySincBox_F4_P4.dat")));
    const FieldReport& field = volume.report().fields.at(0);
    std::printf("sinc box: residual %.1e, largest jump %.2e\n", field.residual, field.max_jump);
    CHECK(volume.report().elements.at("hexahedron") == 125);
    CHECK(field.exact);
    CHECK(field.residual <= 1e-12);
    CHECK(field.max_jump <= 2e-14);
    CHECK(field.continuity == ELVIS_CONTINUITY_CONTINUOUS);
    CHECK(field.lower <= -1.28);
    CHECK(field.upper >= 1.63);
}

TEST_CASE("both byte orders hold the same volume", "[convert]") {
    for (bool big : {true, false}) {
        DatWriter writer(big);
        // 3 + 2 P_1(b) + P_1^(1,0)(c) + 5 (1-c) P_1(a), the terms (0,0,0), (0,1,0), (0,0,1) and (1,0,0).
        writer.add(3, unit_prism, {1, 1, 1}, {3, 1, 2, 0, 5, 0});
        const TemporaryFolder folder;
        const SourceVolume source = open_dat(folder.write("prism.dat", writer.bytes()));
        const native::Point xi{-0.3, 0.4, 0.1};
        const double a = 2 * 0.7 / 0.9 - 1, b = 0.4, c = 0.1;
        CHECK(sample(source, xi) == Approx(3 + 2 * b + 0.5 * (1 + 3 * c) + 5 * (1 - c) * a).epsilon(1e-14));
        // On the collapsed edge.
        CHECK(sample(source, {-1, 0.4, 1}) == Approx(3 + 0.8 + 2).epsilon(1e-14));
        std::array<double, 3> x;
        source.evaluate_mapping(0, xi, x);
        CHECK(x[0] == Approx(0.35).epsilon(1e-14));
        CHECK(x[1] == Approx(0.7).epsilon(1e-14));
        CHECK(x[2] == Approx(0.55).epsilon(1e-14));
        CHECK(ConvertedVolume(source).report().fields[0].exact);
    }
}

TEST_CASE("hexahedra of unequal degrees are exact", "[convert]") {
    DatWriter writer;
    const auto corners = box_corners({0, 0, 0}, {1, 2, 3});
    // One coefficient: P_2(a) P_0(b) P_3(c), at ((2 * 1 + 0) * 4 + 3); degree 0 in the second direction.
    std::vector<double> coefficients(3 * 1 * 4, 0.0);
    coefficients[2 * 4 + 3] = 1;
    writer.add(1, {corners.begin(), corners.end()}, {2, 0, 3}, coefficients);
    const TemporaryFolder folder;
    const SourceVolume source = open_dat(folder.write("hexahedron.dat", writer.bytes()));
    const double a = 0.3, c = -0.6;
    CHECK(sample(source, {a, 0.9, c}) == Approx(0.5 * (3 * a * a - 1) * 0.5 * (5 * c * c * c - 3 * c)).epsilon(1e-14));
    const ConvertedVolume volume(source);
    CHECK(volume.report().fields[0].exact);
    CHECK(volume.value(0, 0, {a, 0.9, c}) == Approx(sample(source, {a, 0.9, c})).epsilon(1e-13));
}

TEST_CASE("data that are not finite stay in their element", "[convert]") {
    DatWriter writer;
    writer.add_box({0, 0, 0}, {1, 1, 1});
    const auto corners = box_corners({1, 0, 0}, {2, 1, 1});
    std::vector<double> coefficients(8, 1.0);
    coefficients[3] = std::numeric_limits<double>::quiet_NaN();
    writer.add(1, {corners.begin(), corners.end()}, {1, 1, 1}, coefficients);
    writer.add_box({2, 0, 0}, {3, 1, 1});
    const TemporaryFolder folder;
    const ConvertedVolume volume(open_dat(folder.write("nan.dat", writer.bytes())));
    CHECK(volume.report().fields[0].n_not_finite == 1);
    CHECK_FALSE(volume.report().fields[0].exact);
    CHECK(volume.value(0, 0, {0.5, 0, 0}) == Approx(1.5).epsilon(1e-14));
    CHECK(std::isnan(volume.value(1, 0, {0.5, 0, 0})));
    CHECK(volume.value(2, 0, {0.5, 0, 0}) == Approx(1.5).epsilon(1e-14));
}

TEST_CASE("wrong files are refused at the byte", "[convert]") {
    DatWriter writer;
    writer.add_box({0, 0, 0}, {1, 1, 1});
    const std::string good = writer.bytes();
    REQUIRE(failure(good) == "no failure");

    const auto changed = [&](std::size_t at, char byte) {
        std::string bytes = good;
        bytes[at] = byte;
        return failure(bytes);
    };
    CHECK_THAT(failure(""), Contains("wrong.dat") && Contains("byte 0"));
    CHECK_THAT(failure("Finite Element"), Contains("byte 0"));
    CHECK_THAT(changed(3, 'X'), Contains("byte 0"));
    CHECK_THAT(changed(27, 2), Contains("byte 24"));
    CHECK_THAT(changed(28, '\x7f'), Contains("byte 28"));
    CHECK_THAT(changed(31, 0), Contains("byte 28"));
    for (char type : {'\0', '\2', '\7'})
        CHECK_THAT(changed(35, type), Contains("byte 32") && Contains("type") && Contains("element 0"));
    CHECK_THAT(changed(32 + 216, '\xff'), Contains("byte 248") && Contains("degree"));
    CHECK_THAT(failure(good.substr(0, good.size() - 1)), Contains("ends"));
    CHECK_THAT(failure(good.substr(0, 100)), Contains("byte"));
    CHECK_THAT(failure(good + "x"), Contains("byte " + std::to_string(good.size())));

    DatWriter unequal;
    unequal.add(3, unit_prism, {1, 1, 2}, std::vector<double>(10, 1.0));
    CHECK_THAT(failure(unequal.bytes()), Contains("byte 248") && Contains("degree"));
}
