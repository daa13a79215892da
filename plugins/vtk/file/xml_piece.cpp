#include "xml_piece.hpp"

#include "data_array.hpp"

namespace elvis_vtk {

namespace {

pugi::xml_node find_array(pugi::xml_node parent, const std::string& name) {
    for (const pugi::xml_node array : parent.children("DataArray")) {
        if (name == array.attribute("Name").as_string()) {
            return array;
        }
    }
    return {};
}

/** n * factor, both of the file; a failure instead of an overflow. */
std::size_t times(const XmlFile& file, pugi::xml_node node, std::size_t n, std::size_t factor) {
    if (n > (std::size_t(1) << 46) / factor) {
        file.fail(node, "announces " + std::to_string(n) + " points or cells");
    }
    return n * factor;
}

} // namespace

XmlPiece::XmlPiece(const XmlFile& file, pugi::xml_node node)
    : Piece(file.count(node, "NumberOfPoints"), file.count(node, "NumberOfCells")), m_file(file), m_node(node) {}

Numbers XmlPiece::points() const {
    const pugi::xml_node array = m_file.child(m_file.child(m_node, "Points"), "DataArray");
    if (n_components(m_file, array) != 3) {
        m_file.fail(array, "points need 3 components");
    }
    return read_numbers(m_file, array, times(m_file, m_node, n_points(), 3));
}

PieceCells XmlPiece::cells() const {
    const pugi::xml_node cells = m_file.child(m_node, "Cells");
    const auto integers = [&](const char* name) {
        const pugi::xml_node array = find_array(cells, name);
        if (!array) {
            m_file.fail(cells, "has no array '" + std::string(name) + "'");
        }
        return read_integers(m_file, array);
    };
    PieceCells read{integers("connectivity"), integers("offsets"), integers("types")};
    if (read.ends.size() != n_cells() || read.types.size() != n_cells()) {
        m_file.fail(cells, std::to_string(read.ends.size()) + " offsets and " + std::to_string(read.types.size()) +
                               " types for " + std::to_string(n_cells()) + " cells");
    }
    return read;
}

std::vector<FieldArray> XmlPiece::arrays(Section section) const {
    std::vector<FieldArray> found;
    for (const pugi::xml_node array : child(section).children("DataArray")) {
        if (is_numeric(array)) {
            found.push_back({array.attribute("Name").as_string(), n_components(m_file, array)});
        }
    }
    return found;
}

std::string XmlPiece::named_by(Section section, const char* attribute) const {
    return child(section).attribute(attribute).as_string();
}

std::uint32_t XmlPiece::mantissa_bits(Section section, const FieldArray& array) const {
    const pugi::xml_node node = find_array(child(section), array.name);
    // Text tells its precision by its digits.
    return is_text(node) ? read(section, array).mantissa_bits : mantissa_bits_of_type(node);
}

std::vector<double> XmlPiece::values(Section section, const FieldArray& array) const { return read(section, array).values; }

void XmlPiece::fail(Section section, const std::string& what) const {
    const pugi::xml_node node = child(section);
    m_file.fail(node ? node : m_node, what);
}

pugi::xml_node XmlPiece::child(Section section) const {
    constexpr const char* names[] = {"Points", "Cells", "PointData", "CellData"};
    return m_node.child(names[static_cast<std::size_t>(section)]);
}

Numbers XmlPiece::read(Section section, const FieldArray& array) const {
    const pugi::xml_node node = find_array(child(section), array.name);
    if (!node || n_components(m_file, node) != array.n_components) {
        fail(section, "has no array '" + array.name + "' of " + std::to_string(array.n_components) + " components");
    }
    const std::size_t n = section == Section::point_data ? n_points() : n_cells();
    return read_numbers(m_file, node, times(m_file, node, n, array.n_components));
}

std::optional<double> visit_xml_pieces(const std::string& path, const std::function<void(const Piece&)>& visit) {
    const XmlFile file(path);
    if (file.type() != "UnstructuredGrid") {
        file.fail(file.root(), "type is '" + file.type() + "', not UnstructuredGrid");
    }
    const pugi::xml_node root = file.child(file.root(), "UnstructuredGrid");
    if (!root.child("Piece")) {
        file.fail(root, "has no element Piece");
    }
    for (const pugi::xml_node node : root.children("Piece")) {
        const XmlPiece piece(file, node);
        if (piece.n_cells() > 0) {
            visit(piece);
        }
    }
    const pugi::xml_node time = find_array(root.child("FieldData"), "TimeValue");
    return time && is_numeric(time) ? std::optional(read_numbers(file, time, 1).values.front()) : std::nullopt;
}

} // namespace elvis_vtk
