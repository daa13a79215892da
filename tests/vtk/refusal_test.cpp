// What cannot be read is refused with place and cause.
#include "vtk_fixture.hpp"

#include <catch2/catch.hpp>

using Catch::Contains;

namespace {

/** A file of one cell. */
std::string one_cell(int type, int n_points, const std::string& version = "2.2") {
    std::string points, connectivity;
    for (int point = 0; point < n_points; ++point) {
        points += std::to_string(point) + " 0 0\n";
        connectivity += std::to_string(point) + " ";
    }
    const std::string n = std::to_string(n_points);
    return "<VTKFile type=\"UnstructuredGrid\" version=\"" + version + "\"><UnstructuredGrid>\n<Piece NumberOfPoints=\"" + n +
           "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" + points +
           "</DataArray></Points>\n<Cells><DataArray type=\"Int32\" Name=\"connectivity\">" + connectivity +
           "</DataArray><DataArray type=\"Int32\" Name=\"offsets\">" + n +
           "</DataArray><DataArray type=\"UInt8\" Name=\"types\">" + std::to_string(type) +
           "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    REQUIRE(text.find(what) != std::string::npos);
    return text.replace(text.find(what), what.size(), by);
}

} // namespace

TEST_CASE("cells that cannot be read are named", "[vtk]") {
    CHECK_THAT(failure_of(one_cell(42, 4)), Contains("cell 0 is VTK_POLYHEDRON (42) is not supported") && Contains("line"));
    CHECK_THAT(failure_of(one_cell(74, 14)), Contains("VTK_LAGRANGE_PYRAMID (74)") && Contains("no such cell"));
    CHECK_THAT(failure_of(one_cell(37, 19)), Contains("VTK_TRIQUADRATIC_PYRAMID (37) is not supported"));
    CHECK_THAT(failure_of(one_cell(72, 26)), Contains("26 points, which is the number of no degree"));
    CHECK_THAT(failure_of(one_cell(72, 22 * 22 * 22)), Contains("degrees up to 20"));
    CHECK_THAT(failure_of(one_cell(12, 7)), Contains("VTK_HEXAHEDRON (12) with 7 points instead of 8"));
    CHECK_THAT(failure_of(one_cell(200, 7)), Contains("cell type 200"));
    CHECK_THAT(failure_of(one_cell(3, 2)), Contains("no cells that are surfaces or volumes"));
    CHECK(failure_of(one_cell(10, 4)) == "no failure");
}

TEST_CASE("numbers that do not fit are refused with their place", "[vtk]") {
    const std::string good = one_cell(10, 4);
    CHECK_THAT(failure_of(replaced(good, "0 1 2 3 <", "0 1 2 4 <")), Contains("cell 0 has point 4 of 4"));
    CHECK_THAT(failure_of(replaced(good, "0 1 2 3 <", "0 1 2 -1 <")), Contains("cell 0 has point -1"));
    CHECK_THAT(failure_of(replaced(good, "offsets\">4", "offsets\">5")), Contains("offset 5 of cell 0"));
    CHECK_THAT(failure_of(replaced(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\"")),
               Contains("holds 12 numbers where 15 are expected") && Contains("line 2"));
    CHECK_THAT(failure_of(replaced(good, "NumberOfCells=\"1\"", "NumberOfCells=\"99999999999\"")),
               Contains("1 offsets and 1 types for 99999999999 cells"));
    CHECK_THAT(failure_of(replaced(good, "NumberOfPoints=\"4\"", "NumberOfPoints=\"18446744073709551615\"")),
               Contains("announces 18446744073709551615"));
    CHECK_THAT(failure_of(replaced(good, "3 0 0", "3 x 0")), Contains("x is not a number"));
    CHECK_THAT(failure_of(replaced(good, "3 0 0", "3 nan 0")), Contains("point 3 of cell 0 is not finite"));
    CHECK_THAT(failure_of(replaced(good, "Float64", "String")), Contains("type 'String'"));
}

TEST_CASE("files of another kind are refused with what they are", "[vtk]") {
    CHECK_THAT(failure_of("<VTKFile type=\"ImageData\" version=\"1.0\"/>"), Contains("type is 'ImageData'"));
    CHECK_THAT(failure_of("no file of VTK"), Contains("not XML") || Contains("VTKFile"));
    CHECK_THAT(failure_of("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" compressor=\"vtkLZMADataCompressor\"/>"),
               Contains("vtkLZMADataCompressor") && Contains("not supported"));
    CHECK_THAT(
        failure_of(
            "<VTKFile type=\"Collection\" version=\"1.0\"><Collection><DataSet file=\"none.vtu\"/></Collection></VTKFile>",
            "wrong.pvd"),
        Contains("none.vtu") && Contains("cannot be opened"));
    CHECK_THAT(
        failure_of(
            "<VTKFile type=\"Collection\" version=\"1.0\"><Collection><DataSet file=\"wrong.pvd\"/></Collection></VTKFile>",
            "wrong.pvd"),
        Contains("type is 'Collection'"));
}

TEST_CASE("a mesh that changes in time is refused", "[vtk]") {
    const TemporaryFolder folder;
    const std::string first = folder.write("0.vtu", one_cell(10, 4));
    const std::string second = folder.write("1.vtu", replaced(one_cell(10, 4), "3 0 0", "3 1 0"));
    try {
        open_vtk({first, second});
        FAIL("no failure");
    } catch (const std::exception& error) {
        CHECK_THAT(error.what(), Contains("1.vtu") && Contains("mesh is not that of the first time step"));
    }
}

TEST_CASE("appended data that end early are refused", "[vtk]") {
    std::string content = read_file(sample_file("small_raw.vtu"));
    const std::size_t end = content.rfind("\n  </AppendedData>");
    CHECK_THAT(failure_of(content.substr(0, end - 500) + content.substr(end)), Contains("bytes") || Contains("data end"));
    CHECK_THAT(failure_of(content.substr(0, end - 500)), Contains("not complete"));
}
