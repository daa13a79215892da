// NURBS meshes and fields.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

using elvis::oracle::Vector;

/** Two squares side by side, the right one turned, of two splines of order 1 along x in the left one. */
const std::string two_patches = R"(MFEM NURBS mesh v1.0
dimension
2
elements
2
1 3 0 1 2 3
2 3 2 1 4 5
boundary
2
3 1 0 3
4 1 4 5
edges
7
0 0 1
0 3 2
1 1 2
1 3 0
2 1 4
2 2 5
1 4 5
vertices
6
knotvectors
3
1 3 0 0 0.25 1 1
1 2 0 0 1 1
1 2 0 0 1 1
weights
1 1 1 1 1 1 1 1
FiniteElementSpace
FiniteElementCollection: NURBS1
VDim: 2
Ordering: 1
0 0
4 0
4 1
0 1
6 0
6 1
1 0
1 1
)";

Vector position(const SourceVolume& source, std::uint64_t element, const Vector& xi) {
    std::array<double, 3> x;
    source.evaluate_mapping(element, std::array{xi[0], xi[1], xi[2]}, x);
    return {x[0], x[1], x[2]};
}

} // namespace

TEST_CASE("NURBS have the values that MFEM computes, and their conversion nearly", "[mfem][data]") {
    const std::string name = GENERATE("mfem-more/disc-nurbs-nurbs", "mfem-more/pipe-nurbs-nurbs");
    const auto source = open_mfem({test::data_file(name + "/mesh.mesh"), test::data_file(name + "/sol.gf")});
    const auto points = read_reference(test::data_file(name + "/sol.ref"), 1);
    REQUIRE(points.size() > 20);
    const Converted converted = convert_mfem(source);
    double extent = 0, of_source = 0, of_converted = 0;
    double source_position = 0, converted_position = 0;
    for (const ReferencePoint& point : points) {
        extent = std::max(extent, point.x.lpNorm<Eigen::Infinity>());
        source_position = std::max(source_position, (position(source, point.element, point.xi) - point.x).norm());
        std::array<double, 1> value;
        source.sample(0, point.element, std::array{point.xi[0], point.xi[1], point.xi[2]}, value);
        of_source = std::max(of_source, std::abs(value[0] - point.value[0]));
        const std::size_t place = converted.place.at(point.element);
        converted_position = std::max(converted_position, (converted.volume.position(place, point.xi) - point.x).norm());
        of_converted = std::max(of_converted, std::abs(converted.volume.field(place, point.xi).at(0) - point.value[0]));
    }
    WARN(name << ": source " << of_source << ", converted " << of_converted << ", positions " << source_position / extent
              << " and " << converted_position / extent << ", residual " << converted.report.fields.at(0).residual);
    CHECK(of_source <= 1e-13);
    CHECK(source_position <= 1e-14 * extent);
    // Circles are quotients: the report says that polynomials are not exact.
    CHECK(of_converted <= 1e-5);
    CHECK(converted_position <= 1e-5 * extent);
    CHECK_FALSE(converted.report.fields.at(0).exact);
    CHECK_FALSE(converted.report.geometry_exact);
}

TEST_CASE("NURBS of equal weights are polynomials, converted exactly", "[mfem][data]") {
    const std::string name = GENERATE("square-nurbs", "beam-quad-nurbs", "beam-hex-nurbs", "cube-nurbs");
    const auto source = open_mfem({test::data_file("mfem-more/meshes/" + name + ".mesh")});
    const Converted converted = convert_mfem(source);
    INFO(name);
    CHECK(converted.report.geometry_exact);
    CHECK(converted.report.fields.at(0).exact);
}

TEST_CASE("spans of knots are elements, patches share their control points", "[mfem]") {
    const TemporaryFolder folder;
    const std::string mesh = folder.write("two.mesh", two_patches);
    // x at the control points.
    const auto source = open_mfem({mesh, folder.write("x.gf", space_text("NURBS1") + "0 4 4 0 6 6 1 1")});
    REQUIRE(source.info().n_elements == 3);
    CHECK((position(source, 0, {1, 1, 0}) - Vector(1, 1, 0)).norm() <= 1e-15);
    CHECK((position(source, 1, {0, 0, 0}) - Vector(2.5, 0.5, 0)).norm() <= 1e-15);
    // The right patch begins at its vertex 2.
    CHECK((position(source, 2, {-1, -1, 0}) - Vector(4, 1, 0)).norm() <= 1e-15);
    CHECK((position(source, 2, {0, 1, 0}) - Vector(6, 0.5, 0)).norm() <= 1e-15);
    for (std::uint64_t element = 0; element < 3; ++element) {
        std::array<double, 1> value;
        source.sample(0, element, std::array{0.3, -0.6, 0.0}, value);
        CHECK(value[0] == Approx(position(source, element, {0.3, -0.6, 0})[0]));
    }
    CHECK(source.boundary_groups() == std::vector<std::string>{"attribute 3", "attribute 4"});
    CHECK(get_element(source, 0).face_groups[3] == 0);
    CHECK(get_element(source, 1).face_groups[3] == -1);
    CHECK(get_element(source, 2).face_groups[2] == 1);
}

TEST_CASE("knots run along their edge as the file has it, control points from the lower vertex to the higher", "[mfem]") {
    const bool is_forward = GENERATE(true, false);
    // Control points at the means of two knots make the parameter itself the coordinate.
    const std::string edge = is_forward ? "0 1" : "1 0", inner = is_forward ? "0.125 0\n0.625 0\n" : "0.375 0\n0.875 0\n";
    const std::string inner_above = is_forward ? "0.125 1\n0.625 1\n" : "0.375 1\n0.875 1\n";
    const std::string mesh = "MFEM NURBS mesh v1.0\ndimension\n2\nelements\n1\n1 3 0 1 3 2\nboundary\n0\nedges\n4\n0 " + edge +
                             "\n0 " + (is_forward ? "2 3" : "3 2") +
                             "\n1 1 3\n1 0 2\nvertices\n4\nknotvectors\n2\n2 4 0 0 0 0.25 1 1 1\n1 2 0 0 1 1\nweights\n"
                             "1 1 1 1 1 1 1 1\nFiniteElementSpace\nFiniteElementCollection: NURBS2\nVDim: 2\nOrdering: 1\n"
                             "0 0\n1 0\n0 1\n1 1\n" +
                             inner + inner_above;
    const TemporaryFolder folder;
    const auto source = open_mfem({folder.write("knots.mesh", mesh)});
    REQUIRE(source.info().n_elements == 2);
    const double knot = is_forward ? 0.25 : 0.75;
    CHECK((position(source, 0, {1, 0, 0}) - Vector(knot, 0.5, 0)).norm() <= 1e-15);
    CHECK((position(source, 0, {0, -1, 0}) - Vector(knot / 2, 0, 0)).norm() <= 1e-15);
    CHECK((position(source, 1, {0, 1, 0}) - Vector((1 + knot) / 2, 1, 0)).norm() <= 1e-15);
}

TEST_CASE("neighbouring elements of NURBS meshes meet", "[mfem][data]") {
    const std::string name = GENERATE("ball-nurbs", "pipe-nurbs", "disc-nurbs", "square-disc-nurbs", "square-disc-nurbs-patch",
                                      "pipe-nurbs-log", "beam-quad-nurbs-sf");
    const auto source = open_mfem({test::data_file("mfem-more/meshes/" + name + ".mesh")});
    // Corners with one number lie in one place.
    std::vector<Vector> place(source.info().n_corner_ids, Vector::Constant(std::nan("")));
    double distance = 0;
    for (std::uint64_t number = 0; number < source.info().n_elements; ++number) {
        const auto element = get_element(source, number);
        const auto shape = static_cast<native::Shape>(element.shape);
        for (int corner = 0; corner < native::n_corners(shape); ++corner) {
            const auto xi = native::corner(shape, corner);
            const Vector x = position(source, number, {xi[0], xi[1], xi[2]});
            Vector& known = place.at(static_cast<std::size_t>(element.corners[corner]));
            distance = std::max(distance, known[0] == known[0] ? (known - x).norm() : 0);
            known = x;
        }
    }
    INFO(name);
    CHECK(std::ranges::none_of(place, [](const Vector& x) { return x[0] != x[0]; }));
    CHECK(distance <= 1e-12);
    // Inner points of shared faces too: the geometry is continuous.
    const Converted converted = convert_mfem(source);
    CHECK(converted.report.n_unknown_faces == 0);
}

TEST_CASE("what of NURBS cannot be read is refused with its place", "[mfem]") {
    const TemporaryFolder folder;
    const auto of_mesh = [&](const std::string& text) { return failure({folder.write("bad.mesh", text)}); };
    REQUIRE(of_mesh(two_patches) == "no failure");
    CHECK_THAT(of_mesh(replaced(two_patches, "0.25", "-0.25")), Contains("line 25") && Contains("ascend"));
    CHECK_THAT(of_mesh(replaced(two_patches, "0 0 0.25 1 1", "0 0.1 0.25 1 1")), Contains("order + 1 times"));
    CHECK_THAT(of_mesh(replaced(two_patches, "1 4 5\nvertices", "1 4 2\nvertices")), Contains("edge"));
    CHECK_THAT(of_mesh(replaced(two_patches, "weights\n1", "weights\n0")), Contains("weight"));
    CHECK_THAT(of_mesh(replaced(two_patches, "1 3 0 1 2 3", "1 2 0 1 2")), Contains("neither a square"));
    CHECK_THAT(of_mesh(replaced(two_patches, "6 1\n1 0\n", "6 1\n")), Contains("values") && Contains("8 control points"));
    CHECK_THAT(of_mesh(replaced(two_patches, "NURBS1", "H1_2D_P1")), Contains("not NURBS"));
    const std::string good = folder.write("good.mesh", two_patches);
    CHECK_THAT(failure({good, folder.write("u.gf", space_text("NURBS2") + "1 2")}), Contains("order 2"));
    CHECK_THAT(failure({good, folder.write("u.gf", space_text("NURBS") + "1 2")}), Contains("line 2"));
    const std::string flat = test::data_file("mfem-more/meshes/star.mesh");
    CHECK_THAT(failure({flat, folder.write("u.gf", space_text("NURBS2") + "1 2")}), Contains("the mesh is not"));
}
