#include "dat_file.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace elvis_dat {

namespace {

/** 23 characters, the last two of them blanks, and a NUL. */
constexpr char mark[24] = "Finite Element Volume  ";
constexpr std::int32_t max_degree = 30;

/** Bytes of a file, read front to back with a check of every step. */
class Bytes {
public:
    explicit Bytes(const std::string& path) : m_path(path) {
        std::ifstream file(path, std::ios::binary | std::ios::ate);
        // A folder can be opened, and claims to be of enormous size.
        if (!file || std::filesystem::is_directory(path)) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be opened");
        }
        m_data.resize(static_cast<std::size_t>(file.tellg()));
        file.seekg(0);
        if (!file.read(m_data.data(), static_cast<std::streamsize>(m_data.size()))) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
        }
    }

    bool at_end() const { return m_at == m_data.size(); }
    std::size_t at() const { return m_at; }
    std::size_t left() const { return m_data.size() - m_at; }
    void swap_bytes(bool swap) { m_swap = swap; }

    [[noreturn]] void fail(std::size_t offset, const std::string& what) const {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, "at byte " + std::to_string(offset) + ": " + what);
    }

    template <class Number> Number read() {
        if (left() < sizeof(Number)) {
            fail(m_at, "the file ends in the middle of a record");
        }
        std::array<char, sizeof(Number)> bytes{};
        std::memcpy(bytes.data(), m_data.data() + m_at, sizeof(Number));
        m_at += sizeof(Number);
        if (m_swap) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return std::bit_cast<Number>(bytes);
    }

    std::span<const char> take(std::size_t count) {
        if (left() < count) {
            fail(m_at, "the file ends in the middle of its header");
        }
        m_at += count;
        return {m_data.data() + m_at - count, count};
    }

private:
    std::string m_path;
    std::vector<char> m_data;
    std::size_t m_at = 0;
    bool m_swap = false;
};

void read_header(Bytes& bytes) {
    if (std::memcmp(bytes.take(sizeof mark).data(), mark, sizeof mark) != 0) {
        bytes.fail(0, "the file does not begin with 'Finite Element Volume'");
    }
    const std::size_t offset = bytes.at();
    const std::span<const char> endian = bytes.take(4);
    constexpr char big[4] = {0, 0, 0, 1};
    constexpr char little[4] = {1, 0, 0, 0};
    const bool is_big = std::memcmp(endian.data(), big, 4) == 0;
    if (!is_big && std::memcmp(endian.data(), little, 4) != 0) {
        bytes.fail(offset, "the endian mark is neither that of a big-endian nor that of a little-endian file");
    }
    bytes.swap_bytes(is_big != (std::endian::native == std::endian::big));
}

/**
 * Values of P_0 .. P_n^{(alpha, 0)} at x (standard normalisation), by the three-term recurrence.
 */
void jacobi(int n, double alpha, double x, double* values) {
    values[0] = 1;
    if (n >= 1) {
        values[1] = 0.5 * (alpha + (alpha + 2) * x);
    }
    for (int k = 2; k <= n; ++k) {
        const double a1 = 2 * k * (k + alpha) * (2 * k + alpha - 2);
        const double a2 = (2 * k + alpha - 1) * alpha * alpha;
        const double a3 = (2 * k + alpha - 2) * (2 * k + alpha - 1) * (2 * k + alpha);
        const double a4 = 2 * (k + alpha - 1) * (k - 1) * (2 * k + alpha);
        values[k] = ((a2 + a3 * x) * values[k - 1] - a4 * values[k - 2]) / a1;
    }
}

} // namespace

std::size_t n_coefficients(Type type, const std::array<std::int32_t, 3>& degree) {
    const auto d0 = static_cast<std::size_t>(degree[0]);
    const auto d1 = static_cast<std::size_t>(degree[1]);
    const auto d2 = static_cast<std::size_t>(degree[2]);
    if (type == Type::hexahedron) {
        return (d0 + 1) * (d1 + 1) * (d2 + 1);
    }
    // Runs of d2 - i + 1 coefficients: the file's count (d0+1)(d1+1)(d2+2)/2 for equal degrees.
    std::size_t count = 0;
    for (std::size_t i = 0; i <= d0 && i <= d2; ++i) {
        count += (d1 + 1) * (d2 - i + 1);
    }
    return count;
}

bool DatFile::has_mark(const char* path) {
    std::ifstream file(path, std::ios::binary);
    char head[sizeof mark] = {};
    return file.read(head, sizeof head) && std::memcmp(head, mark, sizeof mark) == 0;
}

DatFile::DatFile(const std::string& path) {
    Bytes bytes(path);
    read_header(bytes);
    const std::size_t count_offset = bytes.at();
    const auto n_elements = bytes.read<std::int32_t>();
    // Header, corners, degrees and one coefficient: no element is smaller.
    constexpr std::size_t smallest_record = 4 + 4 + 16 + 192 + 12 + 8;
    if (n_elements <= 0 || static_cast<std::size_t>(n_elements) > bytes.left() / smallest_record) {
        bytes.fail(count_offset, "the file cannot hold " + std::to_string(n_elements) + " elements");
    }
    m_elements.reserve(static_cast<std::size_t>(n_elements));
    for (std::int32_t index = 0; index < n_elements; ++index) {
        const std::string which = " of element " + std::to_string(index);
        Element element;
        std::size_t offset = bytes.at();
        const auto type = bytes.read<std::int32_t>();
        if (type != static_cast<std::int32_t>(Type::hexahedron) && type != static_cast<std::int32_t>(Type::prism)) {
            bytes.fail(offset, "type " + std::to_string(type) + which +
                                   " is neither 1 (hexahedron) nor 3 (prism), the only ones this format ever stored");
        }
        element.type = static_cast<Type>(type);
        // Stored range: known to be unreliable, hence not used.
        bytes.read<std::int32_t>();
        bytes.read<double>();
        bytes.read<double>();
        offset = bytes.at();
        for (double& coordinate : element.corners) {
            coordinate = bytes.read<double>();
            if (!std::isfinite(coordinate)) {
                bytes.fail(offset, "a corner" + which + " is not finite");
            }
        }
        offset = bytes.at();
        for (std::int32_t& degree : element.degree) {
            degree = bytes.read<std::int32_t>();
            if (degree < 0 || degree > max_degree) {
                bytes.fail(offset, "degree " + std::to_string(degree) + which + " is outside 0.." + std::to_string(max_degree));
            }
        }
        if (element.type == Type::prism && element.degree[0] != element.degree[2]) {
            bytes.fail(offset,
                       "unequal degrees in the triangular directions" + which + ": the number of coefficients is undefined");
        }
        element.first_coefficient = m_coefficients.size();
        const std::size_t count = n_coefficients(element.type, element.degree);
        if (bytes.left() / sizeof(double) < count) {
            bytes.fail(bytes.at(), "the file ends within the coefficients" + which);
        }
        for (std::size_t mode = 0; mode < count; ++mode) {
            m_coefficients.push_back(bytes.read<double>());
        }
        m_elements.push_back(element);
    }
    if (!bytes.at_end()) {
        bytes.fail(bytes.at(), std::to_string(bytes.left()) + " bytes follow the last element");
    }
}

std::span<const double> DatFile::coefficients(const Element& element) const {
    return {m_coefficients.data() + element.first_coefficient, n_coefficients(element.type, element.degree)};
}

std::array<double, 3> position(const Element& element, const double* xi) {
    const double r = xi[0], s = xi[1], t = xi[2];
    std::array<double, 8> weights{};
    if (element.type == Type::hexahedron) {
        weights = {(1 - r) * (1 - s) * (1 - t), (1 + r) * (1 - s) * (1 - t), (1 + r) * (1 + s) * (1 - t),
                   (1 - r) * (1 + s) * (1 - t), (1 - r) * (1 - s) * (1 + t), (1 + r) * (1 - s) * (1 + t),
                   (1 + r) * (1 + s) * (1 + t), (1 - r) * (1 + s) * (1 + t)};
    } else {
        // Scaled by two against the prism's formula, to share the factor 1/8 below.
        weights = {-2 * (r + t) * (1 - s),
                   2 * (1 + r) * (1 - s),
                   2 * (1 + r) * (1 + s),
                   -2 * (r + t) * (1 + s),
                   2 * (1 - s) * (1 + t),
                   2 * (1 + s) * (1 + t),
                   0,
                   0};
    }
    std::array<double, 3> x{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            x[axis] += 0.125 * weights[corner] * element.corners[3 * corner + axis];
        }
    }
    return x;
}

double value(const Element& element, std::span<const double> coefficients, const double* xi) {
    const bool is_prism = element.type == Type::prism;
    const double b = xi[1], c = xi[2];
    // Collapsed coordinate; on the collapsed edge c = 1 every term with i > 0 vanishes, so that any a will do.
    const double a = !is_prism ? xi[0] : c < 1 ? 2 * (1 + xi[0]) / (1 - c) - 1 : 0;
    std::array<double, max_degree + 1> in_a{}, in_b{}, in_c{};
    jacobi(element.degree[0], 0, a, in_a.data());
    jacobi(element.degree[1], 0, b, in_b.data());
    jacobi(element.degree[2], 0, c, in_c.data());
    double sum = 0;
    double power = 1;
    std::size_t n = 0;
    for (int i = 0; i <= element.degree[0]; ++i) {
        const int last = is_prism ? element.degree[2] - i : element.degree[2];
        if (is_prism) {
            jacobi(last, 2 * i + 1, c, in_c.data());
        }
        for (int j = 0; j <= element.degree[1]; ++j) {
            double run = 0;
            for (int k = 0; k <= last; ++k) {
                run += coefficients[n++] * in_c[static_cast<std::size_t>(k)];
            }
            sum += in_a[static_cast<std::size_t>(i)] * in_b[static_cast<std::size_t>(j)] * power * run;
        }
        power *= is_prism ? 1 - c : 1;
    }
    return sum;
}

} // namespace elvis_dat
