// What cannot be read is refused with file, place and cause.
#include "nek5000_fixture.hpp"
#include "written_file.hpp"

#include <catch2/catch.hpp>
#include <core/plugin_host/plugin.hpp>

using namespace elvis;
using Catch::Contains;

namespace {

std::string of(const TemporaryFolder& folder, const std::string& content) {
    return failure({folder.write("bad0.f00001", content)});
}

std::string replaced(std::string text, std::size_t place, const std::string& by) { return text.replace(place, by.size(), by); }

} // namespace

TEST_CASE("Headers that cannot be are refused", "[nek5000]") {
    const TemporaryFolder folder;
    const std::string good = WrittenFile{}.content();
    REQUIRE(of(folder, good) == "no failure");
    CHECK_THAT(of(folder, replaced(good, 5, "5")), Contains("bad0.f00001") && Contains("size of a number is 5"));
    CHECK_THAT(of(folder, replaced(good, 7, " 1")), Contains("1 x 5 x 5 nodes"));
    CHECK_THAT(of(folder, replaced(good, 7, "32")), Contains("32 x 5 x 5 nodes") && Contains("31"));
    CHECK_THAT(of(folder, replaced(good, 7, "-5")), Contains("nodes a direction is -5"));
    CHECK_THAT(of(folder, replaced(good, 7, "xx")), Contains("nodes a direction is missing or no number"));
    CHECK_THAT(of(folder, replaced(good, 16, "         4")), Contains("4 elements in this part") && Contains("3 in all"));
    CHECK_THAT(of(folder, replaced(good, 27, "         4")), Contains("4 elements in all") && Contains("parts have 3"));
    CHECK_THAT(of(folder, replaced(good, 27, "9999999999")), Contains("9999999999 elements"));
    CHECK_THAT(of(folder, replaced(good, 38, "never")), Contains("time"));
    CHECK_THAT(of(folder, replaced(good, 38, "                 nan")), Contains("time"));
    CHECK_THAT(of(folder, replaced(good, 76, "     0")), Contains("number of parts is 0"));
    CHECK_THAT(of(folder, replaced(good, 69, "     2      2")), Contains("number of this part is 2"));
    CHECK_THAT(of(folder, replaced(good, 83, "XVPT")), Contains("'XVPTS02' is no list of fields"));
    CHECK_THAT(of(folder, replaced(good, 83, "UXPT")), Contains("no list of fields"));
    CHECK_THAT(of(folder, replaced(good, 83, "XUPTS99")), Contains("promises"));
    CHECK_THAT(of(folder, replaced(good, 132, "1234")), Contains("byte 132") && Contains("6.54321"));
    CHECK_THAT(of(folder, good.substr(0, 100)), Contains("100 bytes"));
    const std::string without_ranges = good.substr(0, good.size() - 8 * 3 * 10);
    CHECK(of(folder, without_ranges) == "no failure");
    CHECK_THAT(of(folder, without_ranges.substr(0, without_ranges.size() - 1)), Contains("promises 30148"));
}

TEST_CASE("Elements that are missing or there twice are refused", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.numbers = {1, 2, 2};
    CHECK_THAT(of(folder, file.content()), Contains("byte 144") && Contains("element number 2 was there before"));
    const std::string good = WrittenFile{}.content();
    CHECK_THAT(of(folder, replaced(good, 136, integer_bytes(4, false))), Contains("byte 136") && Contains("4 is not in 1..3"));
    CHECK_THAT(of(folder, replaced(good, 140, integer_bytes(0, false))), Contains("number 2 is missing, but 0 is there"));
    CHECK_THAT(of(folder, replaced(good, 140, integer_bytes(-7, false))),
               Contains("byte 140") && Contains("-7 is not in 1..3"));
}

TEST_CASE("Coordinates that are not finite are refused, such values are not", "[nek5000]") {
    const TemporaryFolder folder;
    const std::string good = WrittenFile{}.content(), nan = real_bytes(std::nan(""), 8, false);
    const std::size_t first = 136 + 4 * 3;
    // In the second element's y.
    CHECK_THAT(of(folder, replaced(good, first + 8 * (3 * 125 + 125 + 7), nan)),
               Contains("element 2 ") && Contains("not finite"));
    const auto source = open_nek5000({folder.write("nan0.f00001", replaced(good, first + 8 * (9 * 125 + 3 * 125 + 7), nan))});
    CHECK(std::isnan(sample(source, 0, 1, {0.1, 0.2, 0.3})[0]));
    CHECK(std::isfinite(sample(source, 0, 0, {0.1, 0.2, 0.3})[0]));
}

TEST_CASE("Parts that do not fit together are refused", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    file.n_parts = 2;
    file.numbers = {1, 2};
    const std::string first = folder.write("a0.f00001", file.content());
    CHECK_THAT(failure({first}), Contains("a1.f00001") && Contains("opened"));
    file.part = 1;
    file.numbers = {3};
    folder.write("a1.f00001", file.content());
    REQUIRE(failure({first}) == "no failure");
    const auto with = [&](const WrittenFile& second) {
        folder.write("a1.f00001", second.content());
        return failure({first});
    };
    WrittenFile other = file;
    other.time = 3;
    CHECK_THAT(with(other), Contains("a1.f00001") && Contains("another time"));
    other = file;
    other.code = "XUPTS01";
    CHECK_THAT(with(other), Contains("other fields"));
    other = file;
    other.n = 6;
    CHECK_THAT(with(other), Contains("numbers of nodes"));
    other = file;
    other.part = 0;
    CHECK_THAT(with(other), Contains("part 0 of 2") && Contains("by its name it is part 1"));
    other = file;
    other.numbers = {3, 2};
    CHECK_THAT(with(other), Contains("3 elements in all") && Contains("parts have 4"));
    other.numbers = {2};
    CHECK_THAT(with(other), Contains("a1.f00001") && Contains("element number 2 was there before"));
    // The byte order may be another one.
    other = file;
    other.is_big = true;
    CHECK(with(other) == "no failure");
    CHECK_THAT(failure({folder.write("renamed.f00001", file.content())}), Contains("part 1 of 2") && Contains("name"));
}

TEST_CASE("Time steps that do not fit together are refused", "[nek5000]") {
    const TemporaryFolder folder;
    WrittenFile file;
    const std::string first = folder.write("a0.f00001", file.content());
    file.n_elements = 2;
    file.numbers = {1, 2};
    CHECK_THAT(failure({first, folder.write("a0.f00002", file.content())}),
               Contains("a0.f00002") && Contains("2 elements") && Contains("has 3"));
    file = {};
    file.dimension = 2;
    CHECK_THAT(failure({first, folder.write("a0.f00003", file.content())}), Contains("dimension 2"));
}

TEST_CASE("Lists that cannot be are refused", "[nek5000]") {
    const TemporaryFolder folder;
    folder.write("a0.f00001", WrittenFile{}.content());
    const auto list = [&](const std::string& text) { return failure({folder.write("bad.nek5000", text)}); };
    REQUIRE(list("filetemplate: a%01d.f%05d\nfirsttimestep: 1\nnumtimesteps: 1\n") == "no failure");
    CHECK_THAT(list("filetemplate: a%01d.f%05d\nfirsttimestep: 2\nnumtimesteps: 3\n"),
               Contains("bad.nek5000") && Contains("none of its files") && Contains("a0.f00002"));
    CHECK_THAT(list("filetemplate: a%01d.f%05d\nfirsttimestep: x\nnumtimesteps: 3\n"), Contains("firsttimestep is 'x'"));
    CHECK_THAT(list("filetemplate: a%01d.f%05d\nfirsttimestep: 1\n"), Contains("numtimesteps is missing"));
    CHECK_THAT(list("filetemplate: a%01d.f%05d\nfirsttimestep: 1\nnumtimesteps: 99999999\n"), Contains("99999999"));
    CHECK_THAT(list("filetemplate: a%s.f%05d\nfirsttimestep: 1\nnumtimesteps: 1\n"), Contains("%05d is expected"));
    CHECK_THAT(list("filetemplate: a%\nfirsttimestep: 1\nnumtimesteps: 1\n"), Contains("%05d is expected"));
    CHECK_THAT(list("filetemplate: a0.f00001\nfirsttimestep: 1\nnumtimesteps: 1\n"), Contains("no place for the step"));
    CHECK_THAT(list("filetemplate:\nfirsttimestep: 1\nnumtimesteps: 1\n"), Contains("no place for the step"));
    // A list that names itself.
    CHECK_THAT(list("filetemplate: bad.nek500%01d\nfirsttimestep: 0\nnumtimesteps: 1\n"), Contains("header"));
}

TEST_CASE("Files of other formats are not taken", "[nek5000]") {
    const auto plugin = Plugin::load(NEK5000_PLUGIN);
    for (const char* name : {"nektarpp/CubeAllElements.fld", "mfem/dg-fichera-q3-p4/mesh.mesh", "vtk/cells3.vtu",
                             "nek5000/io_test.re2", "nek5000/io_test.par", "elvis/bulletH1P2.dat"}) {
        INFO(name);
        std::uint32_t confidence = 1;
        CHECK(plugin->converter()->probe(nullptr, test::data_file(name).c_str(), &confidence) == ELVIS_OK);
        CHECK(confidence == 0);
    }
    std::uint32_t confidence = 0;
    CHECK(plugin->converter()->probe(nullptr, sample_file("fa2io_test.fld01").c_str(), &confidence) == ELVIS_OK);
    CHECK(confidence > 50);
    CHECK(plugin->converter()->probe(nullptr, "/", &confidence) == ELVIS_OK);
    CHECK(confidence == 0);
}
