#include "written_file.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <limits>

using elvis::native::Point;

namespace {

template <class Number> std::string bytes_of(Number value, bool is_big) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    if (is_big != (std::endian::native == std::endian::big)) {
        std::ranges::reverse(bytes);
    }
    return bytes;
}

/** The unit cubes in a row, before they are bent. */
Point straight(int dimension, std::uint64_t element, const Point& xi) {
    return {static_cast<double>(element) + (xi[0] + 1) / 2, (xi[1] + 1) / 2, dimension == 3 ? (xi[2] + 1) / 2 : 0};
}

std::vector<double> line(Nodes nodes, int n) {
    std::vector<double> points(static_cast<std::size_t>(n));
    elvis::native::gauss_lobatto_legendre(points);
    if (nodes == Nodes::equidistant) {
        for (int i = 0; i < n; ++i) {
            points[static_cast<std::size_t>(i)] = -1 + 2.0 * i / (n - 1);
        }
    }
    return points;
}

/** Products of points, the first direction fastest. */
std::vector<Point> grid(const std::vector<double>& points, int dimension) {
    std::vector<Point> result;
    for (const double z : dimension == 3 ? points : std::vector<double>{0.0}) {
        for (const double y : points) {
            for (const double x : points) {
                result.push_back({x, y, z});
            }
        }
    }
    return result;
}

/** The scalar fields behind the coordinates and the velocity: a letter each. */
int n_scalars(const std::string& code) {
    const std::size_t at = code.find('S');
    return at == std::string::npos ? 0 : std::stoi(code.substr(at + 1));
}

class Writer {
public:
    Writer(const WrittenFile& file) : m_file(file), m_nodes(grid(line(file.nodes, file.n), file.dimension)) {
        std::vector<double> points(static_cast<std::size_t>(file.n - 2)), weights(points.size());
        if (file.has_gauss_pressure) {
            elvis::native::gauss_legendre(points, weights);
            m_gauss = grid(points, file.dimension);
        }
    }

    std::string operator()() {
        const std::string letters = m_file.code.substr(0, m_file.code.find('S'));
        const std::size_t dimension = static_cast<std::size_t>(m_file.dimension);
        const auto has = [&](char letter) { return letters.find(letter) != std::string::npos; };
        if (has('X')) {
            block(0, dimension, true);
        }
        if (has('U')) {
            block(0, dimension, false);
        }
        if (has('P')) {
            block(dimension, 1, false);
        }
        if (has('T')) {
            block(dimension + 1, 1, false);
        }
        for (std::size_t scalar = 0; scalar < static_cast<std::size_t>(n_scalars(m_file.code)); ++scalar) {
            block(dimension + 2 + scalar, 1, false);
        }
        if (m_file.has_ranges && m_file.dimension == 3) {
            m_bytes += std::string(8 * m_file.numbers.size() * m_n_components, '\0');
        }
        return m_bytes;
    }

private:
    void block(std::size_t first, std::size_t n_components, bool is_position) {
        const bool is_gauss = m_file.has_gauss_pressure && !is_position && first == static_cast<std::size_t>(m_file.dimension);
        m_n_components += n_components;
        for (const int number : m_file.numbers) {
            const auto element = static_cast<std::uint64_t>(number - 1);
            for (std::size_t component = first; component < first + n_components; ++component) {
                const std::vector<Point>& points = is_gauss ? m_gauss : m_nodes;
                for (const Point& xi : points) {
                    if (is_position) {
                        const Point x = written_position(m_file.dimension, element, xi);
                        put(x[component] + (component == 0 ? m_file.shift : 0));
                    } else {
                        put(written_values(m_file.dimension, element, xi, m_file.time, n_scalars(m_file.code))[component]);
                    }
                }
                for (std::size_t rest = points.size(); rest < m_nodes.size(); ++rest) {
                    put(std::numeric_limits<double>::quiet_NaN());
                }
            }
        }
    }

    void put(double value) { m_bytes += real_bytes(value, m_file.real_size, m_file.is_big); }

    const WrittenFile& m_file;
    std::vector<Point> m_nodes, m_gauss;
    std::string m_bytes;
    std::size_t m_n_components = 0;
};

} // namespace

std::string real_bytes(double value, int size, bool is_big) {
    return size == 8 ? bytes_of(value, is_big) : bytes_of(static_cast<float>(value), is_big);
}

std::string integer_bytes(std::int32_t value, bool is_big) { return bytes_of(value, is_big); }

std::string in_columns(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string WrittenFile::header() const {
    char text[133];
    std::snprintf(text, sizeof text, "#std %1d %2d %2d %2d %10zu %10d %20.13E %9d %6d %6d %-10s", real_size, n, n,
                  dimension == 3 ? n : 1, numbers.size(), n_elements, time, 7, part, n_parts, code.c_str());
    std::string result = text + tail;
    result.resize(132, ' ');
    return result;
}

std::string WrittenFile::content() const {
    std::string result = header() + real_bytes(6.54321, 4, is_big);
    for (const int number : numbers) {
        result += integer_bytes(number, is_big);
    }
    return result + Writer(*this)();
}

Point written_position(int dimension, std::uint64_t element, Point xi) {
    const auto [x, y, z] = straight(dimension, element, xi);
    // Zero at both ends of an element, so that neighbours meet, and long rows are not sheared.
    const double s = x - static_cast<double>(element), bubble = s * (1 - s);
    return {x + 0.1 * y * z - 0.05 * y, y + 0.4 * z * bubble, z + 0.4 * bubble * y * (dimension - 2)};
}

std::vector<double> written_values(int dimension, std::uint64_t element, Point xi, double time, int n_scalars) {
    const auto [x, y, z] = straight(dimension, element, xi);
    std::vector<double> values{x * x - y, x * y + z};
    if (dimension == 3) {
        values.push_back(z * z - x * y);
    }
    values.push_back(x * y * y + z + time);
    values.push_back(2 - x + y * z);
    for (int scalar = 1; scalar <= n_scalars; ++scalar) {
        values.push_back(scalar * x - y * y);
    }
    return values;
}
