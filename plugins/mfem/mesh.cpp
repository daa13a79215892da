#include "mesh.hpp"

#include "band.hpp"
#include "file_content.hpp"
#include "text.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace elvis_mfem {

namespace {

constexpr std::string_view mark = "MFEM ";
/** What begins a stream for GLVis, of a mesh and a solution. */
constexpr std::string_view stream_mark = "solution\n";
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
    mesh.coordinates = read_coordinates(text, mesh.n_vertices, mesh.dimension, &mesh.space_dimension);
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

/** What the parts of a parallel mesh share: positions tell that, too. */
void skip_communication(Text& text) {
    if (!text.accept("communication_groups")) {
        return;
    }
    while (text.word("mfem_mesh_end") != "mfem_mesh_end") {
    }
}

Mesh read_conforming(Text& text) {
    Mesh mesh;
    mesh.dimension = read_dimension(text, 1);
    text.expect("elements");
    const std::size_t n_elements = text.count("the number of elements", mesh.dimension == 1 ? 8 : 10);
    mesh.elements.reserve(n_elements);
    for (std::size_t index = 0; index < n_elements; ++index) {
        MeshElement element;
        element.attribute = static_cast<int>(text.integer("an attribute", 0, most));
        if (mesh.dimension > 1) {
            element.geometry = read_geometry(text, mesh.dimension);
        } else {
            text.integer("the geometry of a segment", 1, 1);
        }
        const std::size_t n_corners = mesh.dimension > 1 ? vertices(element.geometry).size() : 2;
        for (std::size_t corner = 0; corner < n_corners; ++corner) {
            element.vertices[corner] = static_cast<std::int32_t>(text.integer("a vertex", 0, most));
        }
        mesh.elements.push_back(element);
    }
    if (text.accept("attribute_sets")) {
        read_sets(text);
    }
    text.expect("boundary");
    const std::size_t n_boundary = text.count("the number of boundary elements", mesh.dimension == 1 ? 6 : 8);
    mesh.boundary.reserve(n_boundary);
    for (std::size_t index = 0; index < n_boundary; ++index) {
        mesh.boundary.push_back(read_boundary_element(text, mesh.dimension, most));
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
    std::string head = read_head(path, 60);
    if (head.starts_with(stream_mark)) {
        head.erase(0, stream_mark.size());
    }
    return head.starts_with(mark) && head.substr(0, head.find('\n')).find("mesh") != std::string::npos;
}

int read_dimension(Text& text, int least) {
    text.expect("dimension");
    const auto dimension = static_cast<int>(text.integer("the dimension", 1, 3));
    if (dimension < least) {
        text.fail("this is a mesh of segments, of dimension 1, which is supported in 'MFEM mesh', INLINE, and NURBS of one "
                  "span each");
    }
    return dimension;
}

Geometry read_geometry(Text& text, int dimension) {
    return static_cast<Geometry>(dimension == 2 ? text.integer("the geometry of an element of dimension 2", 2, 3)
                                                : text.integer("the geometry of an element of dimension 3", 4, 7));
}

BoundaryElement read_boundary_element(Text& text, int dimension, std::int64_t n_vertices) {
    BoundaryElement element;
    element.attribute = static_cast<int>(text.integer("an attribute", 0, most));
    // Points are geometry 0, segments 1, triangles 2, squares 3.
    const auto n_corners =
        1 + text.integer("the geometry of a boundary element", dimension - 1, dimension == 3 ? 3 : dimension - 1);
    for (std::size_t corner = 0; corner < static_cast<std::size_t>(n_corners); ++corner) {
        element.vertices[corner] = static_cast<std::int32_t>(text.integer("a vertex", 0, n_vertices - 1));
    }
    return element;
}

std::vector<double> read_coordinates(Text& text, std::size_t n_vertices, int dimension, int* space_dimension) {
    *space_dimension = static_cast<int>(text.integer("the number of coordinates of a vertex", dimension, 3));
    const auto n_coordinates = static_cast<std::size_t>(*space_dimension);
    // A digit and a blank each.
    if (n_vertices > text.left() / (2 * n_coordinates) + 1) {
        text.fail("the file cannot hold " + std::to_string(n_vertices) + " vertices");
    }
    std::vector<double> coordinates(3 * n_vertices);
    for (std::size_t vertex = 0; vertex < n_vertices; ++vertex) {
        for (std::size_t d = 0; d < n_coordinates; ++d) {
            const double coordinate = text.real("a coordinate");
            if (!std::isfinite(coordinate)) {
                text.fail("a coordinate is not finite");
            }
            coordinates[3 * vertex + d] = coordinate;
        }
    }
    return coordinates;
}

void read_nodes(Text& text, Mesh& mesh) {
    if (text.accept("nodes")) {
        take_nodes(text, mesh);
    }
}

void take_nodes(Text& text, Mesh& mesh) {
    mesh.nodes = read_grid_function(text);
    const int n_components = mesh.nodes->n_components;
    if (mesh.nodes->collection.is_vector() || n_components < mesh.dimension || n_components > 3) {
        text.fail(std::string("the nodes of a mesh must have ") + (mesh.dimension < 3 ? "two or " : "") +
                  "three components in an H1 or L2 space");
    }
    mesh.space_dimension = n_components;
    if (!std::ranges::all_of(mesh.nodes->values, [](double value) { return std::isfinite(value); })) {
        text.fail("a coordinate of the nodes is not finite");
    }
    mesh.coordinates.clear();
}

namespace {

Mesh as_band(Mesh curve, const Text& text) {
    try {
        return band_of(std::move(curve));
    } catch (const std::invalid_argument& error) {
        text.fail(error.what());
    }
}

} // namespace

Mesh read_mesh(const std::string& path) {
    Text text(path);
    const bool is_stream = text.accept("solution");
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
    } else if (version == "NURBS mesh v1.0" || version == "NURBS mesh v1.1") {
        mesh = read_nurbs(text);
    } else if (version == "INLINE mesh v1.0") {
        mesh = read_inline(text);
        return mesh.dimension == 1 ? as_band(std::move(mesh), text) : mesh;
    } else {
        const std::string hint = version == "mesh v1.1" ? " (let MFEM write it again, as 'MFEM NC mesh v1.0')"
                                 : version.find("NURBS") != std::string::npos ? " (let MFEM convert it with Mesh::SetCurvature)"
                                                                              : "";
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "line 1: 'MFEM " + version + "' is not supported" + hint +
                                    "; MFEM mesh v1.0, v1.2, v1.3, MFEM NC mesh v1.0, v1.1, MFEM NURBS mesh v1.0, v1.1 and "
                                    "MFEM INLINE mesh v1.0 are");
    }
    if (mesh.elements.empty()) {
        text.fail("the mesh has no elements");
    }
    text.accept("mfem_mesh_end");
    text.accept("mfem_serial_mesh_end");
    skip_communication(text);
    if (mesh.dimension == 1) {
        mesh.solution = is_stream ? std::optional(read_grid_function(text)) : std::nullopt;
        mesh.digits = text.max_digits();
        return as_band(std::move(mesh), text);
    }
    if (is_stream) {
        // Commands for GLVis may follow.
        mesh.solution = read_grid_function(text);
        mesh.digits = text.max_digits();
        return mesh;
    }
    if (!text.at_end()) {
        text.fail("the mesh should end here, but " + shown(text.peek()) + " follows");
    }
    mesh.digits = text.max_digits();
    return mesh;
}

} // namespace elvis_mfem
