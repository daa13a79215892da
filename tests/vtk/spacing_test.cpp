// Nodes that are not equidistant are told by the positions of points, and read right or refused.
#include "vtk_fixture.hpp"
#include "written_hexahedra.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

/** Largest difference from what was written, between nodes. */
double difference(const SourceVolume& source, const Hexahedra& cells) {
    double largest = 0;
    std::vector<double> values(source.n_values());
    for (std::uint64_t cell = 0; cell < cells.n_cells; ++cell) {
        for (const Hexahedra::Vector& r : {Hexahedra::Vector{0.1, 0.45, 0.93}, Hexahedra::Vector{0.77, 0.02, 0.61}}) {
            source.sample(0, cell, native::Point{2 * r[0] - 1, 2 * r[1] - 1, 2 * r[2] - 1}, values);
            largest = std::max(largest, std::abs(values[0] - cells.field(cell, r, 0)));
        }
    }
    return largest;
}

/** A triangle of degree 4 whose edges have these nodes; VTK's order. */
std::string triangle_file(const std::vector<double>& line) {
    std::string points = "0 0 0 1 0 0 0 1 0 ";
    const auto add = [&](double x, double y) { points += std::to_string(x) + " " + std::to_string(y) + " 0 "; };
    for (std::size_t i = 1; i < 4; ++i) {
        add(line[i], 0);
    }
    for (std::size_t i = 1; i < 4; ++i) {
        add(1 - line[i], line[i]);
    }
    for (std::size_t i = 1; i < 4; ++i) {
        add(0, 1 - line[i]);
    }
    add(0.25, 0.25);
    add(0.5, 0.25);
    add(0.25, 0.5);
    return R"(<VTKFile type="UnstructuredGrid" version="2.2"><UnstructuredGrid><Piece NumberOfPoints="15" NumberOfCells="1">
        <Points><DataArray type="Float64" NumberOfComponents="3">)" +
           points + R"(</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity">0 1 2 3 4 5 6 7 8 9 10 11 12
        13 14</DataArray><DataArray type="Int32" Name="offsets">15</DataArray><DataArray type="UInt8" Name="types">69
        </DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";
}

/** A quadrilateral of degree 3 with these nodes, and the field r^3 s - s^3; VTK's order. */
std::string quadrilateral_file(const std::vector<double>& line) {
    constexpr std::array<std::array<std::size_t, 2>, 16> nodes{{{0, 0},
                                                                {3, 0},
                                                                {3, 3},
                                                                {0, 3},
                                                                {1, 0},
                                                                {2, 0},
                                                                {3, 1},
                                                                {3, 2},
                                                                {1, 3},
                                                                {2, 3},
                                                                {0, 1},
                                                                {0, 2},
                                                                {1, 1},
                                                                {2, 1},
                                                                {1, 2},
                                                                {2, 2}}};
    std::ostringstream points, values;
    points.precision(17);
    values.precision(17);
    for (const auto& [i, j] : nodes) {
        const double r = line[i], s = line[j];
        points << r + 0.2 * s * s << ' ' << s << " 0 ";
        values << r * r * r * s - s * s * s << ' ';
    }
    return R"(<VTKFile type="UnstructuredGrid" version="2.2"><UnstructuredGrid><Piece NumberOfPoints="16" NumberOfCells="1">
        <Points><DataArray type="Float64" NumberOfComponents="3">)" +
           points.str() + R"(</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity">0 1 2 3 4 5 6 7 8 9 10 11
        12 13 14 15</DataArray><DataArray type="Int32" Name="offsets">16</DataArray><DataArray type="UInt8" Name="types">70
        </DataArray></Cells><PointData><DataArray type="Float64" Name="u">)" +
           values.str() + "</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>";
}

} // namespace

TEST_CASE("nodes of quadrilaterals are told apart", "[vtk][spacing]") {
    const TemporaryFolder folder;
    for (const std::vector<double>& line : {equidistant_line(3), lobatto_line(3)}) {
        const SourceVolume source = open_vtk({folder.write("plane.vtu", quadrilateral_file(line))});
        std::array<double, 1> value{};
        source.sample(0, 0, native::Point{0.6, -0.5, 0}, value);
        CHECK(value[0] == Approx(0.8 * 0.8 * 0.8 * 0.25 - 0.25 * 0.25 * 0.25).margin(1e-14));
        std::array<double, 3> x{};
        source.evaluate_mapping(0, native::Point{0.6, -0.5, 0}, x);
        CHECK(x[0] == Approx(0.8 + 0.2 * 0.25 * 0.25).margin(1e-14));
    }
}

TEST_CASE("Gauss-Lobatto and equidistant nodes are told apart and read right", "[vtk][spacing]") {
    const TemporaryFolder folder;
    double largest = 0;
    for (const int degree : {1, 2, 3, 4, 5, 7, 9}) {
        for (const bool is_bent : {false, true}) {
            for (const bool is_lobatto : {false, true}) {
                INFO("degree " << degree << ", bent " << is_bent << ", Gauss-Lobatto " << is_lobatto);
                Hexahedra cells{degree, 4, is_lobatto ? lobatto_line(degree) : equidistant_line(degree)};
                if (is_bent) {
                    cells.map = bent;
                }
                write_vtu(folder.path("nodes.vtu"), cells);
                write_vtkhdf(folder.path("nodes.vtkhdf"), cells, {});
                for (const char* name : {"nodes.vtu", "nodes.vtkhdf"}) {
                    const double here = difference(open_vtk({folder.path(name)}), cells);
                    CHECK(here < 1e-11);
                    largest = std::max(largest, here);
                }
            }
        }
    }
    WARN("largest difference from what was written: " << largest);
}

TEST_CASE("nodes in single precision are told apart too", "[vtk][spacing]") {
    const TemporaryFolder folder;
    const Hexahedra cells{5, 6, lobatto_line(5), bent};
    HdfLayout layout;
    layout.is_single = true;
    write_vtkhdf(folder.path("nodes.vtkhdf"), cells, layout);
    CHECK(difference(open_vtk({folder.path("nodes.vtkhdf")}), cells) < 1e-4);
}

TEST_CASE("graded meshes keep their equidistant nodes", "[vtk][spacing]") {
    const TemporaryFolder folder;
    Hexahedra cells{4, 8, equidistant_line(4)};
    // Layers at both walls, cells that grow by half each, and edges that are graded within.
    cells.map = [](const Hexahedra::Vector& x) {
        return Hexahedra::Vector{std::pow(1.5, x[0]), std::tanh(1.5 * (2 * x[1] - 1)), x[2] * x[2] + 0.1 * x[2]};
    };
    write_vtu(folder.path("nodes.vtu"), cells);
    CHECK(difference(open_vtk({folder.path("nodes.vtu")}), cells) < 1e-11);
}

TEST_CASE("where edges disagree about their nodes, fields are not called exact", "[vtk][spacing]") {
    const TemporaryFolder folder;
    Hexahedra cells{3, 4, equidistant_line(3)};
    const std::vector<double> line = lobatto_line(3);
    cells.map = [&](const Hexahedra::Vector& x) {
        return Hexahedra::Vector{x[0], x[1], line[static_cast<std::size_t>(std::lround(3 * x[2]))]};
    };
    write_vtu(folder.path("nodes.vtu"), cells);
    const SourceVolume unclear = open_vtk({folder.path("nodes.vtu")});
    CHECK(difference(unclear, cells) < 1e-12);
    CHECK_FALSE(ConvertedVolume(unclear).report().fields.at(0).exact);
    cells.map = bent;
    write_vtu(folder.path("nodes.vtu"), cells);
    CHECK(ConvertedVolume(open_vtk({folder.path("nodes.vtu")})).report().fields.at(0).exact);
}

TEST_CASE("time steps of Gauss-Lobatto nodes are read right", "[vtk][spacing]") {
    const TemporaryFolder folder;
    const Hexahedra cells{4, 4, lobatto_line(4), bent};
    HdfLayout layout;
    layout.times = {0, 1};
    layout.repeats_mesh = true;
    write_vtkhdf(folder.path("nodes.vtkhdf"), cells, layout);
    const SourceVolume source = open_vtk({folder.path("nodes.vtkhdf")});
    CHECK(difference(source, cells) < 1e-12);
    std::vector<double> values(source.n_values());
    source.sample(1, 3, native::Point{0.3, -0.2, 0.7}, values);
    CHECK(values[0] == Approx(cells.field(3, {0.65, 0.4, 0.85}, 1)));
}

TEST_CASE("nodes of which nobody knows where they are meant are refused", "[vtk][spacing]") {
    const TemporaryFolder folder;
    for (const bool is_bent : {false, true}) {
        Hexahedra cells{6, 4, chebyshev_line(6)};
        if (is_bent) {
            cells.map = bent;
        }
        write_vtu(folder.path("wrong.vtu"), cells);
        CHECK_THAT(failure_of(read_file(folder.path("wrong.vtu"))),
                   Contains("wrong.vtu") && Contains("hexahedra are Chebyshev-Gauss-Lobatto points"));
    }
    CHECK_THAT(failure_of(triangle_file(lobatto_line(4))), Contains("triangles") && Contains("Gauss-Lobatto points"));
    CHECK(failure_of(triangle_file(equidistant_line(4))) == "no failure");
}
