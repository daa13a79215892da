#include "field_file.hpp"

#include "../text/id_ranges.hpp"
#include "../text/number_text.hpp"
#include "../text/packed_data.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <map>
#include <stdexcept>

namespace nektarpp {

namespace {

constexpr int place_bits = 48;
constexpr std::size_t most_sets = 0xffff;
constexpr std::size_t most_fields = 4096;

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t first = 0; first <= text.size();) {
        const std::size_t last = std::min(text.find(separator, first), text.size());
        const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n", first), last);
        const std::size_t end = std::max(begin, text.find_last_not_of(" \t\r\n", last == 0 ? 0 : last - 1) + 1);
        parts.push_back(text.substr(begin, std::min(end, last) - begin));
        first = last + 1;
    }
    return parts;
}

Shape shape_of(const XmlFile& file, const pugi::xml_node& node) {
    const std::string name = file.attribute(node, "SHAPE");
    constexpr std::pair<const char*, Shape> shapes[] = {{"Triangle", Shape::triangle},
                                                        {"Quadrilateral", Shape::quadrilateral},
                                                        {"Tetrahedron", Shape::tetrahedron},
                                                        {"Pyramid", Shape::pyramid},
                                                        {"Prism", Shape::prism},
                                                        {"Hexahedron", Shape::hexahedron}};
    for (const auto& [known, shape] : shapes) {
        if (name == known) {
            return shape;
        }
    }
    if (name.find("Homogen") != std::string::npos) {
        file.fail(node, "SHAPE " + name +
                            ": homogeneous (Fourier) expansions are not supported; expand the field to three "
                            "dimensions with FieldConvert first");
    }
    file.fail(node, "SHAPE " + name + " is not supported");
}

/** Names of the factors for each shape, in the one family that a file may use. */
Basis basis_of(const XmlFile& file, const pugi::xml_node& node, Shape shape) {
    const std::vector<std::string> names = split(file.attribute(node, "BASIS"), ',');
    const auto is = [&](std::initializer_list<const char*> wanted) {
        return std::ranges::equal(names, std::vector<std::string>(wanted.begin(), wanted.end()));
    };
    const bool has_three = elvis::native::dimension(shape) == 3;
    if (shape == Shape::hexahedron || shape == Shape::quadrilateral) {
        constexpr std::pair<const char*, Basis> bases[] = {{"Modified_A", Basis::modified},
                                                           {"Ortho_A", Basis::orthogonal},
                                                           {"GLL_Lagrange", Basis::gll_lagrange},
                                                           {"Gauss_Lagrange", Basis::gauss_lagrange}};
        for (const auto& [name, basis] : bases) {
            if (has_three ? is({name, name, name}) : is({name, name})) {
                return basis;
            }
        }
    } else if (shape == Shape::triangle) {
        if (is({"Modified_A", "Modified_B"})) {
            return Basis::modified;
        }
        if (is({"Ortho_A", "Ortho_B"})) {
            return Basis::orthogonal;
        }
    } else if (shape == Shape::prism) {
        if (is({"Modified_A", "Modified_A", "Modified_B"})) {
            return Basis::modified;
        }
        if (is({"Ortho_A", "Ortho_A", "Ortho_B"})) {
            return Basis::orthogonal;
        }
    } else if (shape == Shape::tetrahedron) {
        if (is({"Modified_A", "Modified_B", "Modified_C"})) {
            return Basis::modified;
        }
        if (is({"Ortho_A", "Ortho_B", "Ortho_C"})) {
            return Basis::orthogonal;
        }
    } else {
        if (is({"Modified_A", "Modified_A", "ModifiedPyr_C"})) {
            return Basis::modified;
        }
        if (is({"Ortho_A", "Ortho_A", "OrthoPyr_C"})) {
            return Basis::orthogonal;
        }
        if (is({"Modified_A", "Modified_A", "Modified_C"})) {
            file.fail(node, "pyramids in the basis of Nektar++ 4 and older, which is not known");
        }
    }
    file.fail(node, std::string("BASIS ") + file.attribute(node, "BASIS") + " is not supported for this SHAPE");
}

/** NUMMODESPERDIR: one set of numbers for all elements, or one for each. */
class ModeNumbers {
public:
    ModeNumbers(const XmlFile& file, const pugi::xml_node& node, std::size_t dimension)
        : m_file(file), m_node(node), m_dimension(dimension) {
        const std::string text = file.attribute(node, "NUMMODESPERDIR");
        m_is_uniform = text.starts_with("UNIORDER:");
        if (!m_is_uniform && !text.starts_with("MIXORDER:")) {
            file.fail(node, "NUMMODESPERDIR begins with neither UNIORDER: nor MIXORDER:");
        }
        std::string list = text.substr(text.find(':') + 1);
        // Older versions end the list with a comma.
        while (!list.empty() && (list.back() == ',' || list.back() == ' ')) {
            list.pop_back();
        }
        for (const std::string& part : split(list, ',')) {
            std::uint32_t number = 0;
            const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
            if (error != std::errc() || end != part.data() + part.size()) {
                file.fail(node, "NUMMODESPERDIR: '" + part.substr(0, 20) + "' is no number of modes");
            }
            m_numbers.push_back(number);
        }
    }

    void check_count(std::size_t n_elements) const {
        const std::size_t n_sets = m_is_uniform ? 1 : n_elements;
        if (m_numbers.size() != n_sets * m_dimension) {
            m_file.fail(m_node, "NUMMODESPERDIR holds " + std::to_string(m_numbers.size()) + " numbers; expected are " +
                                    std::to_string(n_sets) + " times " + std::to_string(m_dimension));
        }
    }

    std::array<std::uint32_t, 3> of(std::size_t element) const {
        std::array<std::uint32_t, 3> numbers{1, 1, 1};
        const std::size_t first = m_is_uniform ? 0 : element * m_dimension;
        std::copy_n(m_numbers.begin() + static_cast<std::ptrdiff_t>(first), m_dimension, numbers.begin());
        return numbers;
    }

private:
    const XmlFile& m_file;
    pugi::xml_node m_node;
    std::size_t m_dimension;
    bool m_is_uniform = true;
    std::vector<std::uint32_t> m_numbers;
};

} // namespace

class FieldFile::Builder {
public:
    Builder(FieldFile& fields, const Mesh& mesh, FieldContent content) : m_target(fields), m_mesh(mesh), m_content(content) {}

    void read(const XmlFile& file) {
        read_time(file);
        for (const pugi::xml_node& node : file.root().children("ELEMENTS")) {
            read_block(file, node);
            m_has_blocks = true;
        }
    }

    bool has_blocks() const { return m_has_blocks; }

    void read_time(const XmlFile& file) {
        pugi::xml_node node = file.root().child("Metadata").child("Time");
        if (!node) {
            // Version 3.
            node = file.root().child("FIELDMETADATA").find_child_by_attribute("P", "PARAM", "Time");
        }
        if (node) {
            m_target.m_time = NumberText(file, node).real();
        }
    }

private:
    void read_block(const XmlFile& file, const pugi::xml_node& node) {
        if (node.attribute("HOMOGENEOUSLENGTHS")) {
            file.fail(node, "homogeneous (Fourier) expansions are not supported");
        }
        const Shape shape = shape_of(file, node);
        if (elvis::native::dimension(shape) != m_mesh.dimension()) {
            file.fail(node, "SHAPE " + std::string(file.attribute(node, "SHAPE")) + " in a mesh of dimension " +
                                std::to_string(m_mesh.dimension()));
        }
        const Basis basis = basis_of(file, node, shape);
        const std::vector<std::size_t> fields = fields_of(file, node);
        const std::vector<Mesh::Found> elements = elements_of(file, node, shape);
        const ModeNumbers numbers(file, node, static_cast<std::size_t>(m_mesh.dimension()));
        numbers.check_count(elements.size());
        std::vector<std::size_t> sets;
        std::map<std::array<std::uint32_t, 3>, std::size_t> known_sets;
        std::uint64_t per_field = 0;
        for (std::size_t index = 0; index < elements.size(); ++index) {
            const auto [known, is_new] = known_sets.try_emplace(numbers.of(index), 0u);
            if (is_new) {
                known->second = set_number(file, node, {shape, basis, known->first});
            }
            sets.push_back(known->second);
            per_field += m_target.m_sets[sets.back()].n_coefficients;
        }
        // Old files lack the attributes and are compressed all the same.
        file.is_compressed(node);
        std::uint64_t offset = m_target.m_coefficients.size();
        if (m_content == FieldContent::everything) {
            read_coefficients(file, node, per_field, fields.size(), elements.size());
        }
        for (const std::size_t field : fields) {
            for (std::size_t index = 0; index < elements.size(); ++index) {
                if (elements[index].number) {
                    Place& place = m_target.m_places[field][*elements[index].number];
                    if (place != no_place) {
                        file.fail(node, "field " + m_target.m_fields[field] + " has been given for the same elements before");
                    }
                    place = static_cast<Place>(sets[index]) << place_bits | offset;
                }
                offset += m_target.m_sets[sets[index]].n_coefficients;
            }
        }
    }

    void read_coefficients(const XmlFile& file, const pugi::xml_node& node, std::uint64_t per_field, std::size_t n_fields,
                           std::size_t n_elements) {
        const std::uint64_t expected = per_field * n_fields;
        const std::vector<std::uint64_t> words = unpack(file, node, expected);
        if (words.size() != expected) {
            file.fail(node, "the content holds " + std::to_string(words.size()) + " coefficients; " + std::to_string(n_fields) +
                                " fields in " + std::to_string(n_elements) + " elements have " + std::to_string(expected));
        }
        for (const std::uint64_t word : words) {
            m_target.m_coefficients.push_back(std::bit_cast<double>(word));
        }
    }

    std::vector<std::size_t> fields_of(const XmlFile& file, const pugi::xml_node& node) {
        std::vector<std::size_t> numbers;
        for (const std::string& name : split(file.attribute(node, "FIELDS"), ',')) {
            if (name.empty()) {
                file.fail(node, "FIELDS holds an empty name");
            }
            const auto found = std::ranges::find(m_target.m_fields, name);
            const auto number = static_cast<std::size_t>(found - m_target.m_fields.begin());
            if (found == m_target.m_fields.end()) {
                if (number == most_fields) {
                    file.fail(node, "more than " + std::to_string(most_fields) + " fields");
                }
                m_target.m_fields.push_back(name);
                m_target.m_places.emplace_back(m_mesh.elements().size(), no_place);
            }
            if (std::ranges::find(numbers, number) != numbers.end()) {
                file.fail(node, "FIELDS names " + name + " twice");
            }
            numbers.push_back(number);
        }
        return numbers;
    }

    /** Every id is known to the mesh, which bounds their number whatever the ranges say. */
    std::vector<Mesh::Found> elements_of(const XmlFile& file, const pugi::xml_node& node, Shape shape) const {
        std::vector<Mesh::Found> elements;
        std::int64_t previous = -1;
        std::vector<std::int64_t> ids;
        bool is_ascending = true;
        for (const IdRange& range : parse_ranges(file, node, file.attribute(node, "ID"))) {
            for (std::int64_t id = range.first; id <= range.last; ++id) {
                elements.push_back(m_mesh.find(shape, id));
                if (!elements.back().exists) {
                    file.fail(node, "element " + std::to_string(id) + " is no " + std::string(elvis::native::name(shape)) +
                                        " of the mesh " + m_mesh.path());
                }
                if (elements.size() > m_mesh.n_known()) {
                    file.fail(node, "ID names elements twice");
                }
                is_ascending = is_ascending && id > previous;
                previous = id;
                ids.push_back(id);
            }
        }
        if (!is_ascending) {
            std::ranges::sort(ids);
            if (std::ranges::adjacent_find(ids) != ids.end()) {
                file.fail(node, "ID names elements twice");
            }
        }
        return elements;
    }

    std::size_t set_number(const XmlFile& file, const pugi::xml_node& node, const ModeSet& modes) {
        const auto found = std::ranges::find(m_target.m_sets, modes, &KnownSet::modes);
        if (found != m_target.m_sets.end()) {
            return static_cast<std::size_t>(found - m_target.m_sets.begin());
        }
        try {
            check(modes);
        } catch (const std::invalid_argument& error) {
            file.fail(node, error.what());
        }
        if (m_target.m_sets.size() == most_sets) {
            file.fail(node, "more than " + std::to_string(most_sets) + " different numbers of modes");
        }
        m_target.m_sets.push_back({modes, n_modes(modes)});
        return m_target.m_sets.size() - 1;
    }

    FieldFile& m_target;
    const Mesh& m_mesh;
    FieldContent m_content;
    bool m_has_blocks = false;
};

FieldFile::FieldFile(const FieldPaths& paths, const Mesh& mesh, FieldContent content) {
    Builder builder(*this, mesh, content);
    if (!paths.info.empty()) {
        builder.read_time(XmlFile(paths.info));
    }
    for (const std::string& part : paths.parts) {
        builder.read(XmlFile(part));
    }
    if (!builder.has_blocks()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, paths.path, "holds no fields: there is no ELEMENTS in it");
    }
}

const ModeSet* FieldFile::modes(std::size_t field, std::uint64_t element) const {
    const Place place = m_places[field][element];
    return place == no_place ? nullptr : &m_sets[place >> place_bits].modes;
}

std::span<const double> FieldFile::coefficients(std::size_t field, std::uint64_t element) const {
    const Place place = m_places[field][element];
    return {m_coefficients.data() + (place & ((Place{1} << place_bits) - 1)), m_sets[place >> place_bits].n_coefficients};
}

} // namespace nektarpp
