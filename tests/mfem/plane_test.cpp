// Meshes of the plane and of surfaces in space.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace elvis;
using Catch::Contains;

namespace {

/** A square and two triangles, 1 wide and 2 high. */
const std::string square_and_triangles = R"(MFEM mesh v1.3
dimension
2
elements
3
5 3 0 1 3 2
6 2 2 3 5
7 2 2 5 4
boundary
3
1 1 1 0
2 1 2 0
3 1 5 4
bdr_attribute_sets
1
"walls" 2 1 3
vertices
6
2
0 0
1 0
0 1
1 1
0 2
1 2
mfem_mesh_end
)";

/** One square, refined into four children, in the file from the last to the first. */
const std::string refined_square = R"(MFEM NC mesh v1.0
dimension
2
elements
5
-1 1 3 3 4 3 2 1
0 1 3 0 7 8 6 3
0 1 3 0 8 5 2 6
0 1 3 0 4 1 5 8
0 1 3 0 0 4 8 7
boundary
1
9 1 0 4
vertex_parents
5
4 0 1
5 1 2
6 2 3
7 3 0
8 4 6
root_state
1
1
coordinates
4
2
0 0
2 0
2 2
0 2
mfem_mesh_end
)";

} // namespace

TEST_CASE("a mesh of the plane has quadrilaterals and triangles in the order of the file, and groups of edges", "[mfem]") {
    const TemporaryFolder folder;
    const auto source = open_mfem({folder.write("flat.mesh", square_and_triangles)});
    CHECK(source.info().dimension == 2);
    REQUIRE(source.info().n_elements == 3);
    const auto square = get_element(source, 0), triangle = get_element(source, 1), last = get_element(source, 2);
    CHECK(square.shape == ELVIS_SHAPE_QUADRILATERAL);
    CHECK(triangle.shape == ELVIS_SHAPE_TRIANGLE);
    REQUIRE(source.boundary_groups() == std::vector<std::string>{"walls", "attribute 2"});
    CHECK(std::vector<int>(square.face_groups, square.face_groups + 4) == std::vector<int>{0, -1, -1, 1});
    CHECK(std::vector<int>(last.face_groups, last.face_groups + 3) == std::vector<int>{-1, 0, -1});
    std::array<double, 3> x;
    source.evaluate_mapping(1, std::array{-1.0, 1.0, 0.7}, x);
    CHECK(x == std::array{1.0, 2.0, 0.0});
    source.evaluate_mapping(0, std::array{0.5, 0.0, 0.7}, x);
    CHECK(x == std::array{0.75, 0.5, 0.0});
}

TEST_CASE("a mesh without solutions has the attributes of its elements as a field", "[mfem]") {
    const TemporaryFolder folder;
    const auto source = open_mfem({folder.write("flat.mesh", square_and_triangles)});
    REQUIRE(source.fields().size() == 1);
    CHECK(source.fields()[0].name == "attribute");
    const Converted converted = convert_mfem(source);
    CHECK(converted.report.fields.at(0).exact);
    for (std::size_t number = 0; number < 3; ++number) {
        CHECK(converted.volume.field(converted.place.at(number), {-0.4, -0.5, 0}).at(0) == Approx(5.0 + double(number)));
    }
}

TEST_CASE("a refined square becomes its children, along the curve of the root's state", "[mfem]") {
    const TemporaryFolder folder;
    const auto source = open_mfem({folder.write("nc.mesh", refined_square)});
    REQUIRE(source.info().n_elements == 4);
    // State 1 goes round the other way: the corners 0, 3, 2, 1 of the parent.
    constexpr std::array<std::array<double, 3>, 4> centres{{{0.5, 0.5, 0}, {0.5, 1.5, 0}, {1.5, 1.5, 0}, {1.5, 0.5, 0}}};
    for (std::uint64_t element = 0; element < 4; ++element) {
        std::array<double, 3> x;
        source.evaluate_mapping(element, std::array{0.0, 0.0, 0.0}, x);
        CHECK(x == centres[element]);
    }
    CHECK(get_element(source, 0).face_groups[0] == 0);
}

TEST_CASE("surfaces in space are read with all their coordinates", "[mfem]") {
    const TemporaryFolder folder;
    std::string text = replaced(square_and_triangles, "6\n2\n", "6\n3\n");
    for (const char* point : {"0 0\n1", "1 0\n0", "0 1\n1", "1 1\n0", "0 2\n1", "1 2\nm"}) {
        text = replaced(text, point, std::string(point).insert(3, " 3"));
    }
    const auto source = open_mfem({folder.write("surface.mesh", text)});
    std::array<double, 3> x;
    source.evaluate_mapping(0, std::array{0.5, 0.0, 0.0}, x);
    CHECK(x == std::array{0.75, 0.5, 3.0});
    const std::string vectors = folder.write("u.gf", space_text("RT_2D_P0") + "1 2 3 4 5 6 7 8");
    CHECK_THAT(failure({folder.path("surface.mesh"), vectors}), Contains("u.gf") && Contains("surfaces in space"));
}

// Data with values of MFEM are of even order only: MFEM, fem/fe/fe_rt.cpp, RT_QuadrilateralElement.
TEST_CASE("Raviart-Thomas squares of odd order have MFEM's signs at their middle nodes", "[mfem][data]") {
    const TemporaryFolder folder;
    // Eight functions of edges, then those inside.
    const std::string solution = folder.write("u.gf", space_text("RT_2D_P1") + "0 0 0 0 0 0 0 0 1 1 1 1");
    const auto source = open_mfem({test::data_file("mfem-more/meshes/ref-square.mesh"), solution});
    // The two Gauss-Legendre points; the node between the closed ones is 0. In xi values are halved.
    const double open = 1 / std::sqrt(3);
    const auto value = [&](double xi, double eta) {
        std::array<double, 2> u;
        source.sample(0, 0, std::array{xi, eta, 0.0}, u);
        return u;
    };
    CHECK(value(0, -open)[0] == Approx(0.5));
    CHECK(value(0, open)[0] == Approx(-0.5));
    CHECK(value(-open, 0)[1] == Approx(-0.5));
    CHECK(value(open, 0)[1] == Approx(0.5));
}

TEST_CASE("what of a mesh in two dimensions cannot be read is refused with its place", "[mfem]") {
    const TemporaryFolder folder;
    const auto of_mesh = [&](const std::string& text) { return failure({folder.write("bad.mesh", text)}); };
    REQUIRE(of_mesh(square_and_triangles) == "no failure");
    REQUIRE(of_mesh(refined_square) == "no failure");
    CHECK_THAT(of_mesh(replaced(square_and_triangles, "5 3 0", "5 4 0")), Contains("line 6") && Contains("geometry"));
    CHECK_THAT(of_mesh(replaced(square_and_triangles, "1 1 1 0", "1 2 1 0")), Contains("line 11") && Contains("geometry"));
    CHECK_THAT(of_mesh(replaced(square_and_triangles, "6\n2\n", "6\n1\n")), Contains("coordinates of a vertex"));
    CHECK_THAT(of_mesh(replaced(square_and_triangles, "6 2 2 3 5", "6 2 2 3 6")), Contains("vertex 6"));
    CHECK_THAT(of_mesh(replaced(refined_square, "state\n1\n1", "state\n1\n8")), Contains("0..7"));
    const std::string nodes = "vertices\n6\n\nnodes\n" + space_text("H1_2D_P1", 1) + "0 1 0 1 0 1\n";
    const std::string curved = square_and_triangles.substr(0, square_and_triangles.find("vertices")) + nodes;
    CHECK_THAT(of_mesh(curved), Contains("two or three components"));
    CHECK_THAT(of_mesh(replaced(curved, "H1_2D_P1", "H1_3D_P1").replace(curved.find("VDim: 1"), 7, "VDim: 2")),
               Contains("dimension 3"));
}

TEST_CASE("all meshes that MFEM brings are read", "[mfem][data]") {
    std::size_t n_read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::data_file("mfem-more/meshes"))) {
        INFO(entry.path());
        CHECK(failure({entry.path().string()}) == "no failure");
        ++n_read;
    }
    CHECK(n_read == 80);
}
