// Root files of VisItDataCollections, streams for GLVis.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

std::string root(const char* cycle) {
    return test::data_file(std::string("mfem-more/star-visit/solution_00000") + cycle + ".mfem_root");
}

} // namespace

TEST_CASE("cycles of a collection are time steps", "[mfem][data]") {
    const auto source = open_mfem({root("5"), root("6")});
    REQUIRE(source.times() == std::vector<double>{0.25, 0.5});
    REQUIRE(source.fields().size() == 1);
    CHECK(source.fields()[0].name == "sol");
    const auto second = open_mfem({test::data_file("mfem-more/star-visit/solution_000006/mesh.000000"),
                                   test::data_file("mfem-more/star-visit/solution_000006/sol.000000")});
    double error = 0, change = 0;
    for (const ReferencePoint& point : read_reference(test::data_file("mfem-more/star-visit/sol.ref"), 1)) {
        const std::array xi{point.xi[0], point.xi[1], point.xi[2]};
        std::array<double, 1> value, later, alone;
        source.sample(0, point.element, xi, value);
        source.sample(1, point.element, xi, later);
        second.sample(0, point.element, xi, alone);
        error = std::max(error, std::abs(value[0] - point.value[0]));
        change = std::max(change, std::abs(later[0] - value[0]));
        CHECK(later == alone);
    }
    CHECK(error <= 1e-14);
    CHECK(change > 0.1);
}

TEST_CASE("a stream for GLVis holds mesh and solution", "[mfem][data]") {
    const TemporaryFolder folder;
    const std::string name = GENERATE("mfem-more/star-h1-p3", "mfem-more/klein-bottle-h1-p4", "mfem-more/amr-quad-h1-p3");
    const std::string mesh = test::data_file(name + "/mesh.mesh"), solution = test::data_file(name + "/sol.gf");
    const auto source =
        open_mfem({folder.write("glvis.saved", "solution\n" + read_file(mesh) + "\n" + read_file(solution) + "\nkeys Am\n")});
    const auto expected = open_mfem({mesh, solution});
    REQUIRE(source.fields().size() == 1);
    CHECK(source.fields()[0].name == "solution");
    for (std::uint64_t element = 0; element < expected.info().n_elements; ++element) {
        std::array<double, 1> here, there;
        source.sample(0, element, std::array{-0.3, -0.4, 0.0}, here);
        expected.sample(0, element, std::array{-0.3, -0.4, 0.0}, there);
        CHECK(here == there);
    }
    CHECK_THAT(failure({folder.write("short.saved", "solution\n" + read_file(mesh))}),
               Contains("short.saved") && Contains("ends"));
}

TEST_CASE("what of a root file cannot be read is refused", "[mfem][data]") {
    const TemporaryFolder folder;
    const std::string text = read_file(root("5"));
    std::filesystem::create_directory(folder.path("solution_000005"));
    for (const char* name : {"solution_000005/mesh.000000", "solution_000005/sol.000000"}) {
        std::filesystem::copy_file(test::data_file(std::string("mfem-more/star-visit/") + name), folder.path(name));
    }
    const auto of = [&](const std::string& root_text) { return failure({folder.write("a.mfem_root", root_text)}); };
    REQUIRE(of(text) == "no failure");
    CHECK_THAT(of(replaced(text, "\"domains\": 1", "\"domains\": 4")), Contains("mesh.000001"));
    CHECK_THAT(of(replaced(text, "\"time\"", "\"tame\"")), Contains("a.mfem_root") && Contains("root file"));
    CHECK_THAT(of(replaced(text, "sol.%06d", "sol.%0xd")), Contains("number of a part"));
    CHECK_THAT(of(replaced(text, "sol.%06d", "other.%06d")), Contains("other.000000") && Contains("opened"));
    for (std::size_t size = 30; size + 3 < text.size(); size += 11) {
        CHECK(of(text.substr(0, size)) != "no failure");
    }
    const std::string good = folder.write("good.mfem_root", text);
    CHECK_THAT(failure({good, folder.write("b.mfem_root", replaced(text, "\"sol\"", "\"u\""))}),
               Contains("b.mfem_root") && Contains("fields"));
    const std::string moved = folder.write(
        "solution_000005/moved.000000", replaced(read_file(folder.path("solution_000005/mesh.000000")), "0.80901", "0.80900"));
    CHECK_THAT(failure({good, folder.write("b.mfem_root", replaced(text, "mesh.%06d", "moved.%06d"))}),
               Contains("moved.000000") && Contains("differs"));
    const std::string solution = replaced(read_file(folder.path("solution_000005/sol.000000")), "H1_2D_P3", "L2_2D_P3");
    folder.write("solution_000005/rough.000000", solution);
    CHECK_THAT(failure({good, folder.write("b.mfem_root", replaced(text, "sol.%06d", "rough.%06d"))}),
               Contains("rough.000000") && Contains("space"));
}
