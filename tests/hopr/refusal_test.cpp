// What cannot be read is refused with file, place and cause.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using Catch::Contains;

namespace {

struct Written {
    TemporaryFolder folder;
    std::string mesh = folder.path("bad_mesh.h5"), state = folder.path("bad_state.h5");

    std::string failure_of(const WrittenMesh& written) const {
        write_mesh(mesh, written);
        return failure({mesh});
    }
    std::string failure_of(const WrittenState& written) const {
        write_mesh(mesh, two_cubes());
        write_state(state, two_cubes(), written);
        return failure({mesh, state});
    }
};

WrittenState ones() {
    WrittenState state;
    state.line = {-0.5, 0.5};
    state.value = [](std::size_t, std::size_t, const std::array<double, 3>&) { return 1.0; };
    return state;
}

} // namespace

TEST_CASE("files of another kind are refused", "[hopr][data]") {
    CHECK_THAT(failure({elvis::test::data_file("pyfr/mixed_3.1.pyfrm")}), Contains("neither a HOPR mesh nor a state"));
    CHECK_THAT(failure({hopr_data("Box27.h5"), hopr_data("Circle_mesh.h5")}), Contains("is a second mesh beside"));
    CHECK_THAT(failure({"/no/such/file.h5"}), Contains("there is no such file"));
}

TEST_CASE("meshes that do not hold together are refused", "[hopr]") {
    const Written files;
    REQUIRE(files.failure_of(two_cubes()) == "no failure");
    WrittenMesh mesh = two_cubes();
    mesh.element_type = 106;
    CHECK_THAT(files.failure_of(mesh), Contains("ElemInfo has element 1, which is a prism; hexahedra only"));
    mesh = two_cubes();
    mesh.sides[1].pop_back();
    CHECK_THAT(files.failure_of(mesh), Contains("SideInfo of element 2 are 5 instead of six"));
    mesh = two_cubes();
    mesh.sides[0].push_back({});
    CHECK_THAT(files.failure_of(mesh), Contains("SideInfo of element 1 are more than six"));
    mesh = two_cubes();
    mesh.sides[0][2].condition = 5;
    CHECK_THAT(files.failure_of(mesh), Contains("have boundary condition 5 of 4"));
    mesh = two_cubes();
    mesh.elements[1].low[2] = std::nan("");
    CHECK_THAT(files.failure_of(mesh), Contains("NodeCoords has a node of element 2 that is not finite"));
}

TEST_CASE("states that do not fit are refused", "[hopr]") {
    const Written files;
    REQUIRE(files.failure_of(ones()) == "no failure");
    WrittenState state = ones();
    state.node_type = "UNHEARD-OF";
    CHECK_THAT(files.failure_of(state), Contains("NodeType is 'UNHEARD-OF'"));
    state = ones();
    state.cell_widths = {1, 2};
    CHECK_THAT(files.failure_of(state), Contains("FV_w is not the widths of 2 cells"));
    state = ones();
    state.line.resize(14, 0);
    CHECK_THAT(files.failure_of(state), Contains("has 14 nodes in a direction"));
    WrittenMesh one = two_cubes();
    one.elements.pop_back();
    write_state(files.state, one, ones());
    CHECK_THAT(failure({files.mesh, files.state}), Contains("has values of 1 elements, but the mesh"));
}
