// Meshes of segments, which are read as bands.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

/** From 0 over 1 to 3; the second segment goes from 3 to 1. */
const std::string two_segments = R"(MFEM mesh v1.0
dimension
1
elements
2
5 1 0 1
6 1 2 1
boundary
2
1 0 0
2 0 2
vertices
3
1
0
1
3
)";

double value(const SourceVolume& source, std::uint64_t element, double along, double across) {
    std::array<double, 1> found{};
    source.sample(0, element, std::array{along, across, 0.0}, found);
    return found[0];
}

std::array<double, 3> place(const SourceVolume& source, std::uint64_t element, double along, double across) {
    std::array<double, 3> x{};
    source.evaluate_mapping(element, std::array{along, across, 0.0}, x);
    return x;
}

} // namespace

TEST_CASE("segments become a band, with values that are constant across", "[mfem]") {
    const TemporaryFolder folder;
    const std::string mesh = folder.write("line.mesh", two_segments);
    // x^2 by its values at vertices and middles, and 1, 2 and 3, 4 from the first to the second vertex of each segment.
    const std::string square = folder.write("square.gf", space_text("H1_1D_P2") + "0 1 9 0.25 4");
    const std::string jumping = folder.write("jumping.gf", space_text("L2_T1_1D_P1") + "1 2 3 4");
    const auto source = open_mfem({mesh, square}), steps = open_mfem({mesh, jumping});
    REQUIRE(source.info().n_elements == 2);
    CHECK(get_element(source, 0).shape == ELVIS_SHAPE_QUADRILATERAL);
    REQUIRE(source.boundary_groups() == std::vector<std::string>{"attribute 1", "attribute 2"});
    for (const double across : {-1.0, -0.3, 1.0}) {
        for (const double along : {-1.0, 0.2, 0.9}) {
            for (const std::uint64_t element : {0, 1}) {
                const auto x = place(source, element, along, across);
                CHECK(x[0] == Approx(element == 0 ? (1 + along) / 2 : 2 - along).margin(1e-14));
                CHECK(std::hypot(x[1], x[2]) == Approx(0.075 * std::abs(across)));
                CHECK(value(source, element, along, across) == Approx(x[0] * x[0]).margin(1e-13));
            }
            CHECK(value(steps, 0, along, across) == Approx(1.5 + along / 2));
            CHECK(value(steps, 1, along, across) == Approx(3.5 + along / 2));
        }
    }
    CHECK(convert_mfem(source).report.fields.at(0).exact);
}

TEST_CASE("what does not fit segments is refused", "[mfem]") {
    const TemporaryFolder folder;
    const std::string mesh = folder.write("line.mesh", two_segments);
    const auto of_mesh = [&](const std::string& text) { return failure({folder.write("bad.mesh", text)}); };
    const auto of_solution = [&](const std::string& text) { return failure({mesh, folder.write("bad.gf", text)}); };
    CHECK_THAT(of_mesh(replaced(two_segments, "6 1 2 1", "6 1 2 9")), Contains("vertex 9"));
    CHECK_THAT(of_mesh(replaced(two_segments, "6 1 2 1", "6 2 2 1")), Contains("line 7") && Contains("segment"));
    CHECK_THAT(of_mesh(replaced(two_segments, "2 0 2", "2 0 7")), Contains("vertex 7"));
    CHECK_THAT(of_solution(space_text("H1_1D_P2") + "0 1 9 0.25"), Contains("bad.gf"));
    CHECK_THAT(of_solution(space_text("H1_2D_P2") + "0 1 9 0.25 4"), Contains("dimension"));
    CHECK_THAT(of_solution(space_text("ND_1D_P1") + "0 1"), Contains("bad.gf"));
}
