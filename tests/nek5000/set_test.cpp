// Sets of files: parts, time steps, lists.
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>

using namespace elvis;
using Catch::Contains;
using native::Point;

namespace {

/** Largest difference of positions and all values from what was written, at points inside. */
double difference(const SourceVolume& source, std::size_t step, double time, int n_scalars = 2) {
    const auto dimension = static_cast<int>(source.info().dimension);
    double largest = 0;
    for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
        for (int repeat = 0; repeat < 5; ++repeat) {
            Point xi = random_point(native::Shape::hexahedron);
            xi[2] = dimension == 2 ? 0 : xi[2];
            const Point x = position(source, element, xi), expected_x = written_position(dimension, element, xi);
            const auto values = sample(source, step, element, xi);
            const auto expected = written_values(dimension, element, xi, time, n_scalars);
            REQUIRE(values.size() == expected.size());
            for (std::size_t axis = 0; axis < 3; ++axis) {
                largest = std::max(largest, std::abs(x[axis] - expected_x[axis]));
            }
            for (std::size_t index = 0; index < values.size(); ++index) {
                largest = std::max(largest, std::abs(values[index] - expected[index]));
            }
        }
    }
    return largest;
}

/** Values up to 10 in double precision. */
constexpr double round_off = 1e-13;

} // namespace

TEST_CASE("All sizes of numbers, byte orders and dimensions are read", "[nek5000]") {
    const TemporaryFolder folder;
    for (const int dimension : {2, 3}) {
        for (const int real_size : {4, 8}) {
            for (const bool is_big : {false, true}) {
                for (const int n : {3, 8, 31}) {
                    WrittenFile file;
                    file.n = n;
                    file.dimension = dimension;
                    file.real_size = real_size;
                    file.is_big = is_big;
                    file.numbers = {2, 3, 1};
                    const auto source = open_nek5000({folder.write("a0.f00001", file.content())});
                    INFO("dimension " << dimension << ", " << real_size << " bytes, big " << is_big << ", " << n << " nodes");
                    CHECK(difference(source, 0, 1.5) < (real_size == 8 ? 2e-13 : 5e-6));
                    CHECK(source.info().dimension == static_cast<std::uint32_t>(dimension));
                }
            }
        }
    }
}

TEST_CASE("Steps without coordinates take those of the latest earlier file of their set", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    // Before the latest: elsewhere.
    file.shift = 5;
    folder.write("a0.f00000", file.content());
    file.shift = 0;
    folder.write("a0.f00002", file.content());
    file.code = "UPTS02";
    folder.write("a0.f00003", file.content());
    file.numbers = {3, 1, 2};
    file.time = 2.5;
    const std::string last = folder.write("a0.f00010", file.content());
    // After it, and of another set.
    file.code = "XUPTS02";
    file.shift = 7;
    folder.write("a0.f00011", file.content());
    folder.write("b0.f00009", file.content());
    CHECK(difference(open_nek5000({last}), 0, 2.5) < round_off);
    const auto both = open_nek5000({folder.path("a0.f00003"), last});
    REQUIRE(both.times() == std::vector<double>{1.5, 2.5});
    CHECK(difference(both, 0, 1.5) < round_off);
    CHECK(difference(both, 1, 2.5) < round_off);
    file.code = "UPTS02";
    CHECK_THAT(failure({folder.write("c0.f00002", file.content())}), Contains("c0.f00002") && Contains("coordinates"));
    // The user may name them.
    CHECK(difference(open_nek5000({folder.path("a0.f00002"), folder.path("c0.f00002")}), 1, 2.5) < round_off);
}

TEST_CASE("Parts may hold other elements at every step, and lie in folders", "[nek5000]") {
    const TemporaryFolder folder;
    const bool in_folders = GENERATE(false, true);
    // Twelve parts have names of two digits.
    constexpr int n_parts = 12;
    for (int step = 1; step <= 2; ++step) {
        for (int part = 0; part < n_parts; ++part) {
            WrittenFile file;
            file.code = step == 1 ? "XUPTS02" : "UPTS02";
            file.time = step;
            file.n_elements = 2 * n_parts;
            file.part = part;
            file.n_parts = n_parts;
            file.numbers = step == 1 ? std::vector{part + 1, 2 * n_parts - part} : std::vector{2 * n_parts - part, part + 1};
            if (part < 2) {
                // One part has three elements, another one.
                file.numbers = part == 0 ? std::vector{1, 2 * n_parts, 2} : std::vector{2 * n_parts - 1};
            }
            const std::string digits = (part < 10 ? "0" : "") + std::to_string(part);
            std::filesystem::create_directories(folder.path("A" + digits));
            folder.write((in_folders ? "A" + digits + "/" : "") + "run2" + digits + ".f0000" + std::to_string(step),
                         file.content());
        }
    }
    const std::string first = in_folders ? "A07/run207.f00001" : "run207.f00001";
    const std::string second = in_folders ? "A11/run211.f00002" : "run211.f00002";
    const auto source = open_nek5000({folder.path(first), folder.path(second)});
    REQUIRE(source.info().n_elements == 2 * n_parts);
    CHECK(difference(source, 0, 1) < 10 * round_off);
    CHECK(difference(source, 1, 2) < 10 * round_off);
    // Alone: the geometry is found in all parts of the earlier step.
    CHECK(difference(open_nek5000({folder.path(second)}), 0, 2) < 10 * round_off);
    folder.write("list.nek5000", std::string("filetemplate: ") + (in_folders ? "A%02d/" : "") +
                                     "run2%02d.f%05d\nfirsttimestep: 1\nnumtimesteps: 2\n");
    const auto listed = open_nek5000({folder.path("list.nek5000")});
    REQUIRE(listed.times() == std::vector<double>{1, 2});
    CHECK(difference(listed, 1, 2) < 10 * round_off);
}

TEST_CASE("Neighbours are found though their copies of a point are rounded to neighbouring numbers", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.real_size = 4;
    // Far from the origin, where numbers are 2e-6 apart.
    file.shift = 20;
    std::string content = file.content();
    // x of the second of three elements with 5^3 nodes.
    const std::size_t first = 136 + 4 * 3 + 4 * 3 * 125;
    for (std::size_t node = 0; node < 125; ++node) {
        float x = 0;
        std::memcpy(&x, &content[first + 4 * node], 4);
        x = std::nextafter(x, 100.0F);
        std::memcpy(&content[first + 4 * node], &x, 4);
    }
    const ConvertedVolume volume(open_nek5000({folder.write("a0.f00001", content)}));
    CHECK(volume.report().n_unknown_faces == 0);
    CHECK(volume.report().n_boundary_faces == 3 * 6 - 2 * 2);
    CHECK(volume.report().fields.at(0).max_jump < 1e-5);
}

TEST_CASE("Elements may be counted from 0", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.numbers = {2, 3, 1};
    std::string content = file.content();
    content.replace(136, 12, integer_bytes(1, false) + integer_bytes(2, false) + integer_bytes(0, false));
    CHECK(difference(open_nek5000({folder.write("a0.f00001", content)}), 0, 1.5) < round_off);
}

TEST_CASE("A list names the steps of a run, of which some may be missing", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    for (int step = 3; step < 6; ++step) {
        file.time = step;
        folder.write("eddy_uv0.f0000" + std::to_string(step), file.content());
        file.code = "UPTS02";
    }
    const std::string path = folder.write(
        "eddy_uv.nek5000", "   filetemplate: eddy_uv%01d.f%05d\n   firsttimestep: 3\r\n numtimesteps:      4\ntype: binary\n");
    const auto source = open_nek5000({path});
    REQUIRE(source.times() == std::vector<double>{3, 4, 5});
    for (std::size_t step = 0; step < 3; ++step) {
        CHECK(difference(source, step, static_cast<double>(step + 3)) < round_off);
    }
    const ConvertedVolume volume(source);
    CHECK(volume.value(1, 1, {0.1, 0.2, 0.3}, nullptr, 0, 2) ==
          Approx(written_values(3, 1, {0.1, 0.2, 0.3}, 5, 2)[3]).margin(round_off));
}

TEST_CASE("Fields that not all steps have are left out", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    const std::string first = folder.write("a0.f00001", file.content());
    file.code = "PTS03";
    const auto source = open_nek5000({first, folder.write("a0.f00002", file.content())});
    std::vector<std::string> names;
    for (const SourceField& field : source.fields()) {
        names.push_back(field.name);
    }
    CHECK(names == std::vector<std::string>{"pressure", "temperature", "S01", "S02"});
    const auto values = sample(source, 1, 2, {0.1, 0.2, 0.3});
    const auto expected = written_values(3, 2, {0.1, 0.2, 0.3}, 1.5, 2);
    for (std::size_t index = 0; index < 4; ++index) {
        CHECK(values[index] == Approx(expected[3 + index]).margin(round_off));
    }
}

TEST_CASE("A file of coordinates alone is the mesh of others, or is drawn by the elements' numbers", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.code = "X";
    file.numbers = {3, 2, 1};
    const std::string mesh = folder.write("a0.f00000", file.content());
    const auto alone = open_nek5000({mesh});
    REQUIRE(alone.fields().size() == 1);
    CHECK(alone.fields()[0].name == "number");
    CHECK(sample(alone, 0, 1, {0, 0, 0}) == std::vector<double>{2});
    file.code = "UPTS02";
    const auto source = open_nek5000({mesh, folder.write("a0.f00001", file.content())});
    CHECK(source.times().size() == 1);
    CHECK(difference(source, 0, 1.5) < round_off);
}

TEST_CASE("Meshes that move are refused, those written again are not", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    const std::string first = folder.write("a0.f00001", file.content());
    file.numbers = {2, 1, 3};
    file.real_size = 4;
    const std::string again = folder.write("a0.f00002", file.content());
    CHECK(failure({first, again}) == "no failure");
    // Other orders are other nodes, but corners of the same mesh stay where they are.
    file.n = 7;
    CHECK(failure({first, folder.write("a0.f00003", file.content())}) == "no failure");
    file.shift = 1e-3;
    CHECK_THAT(failure({first, folder.write("a0.f00004", file.content())}),
               Contains("a0.f00004") && Contains("element 1 ") && Contains("0.001") && Contains("move"));
    file.n = 5;
    CHECK_THAT(failure({first, folder.write("a0.f00005", file.content())}), Contains("element 1 ") && Contains("move"));
    CHECK(failure({folder.path("a0.f00005")}) == "no failure");
    file = {};
    std::string content = file.content();
    content.replace(136 + 4 * 3 + 8 * 130, 8, real_bytes(std::nan(""), 8, false));
    CHECK_THAT(failure({first, folder.write("a0.f00006", content)}),
               Contains("a0.f00006") && Contains("element 1 has a coordinate that is not finite"));
}

TEST_CASE("Steps of different orders are converted at the highest", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    const std::string first = folder.write("a0.f00001", file.content());
    file.n = 7;
    file.code = "UPTS02";
    file.time = 2;
    const auto source = open_nek5000({first, folder.write("a0.f00002", file.content())});
    CHECK(difference(source, 0, 1.5) < round_off);
    CHECK(difference(source, 1, 2) < round_off);
    const ConvertedVolume volume(source);
    CHECK(volume.description().classes.at(0).fields.at(0).order == std::array<std::uint32_t, 3>{6, 6, 6});
    CHECK(volume.description().classes.at(0).geometry.order == std::array<std::uint32_t, 3>{4, 4, 4});
    CHECK(volume.report().fields.at(0).exact);
}
