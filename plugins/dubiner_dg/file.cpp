#include "file.hpp"

#include <text/lines.hpp>

#include <algorithm>

namespace elvis::dubiner {

namespace {

using text::Lines;

constexpr const char* header = "dubiner-dg";

/** Reads statement after statement. */
class Reader {
public:
    explicit Reader(const std::string& path) : m_path(path), m_lines(path) { m_lines.header(header); }

    File read() {
        while (m_lines.next()) {
            const std::string keyword = m_lines.word("a keyword");
            if (keyword == "field") {
                read_field();
            } else if (keyword == "element") {
                read_element();
            } else if (keyword == "boundary") {
                read_boundary();
            } else if (keyword == "time") {
                read_time();
            } else if (keyword == "modes") {
                read_modes();
            } else {
                m_lines.fail("unknown keyword '" + keyword + "'; known are field, element, boundary, time and modes");
            }
            m_lines.end();
        }
        check_complete();
        return std::move(m_file);
    }

private:
    void read_field() {
        if (!m_file.times.empty()) {
            m_lines.fail("fields come before the first time");
        }
        Field field;
        field.name = m_lines.new_name("field", m_file.fields);
        field.n_components = static_cast<std::uint32_t>(m_lines.count("the number of components", 1, 16));
        field.unit = m_lines.at_end() ? "" : m_lines.word("the unit");
        m_file.fields.push_back(field);
    }

    void read_element() {
        if (!m_file.times.empty()) {
            m_lines.fail("elements come before the first time");
        }
        Element element;
        element.order = m_lines.count("the order", 0, max_order);
        element.geometry_order = m_lines.count("the order of the geometry", 1, max_order);
        for (std::int64_t& vertex : element.vertices) {
            vertex = m_lines.number<std::int64_t>("vertex number");
        }
        std::array<std::int64_t, 4> sorted = element.vertices;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
            m_lines.fail("an element has four different vertices");
        }
        element.nodes.resize(n_modes(element.geometry_order));
        for (Point& node : element.nodes) {
            for (double& coordinate : node) {
                coordinate = m_lines.number<double>("coordinate");
            }
        }
        m_file.elements.push_back(std::move(element));
    }

    void read_boundary() {
        const std::string name = m_lines.word("the group's name");
        const auto found = std::find(m_file.groups.begin(), m_file.groups.end(), name);
        BoundaryFace face;
        face.group = static_cast<std::size_t>(found - m_file.groups.begin());
        if (found == m_file.groups.end()) {
            m_file.groups.push_back(name);
        }
        for (std::int64_t& vertex : face.vertices) {
            vertex = m_lines.number<std::int64_t>("vertex number");
        }
        std::sort(face.vertices.begin(), face.vertices.end());
        m_file.boundary.push_back(face);
    }

    void read_time() {
        const double time = m_lines.number<double>("time");
        if (!m_file.times.empty() && !(time > m_file.times.back())) {
            m_lines.fail("times ascend");
        }
        check_complete();
        m_file.times.push_back(time);
        m_file.coefficients.emplace_back(m_file.fields.size(), std::vector<std::vector<double>>(m_file.elements.size()));
    }

    void read_modes() {
        if (m_file.times.empty()) {
            m_lines.fail("modes before any time");
        }
        const std::size_t index = m_lines.known_name("field", m_file.fields);
        const Field& field = m_file.fields[index];
        if (m_file.elements.empty()) {
            m_lines.fail("modes before any element");
        }
        const std::size_t element = m_lines.count("the element", 0, m_file.elements.size() - 1);
        auto& of_field = m_file.coefficients.back()[index];
        std::vector<double>& coefficients = of_field[element];
        if (!coefficients.empty()) {
            m_lines.fail("the modes of field '" + field.name + "' in element " + std::to_string(element) + " stand above");
        }
        coefficients.resize(field.n_components * n_modes(m_file.elements[element].order));
        for (double& coefficient : coefficients) {
            coefficient = m_lines.number<double>("coefficient");
        }
    }

    /** That the newest time step has modes of every field in every element. */
    void check_complete() const {
        if (m_file.times.empty()) {
            return;
        }
        for (std::size_t field = 0; field < m_file.fields.size(); ++field) {
            const auto& of_field = m_file.coefficients.back()[field];
            const auto missing =
                std::find_if(of_field.begin(), of_field.end(), [](const auto& modes) { return modes.empty(); });
            if (missing != of_field.end()) {
                throw api::Error(ELVIS_ERROR_FORMAT, m_path,
                                 "time " + std::to_string(m_file.times.back()) + " lacks modes of field '" +
                                     m_file.fields[field].name + "' in element " + std::to_string(missing - of_field.begin()));
            }
        }
    }

    std::string m_path;
    Lines m_lines;
    File m_file;
};

} // namespace

bool has_our_header(const char* path) { return text::begins_with(path, header); }

File read_file(const std::string& path) {
    File file = Reader(path).read();
    if (file.elements.empty() || file.fields.empty() || file.times.empty()) {
        throw api::Error(ELVIS_ERROR_FORMAT, path,
                         std::string("there is no ") + (file.elements.empty() ? "element"
                                                        : file.fields.empty() ? "field"
                                                                              : "time"));
    }
    return file;
}

} // namespace elvis::dubiner
