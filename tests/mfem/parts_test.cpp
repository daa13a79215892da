// Parallel files: a mesh in parts, as the processes of a program write it.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <sstream>

using namespace elvis;
using Catch::Contains;

namespace {

/** A mesh of tetrahedra with straight edges, as its file has it. */
struct WholeMesh {
    struct Item {
        int attribute = 0, geometry = 0;
        std::vector<int> vertices;
    };
    std::vector<Item> elements, boundary;
    std::vector<std::array<std::string, 3>> vertices;

    std::vector<double> position(int vertex) const {
        std::vector<double> x;
        for (const std::string& coordinate : vertices[static_cast<std::size_t>(vertex)]) {
            x.push_back(std::stod(coordinate));
        }
        return x;
    }
};

WholeMesh read_whole(const std::string& path) {
    const std::string text = read_file(path);
    const auto section = [&](const std::string& name) {
        return std::istringstream(text.substr(text.find("\n" + name + "\n") + name.size() + 2));
    };
    const auto items = [&](const std::string& name, std::size_t n_vertices) {
        std::istringstream in = section(name);
        std::size_t n = 0;
        in >> n;
        std::vector<WholeMesh::Item> list(n);
        for (WholeMesh::Item& item : list) {
            in >> item.attribute >> item.geometry;
            item.vertices.resize(n_vertices);
            for (int& vertex : item.vertices) {
                in >> vertex;
            }
        }
        return list;
    };
    WholeMesh mesh;
    mesh.elements = items("elements", 4);
    mesh.boundary = items("boundary", 3);
    std::istringstream in = section("vertices");
    std::size_t n = 0, n_coordinates = 0;
    in >> n >> n_coordinates;
    mesh.vertices.resize(n);
    for (auto& vertex : mesh.vertices) {
        in >> vertex[0] >> vertex[1] >> vertex[2];
    }
    REQUIRE(in);
    REQUIRE(n_coordinates == 3);
    return mesh;
}

std::vector<int> sorted(std::vector<int> vertices) {
    std::ranges::sort(vertices);
    return vertices;
}

std::set<std::vector<int>> faces_of(const std::vector<int>& v) {
    return {sorted({v[0], v[1], v[2]}), sorted({v[0], v[1], v[3]}), sorted({v[0], v[2], v[3]}), sorted({v[1], v[2], v[3]})};
}

/** One part: which elements it has, and where its vertices are in the whole. */
struct PartFiles {
    std::vector<std::size_t> elements;
    std::vector<int> vertices;
    std::string mesh, linear, discontinuous;
};

double linear_at(const std::vector<double>& x) { return 1 + x[0] - 2 * x[1] + 0.5 * x[2]; }

/** As ParMesh::Print: local vertices, the boundary and behind it the faces that other parts have, too. */
PartFiles write_part(const WholeMesh& whole, const std::vector<int>& part_of, int part, const std::vector<double>& values,
                     bool with_groups) {
    PartFiles files;
    std::map<int, int> local;
    std::map<std::vector<int>, int> n_uses;
    std::ostringstream elements, boundary, vertices;
    const auto number = [&](int vertex) {
        const auto [found, is_new] = local.try_emplace(vertex, static_cast<int>(local.size()));
        if (is_new) {
            files.vertices.push_back(vertex);
        }
        return found->second;
    };
    for (std::size_t element = 0; element < whole.elements.size(); ++element) {
        if (part_of[element] != part) {
            continue;
        }
        files.elements.push_back(element);
        elements << "1 4";
        for (const int vertex : whole.elements[element].vertices) {
            elements << ' ' << number(vertex);
        }
        elements << '\n';
        for (const auto& face : faces_of(whole.elements[element].vertices)) {
            ++n_uses[face];
        }
    }
    int n_boundary = 0;
    for (const WholeMesh::Item& item : whole.boundary) {
        const auto own = n_uses.find(sorted(item.vertices));
        if (own != n_uses.end()) {
            boundary << item.attribute << " 2 " << number(item.vertices[0]) << ' ' << number(item.vertices[1]) << ' '
                     << number(item.vertices[2]) << '\n';
            n_uses.erase(own);
            ++n_boundary;
        }
    }
    for (const auto& [face, uses] : n_uses) {
        if (uses == 1) {
            boundary << "9 2 " << number(face[0]) << ' ' << number(face[1]) << ' ' << number(face[2]) << '\n';
            ++n_boundary;
        }
    }
    for (const int vertex : files.vertices) {
        const auto& x = whole.vertices[static_cast<std::size_t>(vertex)];
        vertices << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
    }
    std::ostringstream mesh;
    mesh << "MFEM mesh " << (with_groups ? "v1.2" : "v1.0") << "\n\ndimension\n3\n\nelements\n"
         << files.elements.size() << '\n'
         << elements.str() << "\nboundary\n"
         << n_boundary << '\n'
         << boundary.str() << "\nvertices\n"
         << files.vertices.size() << "\n3\n"
         << vertices.str();
    if (with_groups) {
        mesh << "\nmfem_serial_mesh_end\n\ncommunication_groups\nnumber_of_groups 2\n\n# number of entities in each group\n1 "
                "0\n2 0 1"
                "\n\ntotal_shared_vertices 1\n\n# group 1\nshared_vertices 1\n0\n\nmfem_mesh_end\n";
    }
    files.mesh = mesh.str();
    std::ostringstream linear, discontinuous;
    linear.precision(17);
    discontinuous.precision(17);
    linear << space_text("H1_3D_P1");
    for (const int vertex : files.vertices) {
        linear << linear_at(whole.position(vertex)) << '\n';
    }
    discontinuous << space_text("L2_3D_P1");
    for (const std::size_t element : files.elements) {
        for (std::size_t i = 0; i < 4; ++i) {
            discontinuous << values[4 * element + i] << '\n';
        }
    }
    files.linear = linear.str();
    files.discontinuous = discontinuous.str();
    return files;
}

struct Split {
    WholeMesh whole = read_whole(mfem_data("poisson-inline-tet-p6/mesh.mesh"));
    std::vector<double> values;
    std::vector<PartFiles> parts;
    std::string mesh, linear, discontinuous;

    Split(const TemporaryFolder& folder, int n_parts, bool with_groups) : values(4 * whole.elements.size()) {
        std::mt19937 random(7);
        std::ranges::generate(values, [&] { return std::uniform_real_distribution<double>(-1, 1)(random); });
        std::vector<int> part_of;
        for (const WholeMesh::Item& element : whole.elements) {
            double x = 0;
            for (const int vertex : element.vertices) {
                x += 0.25 * whole.position(vertex)[0];
            }
            part_of.push_back(std::min(n_parts - 1, static_cast<int>(x * n_parts)));
        }
        for (int part = 0; part < n_parts; ++part) {
            parts.push_back(write_part(whole, part_of, part, values, with_groups));
            const std::string number = ".00000" + std::to_string(part);
            folder.write("mesh" + number, parts.back().mesh);
            folder.write("linear" + number, parts.back().linear);
            folder.write("jumps" + number, parts.back().discontinuous);
        }
        mesh = folder.path("mesh.000000");
        linear = folder.path("linear.000000");
        discontinuous = folder.path("jumps.000000");
    }
};

} // namespace

TEST_CASE("parts of a parallel mesh are one volume", "[mfem]") {
    const bool with_groups = GENERATE(false, true);
    const TemporaryFolder folder;
    const Split split(folder, 3, with_groups);
    const auto joined = open_mfem({split.mesh, split.linear, split.discontinuous});
    const auto whole = open_mfem({mfem_data("poisson-inline-tet-p6/mesh.mesh")});
    REQUIRE(joined.info().n_elements == split.whole.elements.size());
    REQUIRE(joined.fields().size() == 2);
    CHECK(joined.fields()[0].name == "linear");
    CHECK(joined.boundary_groups() == whole.boundary_groups());
    // Elements are those of the parts, one after the other.
    std::uint64_t place = 0;
    double error = 0;
    for (const PartFiles& part : split.parts) {
        for (const std::size_t element : part.elements) {
            const std::array xi{-0.6, -0.5, -0.7};
            std::array<double, 3> here, there;
            std::array<double, 2> values;
            joined.evaluate_mapping(place, xi, here);
            whole.evaluate_mapping(element, xi, there);
            joined.sample(0, place, xi, values);
            CHECK(here == there);
            error = std::max(error, std::abs(values[0] - linear_at({here[0], here[1], here[2]})));
            // Gauss-Legendre nodes of order 1 are no corners: the mean is that of the values.
            std::array<double, 2> middle;
            joined.sample(0, place, std::array{-0.5, -0.5, -0.5}, middle);
            const double mean = std::accumulate(&split.values[4 * element], &split.values[4 * element] + 4, 0.0) / 4;
            error = std::max(error, std::abs(middle[1] - mean));
            CHECK(std::ranges::equal(get_element(joined, place).face_groups, get_element(whole, element).face_groups));
            ++place;
        }
    }
    WARN("joined parts: largest error " << error);
    CHECK(error < 1e-14);
    const Converted converted = convert_mfem(joined), expected = convert_mfem(whole);
    CHECK(converted.report.n_faces == expected.report.n_faces);
    CHECK(converted.report.n_boundary_faces == expected.report.n_boundary_faces);
    CHECK(converted.report.n_unknown_faces == 0);
}

TEST_CASE("parts that do not fit are refused", "[mfem]") {
    const TemporaryFolder folder;
    const Split split(folder, 2, false);
    CHECK_THAT(failure({split.mesh, folder.write("one.000000", split.parts[0].linear)}),
               Contains("one.000000") && Contains("1 part(s)") && Contains("2"));
    CHECK_THAT(failure({folder.write("alone.000003", split.parts[0].mesh)}), Contains("from 0 on"));
    folder.write("linear.000001", replaced(split.parts[1].linear, "H1_3D_P1", "L2_3D_P1"));
    CHECK_THAT(failure({split.mesh, split.linear}), Contains("values") || Contains("not that of the first part"));
    folder.write("mesh.000001", "MFEM mesh v1.0\n\ndimension\n3\n");
    CHECK_THAT(failure({split.mesh}), Contains("mesh.000001"));
    folder.write("mesh.000001", split.parts[1].mesh + "\ncommunication_groups\nnumber_of_groups 1\n");
    CHECK_THAT(failure({split.mesh}), Contains("mfem_mesh_end"));
}

TEST_CASE("root files name the parts of parallel meshes", "[mfem]") {
    const TemporaryFolder folder;
    const Split split(folder, 2, true);
    const std::string root = folder.write("run.mfem_root", R"({"dsets": {"main": {"cycle": 3, "domains": 2, "time": 1.5,
        "mesh": {"path": "mesh.%06d", "tags": {}},
        "fields": {"u": {"path": "linear.%06d", "tags": {"comps": "1"}}}}}})");
    const auto source = open_mfem({root});
    CHECK(source.info().n_elements == split.whole.elements.size());
    CHECK(source.times() == std::vector<double>{1.5});
    CHECK(source.fields()[0].name == "u");
    CHECK_THAT(failure({folder.write("none.mfem_root", replaced(read_file(root), "\"domains\": 2", "\"domains\": 0"))}),
               Contains("domains"));
}
