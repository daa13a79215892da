#include "file.hpp"

#include <text/lines.hpp>

#include <set>

namespace elvis::cut_cells {

namespace {

using text::Lines;

constexpr const char* header = "cut-cells";
/** In one direction: numbers of elements stay below the host's. */
constexpr std::size_t max_cells = 1000;

/** Reads statement after statement. */
class Reader {
public:
    explicit Reader(const std::string& path) : m_path(path), m_lines(path) { m_lines.header(header); }

    File read() {
        while (m_lines.next()) {
            const std::string keyword = m_lines.word("a keyword");
            if (keyword == "grid") {
                read_grid();
            } else if (keyword == "level") {
                m_file.level_order = m_lines.count("the order of the level set", 1, max_order);
            } else if (keyword == "field") {
                read_field();
            } else if (keyword == "whole" || keyword == "cut") {
                read_cell(keyword == "cut");
            } else if (keyword == "modes") {
                read_modes();
            } else {
                m_lines.fail("unknown keyword '" + keyword + "'; known are grid, level, field, whole, cut and modes");
            }
            m_lines.end();
        }
        check_complete();
        return std::move(m_file);
    }

private:
    void read_grid() {
        if (m_file.n_cells[0] > 0) {
            m_lines.fail("there is a grid above");
        }
        for (std::array<double, 3>* corner : {&m_file.lower, &m_file.upper}) {
            for (double& coordinate : *corner) {
                coordinate = m_lines.number<double>("coordinate");
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(m_file.lower[axis] < m_file.upper[axis])) {
                m_lines.fail("the grid's upper corner lies above the lower one in every direction");
            }
            m_file.n_cells[axis] = m_lines.count("the number of cells", 1, max_cells);
        }
    }

    void read_field() {
        if (!m_file.cells.empty()) {
            m_lines.fail("fields come before the first cell");
        }
        Field field;
        field.name = m_lines.new_name("field", m_file.fields);
        if (field.name == "level_set") {
            m_lines.fail("the field 'level_set' is there of itself");
        }
        field.n_components = static_cast<std::uint32_t>(m_lines.count("the number of components", 1, 16));
        field.order = m_lines.count("the order", 0, max_order);
        field.unit = m_lines.at_end() ? "" : m_lines.word("the unit");
        m_file.fields.push_back(field);
    }

    void read_cell(bool is_cut) {
        if (m_file.n_cells[0] == 0 || (is_cut && m_file.level_order == 0)) {
            m_lines.fail("the grid and the level set's order come before the first cell");
        }
        Cell cell;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell.place[axis] = m_lines.count("the cell's place", 0, m_file.n_cells[axis] - 1);
        }
        if (!m_places.insert(cell.place).second) {
            m_lines.fail("there is a cell at this place above");
        }
        if (is_cut) {
            cell.level = read_numbers(n_modes(m_file.level_order));
        }
        cell.modes.resize(m_file.fields.size());
        m_file.cells.push_back(std::move(cell));
    }

    void read_modes() {
        const std::size_t index = m_lines.known_name("field", m_file.fields);
        const Field& field = m_file.fields[index];
        if (m_file.cells.empty()) {
            m_lines.fail("modes before any cell");
        }
        const std::size_t cell = m_lines.count("the cell", 0, m_file.cells.size() - 1);
        std::vector<double>& modes = m_file.cells[cell].modes[index];
        if (!modes.empty()) {
            m_lines.fail("the modes of field '" + field.name + "' in cell " + std::to_string(cell) + " stand above");
        }
        modes = read_numbers(field.n_components * n_modes(field.order));
    }

    std::vector<double> read_numbers(std::size_t count) {
        std::vector<double> numbers(count);
        for (double& number : numbers) {
            number = m_lines.number<double>("coefficient");
        }
        return numbers;
    }

    void check_complete() const {
        if (m_file.cells.empty()) {
            throw api::Error(ELVIS_ERROR_FORMAT, m_path, "there is no cell");
        }
        for (std::size_t cell = 0; cell < m_file.cells.size(); ++cell) {
            for (std::size_t field = 0; field < m_file.fields.size(); ++field) {
                if (m_file.cells[cell].modes[field].empty()) {
                    throw api::Error(ELVIS_ERROR_FORMAT, m_path,
                                     "there are no modes of field '" + m_file.fields[field].name + "' in cell " +
                                         std::to_string(cell));
                }
            }
        }
    }

    std::string m_path;
    Lines m_lines;
    File m_file;
    std::set<std::array<std::size_t, 3>> m_places;
};

} // namespace

bool has_our_header(const char* path) { return text::begins_with(path, header); }

File read_file(const std::string& path) { return Reader(path).read(); }

} // namespace elvis::cut_cells
