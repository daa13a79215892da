#include "grid_piece.hpp"

#include "grid_fields.hpp"

#include <algorithm>
#include <cmath>

namespace elvis_vtk {

namespace {

/** Ghost flags of vtkDataSetAttributes: a cell that another piece owns, a cell that is hidden. */
constexpr int ghost_duplicate = 1, ghost_hidden = 32;

/** A flag or degree that was read as a number; -1 for what is neither. */
int small_integer(double number) { return number >= 0 && number <= 1000 ? static_cast<int>(number) : -1; }

/** Adds one piece. */
class PieceReader {
public:
    PieceReader(const Piece& piece, Grid& grid, const elvis::api::Host& host)
        : m_piece(piece), m_grid(grid), m_host(host), m_first_point(grid.points.size() / 3), m_first_cell(grid.cells.size()) {}

    void read() {
        const bool is_first = m_grid.n_pieces++ == 0;
        Numbers points = m_piece.points();
        m_grid.mantissa_bits = std::min(m_grid.mantissa_bits, points.mantissa_bits);
        append(m_grid.points, std::move(points.values));
        read_weights(is_first);
        read_cells();
        add_fields(m_piece, Section::point_data, m_grid, m_host);
        add_fields(m_piece, Section::cell_data, m_grid, m_host);
        m_grid.n_source_cells += m_piece.n_cells();
    }

    /** Cells that were left out because they are neither surfaces nor volumes. */
    std::size_t n_lower() const { return m_n_lower; }

private:
    void read_weights(bool is_first) {
        const std::string name = m_piece.named_by(Section::point_data, "RationalWeights");
        if (name.empty() != m_grid.weights.empty() && !is_first) {
            m_piece.fail(Section::point_data, "some pieces have RationalWeights and others have not");
        }
        if (name.empty()) {
            return;
        }
        append(m_grid.weights, values_of(Section::point_data, name, 1, "RationalWeights"));
        m_grid.mantissa_bits = std::min(m_grid.mantissa_bits, m_piece.mantissa_bits(Section::point_data, {name, 1}));
        for (const double weight : m_grid.weights) {
            if (!(weight > 0) || !std::isfinite(weight)) {
                m_piece.fail(Section::point_data, "a weight in '" + name + "' is not positive");
            }
        }
    }

    /** Of an array that an attribute names. */
    std::vector<double> values_of(Section section, const std::string& name, std::uint32_t n_components,
                                  const std::string& attribute) {
        const std::vector<FieldArray> arrays = m_piece.arrays(section);
        const auto found = std::ranges::find(arrays, name, &FieldArray::name);
        if (found == arrays.end() || found->n_components != n_components) {
            m_piece.fail(section,
                         "has no array '" + name + "' of " + std::to_string(n_components) + " components, its " + attribute);
        }
        return m_piece.values(section, *found);
    }

    void read_cells() {
        const PieceCells cells = m_piece.cells();
        const std::vector<double> ghosts = read_ghosts(), degrees = read_degrees();
        const std::size_t first_connection = m_grid.connectivity.size();
        std::int64_t begin = 0;
        for (std::size_t index = 0; index < m_piece.n_cells(); ++index) {
            const std::int64_t end = cells.ends[index];
            if (end < begin || end > static_cast<std::int64_t>(cells.connectivity.size())) {
                fail("offset " + std::to_string(end) + " of cell " + std::to_string(index) +
                     " is below the one before or beyond the " + std::to_string(cells.connectivity.size()) +
                     " entries of connectivity");
            }
            const std::span points(cells.connectivity.data() + begin, static_cast<std::size_t>(end - begin));
            begin = end;
            if (!ghosts.empty() && (small_integer(ghosts[index]) & (ghost_duplicate | ghost_hidden)) != 0) {
                continue;
            }
            std::array<int, 3> degree{};
            for (std::size_t i = 0; i < 3 && !degrees.empty(); ++i) {
                degree[i] = small_integer(degrees[3 * index + i]);
            }
            if (cells.types[index] < 0 || cells.types[index] > 255) {
                fail("cell " + std::to_string(index) + " has type " + std::to_string(cells.types[index]));
            }
            add_cell(index, static_cast<int>(cells.types[index]), points, degree);
        }
        const std::string notes =
            unify_node_order(m_grid.points, m_grid.connectivity, std::span(m_grid.cells).subspan(m_first_cell), m_kinds,
                             m_piece.declares_old_hexahedra());
        if (!notes.empty()) {
            m_host.log(ELVIS_LOG_INFO, m_piece.path() + ": " + notes + "told by the positions of the points");
        }
        mark_rational(first_connection);
        adopt_kinds();
    }

    void fail(const std::string& what) const { m_piece.fail(Section::cells, what); }

    void add_cell(std::size_t index, int type, std::span<const std::int64_t> points, const std::array<int, 3>& degree) {
        if (is_less_than_surface(type)) {
            ++m_n_lower;
            return;
        }
        const int plain_type = type == type_pixel ? type_quad : type == type_voxel ? type_hexahedron : type;
        CellKind kind;
        try {
            kind = kind_of(plain_type, points.size(), degree);
        } catch (const UnsupportedCell& error) {
            fail("cell " + std::to_string(index) + " is " + error.what());
        }
        auto found = std::ranges::find(m_kinds, kind);
        if (found == m_kinds.end()) {
            m_kinds.push_back(kind);
            found = m_kinds.end() - 1;
        }
        const std::size_t first = m_grid.connectivity.size();
        for (const std::int64_t point : points) {
            if (point < 0 || static_cast<std::size_t>(point) >= m_piece.n_points()) {
                fail("cell " + std::to_string(index) + " has point " + std::to_string(point) + " of " +
                     std::to_string(m_piece.n_points()));
            }
            const std::size_t in_grid = m_first_point + static_cast<std::size_t>(point);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!std::isfinite(m_grid.points[3 * in_grid + axis])) {
                    fail("point " + std::to_string(point) + " of cell " + std::to_string(index) + " is not finite");
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
        m_grid.cells.push_back({first, static_cast<std::uint32_t>(found - m_kinds.begin()), m_grid.n_source_cells + index});
    }

    /** Cells of Bezier kinds with unequal weights become cells of a rational kind. */
    void mark_rational(std::size_t first_connection) {
        if (m_grid.weights.empty() || first_connection == m_grid.connectivity.size()) {
            return;
        }
        for (std::size_t index = m_first_cell; index < m_grid.cells.size(); ++index) {
            Cell& cell = m_grid.cells[index];
            CellKind kind = m_kinds[cell.kind];
            if (!kind.is_bezier) {
                continue;
            }
            const auto weight = [&](std::size_t node) {
                return m_grid.weights[static_cast<std::size_t>(m_grid.connectivity[cell.first + node])];
            };
            for (std::size_t node = 1; node < n_nodes(kind); ++node) {
                kind.is_rational = kind.is_rational || weight(node) != weight(0);
            }
            auto found = std::ranges::find(m_kinds, kind);
            if (found == m_kinds.end()) {
                m_kinds.push_back(kind);
                found = m_kinds.end() - 1;
            }
            cell.kind = static_cast<std::uint32_t>(found - m_kinds.begin());
        }
    }

    /** From the piece's numbers of kinds to the grid's. */
    void adopt_kinds() {
        std::vector<std::uint32_t> number_of;
        for (const CellKind& kind : m_kinds) {
            auto found = std::ranges::find(m_grid.kinds, kind);
            if (found == m_grid.kinds.end()) {
                m_grid.kinds.push_back(kind);
                found = m_grid.kinds.end() - 1;
            }
            number_of.push_back(static_cast<std::uint32_t>(found - m_grid.kinds.begin()));
        }
        for (std::size_t index = m_first_cell; index < m_grid.cells.size(); ++index) {
            m_grid.cells[index].kind = number_of[m_grid.cells[index].kind];
        }
    }

    std::vector<double> read_ghosts() const {
        const std::vector<FieldArray> arrays = m_piece.arrays(Section::cell_data);
        const auto found = std::ranges::find(arrays, "vtkGhostType", &FieldArray::name);
        if (found == arrays.end()) {
            return {};
        }
        if (found->n_components != 1) {
            m_piece.fail(Section::cell_data, "vtkGhostType has more than one component");
        }
        return m_piece.values(Section::cell_data, *found);
    }

    std::vector<double> read_degrees() {
        const std::string name = m_piece.named_by(Section::cell_data, "HigherOrderDegrees");
        return name.empty() ? std::vector<double>{} : values_of(Section::cell_data, name, 3, "HigherOrderDegrees");
    }

    const Piece& m_piece;
    Grid& m_grid;
    const elvis::api::Host& m_host;
    /** Index of the piece's first point and cell in the grid. */
    std::size_t m_first_point;
    std::size_t m_first_cell;
    /** Kinds of the piece's cells, numbered as its cells are until it is read. */
    std::vector<CellKind> m_kinds;
    std::size_t m_n_lower = 0;
};

} // namespace

std::size_t add_piece(const Piece& piece, Grid& grid, const elvis::api::Host& host) {
    PieceReader reader(piece, grid, host);
    reader.read();
    return reader.n_lower();
}

} // namespace elvis_vtk
