// What the reader makes of meshes and collections for which there are no reference values, and what it refuses.
#include "fixture.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>

using namespace elvis;
using Catch::Contains;

namespace {

using elvis::oracle::Vector;

/** Two unit cubes side by side. */
const std::string two_cubes = R"(MFEM mesh v1.3

dimension
3

elements
2
1 5 0 1 4 3 6 7 10 9
2 5 1 2 5 4 7 8 11 10

attribute_sets
1
"all of it"
2
1 2

boundary
3
1 3 0 3 9 6
2 3 2 5 11 8
7 3 0 1 7 6

bdr_attribute_sets
2
"ends"
2
1 2
"inflow"
1
1

vertices
12
3
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
0 0 1
1 0 1
2 0 1
0 1 1
1 1 1
2 1 1

mfem_mesh_end
)";

/** Degrees of freedom of a collection on a mesh, as the plugin counts them. */
std::size_t count_dofs(const std::string& mesh, const std::string& collection) {
    const TemporaryFolder folder;
    const std::string message = failure({mesh, folder.write("empty.gf", space_text(collection))});
    INFO(message);
    const std::size_t words_after = message.find(" degrees of freedom");
    const std::size_t words_before = message.rfind("has ", words_after);
    REQUIRE(words_after != std::string::npos);
    REQUIRE(words_before != std::string::npos);
    return std::stoul(message.substr(words_before + 4));
}

/** A field with the same or with random coefficients. */
SourceVolume open_field(const std::string& mesh, const std::string& collection, bool is_random) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::ostringstream text;
    text.precision(17);
    text << space_text(collection);
    for (std::size_t n = count_dofs(mesh, collection); n > 0; --n) {
        text << (is_random ? uniform(generator) : 1) << '\n';
    }
    const TemporaryFolder folder;
    return open_mfem({mesh, folder.write("field.gf", text.str())});
}

/** What must agree on both sides of a face (or an edge of two corners): value, tangential components or flux, at a few points.
 */
std::vector<double> trace(const SourceVolume& source, std::uint64_t number, const elvis_source_element& element, int face) {
    const auto shape = static_cast<native::Shape>(element.shape);
    const auto corners = native::face_corners(shape, face);
    const auto n = static_cast<int>(corners.size());
    const auto id = [&](int place) { return element.corners[corners[static_cast<std::size_t>((place + n) % n)]]; };
    const auto at = [&](int place) {
        const auto x = native::corner(shape, corners[static_cast<std::size_t>((place + n) % n)]);
        return Vector(x[0], x[1], x[2]);
    };
    // Frame: from the corner of least id to its neighbours, that of lesser id first. The map of a face is that of its corners.
    int first = 0;
    for (int place = 1; place < n; ++place) {
        first = id(place) < id(first) ? place : first;
    }
    const int step = id(first + 1) < id(first - 1) ? 1 : -1;
    const Vector s = at(first + step) - at(first), t = at(first - step) - at(first);
    std::vector<double> result;
    for (const auto& [a, b] : {std::pair(0.2, 0.3), std::pair(0.45, 0.05), std::pair(0.1, 0.75)}) {
        const Vector xi = at(first) + a * s + b * t;
        std::vector<double> u(source.n_values());
        source.sample(0, number, std::array{xi[0], xi[1], xi[2]}, u);
        const elvis_transform transform = source.fields()[0].transform;
        if (transform == ELVIS_TRANSFORM_NONE) {
            result.insert(result.end(), u.begin(), u.end());
            continue;
        }
        const Vector pulled_back(u[0], u[1], n == 2 ? 0 : u[2]);
        // Edges in the plane have one tangent.
        if (transform == ELVIS_TRANSFORM_COVARIANT) {
            result.push_back(pulled_back.dot(s));
            result.push_back(pulled_back.dot(t));
        } else {
            result.push_back(pulled_back.dot(s.cross(n == 2 ? Vector(Vector::UnitZ()) : t)));
        }
    }
    return result;
}

} // namespace

TEST_CASE("fields that should be continuous are, whatever the coefficients", "[mfem][data]") {
    const std::string data = GENERATE("mfem/poisson-inline-tet-p6/mesh", "mfem/poisson-inline-wedge-p5/mesh",
                                      "mfem/poisson-fichera-mixed-p2-p3/mesh", "mfem/maxwell-fichera-q3-nd3/mesh",
                                      "mfem/poisson-inline-pyramid-p3/mesh", "mfem-more/meshes/star-mixed-p2",
                                      "mfem-more/meshes/square-disc", "mfem-more/meshes/klein-bottle");
    const std::string space =
        GENERATE("H1_*_P4", "H1Pos_*_P3", "H1@U_*_P5", "ND_*_P1", "ND_*_P2", "ND_*_P4", "RT_*_P0", "RT_*_P1", "RT_*_P3");
    const bool is_flat = data.starts_with("mfem-more");
    const std::string collection = replaced(space, "*", is_flat ? "2D" : "3D");
    if (data == "mfem/poisson-inline-pyramid-p3/mesh" && !space.starts_with("H1_") && !space.starts_with("H1@")) {
        return;
    }
    // Surfaces in space have no vector fields.
    if (data == "mfem-more/meshes/klein-bottle" && !space.starts_with("H1")) {
        return;
    }
    const auto source = open_field(test::data_file(data + ".mesh"), collection, true);
    std::map<std::set<std::int64_t>, std::vector<double>> traces;
    double jump = 0;
    std::size_t n_shared = 0;
    for (std::uint64_t number = 0; number < source.info().n_elements; ++number) {
        const auto element = get_element(source, number);
        const auto shape = static_cast<native::Shape>(element.shape);
        for (int face = 0; face < native::n_faces(shape); ++face) {
            std::set<std::int64_t> key;
            for (int corner : native::face_corners(shape, face)) {
                key.insert(element.corners[corner]);
            }
            const auto here = trace(source, number, element, face);
            const auto [there, is_new] = traces.emplace(key, here);
            n_shared += is_new ? 0 : 1;
            for (std::size_t i = 0; i < here.size(); ++i) {
                jump = std::max(jump, std::abs(here[i] - there->second[i]));
            }
        }
    }
    INFO(data << ", " << collection);
    CHECK(n_shared >= (is_flat ? 40 : 100));
    CHECK(jump <= 1e-11);
}

TEST_CASE("equal coefficients are a constant", "[mfem][data]") {
    const std::string space = GENERATE("H1_*_P1", "H1_*_P5", "H1Pos_*_P4", "L2_*_P0", "L2_*_P3", "L2_T1_*_P2", "L2_T2_*_P3",
                                       "L2_T3_*_P2", "L2_T4_*_P3", "L2_T5_*_P1");
    const std::string mesh = GENERATE("mfem/poisson-fichera-mixed-p2-p3/mesh", "mfem/poisson-inline-pyramid-p3/mesh",
                                      "mfem-more/meshes/star-mixed-p2");
    const bool has_pyramids = mesh == "mfem/poisson-inline-pyramid-p3/mesh";
    if (has_pyramids &&
        (space == "H1Pos_*_P4" || space.starts_with("L2_T1") || space.starts_with("L2_T2") || space.starts_with("L2_T4"))) {
        return;
    }
    const std::string collection = replaced(space, "*", mesh.starts_with("mfem-more") ? "2D" : "3D");
    const auto source = open_field(test::data_file(mesh + ".mesh"), collection, false);
    double error = 0;
    for (std::uint64_t number = 0; number < source.info().n_elements; number += 7) {
        // The first is the apex of pyramids.
        const std::vector<double> xi{-1, -1, 1, -0.8, -0.7, -0.9, -0.5, -0.6, -0.3};
        std::vector<double> values(3);
        source.sample(0, number, xi, values);
        for (double value : values) {
            error = std::max(error, std::abs(value - 1));
        }
    }
    INFO(collection);
    CHECK(error <= 1e-13);
}

TEST_CASE("several fields of one mesh", "[mfem]") {
    const TemporaryFolder folder;
    std::string interleaved, separate;
    // x, then x^2 + 1 at the vertices.
    for (int component = 0; component < 2; ++component) {
        for (int vertex = 0; vertex < 12; ++vertex) {
            const int x = vertex % 3;
            separate += std::to_string(component == 0 ? x : x * x + 1) + "\n";
        }
    }
    for (int vertex = 0; vertex < 12; ++vertex) {
        const int x = vertex % 3;
        interleaved += std::to_string(x) + " " + std::to_string(x * x + 1) + "\n";
    }
    const std::string long_header = "MFEM FiniteElementSpace v1.0\nFiniteElementCollection: L2_3D_P0\nVDim: 1\nOrdering: 0\n"
                                    "End: MFEM FiniteElementSpace v1.0\n\n3.25\n-1.5e1\n";
    std::filesystem::create_directory(folder.path("other"));
    const auto source =
        open_mfem({folder.write("two.mesh", two_cubes), folder.write("separate.gf", space_text("H1_3D_P1", 2, 0) + separate),
                   folder.write("pressure.gf", long_header),
                   folder.write("other/separate.gf", space_text("H1_3D_P1", 2, 1) + interleaved)});
    REQUIRE(source.fields().size() == 3);
    CHECK(source.fields()[0].name == "separate");
    CHECK(source.fields()[0].n_components == 2);
    CHECK(source.fields()[0].continuity == ELVIS_CONTINUITY_CONTINUOUS);
    CHECK(source.fields()[1].name == "pressure");
    CHECK(source.fields()[1].continuity == ELVIS_CONTINUITY_DISCONTINUOUS);
    CHECK(source.fields()[2].name == "separate 2");
    std::array<double, 5> values;
    source.sample(0, 1, std::array{0.5, 0.0, 0.0}, values);
    CHECK(values[0] == Approx(1.75));
    CHECK(values[1] == Approx(2 + 0.75 * 3));
    CHECK(values[2] == -15);
    CHECK(values[3] == values[0]);
    CHECK(values[4] == values[1]);
}

TEST_CASE("boundary attributes are groups of faces, named after their sets", "[mfem]") {
    const TemporaryFolder folder;
    const auto source = open_mfem({folder.write("two.mesh", two_cubes), folder.write("u.gf", space_text("L2_3D_P0") + "1 2")});
    // Attribute 1 is in both sets: the smaller one names it.
    REQUIRE(source.boundary_groups() == std::vector<std::string>{"inflow", "ends", "attribute 7"});
    const auto left = get_element(source, 0), right = get_element(source, 1);
    CHECK(std::vector<int>(left.face_groups, left.face_groups + 6) == std::vector<int>{-1, 2, -1, -1, 0, -1});
    CHECK(std::vector<int>(right.face_groups, right.face_groups + 6) == std::vector<int>{-1, -1, 1, -1, -1, -1});
}

TEST_CASE("a refined hexahedron becomes its children, at the scale of the refinement", "[mfem]") {
    // One cube, refined in x into a quarter and three quarters.
    const std::string mesh = R"(MFEM NC mesh v1.1
dimension
3
elements
3
-1 1 5 1 1 2
0 1 5 0 0 8 9 3 4 10 11 7
0 1 5 0 8 1 2 9 10 5 6 11
boundary
1
4 3 0 3 7 4
vertex_parents
4
8 0 1 0.25
9 3 2 0.25
10 4 5 0.25
11 7 6 0.25
coordinates
8
3
0 0 0
4 0 0
4 4 0
0 4 0
0 0 4
4 0 4
4 4 4
0 4 4
mfem_mesh_end
)";
    const TemporaryFolder folder;
    const auto source = open_mfem({folder.write("nc.mesh", mesh), folder.write("u.gf", space_text("L2_3D_P0") + "1 2")});
    REQUIRE(source.info().n_elements == 2);
    std::array<double, 3> x;
    source.evaluate_mapping(0, std::array{1.0, 1.0, 1.0}, x);
    CHECK(x == std::array{1.0, 4.0, 4.0});
    source.evaluate_mapping(1, std::array{0.0, 0.0, 0.0}, x);
    CHECK(x == std::array{2.5, 2.0, 2.0});
    CHECK(get_element(source, 0).face_groups[4] == 0);
    CHECK(source.boundary_groups() == std::vector<std::string>{"attribute 4"});
}

TEST_CASE("what cannot be read is refused with its place", "[mfem]") {
    const TemporaryFolder folder;
    const std::string solution = folder.write("u.gf", space_text("L2_3D_P0") + "1 2");
    const auto of_mesh = [&](const std::string& text) { return failure({folder.write("bad.mesh", text), solution}); };
    const std::string good = folder.write("two.mesh", two_cubes);
    const auto of_solution = [&](const std::string& text) { return failure({good, folder.write("bad.gf", text)}); };
    REQUIRE(of_mesh(two_cubes) == "no failure");

    CHECK_THAT(of_mesh("MFEM NC NURBS mesh v1.0\n"), Contains("line 1") && Contains("NURBS") && Contains("not supported"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "v1.3", "v1.1")), Contains("line 1") && Contains("not supported"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "dimension\n3", "dimension\n2")), Contains("line 8") && Contains("geometry"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "dimension\n3", "dimension\n1")), Contains("line 8") && Contains("geometry"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "elements\n2\n", "elements\n999999999\n")), Contains("line 7") && Contains("hold"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "elements\n2\n", "elements\n-1\n")), Contains("line 7"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "2 5 1 2 5", "2 5 1 2 55")), Contains("element 1") && Contains("vertex 55"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "2 5 1 2 5", "2 3 1 2 5")), Contains("line 9") && Contains("geometry"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "1 3 0 3 9 6", "1 3 0 x 9 6")), Contains("line 19") && Contains("'x'"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "2 1 1\n\nmfem_mesh_end\n", "")), Contains("ends"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "0 0 0\n", "0 nan 0\n")), Contains("finite"));
    CHECK_THAT(of_mesh(two_cubes + "communication_groups\n"), Contains("mfem_mesh_end"));
    CHECK_THAT(of_mesh(two_cubes + "more\n"), Contains("'more'"));
    CHECK_THAT(of_mesh(replaced(two_cubes, "\"ends\"", "\"ends")), Contains("quotes"));

    CHECK_THAT(of_solution(space_text("L2_3D_P0") + "1"), Contains("bad.gf") && Contains("1 values") && Contains("2 degrees"));
    CHECK_THAT(of_solution(space_text("L2_3D_P0") + "1 two"), Contains("line 6"));
    CHECK_THAT(of_solution(space_text("L2Int_3D_P0") + "1 2"), Contains("line 2") && Contains("densities"));
    CHECK_THAT(of_solution(space_text("H1_4D_P2") + "1 2"), Contains("line 2") && Contains("'H1_4D_P2'"));
    CHECK_THAT(of_solution(space_text("H1_2D_P2") + "1 2"), Contains("bad.gf") && Contains("dimension 2"));
    CHECK_THAT(of_solution(space_text("H1_3D_P99") + "1 2"), Contains("0") && Contains("20"));
    CHECK_THAT(of_solution(space_text("NURBS2") + "1 2"), Contains("NURBS"));
    CHECK_THAT(of_solution(space_text("RT_3D_P1", 3) + "1 2"), Contains("line 3"));
    CHECK_THAT(of_solution(two_cubes), Contains("FiniteElementSpace"));
    CHECK_THAT(failure({good, folder.path("missing.gf")}), Contains("missing.gf") && Contains("opened"));
    const std::string pyramids = mfem_data("poisson-inline-pyramid-p3/mesh.mesh");
    CHECK_THAT(failure({pyramids, folder.write("bad.gf", space_text("ND_3D_P2") + "1")}),
               Contains("yramid") || Contains("values"));

    // Cycles among the elements and the vertices of a nonconforming mesh.
    const std::string tree =
        "MFEM NC mesh v1.0\ndimension\n3\nelements\n3\n-1 1 5 1 1 2\n-1 1 5 1 0 2\n0 1 5 0 0 1 2 3 4 5 6 7\n";
    CHECK_THAT(of_mesh(tree), Contains("two parents"));
    const std::string cycle = "MFEM NC mesh v1.0\ndimension\n3\nelements\n1\n0 1 5 0 0 1 2 3 4 5 6 7\nvertex_parents\n2\n"
                              "6 7 0\n7 6 0\ncoordinates\n6\n3\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1\n";
    CHECK_THAT(of_mesh(cycle), Contains("ancestor"));
}
