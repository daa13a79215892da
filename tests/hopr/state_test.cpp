// States, written here as FLEXI's page and source say.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

double value(std::size_t variable, std::size_t element, const std::array<double, 3>& xi) {
    return static_cast<double>(10 * element + variable) + xi[0] * xi[0] - 0.5 * xi[1] * xi[2] * xi[2] + xi[0] * xi[1] * xi[2];
}

WrittenState state_of(const std::string& type) {
    WrittenState state;
    state.node_type = type;
    const double g = std::sqrt(0.6);
    state.line = type == "GAUSS" ? std::vector<double>{-g, 0, g} : std::vector<double>{-1, 0, 1};
    state.value = value;
    return state;
}

std::vector<std::string> names_of(const SourceVolume& source) {
    std::vector<std::string> names;
    for (const auto& field : source.fields()) {
        names.push_back(field.name + " " + std::to_string(field.n_components));
    }
    return names;
}

} // namespace

TEST_CASE("values at every type of nodes are polynomials", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    const std::string type = GENERATE("GAUSS", "GAUSS-LOBATTO", "CHEBYSHEV-GAUSS-LOBATTO");
    write_state(folder.path("state.h5"), two_cubes(), state_of(type));
    const SourceVolume source = open_hopr({folder.path("mesh.h5"), folder.path("state.h5")});
    CHECK(names_of(source) == std::vector<std::string>{"Density 1", "Momentum 3"});
    const std::array<double, 3> xi = {0.3, -0.6, 0.7};
    for (std::size_t element = 0; element < 2; ++element) {
        const std::vector<double> values = sample(source, element, xi);
        for (std::size_t variable = 0; variable < 4; ++variable) {
            CHECK(values[variable] == Approx(value(variable, element, xi)).epsilon(1e-13));
        }
    }
    const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
    CHECK(report.fields.at(0).exact);
    CHECK(report.fields.at(1).exact);
    CHECK(report.fields.at(0).residual < 1e-13);
}

TEST_CASE("four Chebyshev nodes are cosines", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    WrittenState state = state_of("CHEBYSHEV-GAUSS-LOBATTO");
    state.line = {-1, -0.5, 0.5, 1};
    state.value = [](std::size_t, std::size_t, const std::array<double, 3>& xi) { return xi[0] * xi[0] * xi[0]; };
    write_state(folder.path("state.h5"), two_cubes(), state);
    const SourceVolume source = open_hopr({folder.path("mesh.h5"), folder.path("state.h5")});
    CHECK(sample(source, 0, {0.3, 0.1, 0.2})[0] == Approx(0.027).epsilon(1e-13));
}

TEST_CASE("a state alone finds its mesh beside it, whatever the folder was", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    write_state(folder.path("state.h5"), two_cubes(), state_of("GAUSS"));
    CHECK(open_hopr({folder.path("state.h5")}).info().n_elements == 2);
    WrittenState other = state_of("GAUSS");
    other.mesh_file = "other_mesh.h5";
    write_state(folder.path("state.h5"), two_cubes(), other);
    CHECK_THAT(failure({folder.path("state.h5")}), Contains("state.h5") && Contains("'other_mesh.h5', which is not beside it"));
}

TEST_CASE("several states are time steps, in the order of their times", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    WrittenState state = state_of("GAUSS");
    write_state(folder.path("0.h5"), two_cubes(), state);
    state.time = 0.125;
    state.value = [](std::size_t, std::size_t, const std::array<double, 3>&) { return 4.0; };
    write_state(folder.path("1.h5"), two_cubes(), state);
    const SourceVolume source = open_hopr({folder.path("1.h5"), folder.path("0.h5"), folder.path("mesh.h5")});
    CHECK(source.times() == std::vector<double>{0, 0.125});
    CHECK(sample(source, 1, {0.1, 0.2, 0.3}, 1)[0] == Approx(4));
    CHECK(sample(source, 1, {0.1, 0.2, 0.3}, 0)[0] == Approx(value(0, 1, {0.1, 0.2, 0.3})));
    state.names = {"Density", "MomentumX", "MomentumY", "Other"};
    write_state(folder.path("1.h5"), two_cubes(), state);
    CHECK_THAT(failure({folder.path("0.h5"), folder.path("1.h5")}), Contains("1.h5") && Contains("other variables"));
}

TEST_CASE("numbers of elements are constants", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    WrittenState state = state_of("GAUSS");
    state.added_names = {"dt", "Density"};
    state.added = {{1, 2}, {3, 4}};
    write_state(folder.path("state.h5"), two_cubes(), state);
    const SourceVolume source = open_hopr({folder.path("state.h5")});
    CHECK(names_of(source) == std::vector<std::string>{"Density 1", "Momentum 3", "dt 1", "Density (ElemData) 1"});
    const std::vector<double> values = sample(source, 1, {0.1, 0.2, 0.3});
    CHECK(values[4] == 3);
    CHECK(values[5] == 4);
    const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
    CHECK(report.fields.at(2).exact);
    CHECK(report.fields.at(2).upper == 3);
}

TEST_CASE("two-dimensional output is the same on all layers", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    WrittenState state = state_of("GAUSS");
    state.is_flat = true;
    state.value = [](std::size_t, std::size_t, const std::array<double, 3>& xi) { return xi[0] - 2 * xi[1]; };
    write_state(folder.path("state.h5"), two_cubes(), state);
    CHECK(sample(open_hopr({folder.path("state.h5")}), 1, {0.5, 0.25, 0.9})[0] == Approx(0).margin(1e-14));
}

TEST_CASE("finite-volume elements are constant in cells, and never called exact", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    WrittenState state = state_of("GAUSS");
    state.added_names = {"FV_Elems"};
    state.added = {{0}, {1}};
    state.cell_widths = {0.5, 1, 0.5};
    write_state(folder.path("state.h5"), two_cubes(), state);
    const SourceVolume source = open_hopr({folder.path("state.h5")});
    const double g = std::sqrt(0.6);
    CHECK(sample(source, 1, {-0.6, 0.4, 0.6})[0] == Approx(value(0, 1, {-g, 0, g})));
    CHECK(sample(source, 0, {-0.6, 0.4, 0.6})[0] == Approx(value(0, 0, {-0.6, 0.4, 0.6})));
    std::vector<elvis_source_space> spaces(2);
    source.spaces(0, 0, 2, spaces);
    CHECK(spaces[0].is_contained == 1);
    CHECK(spaces[1].is_contained == 0);
    CHECK_FALSE(convert(source, folder.path("volume.h5"), {}, {}).fields.at(0).exact);
}
