// What cannot be read is refused with file, place and cause.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using Catch::Contains;

namespace {

struct Written {
    TemporaryFolder folder;
    std::string mesh = folder.path("bad.pyfrm"), solution = folder.path("bad.pyfrs");
    int layout;

    explicit Written(int written_layout) : layout(written_layout) {}

    std::string failure_of(const WrittenMesh& written_mesh, const WrittenSolution& written) const {
        write_mesh(mesh, written_mesh, layout);
        write_solution(solution, written_mesh, written, layout);
        return failure({mesh, solution});
    }
};

WrittenSolution ones() {
    WrittenSolution solution;
    solution.values = [](const std::string&, std::size_t, std::size_t, const Coordinates&) { return 1.0; };
    return solution;
}

} // namespace

TEST_CASE("files that do not belong together are refused", "[pyfr][data]") {
    CHECK_THAT(failure({pyfr_data("waves_3.1.pyfrs"), pyfr_data("mixed_develop_imported.pyfrm")}),
               Contains("waves_3.1.pyfrs") && Contains("belongs to the mesh with the id 'a8e8fc43-") &&
                   Contains("whose id is 'bd92eae3-"));
    CHECK_THAT(failure({pyfr_data("mixed_3.1.pyfrm"), pyfr_data("mixed_2.1.pyfrm")}), Contains("is a second mesh beside"));
    const TemporaryFolder folder;
    std::filesystem::copy(pyfr_data("waves_2.1.pyfrs"), folder.path("waves.pyfrs"));
    CHECK_THAT(failure({folder.path("waves.pyfrs")}),
               Contains("waves.pyfrs") && Contains("4aaa04cc-") && Contains("none of the 0 files"));
    std::filesystem::copy(pyfr_data("mixed_3.1.pyfrm"), folder.path("other.pyfrm"));
    CHECK_THAT(failure({folder.path("waves.pyfrs")}), Contains("none of the 1 files"));
}

TEST_CASE("files of another kind are refused", "[pyfr][data]") {
    CHECK_THAT(failure({elvis::test::data_file("hopr/Box27.h5")}), Contains("neither a mesh nor a solution of PyFR"));
    CHECK_THAT(failure({pyfr_data("case4.ini")}), Contains("case4.ini") && Contains("is not a readable HDF5 file"));
    CHECK_THAT(failure({"/no/such/file.pyfrs"}), Contains("there is no such file"));
}

TEST_CASE("meshes with elements that are none are refused", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files(layout);
    REQUIRE(files.failure_of(plane_mesh(), ones()) == "no failure");
    WrittenMesh mesh = plane_mesh();
    mesh.kinds[0].elements[1][4] = {std::nan(""), 0};
    CHECK_THAT(files.failure_of(mesh, ones()),
               Contains("bad.pyfrm") && Contains("element 1 of the quad") && Contains("not finite"));
    mesh = plane_mesh();
    mesh.kinds[0].shape_points.pop_back();
    for (auto& element : mesh.kinds[0].elements) {
        element.pop_back();
    }
    CHECK_THAT(files.failure_of(mesh, ones()), Contains("8 nodes, which is the number of no order"));
    mesh = plane_mesh();
    mesh.kinds.clear();
    CHECK_THAT(files.failure_of(mesh, ones()), Contains("bad.pyfrm"));
}

TEST_CASE("solutions that do not fit the mesh are refused", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files(layout);
    WrittenMesh fewer = plane_mesh();
    fewer.kinds[1].elements.pop_back();
    write_solution(files.solution, fewer, ones(), layout);
    write_mesh(files.mesh, plane_mesh(), layout);
    CHECK_THAT(failure({files.mesh, files.solution}),
               Contains("bad.pyfrs") &&
                   (Contains("other partitions than the mesh") || Contains("has values of 1 elements, but the mesh")));
}

TEST_CASE("points that determine no polynomial are refused", "[pyfr]") {
    const int layout = GENERATE(1, 2);
    const Written files(layout);
    WrittenMesh mesh = plane_mesh();
    mesh.kinds[0].solution_points[3] = mesh.kinds[0].solution_points[4];
    CHECK_THAT(files.failure_of(mesh, ones()), Contains("p2-quad@pts") && Contains("do not determine"));
    mesh = plane_mesh();
    mesh.kinds[1].solution_points.pop_back();
    CHECK_THAT(files.failure_of(mesh, ones()), Contains("5 solution points an element, which is the number of no order"));
}

TEST_CASE("elements without values have to be in the mesh, in ascending order", "[pyfr]") {
    const int layout = GENERATE(1, 2);
    const Written files(layout);
    WrittenSolution solution = ones();
    solution.only = {{"quad", {1, 0}}};
    CHECK_THAT(files.failure_of(plane_mesh(), solution), Contains("p2-quad-idxs") && Contains("does not ascend"));
    write_mesh(files.mesh, plane_mesh(), layout);
    WrittenMesh more = plane_mesh();
    more.kinds[0].elements.push_back(more.kinds[0].elements[0]);
    solution.only = {{"quad", {0, 2}}};
    write_solution(files.solution, more, solution, layout);
    CHECK_THAT(failure({files.mesh, files.solution}), Contains("p2-quad-idxs") && Contains("does not have"));
}

TEST_CASE("variables without names are refused", "[pyfr]") {
    const Written files(GENERATE(0, 1));
    WrittenSolution solution = ones();
    solution.names = {"rho"};
    write_mesh(files.mesh, plane_mesh(), files.layout);
    write_solution(files.solution, plane_mesh(), solution, files.layout);
    CHECK(failure({files.mesh, files.solution}) == "no failure");
    solution.names = {};
    write_solution(files.solution, plane_mesh(), solution, files.layout);
    CHECK_THAT(failure({files.mesh, files.solution}), Contains("bad.pyfrs"));
}

TEST_CASE("later versions of the format are refused", "[pyfr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("new.pyfrm"), plane_mesh(), 3);
    CHECK_THAT(failure({folder.path("new.pyfrm")}), Contains("version is 3; versions 1 and 2 are read"));
}
