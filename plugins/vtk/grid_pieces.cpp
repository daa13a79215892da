#include "grid_pieces.hpp"

#include "data_array.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace elvis_vtk {

namespace {

/** Ghost flags of vtkDataSetAttributes: a cell that another piece owns, a cell that is hidden. */
constexpr int ghost_duplicate = 1, ghost_hidden = 32;

pugi::xml_node find_array(pugi::xml_node parent, const std::string& name) {
    for (const pugi::xml_node array : parent.children("DataArray")) {
        if (name == array.attribute("Name").as_string()) {
            return array;
        }
    }
    return {};
}

/** A flag or degree that was read as a number; -1 for what is neither. */
int small_integer(double number) { return number >= 0 && number <= 1000 ? static_cast<int>(number) : -1; }

class GridReader {
public:
    GridReader(const XmlFile& file, Grid& grid, const elvis::api::Host& host) : m_file(file), m_grid(grid), m_host(host) {}

    void read() {
        const pugi::xml_node root = m_file.child(m_file.root(), "UnstructuredGrid");
        if (const pugi::xml_node time = find_array(root.child("FieldData"), "TimeValue"); time && is_numeric(time)) {
            m_grid.time = read_numbers(m_file, time, 1).values.front();
        }
        std::size_t n_pieces = 0;
        for (const pugi::xml_node piece : root.children("Piece")) {
            ++n_pieces;
            read_piece(piece);
        }
        if (n_pieces == 0) {
            m_file.fail(root, "has no element Piece");
        }
    }

    /** Cells that were left out because they are neither surfaces nor volumes. */
    std::size_t n_lower() const { return m_n_lower; }

private:
    /** Numbers that belong to the current piece. */
    struct Piece {
        std::size_t n_points = 0;
        std::size_t n_cells = 0;
        /** Index of the piece's first point and cell in the grid. */
        std::size_t first_point = 0;
        std::size_t first_cell = 0;
        /** Whether a cell of the file becomes one of the grid. */
        std::vector<bool> is_kept;
    };

    void read_piece(pugi::xml_node node) {
        Piece piece;
        piece.n_points = m_file.count(node, "NumberOfPoints");
        piece.n_cells = m_file.count(node, "NumberOfCells");
        if (piece.n_cells == 0) {
            return;
        }
        m_host.check_cancelled();
        piece.first_point = m_grid.points.size() / 3;
        piece.first_cell = m_grid.cells.size();
        const bool is_first = m_grid.n_pieces++ == 0;

        const pugi::xml_node points = m_file.child(m_file.child(node, "Points"), "DataArray");
        if (n_components(m_file, points) != 3) {
            m_file.fail(points, "points need 3 components");
        }
        append(m_grid.points, take(points, times(node, piece.n_points, 3)));
        const pugi::xml_node point_data = node.child("PointData"), cell_data = node.child("CellData");
        read_weights(point_data, piece, is_first);
        read_cells(m_file.child(node, "Cells"), cell_data, piece);
        read_arrays(point_data, piece, m_grid.point_arrays, true, is_first);
        read_arrays(cell_data, piece, m_grid.cell_arrays, false, is_first);
    }

    static void append(std::vector<double>& to, std::vector<double>&& from) {
        if (to.empty()) {
            to = std::move(from);
        } else {
            to.insert(to.end(), from.begin(), from.end());
        }
    }

    /** n * factor, both of the file; a failure instead of an overflow. */
    std::size_t times(pugi::xml_node node, std::size_t n, std::size_t factor) const {
        if (n > (std::size_t(1) << 46) / factor) {
            m_file.fail(node, "announces " + std::to_string(n) + " points or cells");
        }
        return n * factor;
    }

    std::vector<double> take(pugi::xml_node array, std::size_t size) {
        Numbers numbers = read_numbers(m_file, array, size);
        m_grid.mantissa_bits = std::min(m_grid.mantissa_bits, numbers.mantissa_bits);
        return std::move(numbers.values);
    }

    void read_weights(pugi::xml_node point_data, const Piece& piece, bool is_first) {
        const pugi::xml_attribute name = point_data.attribute("RationalWeights");
        if (bool(name) == m_grid.weights.empty() && !is_first) {
            m_file.fail(point_data, "some pieces have RationalWeights and others have not");
        }
        if (!name) {
            return;
        }
        const pugi::xml_node array = find_array(point_data, name.as_string());
        if (!array) {
            m_file.fail(point_data, "has no array '" + std::string(name.as_string()) + "', its RationalWeights");
        }
        append(m_grid.weights, take(array, piece.n_points));
        for (const double weight : m_grid.weights) {
            if (!(weight > 0) || !std::isfinite(weight)) {
                m_file.fail(array, "a weight is not positive");
            }
        }
    }

    void read_cells(pugi::xml_node cells, pugi::xml_node cell_data, Piece& piece) {
        const auto integers = [&](const char* name) {
            const pugi::xml_node array = find_array(cells, name);
            if (!array) {
                m_file.fail(cells, "has no array '" + std::string(name) + "'");
            }
            return read_integers(m_file, array);
        };
        const std::vector<std::int64_t> connectivity = integers("connectivity"), offsets = integers("offsets"),
                                        types = integers("types");
        if (offsets.size() != piece.n_cells || types.size() != piece.n_cells) {
            m_file.fail(cells, std::to_string(offsets.size()) + " offsets and " + std::to_string(types.size()) + " types for " +
                                   std::to_string(piece.n_cells) + " cells");
        }
        const std::vector<double> ghosts = read_ghosts(cell_data, piece);
        const std::vector<double> degrees = read_degrees(cell_data, piece);
        piece.is_kept.assign(piece.n_cells, false);
        const std::size_t first_connection = m_grid.connectivity.size();
        std::int64_t begin = 0;
        for (std::size_t index = 0; index < piece.n_cells; ++index) {
            const std::int64_t end = offsets[index];
            if (end < begin || end > static_cast<std::int64_t>(connectivity.size())) {
                m_file.fail(cells, "offset " + std::to_string(end) + " of cell " + std::to_string(index) +
                                       " is below the one before or beyond the " + std::to_string(connectivity.size()) +
                                       " entries of connectivity");
            }
            const std::span points(connectivity.data() + begin, static_cast<std::size_t>(end - begin));
            begin = end;
            if (!ghosts.empty() && (small_integer(ghosts[index]) & (ghost_duplicate | ghost_hidden)) != 0) {
                continue;
            }
            std::array<int, 3> degree{};
            for (std::size_t i = 0; i < 3 && !degrees.empty(); ++i) {
                degree[i] = small_integer(degrees[3 * index + i]);
            }
            if (types[index] < 0 || types[index] > 255) {
                m_file.fail(cells, "cell " + std::to_string(index) + " has type " + std::to_string(types[index]));
            }
            add_cell(cells, index, static_cast<int>(types[index]), points, degree, piece);
        }
        const std::string notes =
            unify_node_order(m_grid.points, m_grid.connectivity, std::span(m_grid.cells).subspan(piece.first_cell),
                             m_piece_kinds, !m_file.is_at_least(2, 1));
        if (!notes.empty()) {
            m_host.log(ELVIS_LOG_INFO, m_file.path() + ": " + notes + "told by the positions of the points");
        }
        mark_rational(first_connection, piece);
        adopt_kinds(piece);
    }

    void add_cell(pugi::xml_node cells, std::size_t index, int type, std::span<const std::int64_t> points,
                  const std::array<int, 3>& degree, Piece& piece) {
        if (is_less_than_surface(type)) {
            ++m_n_lower;
            return;
        }
        const int plain_type = type == type_pixel ? type_quad : type == type_voxel ? type_hexahedron : type;
        CellKind kind;
        try {
            kind = kind_of(plain_type, points.size(), degree);
        } catch (const UnsupportedCell& error) {
            m_file.fail(cells, "cell " + std::to_string(index) + " is " + error.what());
        }
        auto found = std::ranges::find(m_piece_kinds, kind);
        if (found == m_piece_kinds.end()) {
            m_piece_kinds.push_back(kind);
            found = m_piece_kinds.end() - 1;
        }
        const std::size_t first = m_grid.connectivity.size();
        for (const std::int64_t point : points) {
            if (point < 0 || static_cast<std::size_t>(point) >= piece.n_points) {
                m_file.fail(cells, "cell " + std::to_string(index) + " has point " + std::to_string(point) + " of " +
                                       std::to_string(piece.n_points));
            }
            const std::size_t in_grid = piece.first_point + static_cast<std::size_t>(point);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!std::isfinite(m_grid.points[3 * in_grid + axis])) {
                    m_file.fail(cells,
                                "point " + std::to_string(point) + " of cell " + std::to_string(index) + " is not finite");
                }
            }
            m_grid.connectivity.push_back(static_cast<std::int64_t>(in_grid));
        }
        if (plain_type != type) {
            // Pixels and voxels count points row by row.
            std::swap(m_grid.connectivity[first + 2], m_grid.connectivity[first + 3]);
            if (type == type_voxel) {
                std::swap(m_grid.connectivity[first + 6], m_grid.connectivity[first + 7]);
            }
        }
        m_grid.cells.push_back({first, static_cast<std::uint32_t>(found - m_piece_kinds.begin())});
        piece.is_kept[index] = true;
    }

    /** Cells of Bezier kinds with unequal weights become cells of a rational kind. */
    void mark_rational(std::size_t first_connection, const Piece& piece) {
        if (m_grid.weights.empty() || first_connection == m_grid.connectivity.size()) {
            return;
        }
        for (std::size_t index = piece.first_cell; index < m_grid.cells.size(); ++index) {
            Cell& cell = m_grid.cells[index];
            CellKind kind = m_piece_kinds[cell.kind];
            if (!kind.is_bezier) {
                continue;
            }
            const auto weight = [&](std::size_t node) {
                return m_grid.weights[static_cast<std::size_t>(m_grid.connectivity[cell.first + node])];
            };
            for (std::size_t node = 1; node < n_nodes(kind); ++node) {
                kind.is_rational = kind.is_rational || weight(node) != weight(0);
            }
            auto found = std::ranges::find(m_piece_kinds, kind);
            if (found == m_piece_kinds.end()) {
                m_piece_kinds.push_back(kind);
                found = m_piece_kinds.end() - 1;
            }
            cell.kind = static_cast<std::uint32_t>(found - m_piece_kinds.begin());
        }
    }

    /** From the piece's numbers of kinds to the grid's. */
    void adopt_kinds(const Piece& piece) {
        std::vector<std::uint32_t> number_of;
        for (const CellKind& kind : m_piece_kinds) {
            auto found = std::ranges::find(m_grid.kinds, kind);
            if (found == m_grid.kinds.end()) {
                m_grid.kinds.push_back(kind);
                found = m_grid.kinds.end() - 1;
            }
            number_of.push_back(static_cast<std::uint32_t>(found - m_grid.kinds.begin()));
        }
        for (std::size_t index = piece.first_cell; index < m_grid.cells.size(); ++index) {
            m_grid.cells[index].kind = number_of[m_grid.cells[index].kind];
        }
        m_piece_kinds.clear();
    }

    std::vector<double> read_ghosts(pugi::xml_node cell_data, const Piece& piece) {
        const pugi::xml_node array = find_array(cell_data, "vtkGhostType");
        return array ? read_numbers(m_file, array, piece.n_cells).values : std::vector<double>{};
    }

    std::vector<double> read_degrees(pugi::xml_node cell_data, const Piece& piece) {
        const pugi::xml_attribute name = cell_data.attribute("HigherOrderDegrees");
        if (!name) {
            return {};
        }
        const pugi::xml_node array = find_array(cell_data, name.as_string());
        if (!array || n_components(m_file, array) != 3) {
            m_file.fail(cell_data,
                        "has no array '" + std::string(name.as_string()) + "' of 3 components, its HigherOrderDegrees");
        }
        return read_numbers(m_file, array, times(array, piece.n_cells, 3)).values;
    }

    /** Arrays that are fields: of numbers, with a name of their own, and not in the service of the format. */
    static std::set<std::string> reserved_names(pugi::xml_node data) {
        std::set<std::string> names{"vtkGhostType", "vtkGhostLevels", ""};
        for (const char* attribute : {"RationalWeights", "HigherOrderDegrees", "GlobalIds", "PedigreeIds", "ProcessIds"}) {
            names.insert(data.attribute(attribute).as_string());
        }
        return names;
    }

    void read_arrays(pugi::xml_node data, const Piece& piece, std::vector<Array>& arrays, bool of_points, bool is_first) {
        std::set<std::string> seen = reserved_names(data);
        std::vector<std::string> present;
        for (const pugi::xml_node node : data.children("DataArray")) {
            const std::string name = node.attribute("Name").as_string();
            if (!seen.insert(name).second || !is_numeric(node)) {
                continue;
            }
            auto found = std::ranges::find(arrays, name, &Array::name);
            if (found == arrays.end()) {
                if (!is_first) {
                    m_host.log(ELVIS_LOG_WARNING, m_file.path() + ": field '" + name + "' is not in all pieces; left out");
                    continue;
                }
                arrays.push_back({name, n_components(m_file, node), {}});
                found = arrays.end() - 1;
            }
            if (n_components(m_file, node) != found->n_components) {
                m_file.fail(node, "has " + std::to_string(n_components(m_file, node)) + " components, in another piece " +
                                      std::to_string(found->n_components));
            }
            present.push_back(name);
            std::vector<double> values =
                take(node, times(node, of_points ? piece.n_points : piece.n_cells, found->n_components));
            if (!of_points) {
                values = kept_only(std::move(values), piece, found->n_components);
            }
            append(found->values, std::move(values));
        }
        std::erase_if(arrays, [&](const Array& array) {
            const bool is_missing = std::ranges::find(present, array.name) == present.end();
            if (is_missing) {
                m_host.log(ELVIS_LOG_WARNING,
                           m_file.path() + ": has no field '" + array.name + "', which other pieces have; left out");
            }
            return is_missing;
        });
    }

    static std::vector<double> kept_only(std::vector<double> values, const Piece& piece, std::size_t n) {
        std::size_t to = 0;
        for (std::size_t index = 0; index < piece.n_cells; ++index) {
            if (piece.is_kept[index]) {
                std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(index * n), n,
                            values.begin() + static_cast<std::ptrdiff_t>(to));
                to += n;
            }
        }
        values.resize(to);
        return values;
    }

    const XmlFile& m_file;
    Grid& m_grid;
    const elvis::api::Host& m_host;
    std::vector<CellKind> m_piece_kinds;
    std::size_t m_n_lower = 0;
};

} // namespace

std::size_t add_pieces(const XmlFile& file, Grid& grid, const elvis::api::Host& host) {
    GridReader reader(file, grid, host);
    reader.read();
    return reader.n_lower();
}

} // namespace elvis_vtk
