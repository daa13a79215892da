/*
 * The analytic plugin: its format, its bounds, and errors that name file and line.
 */
#include "fixtures.hpp"

#include <core/plugin_host/runtime_volume.hpp>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::TemporaryFolder;

namespace {

const std::string cube = "vertex 0 0 0\nvertex 1 0 0\nvertex 1 2 0\nvertex 0 2 0\n"
                         "vertex 0 0 3\nvertex 1 0 3\nvertex 1 2 3\nvertex 0 2 4\nhexahedron 0 1 2 3 4 5 6 7\n";

RuntimeVolume open(const std::string& path) { return RuntimeVolume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), path); }

/** Error for a file with this content after the header. */
std::string error_for(const std::string& content) {
    const TemporaryFolder folder;
    const std::string path = folder.write("bad.txt", "elvis-analytic 1\n" + content);
    const std::string text = error_of([&] { open(path); });
    CHECK_THAT(text, Contains(path));
    return text;
}

} // namespace

TEST_CASE("the analytic plugin gives only what is required") {
    const auto plugin = Plugin::load(ELVIS_ANALYTIC_PLUGIN);
    CHECK(plugin->id() == "org.elvis.analytic");
    CHECK(plugin->converter() == nullptr);
    const elvis_runtime& table = *plugin->runtime();
    CHECK_FALSE(table.get_element_numbers);
    CHECK_FALSE(table.get_faces);
    CHECK_FALSE(table.get_boundary_group);
    CHECK_FALSE(table.get_field_ranges);
    CHECK_FALSE(table.get_note);
    CHECK_FALSE(table.evaluate_mapping);
    CHECK_FALSE(table.evaluate_field);
    CHECK(open(ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt").snippet(0).capabilities == 0);
}

TEST_CASE("the analytic plugin reads its format") {
    const TemporaryFolder folder;
    const RuntimeVolume volume =
        open(folder.write("good.txt", "elvis-analytic 1 # header\n\nfield u 2 m/s\nterm 0 sine 1 2 3 4 5\n"
                                      "term 1 pole 7 8 9 10\nfield v 1\nterm 0 gaussian 1 0 0 0 2\n" +
                                          cube));
    CHECK(volume.n_elements() == 1);
    REQUIRE(volume.fields().size() == 2);
    CHECK(volume.fields()[0].unit == "m/s");
    CHECK(volume.fields()[0].n_components == 2);
    CHECK(volume.class_field(0, 0).order[0] == -1);
    const BufferInfo terms = volume.buffer(1, 0);
    CHECK(terms.record_size == 16);
    std::vector<double> numbers(16);
    elvis_fill_request request{};
    request.buffer = 1;
    request.count = 1;
    volume.fill_buffer(request, numbers.data());
    CHECK(numbers == std::vector<double>{0, 0, 1, 5, 2, 3, 4, 0, 2, 1, 7, 0, 8, 9, 10, 0});
    std::vector<double> bounds(6);
    CHECK(volume.bounds(0, 1, bounds) == ELVIS_CERTIFIED);
    const double expected[] = {0, 0, 0, 1, 2, 4};
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(bounds[i] == Approx(expected[i]).margin(1e-4));
        CHECK((i < 3 ? bounds[i] <= expected[i] : bounds[i] >= expected[i]));
    }
}

TEST_CASE("the analytic plugin is sure of its own files only") {
    const TemporaryFolder folder;
    const auto probe = [](const std::string& path) {
        std::uint32_t confidence = 7;
        CHECK(Plugin::load(ELVIS_ANALYTIC_PLUGIN)->runtime()->probe(nullptr, path.c_str(), &confidence) == ELVIS_OK);
        return confidence;
    };
    CHECK(probe(ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt") == 100);
    CHECK(probe(folder.write("other.txt", "something else")) == 0);
    CHECK(probe(folder.write("empty.txt", "")) == 0);
    CHECK(probe("/does/not/exist") == 0);
}

TEST_CASE("a bad analytic file is refused with its line") {
    CHECK_THAT(error_for("field u\n"), Contains("line 2: the number of components"));
    CHECK_THAT(error_for("field u 0\n"), Contains("line 2") && Contains("1 to 16"));
    CHECK_THAT(error_for("field u 1\nterm 0 sine 1 2 3\n"), Contains("line 3: parameter of the term is missing"));
    CHECK_THAT(error_for("field u 1\nterm 1 sine 1 2 3 4 5\n"),
               Contains("line 3: the component must be from 0 to 0, and is 1"));
    CHECK_THAT(error_for("field u 1\nterm 0 tan 1\n"), Contains("line 3: unknown term 'tan'"));
    CHECK_THAT(error_for("field u 1\nterm 0 gaussian 1 0 0 0 0\n"), Contains("line 3: the width"));
    CHECK_THAT(error_for("term 0 sine 1 2 3 4 5\n"), Contains("line 2: a term before any field"));
    CHECK_THAT(error_for("vertex 0 0\n"), Contains("line 2: coordinate is missing"));
    CHECK_THAT(error_for("vertex 0 0 1e999\n"), Contains("line 2: '1e999' is no coordinate"));
    CHECK_THAT(error_for("vertex 0 0 0 0\n"), Contains("line 2: '0' is too much"));
    CHECK_THAT(error_for("hexahedron 0 0 0 0 0 0 0 0\n"), Contains("line 2: there is no vertex 0"));
    CHECK_THAT(error_for("\n# comment\ntetrahedron\n"), Contains("line 4: unknown keyword 'tetrahedron'"));
    CHECK_THAT(error_for(cube + "field u 1\n"), Contains("field 'u' has no terms"));
    CHECK_THAT(error_for("field u 1\nterm 0 sine 1 2 3 4 5\n"), Contains("holds no elements"));
    const TemporaryFolder folder;
    CHECK_THAT(error_of([&] { open(folder.write("version.txt", "elvis-analytic 2\n")); }), Contains("line 1"));
    CHECK_THAT(error_of([&] { open(folder.write("empty.txt", "")); }), Contains("the file ends"));
    CHECK_THAT(error_of([&] { open("/does/not/exist"); }), Contains("/does/not/exist: cannot be read"));
}
