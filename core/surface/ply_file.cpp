// PLY: a header in text that lists elements with properties, then the data as text or binary, in either byte order. Read are x,
// y, z of "vertex" and the list "vertex_indices" (or "vertex_index") of "face"; all else is skipped.
#include <core/base/vector3.hpp>
#include <core/surface/mesh_cursor.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace elvis {

namespace {

enum class Format { text, little, big };

struct NumberType {
    std::size_t bytes = 0;
    bool is_signed = false, is_real = false;
};

std::optional<NumberType> type_of(std::string_view name) {
    if (name == "char" || name == "int8")
        return NumberType{1, true, false};
    if (name == "uchar" || name == "uint8")
        return NumberType{1, false, false};
    if (name == "short" || name == "int16")
        return NumberType{2, true, false};
    if (name == "ushort" || name == "uint16")
        return NumberType{2, false, false};
    if (name == "int" || name == "int32")
        return NumberType{4, true, false};
    if (name == "uint" || name == "uint32")
        return NumberType{4, false, false};
    if (name == "float" || name == "float32")
        return NumberType{4, true, true};
    if (name == "double" || name == "float64")
        return NumberType{8, true, true};
    return std::nullopt;
}

struct Property {
    std::string name;
    NumberType type;
    /** Of the number of entries, where it is a list. */
    std::optional<NumberType> count_type;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Format format = Format::text;
    std::vector<Element> elements;
};

NumberType checked_type(const MeshCursor& cursor, std::string_view name) {
    const auto type = type_of(name);
    if (!type) {
        cursor.fail("'" + std::string(name.substr(0, 40)) + "' is no type of number");
    }
    return *type;
}

Property read_property(const MeshCursor& cursor, const std::vector<std::string_view>& words) {
    if (words.size() == 5 && words[1] == "list") {
        const NumberType count = checked_type(cursor, words[2]);
        if (count.is_real) {
            cursor.fail("the length of a list must be a whole number");
        }
        return {std::string(words[4]), checked_type(cursor, words[3]), count};
    }
    if (words.size() != 3) {
        cursor.fail("a property is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    return {std::string(words[2]), checked_type(cursor, words[1]), std::nullopt};
}

Header read_header(MeshCursor& cursor) {
    Header header;
    bool has_format = false;
    auto line = cursor.line();
    if (!line || *line != "ply") {
        cursor.fail("is no PLY file: its first line is not 'ply'");
    }
    while ((line = cursor.line())) {
        const std::vector<std::string_view> words = words_of(*line);
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
            continue;
        }
        if (words[0] == "end_header") {
            if (!has_format) {
                cursor.fail("the header has no line 'format'");
            }
            return header;
        }
        if (words[0] == "format") {
            const std::string_view name = words.size() > 1 ? words[1] : std::string_view();
            has_format = name == "ascii" || name == "binary_little_endian" || name == "binary_big_endian";
            if (!has_format) {
                cursor.fail("the format is none of ascii, binary_little_endian, binary_big_endian");
            }
            header.format = name == "ascii" ? Format::text : name == "binary_little_endian" ? Format::little : Format::big;
        } else if (words[0] == "element" && words.size() == 3) {
            const std::int64_t count = cursor.integer(words[2]);
            if (count < 0) {
                cursor.fail("the number of elements is negative");
            }
            header.elements.push_back({std::string(words[1]), static_cast<std::uint64_t>(count), {}});
        } else if (words[0] == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(read_property(cursor, words));
        } else {
            cursor.fail("is no line of a PLY header");
        }
    }
    cursor.fail("the file ends within its header");
}

/** Reads one number after the other. */
class Numbers {
public:
    Numbers(MeshCursor& cursor, Format format) : m_cursor(cursor), m_format(format) {}

    double next(const NumberType& type) {
        if (m_format == Format::text) {
            return m_cursor.number(m_cursor.word());
        }
        const std::span<const char> bytes = m_cursor.bytes(type.bytes);
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t from_low = m_format == Format::little ? i : type.bytes - 1 - i;
            word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * from_low);
        }
        if (type.is_real) {
            return type.bytes == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(word)))
                                   : std::bit_cast<double>(word);
        }
        const auto whole = static_cast<double>(word);
        const bool is_negative = type.is_signed && ((word >> (8 * type.bytes - 1)) & 1u) != 0;
        return is_negative ? whole - std::ldexp(1.0, static_cast<int>(8 * type.bytes)) : whole;
    }

    std::size_t count(const NumberType& type) {
        const double number = next(type);
        // Each entry takes a byte at least.
        if (!(number >= 0 && number <= static_cast<double>(m_cursor.n_left())) || number != std::floor(number)) {
            fail("a list of length " + std::to_string(number) + " cannot be in the rest of the file");
        }
        return static_cast<std::size_t>(number);
    }

    [[noreturn]] void fail(const std::string& cause) const {
        if (m_format == Format::text) {
            m_cursor.fail(cause);
        }
        m_cursor.fail_at_byte(cause);
    }

private:
    MeshCursor& m_cursor;
    Format m_format;
};

bool is_corner_list(const Property& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

int axis_of(const Property& property) {
    return property.count_type ? -1 : property.name == "x" ? 0 : property.name == "y" ? 1 : property.name == "z" ? 2 : -1;
}

void check_header(const MeshCursor& cursor, const Header& header) {
    const auto find = [&](const char* name) {
        const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                        [name](const Element& element) { return element.name == name; });
        if (found == header.elements.end()) {
            cursor.fail(std::string("there is no element '") + name + "'");
        }
        return found;
    };
    const auto vertices = find("vertex"), faces = find("face");
    std::array<int, 3> n_axes{};
    for (const Property& property : vertices->properties) {
        if (axis_of(property) >= 0) {
            ++n_axes[static_cast<std::size_t>(axis_of(property))];
        }
    }
    if (n_axes != std::array<int, 3>{1, 1, 1}) {
        cursor.fail("the element 'vertex' needs x, y and z, each once");
    }
    if (std::count_if(faces->properties.begin(), faces->properties.end(), is_corner_list) != 1) {
        cursor.fail("the element 'face' needs a list 'vertex_indices'");
    }
    if (faces < vertices) {
        cursor.fail("the element 'face' stands before 'vertex', which is not read");
    }
}

} // namespace

TriangleMesh read_ply(const std::string& path, std::string_view text) {
    MeshCursor cursor(path, text);
    const Header header = read_header(cursor);
    check_header(cursor, header);
    MeshBuilder builder(cursor);
    Numbers numbers(cursor, header.format);
    for (const Element& element : header.elements) {
        const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
        // Without properties there is nothing to read, however many there are.
        const std::uint64_t count = element.properties.empty() ? 0 : element.count;
        for (std::uint64_t i = 0; i < count; ++i) {
            Vector3 point{};
            std::vector<std::uint32_t> corners;
            for (const Property& property : element.properties) {
                const std::size_t n = property.count_type ? numbers.count(*property.count_type) : 1;
                const bool are_corners = is_face && is_corner_list(property);
                for (std::size_t k = 0; k < n; ++k) {
                    const double number = numbers.next(property.type);
                    if (is_vertex && axis_of(property) >= 0) {
                        point[static_cast<std::size_t>(axis_of(property))] = number;
                    }
                    if (are_corners) {
                        if (!(number >= 0 && number < static_cast<double>(builder.mesh.points.size())) ||
                            number != std::floor(number)) {
                            numbers.fail("face " + std::to_string(i) + " names point " + std::to_string(number) +
                                         "; there are " + std::to_string(builder.mesh.points.size()));
                        }
                        corners.push_back(static_cast<std::uint32_t>(number));
                    }
                }
                if (are_corners && n < 3) {
                    numbers.fail("face " + std::to_string(i) + " has fewer than three points");
                }
            }
            if (is_vertex) {
                if (const auto fault = MeshBuilder::fault_of(point)) {
                    numbers.fail("point " + std::to_string(i) + ": " + *fault);
                }
                builder.add_point(point);
            } else if (is_face) {
                builder.add_polygon(corners);
            }
        }
    }
    return std::move(builder.mesh);
}

} // namespace elvis
