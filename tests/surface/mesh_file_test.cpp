#include "mesh_samples.hpp"

#include <core/base/error.hpp>

#include <catch2/catch.hpp>

namespace elvis {

namespace {

/** Corners of all triangles, one after the other. */
std::vector<std::array<double, 3>> corners_of(const TriangleMesh& mesh) {
    std::vector<std::array<double, 3>> corners;
    for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            corners.push_back(mesh.points.at(corner));
        }
    }
    return corners;
}

using Reader = TriangleMesh (*)(const std::string&, std::string_view);

std::string fault_of(Reader read, const std::string& text) {
    try {
        read("thing", text);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("every format gives the same triangles") {
    const TriangleMesh expected{"", samples::points, samples::triangles};
    for (const samples::Sample& sample : samples::all()) {
        INFO(sample.name);
        CHECK(corners_of(sample.read("file", sample.text)) == corners_of(expected));
    }
}

TEST_CASE("polygons become fans") {
    const TriangleMesh mesh = read_obj("file", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("what is wrong with a file is said with its place") {
    using Catch::Matchers::Contains;
    CHECK_THAT(fault_of(read_obj, "v 0 0 0\nv 1 0\n"), Contains("thing:2") && Contains("three coordinates"));
    CHECK_THAT(fault_of(read_obj, "v 0 0 0\nv 1 0 x1\n"), Contains("thing:2") && Contains("'x1' is no number"));
    CHECK_THAT(fault_of(read_obj, "v 0 0 0\nf 1 1 2\n"), Contains("thing:2") && Contains("point 2; there are 1"));
    CHECK_THAT(fault_of(read_obj, "v 0 0 inf\n"), Contains("thing:1") && Contains("not finite"));
    CHECK_THAT(fault_of(read_obj, "cstype bezier\n"), Contains("free-form"));
    CHECK_THAT(fault_of(read_stl, "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 0\n"),
               Contains("a number is expected"));
    CHECK_THAT(fault_of(read_stl, "solid x\nfacet normal 0 0 1\ninner loop\n"), Contains("thing:3") && Contains("'outer'"));
    CHECK_THAT(fault_of(read_stl, samples::binary_stl() + "x"), Contains("284") && Contains("285"));
    CHECK_THAT(fault_of(read_ply,
                        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nelement face 1\n"
                        "property list uchar int vertex_indices\nend_header\n0 0\n3 0 0 0\n"),
               Contains("x, y and z"));
    std::string cut = samples::ply("binary_big_endian");
    cut.resize(cut.size() - 60);
    CHECK_THAT(fault_of(read_ply, cut), Contains("byte") && Contains("the file ends here"));
    CHECK_THAT(fault_of(read_ply, "PLY\n"), Contains("'ply'"));
    CHECK_THROWS_WITH(read_triangle_mesh("/nowhere/thing.obj"), Contains("/nowhere/thing.obj") && Contains("cannot be read"));
    CHECK_THROWS_WITH(read_triangle_mesh("thing.txt"), Contains(".obj, .stl, .ply"));
}

TEST_CASE("Bezier patches are read with v running first") {
    const PatchMesh mesh = read_bpt("file", samples::bpt());
    REQUIRE(mesh.patches.size() == 2);
    CHECK(mesh.patches[1].points[7] == std::array<double, 3>{2, 3, 0.7});
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(read_bpt("thing", "1\n2 3\n"), Contains("thing:2") && Contains("only bicubic ones"));
    CHECK_THROWS_WITH(read_bpt("thing", "1\n3 3\n0 0 0\n"), Contains("a number is expected"));
    CHECK_THROWS_WITH(read_bpt("thing", "900000\n"), Contains("thing:1") && Contains("cannot be"));
    CHECK_THROWS_WITH(read_bpt("thing", samples::bpt() + "1"), Contains("more than the 2 patches"));
}

TEST_CASE("the part of a patch is the patch there") {
    BezierPatch patch;
    for (std::size_t i = 0; i < 16; ++i) {
        // x = u, y = v, z = u^2 v^3, as control points.
        const double u = static_cast<double>(i / 4) / 3, v = static_cast<double>(i % 4) / 3;
        const std::array<double, 4> square = {0, 0, 1.0 / 3, 1};
        patch.points[i] = {u, v, square[i / 4] * (i % 4 == 3 ? 1.0 : 0.0)};
    }
    const BezierPatch part = patch.part(0.25, 0.5, 0.5);
    CHECK(part.points[0][0] == Approx(0.25));
    CHECK(part.points[0][2] == Approx(0.25 * 0.25 * 0.5 * 0.5 * 0.5));
    CHECK(part.points[12][2] == Approx(0.75 * 0.75 * 0.5 * 0.5 * 0.5));
    CHECK(part.points[15][1] == Approx(1));
    CHECK(part.points[15][2] == Approx(0.75 * 0.75));
}

} // namespace elvis
