#include "nektar_writer.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <zlib.h>

namespace nektar_writer {

namespace {

namespace native = elvis::native;

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string base64(std::vector<unsigned char> bytes) {
    bytes.resize((bytes.size() + 2) / 3 * 3);
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const unsigned bits =
            static_cast<unsigned>(bytes[at]) << 16 | static_cast<unsigned>(bytes[at + 1]) << 8 | bytes[at + 2];
        for (const int shift : {18, 12, 6, 0}) {
            text += digits[bits >> shift & 63u];
        }
    }
    return text;
}

Point between(const std::vector<Point>& corners, double s, double t) {
    const std::vector<double> weights = corners.size() == 3 ? std::vector<double>{-(s + t) / 2, (1 + s) / 2, (1 + t) / 2}
                                                            : std::vector<double>{(1 - s) * (1 - t) / 4, (1 + s) * (1 - t) / 4,
                                                                                  (1 + s) * (1 + t) / 4, (1 - s) * (1 + t) / 4};
    Point x{};
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            x[axis] += weights[corner] * corners[corner][axis];
        }
    }
    return x;
}

std::vector<double> line(const std::string& type, int n) {
    std::vector<double> z(static_cast<std::size_t>(n));
    if (type == "GaussLobattoLegendre") {
        native::gauss_lobatto_legendre(z);
        return z;
    }
    for (int k = 0; k < n; ++k) {
        z[static_cast<std::size_t>(k)] = -1 + 2.0 * k / (n - 1);
    }
    return z;
}

/** Evenly spaced for any n; the others for n = 4 only, where both are Gauss-Lobatto on the edges and the centre. */
std::vector<std::array<double, 2>> triangle(const std::string& type, int n) {
    if (type != "NodalTriEvenlySpaced" && n != 4) {
        throw std::logic_error("no such points here");
    }
    const std::vector<double> z = line(type == "NodalTriEvenlySpaced" ? "PolyEvenlySpaced" : "GaussLobattoLegendre", n);
    std::vector<std::array<double, 2>> points{{-1, -1}, {1, -1}, {-1, 1}};
    for (int edge = 0; edge < 3; ++edge) {
        for (int k = 1; k + 1 < n; ++k) {
            const double up = z[static_cast<std::size_t>(k)];
            points.push_back(edge == 0   ? std::array<double, 2>{up, -1}
                             : edge == 1 ? std::array<double, 2>{-up, up}
                                         : std::array<double, 2>{-1, -up});
        }
    }
    for (int row = 1; row + 2 < n; ++row) {
        for (int k = 1; k + row + 1 < n; ++k) {
            points.push_back({-1 + 2.0 * k / (n - 1), -1 + 2.0 * row / (n - 1)});
        }
    }
    return points;
}

class Writer {
public:
    explicit Writer(const Element& element) : m_element(element), m_dimension(native::dimension(element.shape)) {
        for (int corner = 0; corner < native::n_corners(element.shape); ++corner) {
            m_corners.push_back(native::corner(element.shape, corner));
        }
        if (m_dimension == 2) {
            std::vector<int> corners(m_corners.size());
            for (std::size_t corner = 0; corner < corners.size(); ++corner) {
                corners[corner] = static_cast<int>(corner);
            }
            add_face(corners);
            return;
        }
        for (int face = 0; face < native::n_faces(element.shape); ++face) {
            const auto corners = native::face_corners(element.shape, face);
            add_face(turned({corners.begin(), corners.end()}));
        }
    }

    std::string text() {
        std::ostringstream out;
        out.precision(17);
        out << "<?xml version=\"1.0\"?>\n<NEKTAR>\n<GEOMETRY DIM=\"" << m_dimension << "\" SPACE=\"" << m_dimension << "\">\n";
        write_vertices(out);
        out << "<EDGE" << attributes() << ">";
        for (std::size_t edge = 0; edge < m_edges.size(); ++edge) {
            record(out, "E", id_of_edge(edge), {vertex_id(m_edges[edge].first), vertex_id(m_edges[edge].second)});
        }
        out << flush() << "</EDGE>\n";
        write_faces_and_element(out);
        write_curves(out);
        const char kind = "HRPAQT"[static_cast<int>(m_element.shape)];
        out << "<COMPOSITE><C ID=\"0\"> " << kind << "[7] </C><C ID=\"3\" NAME=\"hull\"> "
            << (m_dimension == 3 ? "F[100]" : "E[10]")
            << " </C></COMPOSITE>\n<DOMAIN> C[0] </DOMAIN>\n</GEOMETRY>\n</NEKTAR>\n";
        return out.str();
    }

private:
    /** Ids with gaps, so that nothing can rest on their being positions. */
    static std::int64_t vertex_id(int corner) { return 5 + 3 * corner; }
    static std::int64_t id_of_edge(std::size_t edge) { return 10 + 2 * static_cast<std::int64_t>(edge); }

    std::vector<int> turned(std::vector<int> corners) const {
        if (corners.size() == 3) {
            // The last corner is where the face is collapsed.
            if (m_element.turn % 2 == 1) {
                std::swap(corners[0], corners[1]);
            }
            return corners;
        }
        std::rotate(corners.begin(), corners.begin() + m_element.turn % 4, corners.end());
        if (m_element.turn / 4 % 2 == 1) {
            std::swap(corners[1], corners[3]);
        }
        return corners;
    }

    void add_face(const std::vector<int>& corners) {
        std::vector<std::int64_t> edges;
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
            const int a = corners[corner], b = corners[(corner + 1) % corners.size()];
            auto found = std::ranges::find_if(
                m_edges, [&](const auto& edge) { return edge == std::pair(a, b) || edge == std::pair(b, a); });
            if (found == m_edges.end()) {
                const bool is_reversed = (static_cast<int>(m_edges.size()) + m_element.turn) % 2 == 1;
                m_edges.push_back(is_reversed ? std::pair(b, a) : std::pair(a, b));
                found = m_edges.end() - 1;
            }
            edges.push_back(id_of_edge(static_cast<std::size_t>(found - m_edges.begin())));
        }
        m_faces.push_back(corners);
        m_face_edges.push_back(edges);
    }

    std::string attributes() const { return m_element.is_compressed ? R"( COMPRESSED="B64Z-LittleEndian" BITSIZE="64")" : ""; }

    void record(std::ostream& out, const char* tag, std::int64_t id, const std::vector<std::int64_t>& numbers) {
        if (m_element.is_compressed) {
            m_words.push_back(static_cast<std::uint64_t>(id));
            m_words.insert(m_words.end(), numbers.begin(), numbers.end());
            return;
        }
        out << "<" << tag << " ID=\"" << id << "\">";
        for (const std::int64_t number : numbers) {
            out << " " << number;
        }
        out << " </" << tag << ">\n";
    }

    /** The records so far, packed. */
    std::string flush() {
        const std::string text = m_element.is_compressed ? pack(m_words) : std::string();
        m_words.clear();
        return text;
    }

    void write_vertices(std::ostream& out) {
        out << "<VERTEX" << attributes() << " " << m_element.vertex_attributes << ">";
        for (std::size_t corner = 0; corner < m_corners.size(); ++corner) {
            const Point x = m_element.map(m_corners[corner]);
            if (m_element.is_compressed) {
                m_words.push_back(static_cast<std::uint64_t>(vertex_id(static_cast<int>(corner))));
                std::ranges::transform(x, std::back_inserter(m_words),
                                       [](double v) { return std::bit_cast<std::uint64_t>(v); });
            } else {
                out << "<V ID=\"" << vertex_id(static_cast<int>(corner)) << "\"> " << x[0] << "\n<!-- a comment --> " << x[1]
                    << " " << x[2] << "</V>\n";
            }
        }
        out << flush() << "</VERTEX>\n";
    }

    void write_faces_and_element(std::ostream& out) {
        std::vector<std::int64_t> sides = m_face_edges.front();
        const auto write_of = [&](std::size_t n_edges) {
            const char* tag = n_edges == 3 ? "T" : "Q";
            bool has_any = false;
            for (std::size_t face = 0; face < m_faces.size(); ++face) {
                if (m_faces[face].size() == n_edges) {
                    if (m_element.is_compressed && !has_any) {
                        out << "<" << tag << attributes() << ">";
                    }
                    has_any = true;
                    record(out, tag, 100 + static_cast<std::int64_t>(face), m_face_edges[face]);
                }
            }
            if (m_element.is_compressed && has_any) {
                out << flush() << "</" << tag << ">";
            }
        };
        if (m_dimension == 3) {
            out << "<FACE>";
            write_of(3);
            write_of(4);
            out << "</FACE>\n";
            sides.clear();
            for (std::size_t face = 0; face < m_faces.size(); ++face) {
                sides.push_back(100 + static_cast<std::int64_t>(face));
            }
        }
        const std::string tag(1, "HRPAQT"[static_cast<int>(m_element.shape)]);
        out << "<ELEMENT>";
        if (m_element.is_compressed) {
            out << "<" << tag << attributes() << ">";
        }
        record(out, tag.c_str(), 7, sides);
        if (m_element.is_compressed) {
            out << flush() << "</" << tag << ">";
        }
        out << "</ELEMENT>\n";
    }

    std::vector<Point> points_of_edge(std::size_t edge) const {
        const Point& a = m_corners[static_cast<std::size_t>(m_edges[edge].first)];
        const Point& b = m_corners[static_cast<std::size_t>(m_edges[edge].second)];
        std::vector<Point> points;
        for (const double z : line(m_element.edge_points, m_element.n_along)) {
            points.push_back(m_element.map(between({a, b, b, a}, z, -1)));
        }
        return points;
    }

    std::vector<Point> points_of_face(std::size_t face) const {
        std::vector<Point> corners;
        for (const int corner : m_faces[face]) {
            corners.push_back(m_corners[static_cast<std::size_t>(corner)]);
        }
        std::vector<Point> points;
        if (corners.size() == 3) {
            for (const auto& [s, t] : triangle(m_element.triangle_points, m_element.n_along)) {
                points.push_back(m_element.map(between(corners, s, t)));
            }
            return points;
        }
        const std::vector<double> z = line(m_element.edge_points, m_element.n_along);
        for (const double t : z) {
            for (const double s : z) {
                points.push_back(m_element.map(between(corners, s, t)));
            }
        }
        return points;
    }

    void write_curves(std::ostream& out) {
        if (m_element.n_along == 0) {
            return;
        }
        out << "<CURVED" << attributes() << ">\n";
        std::vector<std::uint64_t> of_edges, of_faces, index, pool;
        const auto add = [&](bool is_edge, std::int64_t id, const std::string& type, const std::vector<Point>& points) {
            if (!m_element.is_compressed) {
                out << (is_edge ? "<E" : "<F") << " ID=\"" << id << "\" " << (is_edge ? "EDGEID" : "FACEID") << "=\"" << id
                    << "\" NUMPOINTS=\"" << points.size() << "\" TYPE=\"" << type << "\">";
                for (const Point& x : points) {
                    out << " " << x[0] << " " << x[1] << " " << x[2] << "\n";
                }
                out << (is_edge ? "</E>\n" : "</F>\n");
                return;
            }
            const std::map<std::string, std::uint64_t> types{{"GaussLobattoLegendre", 4},
                                                             {"PolyEvenlySpaced", 17},
                                                             {"NodalTriElec", 22},
                                                             {"NodalTriFekete", 23},
                                                             {"NodalTriEvenlySpaced", 24}};
            auto& records = is_edge ? of_edges : of_faces;
            const auto number = static_cast<std::uint64_t>(id);
            records.insert(records.end(), {number, number, points.size(), 0, index.size(), types.at(type)});
            for (const Point& x : points) {
                index.push_back(pool.size() / 4);
                pool.push_back(index.back());
                std::ranges::transform(x, std::back_inserter(pool), [](double v) { return std::bit_cast<std::uint64_t>(v); });
            }
        };
        for (std::size_t edge = 0; edge < m_edges.size(); ++edge) {
            add(true, id_of_edge(edge), m_element.edge_points, points_of_edge(edge));
        }
        for (std::size_t face = 0; face < m_faces.size(); ++face) {
            add(false, m_dimension == 2 ? 7 : 100 + static_cast<std::int64_t>(face),
                m_faces[face].size() == 3 ? m_element.triangle_points : m_element.edge_points, points_of_face(face));
        }
        if (m_element.is_compressed) {
            out << "<E>" << pack(of_edges) << "</E><F>" << pack(of_faces) << "</F><DATAPOINTS ID=\"0\"><INDEX>" << pack(index)
                << "</INDEX><POINTS>" << pack(pool) << "</POINTS></DATAPOINTS>";
        }
        out << "</CURVED>\n";
    }

    const Element& m_element;
    int m_dimension;
    std::vector<Point> m_corners;
    /** From corner to corner. */
    std::vector<std::pair<int, int>> m_edges;
    std::vector<std::vector<int>> m_faces;
    std::vector<std::vector<std::int64_t>> m_face_edges;
    std::vector<std::uint64_t> m_words;
};

} // namespace

std::string pack(const std::vector<std::uint64_t>& words) {
    uLongf size = compressBound(static_cast<uLong>(words.size() * 8));
    std::vector<unsigned char> bytes(size);
    if (compress(bytes.data(), &size, reinterpret_cast<const Bytef*>(words.data()), static_cast<uLong>(words.size() * 8)) !=
        Z_OK) {
        throw std::runtime_error("zlib");
    }
    bytes.resize(size);
    return base64(std::move(bytes));
}

std::string pack(const std::vector<double>& numbers) {
    std::vector<std::uint64_t> words;
    std::ranges::transform(numbers, std::back_inserter(words), [](double v) { return std::bit_cast<std::uint64_t>(v); });
    return pack(words);
}

std::vector<std::uint64_t> unpack(const std::string& text) {
    std::vector<unsigned char> bytes;
    unsigned bits = 0;
    int n_bits = 0;
    for (const char digit : text) {
        const std::size_t value = digits.find(digit);
        if (value == std::string_view::npos) {
            return {};
        }
        bits = bits << 6 | static_cast<unsigned>(value);
        n_bits += 6;
        if (n_bits >= 8) {
            n_bits -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> n_bits));
        }
    }
    // The samples' numbers do not shrink to less than a hundredth.
    std::vector<std::uint64_t> words(bytes.size() * 100 / 8);
    uLongf size = static_cast<uLongf>(words.size() * 8);
    if (uncompress(reinterpret_cast<Bytef*>(words.data()), &size, bytes.data(), static_cast<uLong>(bytes.size())) != Z_OK) {
        return {};
    }
    words.resize(size / 8);
    return words;
}

std::string field_file(const std::vector<Block>& blocks, const std::string& metadata) {
    std::string text = "<?xml version=\"1.0\"?>\n<NEKTAR>\n<Metadata>" + metadata + "</Metadata>\n";
    for (const Block& block : blocks) {
        text += "<ELEMENTS FIELDS=\"" + block.fields + "\" SHAPE=\"" + block.shape + "\" BASIS=\"" + block.basis +
                "\" NUMMODESPERDIR=\"" + block.n_modes + "\" ID=\"" + block.ids + "\" " + block.more_attributes + ">" +
                pack(block.coefficients) + "</ELEMENTS>\n";
    }
    return text + "</NEKTAR>\n";
}

std::string geometry_file(const Element& element) { return Writer(element).text(); }

} // namespace nektar_writer
