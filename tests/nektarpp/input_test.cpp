// What cannot be read is refused with the file, the place and the cause.
#include "fixture.hpp"
#include "nektar_writer.hpp"

#include <catch2/catch.hpp>

using namespace elvis;
using Catch::Contains;
using nektar_writer::Block;
using nektar_writer::Point;
using nektar_writer::Shape;

namespace {

const std::string hexahedral_basis = "Modified_A,Modified_A,Modified_A";

/** What is said of a field file for the mesh of all shapes. */
std::string failure_of(const Block& block) {
    const TemporaryFolder folder;
    return failure({sample_file("CubeAllElements.xml"), folder.write("wrong.fld", nektar_writer::field_file({block}))});
}

/** What is said of a mesh of one element after a replacement in its text. */
std::string failure_after(const nektar_writer::Element& element, const std::string& old_text, const std::string& new_text) {
    std::string text = nektar_writer::geometry_file(element);
    const std::size_t at = text.find(old_text);
    REQUIRE(at != std::string::npos);
    text.replace(at, old_text.size(), new_text);
    const TemporaryFolder folder;
    return failure({folder.write("wrong.xml", text)});
}

nektar_writer::Element box(int n_along = 0, Shape shape = Shape::hexahedron) {
    return {shape, [](const Point& xi) { return xi; }, n_along, "PolyEvenlySpaced", "NodalTriEvenlySpaced", 0, false, {}};
}

} // namespace

TEST_CASE("fields that cannot be read are refused", "[nektarpp][data]") {
    const Block good{"u", "Hexahedron", hexahedral_basis, "UNIORDER:2,2,2", "66-67", std::vector<double>(16, 1.0)};
    CHECK(failure_of(good) == "no failure");
    const auto changed = [&](auto member, const auto& value) {
        Block block = good;
        block.*member = value;
        return failure_of(block);
    };
    CHECK_THAT(changed(&Block::shape, "Hexahedron-HomogenousExp1D"),
               Contains("wrong.fld") && Contains("at byte") && Contains("homogeneous"));
    CHECK_THAT(changed(&Block::more_attributes, R"(HOMOGENEOUSLENGTHS="1" HOMOGENEOUSZIDS="0,1")"), Contains("homogeneous"));
    CHECK_THAT(changed(&Block::shape, "Quadrilateral"), Contains("mesh of dimension 3"));
    CHECK_THAT(changed(&Block::basis, "Fourier,Fourier,Fourier"), Contains("BASIS Fourier,Fourier,Fourier is not supported"));
    CHECK_THAT(changed(&Block::n_modes, "UNIORDER:2,2"), Contains("NUMMODESPERDIR holds 2 numbers; expected are 1 times 3"));
    CHECK_THAT(changed(&Block::n_modes, "UNIORDER:2,2,999999"), Contains("from 1 to 31"));
    CHECK_THAT(changed(&Block::n_modes, "UNIORDER:1,2,2"), Contains("at least 2"));
    CHECK_THAT(changed(&Block::n_modes, "MIXORDER:2,2,2"), Contains("expected are 2 times 3"));
    CHECK_THAT(changed(&Block::ids, "66-68"), Contains("the content holds 16 coefficients; 1 fields in 3 elements have 24"));
    CHECK_THAT(changed(&Block::ids, "66"), Contains("more than the expected 8"));
    CHECK_THAT(changed(&Block::ids, "66,66"), Contains("twice"));
    CHECK_THAT(changed(&Block::ids, "66-9000000000000000000"), Contains("element 76 is no hexahedron of the mesh"));
    CHECK_THAT(changed(&Block::ids, "0"), Contains("element 0 is no hexahedron of the mesh"));
    CHECK_THAT(changed(&Block::ids, "66-"), Contains("list of ids, character 4: an id was expected"));
    CHECK_THAT(changed(&Block::fields, "u,u"), Contains("names u twice"));
    CHECK_THAT(changed(&Block::more_attributes, R"(COMPRESSED="B64Z-BigEndian")"), Contains("B64Z-BigEndian"));
    CHECK_THAT(changed(&Block::more_attributes, R"(BITSIZE="32" COMPRESSED="B64Z-LittleEndian")"), Contains("32 bits"));
    const Block pyramid{"u", "Pyramid", "Modified_A,Modified_A,Modified_C", "UNIORDER:2,2,2", "112", {1, 1, 1, 1, 1}};
    CHECK_THAT(failure_of(pyramid), Contains("Nektar++ 4"));
    const Block unequal{"u", "Pyramid", "Modified_A,Modified_A,ModifiedPyr_C", "UNIORDER:2,3,3", "112", {1, 1, 1, 1, 1}};
    CHECK_THAT(failure_of(unequal), Contains("pyramids need equal numbers"));
    const Block reversed{"u", "Prism", "Modified_A,Modified_A,Modified_B", "UNIORDER:3,2,2", "80", {1, 1, 1, 1, 1}};
    CHECK_THAT(failure_of(reversed), Contains("collapsed directions"));
    const TemporaryFolder folder;
    CHECK_THAT(
        failure({sample_file("CubeAllElements.xml"), folder.write("wrong.fld", nektar_writer::field_file({good, good}))}),
        Contains("given for the same elements before"));
    CHECK_THAT(failure({sample_file("CubeAllElements.xml"), folder.write("empty.fld", "<NEKTAR></NEKTAR>")}),
               Contains("holds no fields"));
    CHECK_THAT(failure({sample_file("CubeAllElements.xml"), folder.write("hdf.fld", "\x89HDF\r\n\x1a\n----")}),
               Contains("HDF5"));
    CHECK_THAT(failure({sample_file("CubeAllElements.xml"), folder.path("absent.fld")}), Contains("cannot be read"));
}

TEST_CASE("paths that do not belong together are refused", "[nektarpp][data]") {
    const std::string mesh = sample_file("CubeAllElements.xml"), fields = sample_file("CubeAllElements.fld");
    const TemporaryFolder folder;
    CHECK_THAT(failure({fields}), Contains("none of the files has a GEOMETRY"));
    CHECK_THAT(failure({mesh, mesh}), Contains("second geometry"));
    CHECK_THAT(failure({sample_file("Hex_CurvedFace.xml"), fields}), Contains("no tetrahedron of the mesh"));
    const std::string session = folder.write("session.xml", "<NEKTAR><CONDITIONS/></NEKTAR>");
    CHECK(open_nektar({mesh, session, fields}).info().n_elements == 181);
    // A mesh alone has no fields.
    CHECK(open_nektar({mesh}).fields().empty());
    std::filesystem::create_directory(folder.path("empty_xml"));
    CHECK_THAT(failure({folder.path("empty_xml")}), Contains("without files P*.xml"));
}

TEST_CASE("wrong meshes are refused", "[nektarpp]") {
    CHECK(failure_after(box(), "<VERTEX", "<VERTEX") == "no failure");
    CHECK_THAT(failure_after(box(), "DIM=\"3\"", "DIM=\"1\""), Contains("only DIM 2 and 3"));
    CHECK_THAT(failure_after(box(), "<VERTEX >", "<VERTEX XSCALE=\"2*lambda\">"),
               Contains("attribute XSCALE, character 3: 'lambda' is no constant or function"));
    CHECK_THAT(failure_after(box(), "<VERTEX >", "<VERTEX XSCALE=\"1/0\">"), Contains("not finite"));
    CHECK_THAT(failure_after(box(), "<VERTEX >", "<VERTEX XSCALE=\"" + std::string(100000, '(') + "\">"),
               Contains("levels of nesting"));
    CHECK_THAT(failure_after(box(), "<V ID=\"5\"", "<V ID=\"4\""), Contains("vertex 5, which is missing"));
    CHECK_THAT(failure_after(box(), "<V ID=\"8\"", "<V ID=\"5\""), Contains("id 5 is defined twice"));
    CHECK_THAT(failure_after(box(), "<E ID=\"12\"> 11", "<E ID=\"12\"> x"), Contains("number 1: 'x' is no integer"));
    CHECK_THAT(failure_after(box(), "<E ID=\"12\"> 11", "<E ID=\"12\"> 5"), Contains("hexahedron 7"));
    CHECK_THAT(failure_after(box(), "<H ID=\"7\"> 100 101", "<H ID=\"7\"> 101 100"), Contains("hexahedron 7"));
    CHECK_THAT(failure_after(box(), "<H ID=\"7\"> 100 101", "<H ID=\"7\"> 100 300"), Contains("face 300 is missing"));
    CHECK_THAT(failure_after(box(), "<H ID=\"7\"> 100 101", "<H ID=\"7\"> 100"), Contains("only 5 numbers"));
    CHECK_THAT(failure_after(box(), "C[0] </DOMAIN>", "C[9] </DOMAIN>"), Contains("composite C[9] does not exist"));
    CHECK_THAT(failure_after(box(), "H[7]", "H[8]"), Contains("the domain holds no elements"));
    CHECK_THAT(failure_after(box(4), "NUMPOINTS=\"4\"", "NUMPOINTS=\"5\""), Contains("there are 4 points"));
    CHECK_THAT(failure_after(box(4), "PolyEvenlySpaced", "GaussGaussLegendre"), Contains("GaussGaussLegendre"));
    CHECK_THAT(failure_after(box(4), "PolyEvenlySpaced", "NodalTriElec"), Contains("those of a triangle"));
    // Turned so that it is collapsed at another vertex than the element says.
    CHECK_THAT(failure_after(box(4, Shape::tetrahedron), "<T ID=\"100\"> 10 12 14", "<T ID=\"100\"> 12 14 10"),
               Contains("collapsed at another vertex"));
    const TemporaryFolder folder;
    CHECK_THAT(failure({folder.write("cut.xml", nektar_writer::geometry_file(box()).substr(0, 300))}), Contains("at byte"));
    CHECK_THAT(failure({folder.write("other.xml", "<VTKFile/>")}), Contains("NEKTAR"));
}
