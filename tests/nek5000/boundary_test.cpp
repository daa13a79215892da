// Boundary groups of meshes beside the fields.
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using native::Point;

namespace {

struct Condition {
    int element, face;
    std::string kind;
    int tag = 0;
};

/** A mesh of the written files' three elements; corners are not looked at. */
std::string mesh(const std::string& version, const std::vector<std::vector<Condition>>& fields, int dimension = 3,
                 bool is_big = false) {
    const int word = version == "#v001" ? 4 : 8;
    const auto integer = [&](int value) { return word == 4 ? integer_bytes(value, is_big) : real_bytes(value, 8, is_big); };
    std::string bytes = version;
    if (version == "#v004") {
        bytes += " 3 " + std::to_string(dimension) + " 3 -" + std::to_string(fields.size()) + " hdr";
    } else {
        bytes += in_columns("3", 9) + in_columns(std::to_string(dimension), 3) + in_columns("3", 9) + "  this is the hdr";
    }
    bytes.resize(80, ' ');
    bytes += real_bytes(6.54321, 4, is_big);
    bytes += std::string(static_cast<std::size_t>(3 * (1 + dimension * (1 << dimension)) * word), '\0');
    // One curved side.
    bytes += integer(1) + integer(1) + integer(1);
    for (int number = 0; number < 5; ++number) {
        bytes += real_bytes(0.5, word, is_big);
    }
    bytes += std::string("C") + std::string(static_cast<std::size_t>(word - 1), ' ');
    for (const auto& conditions : fields) {
        bytes += integer(static_cast<int>(conditions.size()));
        for (const Condition& condition : conditions) {
            bytes += integer(condition.element) + integer(condition.face);
            for (int number = 0; number < 5; ++number) {
                bytes += real_bytes(number == 4 ? condition.tag : 0, word, is_big);
            }
            std::string kind = condition.kind;
            kind.resize(static_cast<std::size_t>(word), ' ');
            bytes += kind;
        }
    }
    if (version == "#v004") {
        bytes += "more to come";
    }
    return bytes;
}

elvis_source_element get_element(const SourceVolume& source, std::uint64_t number) {
    elvis_source_element element{};
    element.struct_size = sizeof element;
    source.elements(number, 1, std::span(&element, 1));
    return element;
}

} // namespace

TEST_CASE("Walls of Nek5000's own test are its boundary", "[nek5000]") {
    // The session of m22io_test0.f00003 is io_test, with a prefix of three letters.
    const SourceVolume source = open_nek5000({sample_file("m22io_test0.f00003")});
    REQUIRE(source.boundary_groups() == std::vector<std::string>{"W"});
    const ConvertedVolume volume(source);
    std::size_t n_walls = 0;
    for (const native::Face& face : volume.faces()) {
        const bool is_boundary = face.neighbour == ELVIS_NEIGHBOUR_NONE;
        CHECK((face.group == 0) == is_boundary);
        n_walls += is_boundary ? 1 : 0;
    }
    CHECK(n_walls == 66);
}

TEST_CASE("Conditions are groups, of fluid before temperature, by surfaces where there are several", "[nek5000]") {
    const TemporaryFolder folder;
    const std::string version = GENERATE("#v001", "#v002", "#v003", "#v004");
    const bool is_big = GENERATE(false, true);
    const std::vector<Condition> fluid{{1, 4, "v", 9}, {1, 2, "E"},    {1, 5, "W", 1}, {1, 6, "W", 2},
                                       {2, 2, "E"},    {2, 1, "P", 3}, {2, 3, "P", 4}};
    const std::vector<Condition> temperature{{1, 4, "t", 9}, {1, 5, "I", 1}, {2, 2, "E"},
                                             {3, 2, "O"},    {3, 4, "E"},    {3, 1, "SYM"}};
    folder.write("run.re2", mesh(version, {fluid, temperature}, 3, is_big));
    const auto source = open_nek5000({folder.write("run0.f00001", WrittenFile{}.content())});
    CHECK(source.boundary_groups() == std::vector<std::string>{"v", "W 1", "W 2", "P", "O", "SYM"});
    // Faces of ElVis: t = -1, s = -1, r = 1, s = 1, r = -1, t = 1.
    const auto groups = [&](std::uint64_t number) {
        const auto element = get_element(source, number);
        return std::vector<int>(element.face_groups, element.face_groups + 6);
    };
    CHECK(groups(0) == std::vector<int>{1, -1, -1, -1, 0, 2});
    CHECK(groups(1) == std::vector<int>{-1, 3, -1, 3, -1, -1});
    CHECK(groups(2) == std::vector<int>{-1, 5, 4, -1, -1, -1});
}

TEST_CASE("Sides of squares have groups", "[nek5000]") {
    const TemporaryFolder folder;
    folder.write("run.re2", mesh("#v002", {{{1, 4, "v"}, {1, 1, "W"}, {3, 2, "O"}, {3, 3, "W"}}}, 2));
    WrittenFile file;
    file.dimension = 2;
    const auto source = open_nek5000({folder.write("avgrun0.f00001", file.content())});
    REQUIRE(source.boundary_groups() == std::vector<std::string>{"v", "W", "O"});
    const auto first = get_element(source, 0), last = get_element(source, 2);
    CHECK(std::vector<int>(first.face_groups, first.face_groups + 4) == std::vector<int>{1, -1, -1, 0});
    CHECK(std::vector<int>(last.face_groups, last.face_groups + 4) == std::vector<int>{-1, 2, 1, -1});
}

TEST_CASE("Meshes that do not fit or are damaged leave the fields as they are", "[nek5000]") {
    const TemporaryFolder folder;
    const std::string fields = folder.write("run0.f00001", WrittenFile{}.content());
    const std::string good = mesh("#v002", {{{1, 4, "v"}}});
    const auto n_groups = [&](const std::string& content) {
        folder.write("run.re2", content);
        return open_nek5000({fields}).boundary_groups().size();
    };
    CHECK(n_groups(good) == 1);
    for (std::size_t size = 0; size < good.size() - 64; size += 37) {
        CHECK(n_groups(good.substr(0, size)) == 0);
    }
    CHECK(n_groups(mesh("#v002", {{{1, 4, "v"}}}, 2)) == 0);
    CHECK(n_groups(read_file(sample_file("io_test.re2"))) == 0);
    CHECK(n_groups(mesh("#v002", {{{4, 4, "v"}, {-1, 4, "W"}, {1, 7, "W"}, {1, 0, "W"}}})) == 0);
}
