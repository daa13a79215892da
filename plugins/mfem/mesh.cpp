#include "mesh.hpp"

#include "text.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace elvis_mfem {

namespace {

constexpr std::string_view mark = "MFEM ";
/** Largest number of the files' integers. */
constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();

std::vector<AttributeSet> read_sets(Text& text) {
    std::vector<AttributeSet> sets(text.count("the number of attribute sets", 4));
    for (AttributeSet& set : sets) {
        set.name = text.quoted("the name of an attribute set");
        set.attributes.resize(text.count("the number of attributes in a set", 2));
        for (int& attribute : set.attributes) {
            attribute = static_cast<int>(text.integer("an attribute", 0, most));
        }
    }
    return sets;
}

void read_vertices(Text& text, Mesh& mesh) {
    text.expect("vertices");
    mesh.n_vertices = static_cast<std::size_t>(text.integer("the number of vertices", 1, most));
    read_nodes(text, mesh);
    if (mesh.nodes) {
        return;
    }
    text.integer("the number of coordinates of a vertex", 3, 3);
    // A digit and a blank each.
    if (mesh.n_vertices > text.left() / 6 + 1) {
        text.fail("the file cannot hold " + std::to_string(mesh.n_vertices) + " vertices");
    }
    mesh.coordinates.resize(3 * mesh.n_vertices);
    for (double& coordinate : mesh.coordinates) {
        coordinate = text.real("a coordinate");
        if (!std::isfinite(coordinate)) {
            text.fail("a coordinate is not finite");
        }
    }
    // Curved meshes may have both.
    read_nodes(text, mesh);
}

/** Vertex numbers can only be checked when the number of vertices is known, which comes last. */
void check_vertices(const Text& text, const Mesh& mesh) {
    const auto n = static_cast<std::int64_t>(mesh.n_vertices);
    const auto check = [&](const auto& vertices, const std::string& where) {
        for (std::int32_t vertex : vertices) {
            if (vertex >= n) {
                throw elvis::api::Error(ELVIS_ERROR_FORMAT, text.path(),
                                        where + ": vertex " + std::to_string(vertex) + " does not exist, there are " +
                                            std::to_string(n));
            }
        }
    };
    for (std::size_t index = 0; index < mesh.elements.size(); ++index) {
        check(mesh.elements[index].vertices, "element " + std::to_string(index));
    }
    for (std::size_t index = 0; index < mesh.boundary.size(); ++index) {
        check(mesh.boundary[index].vertices, "boundary element " + std::to_string(index));
    }
}

Mesh read_conforming(Text& text) {
    Mesh mesh;
    read_dimension(text);
    text.expect("elements");
    const std::size_t n_elements = text.count("the number of elements", 12);
    mesh.elements.reserve(n_elements);
    for (std::size_t index = 0; index < n_elements; ++index) {
        text.integer("an attribute", 0, most);
        MeshElement element;
        element.geometry = read_geometry(text);
        for (std::size_t corner = 0; corner < vertices(element.geometry).size(); ++corner) {
            element.vertices[corner] = static_cast<std::int32_t>(text.integer("a vertex", 0, most));
        }
        mesh.elements.push_back(element);
    }
    if (text.accept("attribute_sets")) {
        read_sets(text);
    }
    text.expect("boundary");
    const std::size_t n_boundary = text.count("the number of boundary elements", 10);
    mesh.boundary.reserve(n_boundary);
    for (std::size_t index = 0; index < n_boundary; ++index) {
        mesh.boundary.push_back(read_boundary_element(text, most));
    }
    if (text.accept("bdr_attribute_sets")) {
        mesh.boundary_sets = read_sets(text);
    }
    read_vertices(text, mesh);
    check_vertices(text, mesh);
    return mesh;
}

} // namespace

bool is_mesh(const char* path) {
    std::ifstream file(path, std::ios::binary);
    char head[5] = {};
    if (!file.read(head, sizeof head) || std::string_view(head, sizeof head) != mark) {
        return false;
    }
    std::string rest(40, ' ');
    file.read(rest.data(), static_cast<std::streamsize>(rest.size()));
    return rest.substr(0, rest.find('\n')).find("mesh") != std::string::npos;
}

void read_dimension(Text& text) {
    text.expect("dimension");
    text.integer("the dimension (only meshes of volumes are read)", 3, 3);
}

Geometry read_geometry(Text& text) {
    return static_cast<Geometry>(text.integer("the geometry of an element of a volume", 4, 7));
}

BoundaryElement read_boundary_element(Text& text, std::int64_t n_vertices) {
    BoundaryElement element;
    element.attribute = static_cast<int>(text.integer("an attribute", 0, most));
    const auto n_corners = 1 + text.integer("the geometry of a boundary element", 2, 3);
    for (std::size_t corner = 0; corner < static_cast<std::size_t>(n_corners); ++corner) {
        element.vertices[corner] = static_cast<std::int32_t>(text.integer("a vertex", 0, n_vertices - 1));
    }
    return element;
}

void read_nodes(Text& text, Mesh& mesh) {
    if (!text.accept("nodes")) {
        return;
    }
    mesh.nodes = read_grid_function(text);
    if (mesh.nodes->collection.is_vector() || mesh.nodes->n_components != 3) {
        text.fail("the nodes of a mesh must have three components in an H1 or L2 space");
    }
    if (!std::ranges::all_of(mesh.nodes->values, [](double value) { return std::isfinite(value); })) {
        text.fail("a coordinate of the nodes is not finite");
    }
    mesh.coordinates.clear();
}

Mesh read_mesh(const std::string& path) {
    Text text(path);
    text.expect("MFEM");
    std::string version;
    do {
        if (!version.empty()) {
            version.push_back(' ');
        }
        version.append(text.word("the version of the mesh"));
    } while (text.has_more_on_line() && version.size() < 100);
    Mesh mesh;
    if (version == "mesh v1.0" || version == "mesh v1.2" || version == "mesh v1.3") {
        mesh = read_conforming(text);
    } else if (version == "NC mesh v1.0" || version == "NC mesh v1.1") {
        mesh = read_nonconforming(text, version == "NC mesh v1.1");
    } else {
        const std::string hint = version == "mesh v1.1"          ? " (let MFEM write it again, as 'MFEM NC mesh v1.0')"
                                 : version.starts_with("NURBS")  ? " (let MFEM convert it with Mesh::SetCurvature)"
                                 : version.starts_with("INLINE") ? " (let MFEM write it as 'MFEM mesh v1.0')"
                                                                 : "";
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "line 1: 'MFEM " + version + "' is not supported" + hint +
                                    "; MFEM mesh v1.0, v1.2, v1.3 and MFEM NC mesh v1.0, v1.1 are");
    }
    if (mesh.elements.empty()) {
        text.fail("the mesh has no elements");
    }
    text.accept("mfem_mesh_end");
    text.accept("mfem_serial_mesh_end");
    if (text.peek() == "communication_groups") {
        text.fail("this is a part of a parallel mesh, which is not supported; let MFEM save it in one file (Mesh::SaveAsOne)");
    }
    if (!text.at_end()) {
        text.fail("the mesh should end here, but " + shown(text.peek()) + " follows");
    }
    mesh.digits = text.max_digits();
    return mesh;
}

} // namespace elvis_mfem
