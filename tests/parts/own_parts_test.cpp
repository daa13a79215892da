// Data that a solver wrote in parts: the native file keeps them, and pictures are drawn by them.
#include <tests/support/program_folder.hpp>

#include <elvis/native/volume_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

using namespace elvis::test;
using elvis::native::Reader;

namespace {

std::vector<std::uint32_t> parts_of(const std::string& path) {
    const Reader reader(path);
    std::vector<std::uint32_t> parts(reader.description().n_parts > 0 ? reader.description().n_elements() : 0);
    reader.read_parts(0, parts);
    return parts;
}

/** Prisms of Nektar++ in a folder of two files: elements 0 to 6, and 7 to 15. */
std::string partitioned_prisms(const ProgramFolder& folder) {
    const std::string whole = read_file(data_file("nektarpp/Helmholtz3D_Prism_VarP.xml"));
    const std::size_t begin = whole.find("<ELEMENT>") + 9, end = whole.find("</ELEMENT>");
    const std::string elements = whole.substr(begin, end - begin);
    const std::size_t cut = elements.find("<R ID=\"7\"");
    REQUIRE(cut != std::string::npos);
    folder.write("prisms_xml/P0000000.xml", whole.substr(0, begin) + elements.substr(0, cut) + whole.substr(end));
    folder.write("prisms_xml/P0000001.xml", whole.substr(0, begin) + elements.substr(cut) + whole.substr(end));
    return "prisms_xml '" + data_file("nektarpp/Helmholtz3D_Prism_VarP.fld") + "'";
}

/** A cube of MFEM that begins at `x`. */
std::string cube_at(int x) {
    std::string text = "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n1\n1 5 0 1 2 3 4 5 6 7\n\nboundary\n0\n\nvertices\n8\n3\n";
    for (const int z : {0, 1}) {
        for (const auto& [along, y] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
            text.append(std::to_string(x + along)).append(" ").append(std::to_string(y)).append(" ");
            text.append(std::to_string(z)).append("\n");
        }
    }
    return text;
}

} // namespace

TEST_CASE("A mesh in parts of Nektar++ is drawn by its own parts, as by a list of them") {
    const ProgramFolder folder;
    const Outcome converted = folder.run("convert " + partitioned_prisms(folder) + " -o prisms.h5");
    INFO(converted.err);
    REQUIRE(converted.status == 0);
    std::string list;
    const std::vector<std::uint32_t> parts = parts_of(folder.path("prisms.h5"));
    REQUIRE(parts.size() == 16);
    for (std::size_t element = 0; element < parts.size(); ++element) {
        CHECK(parts[element] == (element < 7 ? 0 : 1));
        list += std::to_string(parts[element]) + "\n";
    }
    folder.write("list.txt", list);
    const std::string render = "render prisms.h5 --cut-plane 1,0.2,0.1,-0.5 --size 64x48 --parts ";
    const Outcome own = folder.run(render + "own -o own.png --buffers own.h5 --stats own.json");
    INFO(own.err);
    REQUIRE(own.status == 0);
    CHECK(folder.read("own.json").find("\"count\": 2") != std::string::npos);
    REQUIRE(folder.run(render + "list.txt -o list.png --buffers list.h5").status == 0);
    CHECK(folder.read("own.png") == folder.read("list.png"));
    CHECK(folder.read("own.h5") == folder.read("list.h5"));
}

TEST_CASE("Parts of MFEM and of Nek5000 are kept") {
    const ProgramFolder folder;
    folder.write("mesh.000000", cube_at(0));
    folder.write("mesh.000001", cube_at(1));
    const Outcome cubes = folder.run("convert mesh.000000 -o cubes.h5");
    INFO(cubes.err);
    REQUIRE(cubes.status == 0);
    CHECK(parts_of(folder.path("cubes.h5")) == std::vector<std::uint32_t>{0, 1});
    CHECK(folder.run("info cubes.h5").out.find("parts: 2, those of the solver's processes") != std::string::npos);
    const Outcome nek = folder.run("convert '" + data_file("nek5000/m22io_test0.f00001") + "' -o nek.h5");
    INFO(nek.err);
    REQUIRE(nek.status == 0);
    const std::vector<std::uint32_t> parts = parts_of(folder.path("nek.h5"));
    CHECK(std::ranges::count(parts, 0u) + std::ranges::count(parts, 1u) == static_cast<std::ptrdiff_t>(parts.size()));
    CHECK(std::ranges::count(parts, 1u) > 0);
    CHECK(std::ranges::count(parts, 0u) > 0);
}

TEST_CASE("A volume in one piece has no parts of its own") {
    const ProgramFolder folder;
    folder.write("mesh.mesh", cube_at(0));
    REQUIRE(folder.run("convert mesh.mesh -o cube.h5").status == 0);
    CHECK(parts_of(folder.path("cube.h5")).empty());
    CHECK(folder.run("info cube.h5").out.find("parts:") == std::string::npos);
    const Outcome outcome = folder.run("render cube.h5 --parts own -o cube.png");
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("cube.h5: has no partition of its own") != std::string::npos);
    CHECK(std::ranges::count(names_in(folder), "cube.png") == 0);
}
