// Traps of headers.
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;
using native::Point;

namespace {

std::string with_header(const WrittenFile& file, std::string header) {
    header.resize(132, ' ');
    return header + file.content().substr(132);
}

/** The pressure's largest error at points inside. */
double pressure_error(const SourceVolume& source) {
    const std::size_t index = field_index(source, "pressure");
    std::size_t at = 0;
    for (std::size_t field = 0; field < index; ++field) {
        at += source.fields()[field].n_components;
    }
    double largest = 0;
    for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
        for (int repeat = 0; repeat < 5; ++repeat) {
            const Point xi = random_point(native::Shape::hexahedron);
            largest =
                std::max(largest, std::abs(sample(source, 0, element, xi)[at] - written_values(3, element, xi, 1.5, 0)[3]));
        }
    }
    return largest;
}

} // namespace

TEST_CASE("Headers of before 2008 have columns, and codes by their places", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.code = "XUP";
    // 4x,i2,3i3,2i10,e20.13,i9,2i6,20a1: nothing between the number of parts and the codes.
    const std::string numbers = "#std" + in_columns("8", 2) + in_columns("5", 3) + in_columns("5", 3) + in_columns("5", 3) +
                                in_columns("3", 10) + in_columns("3", 10) + in_columns(" .1500000000000E+01", 20) +
                                in_columns("7", 9) + in_columns("0", 6) + in_columns("1", 6);
    const auto source = open_nek5000({folder.write("a0.f0001", with_header(file, numbers + "XUP"))});
    CHECK(source.times() == std::vector<double>{1.5});
    REQUIRE(source.fields().size() == 2);
    CHECK(pressure_error(source) < 1e-13);
    // A temperature would look like the flag of headers of today.
    file.code = "XPT";
    const auto other = open_nek5000({folder.write("b0.f0001", with_header(file, numbers + "X PT"))});
    REQUIRE(other.fields().size() == 2);
    CHECK(other.fields()[1].name == "temperature");
    CHECK(pressure_error(other) < 1e-13);
    // Scalars 1 and 3.
    file.code = "XS02";
    const auto scalars = open_nek5000({folder.write("c0.f0001", with_header(file, numbers + "X   S S"))});
    REQUIRE(scalars.fields().size() == 2);
    CHECK(scalars.fields()[0].name == "S01");
    CHECK(scalars.fields()[1].name == "S03");
}

TEST_CASE("Exponents may lack their zero, and times may be negative", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    std::string content = file.content();
    const std::string time = " 1.5000000000000E+00";
    REQUIRE(content.find(time) == 38);
    const auto time_of = [&](const std::string& text) {
        return open_nek5000({folder.write("a0.f00001", content.replace(38, 20, in_columns(text, 20)))}).times().at(0);
    };
    CHECK(time_of(".3141592653590E+01") == 3.141592653590);
    CHECK(time_of("-.3141592653590E+01") == -3.141592653590);
    CHECK(time_of("0.1500000000000-100") == 1.5e-101);
    CHECK(time_of("1.5D+02") == 150);
}

TEST_CASE("Flag T puts pressure at Gauss-Legendre points", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.has_gauss_pressure = true;
    file.tail = "  0.0000000E+00 T";
    const auto source = open_nek5000({folder.write("a0.f00001", file.content())});
    CHECK(pressure_error(source) < 1e-13);
    const ConvertedVolume volume(source);
    const auto& spaces = volume.description().classes.at(0).fields;
    CHECK(spaces.at(0).order == std::array<std::uint32_t, 3>{4, 4, 4});
    CHECK(spaces.at(1).order == std::array<std::uint32_t, 3>{2, 2, 2});
    CHECK(volume.report().fields.at(1).exact);
    // Without p0th, and with four characters about refinement behind it.
    file.tail = " T  1 2";
    CHECK(pressure_error(open_nek5000({folder.write("b0.f00001", file.content())})) < 1e-13);
    file.has_gauss_pressure = false;
    file.tail = "  0.0000000E+00 F";
    CHECK(pressure_error(open_nek5000({folder.write("c0.f00001", file.content())})) < 1e-13);
    file.n = 2;
    file.tail = " T";
    CHECK_THAT(failure({folder.write("d0.f00001", file.content())}), Contains("d0.f00001") && Contains("3 or more nodes"));
}

TEST_CASE("Sessions whose name ends in _reg have equidistant points", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.n = 6;
    file.nodes = Nodes::equidistant;
    const auto source = open_nek5000({folder.write("a_reg0.f00001", file.content())});
    CHECK(pressure_error(source) < 1e-13);
    CHECK(ConvertedVolume(source).report().fields.at(0).exact);
}

TEST_CASE("A single part may have any number, and numbers may be wider", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.code = "XUP";
    // Neko counts parts from 1, others end the code with a line.
    const auto header = [](int more) {
        return "#std 8  5  5  5 " + in_columns("3", 10 + static_cast<std::size_t>(more)) +
               "          3  1.5000000000000E+00         7      1      1 XUP\n";
    };
    for (const int more : {0, 1, 2}) {
        INFO(more << " columns more");
        CHECK(pressure_error(open_nek5000({folder.write("field0.f00000", with_header(file, header(more)))})) < 1e-13);
    }
}

TEST_CASE("What follows the numbers is not needed", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.has_ranges = false;
    CHECK(pressure_error(open_nek5000({folder.write("a0.f00001", file.content())})) < 1e-13);
}

TEST_CASE("The name of a single file is of no importance", "[nek5000]") {
    const TemporaryFolder folder;
    CHECK(pressure_error(open_nek5000({folder.write("r.fld", WrittenFile{}.content())})) < 1e-13);
}
