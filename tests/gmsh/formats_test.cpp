// Versions, text and binary, byte orders, and physical groups.
#include "fixture.hpp"
#include "msh_mesh.hpp"
#include "msh_writer.hpp"
#include "scripts.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace {

/** Saves what a script meshes in all four formats: v41.msh, v41b.msh, v22.msh, v22b.msh. */
void make_all_formats(const TemporaryFolder& folder, const std::string& script, int dimension, int order) {
    std::ostringstream text;
    text << script << "Mesh.ElementOrder = " << order << ";\nMesh " << dimension << ";\n";
    for (const char* const version : {"41", "22"}) {
        for (const char* const binary : {"", "b"}) {
            text << "Mesh.MshFileVersion = " << version[0] << '.' << version[1] << "; Mesh.Binary = " << (*binary ? 1 : 0)
                 << "; Save \"v" << version << binary << ".msh\";\n";
        }
    }
    run_gmsh(folder, text.str(), "-parse_and_exit");
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = a.size() == b.size() ? 0 : HUGE_VAL;
    for (std::size_t index = 0; index < std::min(a.size(), b.size()); ++index) {
        largest = std::max(largest, std::abs(a[index] - b[index]));
    }
    return largest;
}

/** Boundary groups of the converted faces: number of faces by name. Fails if a face inside the domain has one. */
std::map<std::string, int> faces_by_group(const elvis::SourceVolume& source) {
    const Converted converted(source);
    std::vector<elvis_face> faces(converted.volume().n_faces());
    converted.volume().faces(0, faces.size(), faces);
    std::map<std::string, int> count;
    for (const elvis_face& face : faces) {
        const std::string name = face.group < 0 ? "" : source.boundary_groups().at(static_cast<std::size_t>(face.group));
        CHECK((face.group < 0 || face.neighbour == ELVIS_NEIGHBOUR_NONE));
        if (face.neighbour == ELVIS_NEIGHBOUR_NONE) {
            ++count[name];
        }
    }
    return count;
}

} // namespace

TEST_CASE("all formats of the gmsh program hold the same mesh and groups", "[gmsh]") {
    const TemporaryFolder folder;
    make_all_formats(folder, ball_script + "Physical Volume(\"again\") = {1};\n", 3, 3);
    const MshMesh mesh = read_mesh(folder.path("v41.msh"));
    const auto n_skin = static_cast<int>(mesh.of_dimension(2).size());
    const auto first = open_msh({folder.path("v41.msh")});
    CHECK(first.info().n_elements == mesh.of_dimension(3).size());
    for (const std::string name : {"v41.msh", "v41b.msh", "v22.msh", "v22b.msh"}) {
        INFO(name);
        const auto source = open_msh({folder.path(name)});
        // MSH 2.2 holds each element twice, once for each of its groups.
        REQUIRE(source.info().n_elements == first.info().n_elements);
        CHECK(source.fields().empty());
        double error = 0;
        for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
            const Point xi = random_point(elvis::native::Shape::tetrahedron);
            const Point a = position(source, element, xi), b = position(first, element, xi);
            error = std::max(error, largest_difference({a.begin(), a.end()}, {b.begin(), b.end()}));
        }
        WARN(name << ": largest difference " << error);
        CHECK(error <= 1e-14);
        CHECK(source.boundary_groups() == std::vector<std::string>{"skin", "surface 8"});
        CHECK(faces_by_group(source) == std::map<std::string, int>{{"skin", n_skin}});
    }
}

TEST_CASE("partitions, ghosts and parameters of nodes do not matter", "[gmsh]") {
    for (const std::string options : {"-format msh41", "-format msh41 -bin", "-format msh2", "-format msh2 -bin"}) {
        INFO(options);
        const TemporaryFolder folder;
        run_gmsh(folder, ball_script, "-3 -order 2 -o whole.msh -setnumber Mesh.SaveParametric 1 " + options);
        run_gmsh(folder, ball_script,
                 "-3 -order 2 -o parts.msh -part 3 -setnumber Mesh.PartitionCreateGhostCells 1 " + options);
        const auto whole = open_msh({folder.path("whole.msh")}), parts = open_msh({folder.path("parts.msh")});
        CHECK(parts.info().n_elements == whole.info().n_elements);
        CHECK(parts.boundary_groups() == whole.boundary_groups());
        CHECK(faces_by_group(parts) == faces_by_group(whole));
        CHECK(faces_by_group(parts).at("skin") > 10);
        CHECK(Converted(parts).report().n_boundary_faces == Converted(whole).report().n_boundary_faces);
    }
}

TEST_CASE("curves are the groups of plane meshes", "[gmsh]") {
    const TemporaryFolder folder;
    make_all_formats(folder, disc_script, 2, 2);
    for (const std::string name : {"v41.msh", "v41b.msh", "v22.msh", "v22b.msh"}) {
        INFO(name);
        const auto source = open_msh({folder.path(name)});
        CHECK(source.info().dimension == 2);
        std::vector<std::string> groups = source.boundary_groups();
        std::ranges::sort(groups);
        REQUIRE(groups == std::vector<std::string>{"one", "others"});
        const auto others =
            static_cast<int>(std::ranges::find(source.boundary_groups(), "others") - source.boundary_groups().begin());
        // Edges of the curves lie in x = 0, y = 0 or on the circle; no other edge has a group.
        int n_found = 0;
        std::vector<elvis_source_element> elements(source.info().n_elements);
        source.elements(0, elements.size(), elements);
        for (std::size_t element = 0; element < elements.size(); ++element) {
            REQUIRE(elements[element].shape == ELVIS_SHAPE_TRIANGLE);
            for (int edge = 0; edge < 3; ++edge) {
                const auto corners = elvis::native::face_corners(elvis::native::Shape::triangle, edge);
                const Point a = position(source, element, elvis::native::corner(elvis::native::Shape::triangle, corners[0]));
                const Point b = position(source, element, elvis::native::corner(elvis::native::Shape::triangle, corners[1]));
                const auto both = [&](auto is_on) { return is_on(a) && is_on(b); };
                const bool is_boundary = both([](const Point& x) { return std::abs(x[0]) < 1e-12; }) ||
                                         both([](const Point& x) { return std::abs(x[1]) < 1e-12; }) ||
                                         both([](const Point& x) { return std::abs(std::hypot(x[0], x[1]) - 1) < 1e-12; });
                const int group = elements[element].face_groups[edge];
                CHECK((group >= 0) == is_boundary);
                n_found += group == others ? 1 : 0;
            }
        }
        CHECK(n_found > 0);
    }
}

TEST_CASE("both byte orders of both versions hold the same volume", "[gmsh]") {
    const TemporaryFolder folder;
    run_gmsh(folder, boxes_script, "-3 -order 2 -format msh41 -o mesh.msh -setnumber curved 1");
    const MshMesh mesh = read_mesh(folder.path("mesh.msh"));
    ViewText nodes{.name = "nodes", .n_components = 3}, in_elements{.section = "ElementNodeData", .name = "in elements"},
        constants{.section = "ElementData", .name = "constants", .n_components = 9};
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto numbers = [&](std::size_t count) {
        std::vector<double> drawn(count);
        std::ranges::generate(drawn, [&] { return uniform(random_numbers()); });
        return drawn;
    };
    for (const auto& [tag, x] : mesh.nodes) {
        nodes.records.push_back({tag, numbers(3)});
    }
    for (const MshElement& element : mesh.elements) {
        in_elements.records.push_back({element.tag, numbers(element.nodes.size())});
        constants.records.push_back({element.tag, numbers(9)});
    }
    std::vector<std::vector<double>> expected;
    std::set<std::string> sizes;
    for (const bool is_4 : {true, false}) {
        for (const bool is_binary : {false, true}) {
            for (const bool is_big : {false, true}) {
                if (is_big && !is_binary) {
                    continue;
                }
                INFO(is_4 << is_binary << is_big);
                const Variant variant{is_4, is_binary, is_big};
                std::string bytes = write_mesh(mesh, variant);
                for (const ViewText& view : {nodes, in_elements, constants}) {
                    bytes += write_view(view, variant);
                }
                const auto source = open_msh({folder.write("variant.msh", bytes)});
                REQUIRE(source.n_values() == 13);
                CHECK(source.fields()[2].name == "constants");
                CHECK(source.fields()[0].continuity == ELVIS_CONTINUITY_CONTINUOUS);
                CHECK(source.fields()[1].continuity == ELVIS_CONTINUITY_DISCONTINUOUS);
                const auto elements = mesh.of_dimension(3);
                REQUIRE(source.info().n_elements == elements.size());
                for (std::size_t element = 0; element < elements.size(); ++element) {
                    const Point xi = elvis::native::corner(shape_of(source, element), 0);
                    std::vector<double> all = sample(source, element, xi);
                    const Point x = position(source, element, xi);
                    all.insert(all.end(), x.begin(), x.end());
                    if (expected.size() <= element) {
                        expected.push_back(all);
                        // The first corner is the first node: its values are the view's.
                        const auto at = static_cast<std::size_t>(
                            std::distance(mesh.nodes.begin(), mesh.nodes.find(elements[element].nodes[0])));
                        CHECK(std::abs(all[0] - nodes.records[at].second[0]) < 1e-14);
                        CHECK(all[4] == constants.records[element + mesh.elements.size() - elements.size()].second[0]);
                    }
                    CHECK(all == expected[element]);
                }
            }
        }
    }
}
