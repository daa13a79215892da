// Files of before 2006.
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

/** A file of today as one of before 2006: elements in a row, in each all components. */
std::string old_binary(const std::string& header, const std::string& code, bool is_big, int dimension = 3) {
    WrittenFile file;
    file.dimension = dimension;
    file.n = 4;
    std::string bytes = header;
    bytes.resize(80, ' ');
    bytes += real_bytes(6.54321, 4, is_big);
    for (int number = 1; number <= 3; ++number) {
        WrittenFile one = file;
        one.real_size = 4;
        one.is_big = is_big;
        one.numbers = {number};
        one.has_ranges = false;
        one.code = code;
        bytes += one.content().substr(140);
    }
    return bytes;
}

double error(const SourceVolume& source, int n_scalars = 2) {
    double largest = 0;
    const auto dimension = static_cast<int>(source.info().dimension);
    for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
        const native::Point xi{0.1, -0.2, dimension == 3 ? 0.7 : 0};
        const auto values = sample(source, 0, element, xi), expected = written_values(dimension, element, xi, 1.5, n_scalars);
        REQUIRE(values.size() == expected.size());
        for (std::size_t index = 0; index < values.size(); ++index) {
            largest = std::max(largest, std::abs(values[index] - expected[index]));
        }
    }
    return largest;
}

} // namespace

TEST_CASE("Old headers are read in all their forms", "[nek5000]") {
    const TemporaryFolder folder;
    const bool is_big = GENERATE(false, true);
    const auto error_of = [&](const std::string& header, int dimension = 3) {
        return error(open_nek5000({folder.write("a.fld01", old_binary(header, "XUPTS02", is_big, dimension))}));
    };
    // Single precision of values up to 10.
    constexpr double rounding = 5e-6;
    CHECK(error_of("   3   4   4   4 1.5000000E+00    7 X Y Z U P T 1 2                 4 NELT,NX,N") < rounding);
    // Numbers that touch.
    CHECK(error_of("   3   4   4   4 1.5000000E+0099999 X Y Z U P T 1 2                 4 NELT,NX,N") < rounding);
    CHECK(error_of("         3   4   4   4   1.500000000E+00        7 X Y Z U P T 1 2 ") < rounding);
    CHECK(error_of("         3  4  4  4    1.500000000E+00         7 XUPTS02") < rounding);
    CHECK(error_of("   3   4   4   1 1.5000000E+00    7 X Y U P T 1 2                   4 NELT,NX,N", 2) < rounding);
    CHECK(error_of("         3  4  4  1    1.500000000E+00         7 XUPTS02", 2) < rounding);
}

TEST_CASE("Later old files take the coordinates of the first", "[nek5000]") {
    const TemporaryFolder folder;
    folder.write("a.fld99", old_binary("   3   4   4   4 1.5000000E+00    7 X Y Z U P T 1 2 ", "XUPTS02", false));
    const auto source =
        open_nek5000({folder.write("a.fld100", old_binary("   3   4   4   4 1.5000000E+00    7 U P T 1 2 ", "UPTS02", false))});
    CHECK(error(source) < 5e-6);
}

TEST_CASE("Text may end its lines as on Windows", "[nek5000]") {
    const TemporaryFolder folder;
    std::string text = read_file(sample_file("fa2io_test.fld01")), other;
    for (const char letter : text) {
        other += letter == '\n' ? "\r\n" : std::string(1, letter);
    }
    const auto source = open_nek5000({sample_file("fa2io_test.fld01")});
    const auto same = open_nek5000({folder.write("a.fld01", other)});
    CHECK(sample(source, 0, 35, {0.1, 0.2, 0.3}) == sample(same, 0, 35, {0.1, 0.2, 0.3}));
}

TEST_CASE("What of an old file cannot be read is refused with its place", "[nek5000]") {
    const TemporaryFolder folder;
    const std::string text = read_file(sample_file("fa2io_test.fld01")), binary = read_file(sample_file("fb2io_test.fld01"));
    const auto of = [&](const std::string& content) { return failure({folder.write("bad.fld01", content)}); };
    REQUIRE(of(text) == "no failure");
    REQUIRE(of(binary) == "no failure");
    CHECK_THAT(of(text.substr(0, text.size() - 100)), Contains("bad.fld01") && Contains("7776 lines of 10 numbers"));
    CHECK_THAT(of(binary.substr(0, binary.size() - 1)), Contains("bytes") && Contains("promises 311124"));
    std::string wrong = text;
    wrong.replace(482 + 141 * 216 * 4 + 14 * 6, 14, "1.OOOOOOE+00  ");
    CHECK_THAT(of(wrong), Contains("byte 122390") && Contains("1.OOOOOOE+00"));
    wrong = binary;
    wrong.replace(4, 4, "  99");
    CHECK_THAT(of(wrong), Contains("99 x 6 x 6 nodes"));
}
