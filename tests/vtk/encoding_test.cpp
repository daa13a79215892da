// Every form in which VTK writes arrays holds the same field; pieces and steps are put together.
#include "vtk_fixture.hpp"

#include <catch2/catch.hpp>

#include <cstdint>

using namespace elvis;

namespace {

std::string base64(const void* data, std::size_t size) {
    constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto* const bytes = static_cast<const unsigned char*>(data);
    std::string text;
    for (std::size_t at = 0; at < size; at += 3) {
        unsigned group = 0;
        for (std::size_t i = 0; i < 3; ++i)
            group = group << 8 | (at + i < size ? bytes[at + i] : 0u);
        for (std::size_t i = 0; i < 4; ++i)
            text += at + i > size ? '=' : alphabet[group >> (18 - 6 * i) & 63];
    }
    return text;
}

} // namespace

TEST_CASE("every encoding holds the same numbers", "[vtk]") {
    const std::vector<VtkReference> references = read_reference("small.ref");
    for (const char* name : {"small_binary", "small_binary_zlib", "small_binary_lz4_big", "small_raw", "small_raw_big",
                             "small_raw_lz4", "small_base64", "small_base64_zlib"}) {
        INFO(name);
        const SourceVolume source = open_vtk({sample_file(std::string(name) + ".vtu")});
        CHECK(source.info().mantissa_bits == 53);
        const Difference difference = source_difference(source, references);
        CHECK(difference.position < 1e-14);
        CHECK(difference.value < 1e-14);
    }
}

TEST_CASE("header and data may be encoded apart, and lines broken", "[vtk]") {
    const std::array<double, 12> points{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
    const std::uint32_t size = sizeof points;
    std::string data = base64(points.data(), size);
    data.insert(50, "\n    ");
    const std::string text = R"(<VTKFile type="UnstructuredGrid" version="2.2"><UnstructuredGrid>
        <Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="binary">
        <InformationKey name="L2_NORM_RANGE" location="vtkDataArray" length="2"><Value index="0">0</Value></InformationKey>
        )" + base64(&size, sizeof size) +
                             data + R"(
        </DataArray></Points><Cells><DataArray type="Int32" Name="connectivity">0 1 2 3</DataArray>
        <DataArray type="Int32" Name="offsets">4</DataArray><DataArray type="UInt8" Name="types">10</DataArray></Cells>
        </Piece></UnstructuredGrid></VTKFile>)";
    const TemporaryFolder folder;
    const SourceVolume source = open_vtk({folder.write("apart.vtu", text)});
    std::array<double, 3> x;
    source.evaluate_mapping(0, native::Point{-0.5, -0.25, -0.75}, x);
    CHECK(x == std::array<double, 3>{0.5, 0.75, 0.25});
}

TEST_CASE("text tells its precision by its digits", "[vtk]") {
    const SourceVolume source = open_vtk({sample_file("small_ascii.vtu")});
    // VTK 9.1 writes all digits.
    CHECK(source.info().mantissa_bits == 53);
    std::vector<double> values(source.n_values());
    for (const VtkReference& reference : read_reference("small.ref")) {
        const auto [r, s, t] = reference.parametric;
        source.sample(0, reference.cell, native::Point{2 * r - 1, 2 * s - 1, 2 * t - 1}, values);
        CHECK(values[0] == Approx(reference.values[0]).margin(1e-14));
    }
}

TEST_CASE("pieces are joined by the positions of their corners", "[vtk]") {
    // Two unit cubes side by side, a file each, and one that names both.
    const std::string head = R"(<VTKFile type="UnstructuredGrid" version="2.2" byte_order="LittleEndian"><UnstructuredGrid>)";
    const auto cube = [&](int x) {
        std::string points, values;
        for (int node = 0; node < 8; ++node) {
            const int i = x + (node % 4 == 1 || node % 4 == 2), j = node % 4 > 1, k = node / 4;
            points += std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(k) + "\n";
            values += std::to_string(i * i * 0.25) + " ";
        }
        return head +
               R"(<Piece NumberOfPoints="8" NumberOfCells="1"><Points><DataArray type="Float32" NumberOfComponents="3">)" +
               points + R"(</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">
               0 1 2 3 4 5 6 7</DataArray><DataArray type="Int64" Name="offsets">8</DataArray>
               <DataArray type="UInt8" Name="types">12</DataArray></Cells><PointData><DataArray type="Float64" Name="p">)" +
               values + "</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>";
    };
    const TemporaryFolder folder;
    folder.write("0.vtu", cube(0));
    folder.write("1.vtu", cube(1));
    const std::string both = folder.write("all.pvtu", R"(<VTKFile type="PUnstructuredGrid" version="1.0"><PUnstructuredGrid>
        <Piece Source="0.vtu"/><Piece Source="1.vtu"/></PUnstructuredGrid></VTKFile>)");
    const SourceVolume source = open_vtk({both});
    CHECK(source.info().n_elements == 2);
    // Points are Float32 in few digits, hence exact in 24 bits; values have six digits.
    CHECK(source.info().mantissa_bits == 20);
    const ConvertedVolume volume(source);
    CHECK(volume.report().n_faces == 11);
    CHECK(volume.report().n_boundary_faces == 10);
    CHECK(volume.report().fields.at(0).max_jump < 1e-15);
    CHECK(volume.report().fields.at(0).continuity == ELVIS_CONTINUITY_CONTINUOUS);

    // The same twice as time steps, out of order.
    const std::string steps = folder.write("all.pvd", R"(<VTKFile type="Collection" version="0.1"><Collection>
        <DataSet timestep="2.5" part="0" file="all.pvtu"/><DataSet timestep="0.5" part="0" file="0.vtu"/>
        <DataSet timestep="0.5" part="1" file="1.vtu"/></Collection></VTKFile>)");
    const SourceVolume in_time = open_vtk({steps});
    CHECK(in_time.times() == std::vector<double>{0.5, 2.5});
    CHECK(in_time.info().n_elements == 2);
}

TEST_CASE("points that cells share make a field continuous", "[vtk]") {
    const std::string shared = R"(<VTKFile type="UnstructuredGrid" version="2.2"><UnstructuredGrid>
        <Piece NumberOfPoints="5" NumberOfCells="3"><Points><DataArray type="Float64" NumberOfComponents="3">
        0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity">
        0 1 2 3 1 2 3 4 0 1</DataArray><DataArray type="Int32" Name="offsets">4 8 10</DataArray>
        <DataArray type="UInt8" Name="types">10 10 3</DataArray></Cells>
        <PointData><DataArray type="Float64" Name="p">0 1 2 3 4</DataArray></PointData>
        <CellData><DataArray type="Int32" Name="p">7 8 9</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>)";
    const TemporaryFolder folder;
    const SourceVolume source = open_vtk({folder.write("shared.vtu", shared)});
    // The line is left out, its cell data too.
    CHECK(source.info().n_elements == 2);
    CHECK(source.info().n_corner_ids == 5);
    CHECK(source.fields().at(0).continuity == ELVIS_CONTINUITY_CONTINUOUS);
    CHECK(source.fields().at(1).name == "p (cells)");
    CHECK(source.fields().at(1).continuity == ELVIS_CONTINUITY_DISCONTINUOUS);
    const ConvertedVolume volume(source);
    CHECK(volume.value(1, 1, {-0.5, -0.5, -0.5}) == 8);
    CHECK(volume.report().n_faces == 7);
    CHECK(volume.report().fields.at(0).exact);
}

TEST_CASE("the order of a hexahedron's nodes is told by its version and by its points", "[vtk]") {
    // MFEM's data set has version 0.1 and the order of VTK 8. Here the version alone is changed: the points decide.
    std::string content = read_file(sample_file("small_raw.vtu"));
    content.replace(content.find("version=\"2.2\""), 13, "version=\"0.1\"");
    const TemporaryFolder folder;
    const SourceVolume source = open_vtk({folder.write("old.vtu", content)});
    CHECK(source_difference(source, read_reference("small.ref")).value < 1e-14);
}

TEST_CASE("thin hexahedra of old files have their nodes where they belong", "[vtk]") {
    // Edges along t are a hundred times longer than apart. Lagrange cells are in the order of VTK 8, which exchanges the
    // middles of the last two edges; the triquadratic type has always had one order.
    for (const int type : {29, 72}) {
        const std::array<std::array<int, 3>, 27> new_order{
            {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0},
             {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1},
             {2, 2, 1}, {0, 2, 1}, {0, 1, 1}, {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}, {1, 1, 1}}};
        std::string points, connectivity;
        for (std::size_t node = 0; node < 27; ++node) {
            const auto& [i, j, k] = new_order[node];
            points += std::to_string(0.01 * i) + " " + std::to_string(0.01 * j) + " " + std::to_string(k) + "\n";
            const std::size_t exchanged = type == 72 && node == 18 ? 19 : type == 72 && node == 19 ? 18 : node;
            connectivity += std::to_string(exchanged) + " ";
        }
        const TemporaryFolder folder;
        const SourceVolume source = open_vtk({folder.write("thin.vtu", R"(<VTKFile type="UnstructuredGrid" version="0.1">
            <UnstructuredGrid><Piece NumberOfPoints="27" NumberOfCells="1"><Points>
            <DataArray type="Float64" NumberOfComponents="3">)" + points + R"(</DataArray></Points><Cells>
            <DataArray type="Int32" Name="connectivity">)" + connectivity + R"(</DataArray>
            <DataArray type="Int32" Name="offsets">27</DataArray><DataArray type="UInt8" Name="types">)" +
                                                                           std::to_string(type) + R"(</DataArray></Cells>
            </Piece></UnstructuredGrid></VTKFile>)")});
        std::array<double, 3> x;
        source.evaluate_mapping(0, native::Point{0.5, 0.25, -0.2}, x);
        INFO("type " << type);
        CHECK(x[0] == Approx(0.015).margin(1e-14));
        CHECK(x[1] == Approx(0.0125).margin(1e-14));
        CHECK(x[2] == Approx(0.8).margin(1e-14));
    }
}

TEST_CASE("the order of a wedge's nodes is told by its points", "[vtk]") {
    const std::vector<VtkReference> references = read_reference("wedge.ref");
    CHECK(source_difference(open_vtk({sample_file("wedge.vtu")}), references).value < 1e-14);
    CHECK(source_difference(open_vtk({sample_file("wedge_old.vtu")}), references).value < 1e-14);
}

TEST_CASE("cells of another piece are left out", "[vtk]") {
    const std::string ghost = R"(<VTKFile type="UnstructuredGrid" version="2.2"><UnstructuredGrid>
        <Piece NumberOfPoints="5" NumberOfCells="2"><Points><DataArray type="Float64" NumberOfComponents="3">
        0 0 0 1 0 0 0 1 0 0 0 1 1 1 1</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity">
        0 1 2 3 1 2 3 4</DataArray><DataArray type="Int32" Name="offsets">4 8</DataArray>
        <DataArray type="UInt8" Name="types">10 10</DataArray></Cells>
        <CellData><DataArray type="Int32" Name="p">7 8</DataArray>
        <DataArray type="UInt8" Name="vtkGhostType">1 0</DataArray></CellData></Piece></UnstructuredGrid></VTKFile>)";
    const TemporaryFolder folder;
    const SourceVolume source = open_vtk({folder.write("ghost.vtu", ghost)});
    CHECK(source.info().n_elements == 1);
    REQUIRE(source.fields().size() == 1);
    std::array<double, 1> value;
    source.sample(0, 0, native::Point{-0.5, -0.5, -0.5}, value);
    CHECK(value[0] == 8);
}
