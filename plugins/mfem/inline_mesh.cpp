/**
 * @file inline_mesh.cpp
 * MFEM INLINE meshes: a Cartesian grid by its numbers and sizes, divided into one shape. Vertices, elements and boundary in the
 * order of MFEM's Mesh::Make2D and Make3D (mesh/mesh.cpp); see format.md.
 */
#include "grid_curve.hpp"
#include "mesh.hpp"
#include "text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

namespace elvis_mfem {

namespace {

/** Elements and vertices: some hundred megabytes, from a file of a few lines. MFEM can write larger grids out. */
constexpr std::int64_t max_items = 10'000'000;

struct Grid {
    std::string type;
    std::array<int, 3> counts{};
    std::array<double, 3> sizes{};
};

/** What a cell is divided into: elements by corners of a cube or square, 8 is its centre. */
struct Division {
    Geometry geometry;
    std::vector<std::vector<int>> elements;
    /** Whether the cells come along the curve, else row by row. */
    bool is_on_curve;
};

const std::map<std::string, Division, std::less<>> divisions{
    {"quad", {Geometry::square, {{0, 1, 2, 3}}, true}},
    {"tri", {Geometry::triangle, {{0, 2, 3}, {0, 1, 2}}, false}},
    {"hex", {Geometry::cube, {{0, 1, 2, 3, 4, 5, 6, 7}}, true}},
    {"tet",
     {Geometry::tetrahedron, {{0, 1, 2, 6}, {0, 5, 1, 6}, {0, 4, 5, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}}, false}},
    {"wedge", {Geometry::prism, {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}, false}},
    {"pyramid",
     {Geometry::pyramid,
      {{0, 1, 2, 3, 8}, {0, 4, 5, 1, 8}, {1, 5, 6, 2, 8}, {2, 6, 7, 3, 8}, {3, 7, 4, 0, 8}, {7, 6, 5, 4, 8}},
      false}},
};

/** The word behind "name =": blanks around '=' and a semicolon behind the value may be left out, but the one before '='. */
std::string read_value(Text& text) {
    std::string value(text.word("'='"));
    if (!value.starts_with('=')) {
        text.fail("'=' should stand where " + shown(value) + " is");
    }
    value.erase(0, 1);
    if (value.empty()) {
        value = text.word("a value");
    }
    if (value.ends_with(';')) {
        value.pop_back();
    } else {
        text.accept(";");
    }
    return value;
}

template <class Number> Number parse_positive(const Text& text, const std::string& name, const std::string& value) {
    Number number{};
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || !(number > 0) || !std::isfinite(double(number))) {
        text.fail(name + " should be a positive number, but is " + shown(value));
    }
    return number;
}

Grid read_grid(Text& text) {
    Grid grid;
    while (!text.at_end()) {
        const std::string name(text.word("a name"));
        const bool is_count = name.size() == 2 && name[0] == 'n', is_size = name.size() == 2 && name[0] == 's';
        const std::size_t axis = std::string_view("xyz").find(name.back());
        if (name != "type" && (axis == std::string_view::npos || !(is_count || is_size))) {
            text.fail(shown(name) + " is none of type, nx, ny, nz, sx, sy, sz");
        }
        const std::string value = read_value(text);
        if (name == "type") {
            grid.type = value;
        } else if (is_count) {
            grid.counts[axis] = parse_positive<int>(text, name, value);
        } else {
            grid.sizes[axis] = parse_positive<double>(text, name, value);
        }
    }
    return grid;
}

const Division& check(const Text& text, Grid& grid) {
    const auto found = divisions.find(grid.type);
    if (found == divisions.end()) {
        text.fail("the type " + shown(grid.type) + " is none of segment, tri, quad, tet, hex, wedge, pyramid");
    }
    const auto n_axes = static_cast<std::size_t>(dimension(found->second.geometry));
    // One after the other, as the product of three counts may be too large for any integer.
    auto n_elements = static_cast<std::int64_t>(found->second.elements.size());
    std::int64_t n_vertices = 1;
    for (std::size_t axis = 0; axis < n_axes; ++axis) {
        if (grid.counts[axis] == 0 || grid.sizes[axis] == 0) {
            text.fail(std::string("the number or the size in ") + "xyz"[axis] + " is missing");
        }
        n_elements *= grid.counts[axis];
        n_vertices *= grid.counts[axis] + std::int64_t{1};
        if (std::max(n_elements, n_vertices) > max_items) {
            text.fail("the grid has more than " + std::to_string(max_items) +
                      " elements or vertices, which is not supported; let MFEM write it as 'MFEM mesh v1.0'");
        }
    }
    if (n_axes == 2) {
        grid.counts[2] = 0;
    }
    return found->second;
}

/** Make1D. */
Mesh segments_of(const Text& text, const Grid& grid) {
    if (grid.counts[0] == 0 || grid.sizes[0] == 0 || grid.counts[0] > max_items) {
        text.fail("the number or the size in x is missing or too large");
    }
    Mesh mesh;
    mesh.dimension = mesh.space_dimension = 1;
    mesh.n_vertices = static_cast<std::size_t>(grid.counts[0]) + 1;
    for (int i = 0; i <= grid.counts[0]; ++i) {
        mesh.coordinates.insert(mesh.coordinates.end(), {grid.sizes[0] * i / grid.counts[0], 0, 0});
    }
    for (int i = 0; i < grid.counts[0]; ++i) {
        MeshElement& segment = mesh.elements.emplace_back();
        segment.vertices[0] = i;
        segment.vertices[1] = i + 1;
    }
    mesh.boundary.push_back({1, {0, -1, -1, -1}});
    mesh.boundary.push_back({2, {grid.counts[0], -1, -1, -1}});
    return mesh;
}

class Maker {
public:
    Maker(const Grid& grid, const Division& division) : m_grid(grid), m_division(division) {
        m_mesh.dimension = m_mesh.space_dimension = dimension(division.geometry);
    }

    Mesh operator()() {
        add_vertices();
        for (const Cell& cell : cells()) {
            add_elements(cell);
        }
        m_mesh.dimension == 2 ? add_edges() : add_faces();
        // Quotients have all the digits of a double.
        m_mesh.digits = 17;
        return std::move(m_mesh);
    }

private:
    std::size_t axes() const { return static_cast<std::size_t>(m_mesh.dimension); }

    std::int32_t vertex(int x, int y, int z) const { return x + (m_grid.counts[0] + 1) * (y + (m_grid.counts[1] + 1) * z); }

    std::int32_t centre(const Cell& at) const {
        const auto [nx, ny, nz] = m_grid.counts;
        return vertex(0, 0, nz + 1) + at[0] + nx * (at[1] + ny * at[2]);
    }

    /** A point of the grid, `shift` cells from its whole numbers. */
    void add_vertex(const Cell& at, double shift) {
        for (std::size_t d = 0; d < 3; ++d) {
            const bool is_flat = d >= axes();
            m_mesh.coordinates.push_back(is_flat ? 0 : (at[d] + shift) / m_grid.counts[d] * m_grid.sizes[d]);
        }
        ++m_mesh.n_vertices;
    }

    template <class Visit> static void for_rows(const std::array<int, 3>& counts, Visit&& visit) {
        for (int z = 0; z < counts[2]; ++z) {
            for (int y = 0; y < counts[1]; ++y) {
                for (int x = 0; x < counts[0]; ++x) {
                    visit(Cell{x, y, z});
                }
            }
        }
    }

    void add_vertices() {
        const auto [nx, ny, nz] = m_grid.counts;
        for_rows({nx + 1, ny + 1, nz + 1}, [&](const Cell& at) { add_vertex(at, 0); });
        if (m_division.geometry == Geometry::pyramid) {
            for_rows(m_grid.counts, [&](const Cell& at) { add_vertex(at, 0.5); });
        }
    }

    std::vector<Cell> cells() const {
        if (m_division.is_on_curve) {
            return curve_through_grid(m_grid.counts);
        }
        std::vector<Cell> result;
        const auto [nx, ny, nz] = m_grid.counts;
        for_rows({nx, ny, std::max(1, nz)}, [&](const Cell& cell) { result.push_back(cell); });
        return result;
    }

    void add_elements(const Cell& cell) {
        std::array<std::int32_t, 9> corners{};
        const auto unit = vertices(axes() == 2 ? Geometry::square : Geometry::cube);
        for (std::size_t corner = 0; corner < unit.size(); ++corner) {
            const auto at = [&](std::size_t d) { return cell[d] + static_cast<int>(unit[corner][d]); };
            corners[corner] = vertex(at(0), at(1), at(2));
        }
        corners[8] = centre(cell);
        for (const std::vector<int>& own : m_division.elements) {
            MeshElement element;
            element.geometry = m_division.geometry;
            std::ranges::transform(own, element.vertices.begin(), [&](int i) { return corners[static_cast<std::size_t>(i)]; });
            m_mesh.elements.push_back(element);
        }
    }

    void add_edge(int attribute, std::int32_t from, std::int32_t to) {
        m_mesh.boundary.push_back({attribute, {from, to, -1, -1}});
    }

    /** Bottom 1, right 2, top 3, left 4. */
    void add_edges() {
        const auto [nx, ny, nz] = m_grid.counts;
        for (int x = 0; x < nx; ++x) {
            add_edge(1, vertex(x, 0, 0), vertex(x + 1, 0, 0));
            add_edge(3, vertex(x + 1, ny, 0), vertex(x, ny, 0));
        }
        for (int y = 0; y < ny; ++y) {
            add_edge(2, vertex(nx, y, 0), vertex(nx, y + 1, 0));
            add_edge(4, vertex(0, y + 1, 0), vertex(0, y, 0));
        }
    }

    /** A rectangle by its corners; in tetrahedra two triangles, in prisms those at z = 0 and its end. */
    void add_rectangle(int attribute, const std::array<std::int32_t, 4>& v) {
        const bool is_divided = m_division.geometry == Geometry::tetrahedron ||
                                (m_division.geometry == Geometry::prism && (attribute == 1 || attribute == 6));
        if (!is_divided) {
            m_mesh.boundary.push_back({attribute, v});
            return;
        }
        m_mesh.boundary.push_back({attribute, {v[0], v[1], v[2], -1}});
        m_mesh.boundary.push_back({attribute, {v[0], v[2], v[3], -1}});
    }

    /** z = 0 1, its end 6, x = 0 5, its end 3, y = 0 2, its end 4. */
    void add_faces() {
        const auto [nx, ny, nz] = m_grid.counts;
        for_rows({nx, ny, 2}, [&](const Cell& c) {
            const int x = c[0], y = c[1], z = c[2] * m_grid.counts[2];
            add_rectangle(z == 0 ? 1 : 6, {vertex(x, y, z), vertex(x + 1, y, z), vertex(x + 1, y + 1, z), vertex(x, y + 1, z)});
        });
        for_rows({2, ny, nz}, [&](const Cell& c) {
            const int x = c[0] * m_grid.counts[0], y = c[1], z = c[2];
            add_rectangle(x == 0 ? 5 : 3, {vertex(x, y, z), vertex(x, y + 1, z), vertex(x, y + 1, z + 1), vertex(x, y, z + 1)});
        });
        for_rows({nx, 2, nz}, [&](const Cell& c) {
            const int x = c[0], y = c[1] * m_grid.counts[1], z = c[2];
            add_rectangle(y == 0 ? 2 : 4, {vertex(x, y, z), vertex(x + 1, y, z), vertex(x + 1, y, z + 1), vertex(x, y, z + 1)});
        });
    }

    const Grid& m_grid;
    const Division& m_division;
    Mesh m_mesh;
};

} // namespace

Mesh read_inline(Text& text) {
    Grid grid = read_grid(text);
    if (grid.type == "segment") {
        return segments_of(text, grid);
    }
    const Division& division = check(text, grid);
    return Maker(grid, division)();
}

} // namespace elvis_mfem
