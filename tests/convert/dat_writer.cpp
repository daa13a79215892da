#include "dat_writer.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

template <class Number> void DatWriter::append(std::string& bytes, Number number) const {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), &number, sizeof number);
    if (m_big_endian == (std::endian::native == std::endian::little))
        std::ranges::reverse(raw);
    bytes.append(raw.begin(), raw.end());
}

void DatWriter::add(std::int32_t type, std::vector<std::array<double, 3>> corners, const std::array<std::int32_t, 3>& degree,
                    const std::vector<double>& coefficients) {
    ++m_n_elements;
    corners.resize(8);
    append(m_records, type);
    append(m_records, std::int32_t{1});
    append(m_records, 0.0);
    append(m_records, 0.0);
    for (const auto& corner : corners)
        for (double x : corner)
            append(m_records, x);
    for (std::int32_t d : degree)
        append(m_records, d);
    for (double c : coefficients)
        append(m_records, c);
}

void DatWriter::add_box(const std::array<double, 3>& lower, const std::array<double, 3>& upper) {
    const auto corners = box_corners(lower, upper);
    // k fastest, then j, then i: 1 is coefficient 0, P_1(r) is coefficient 4.
    add(1, {corners.begin(), corners.end()}, {1, 1, 1}, {1, 0, 0, 0, 1, 0, 0, 0});
}

std::string DatWriter::bytes() const {
    std::string result("Finite Element Volume  \0", 24);
    append(result, std::int32_t{1});
    append(result, m_n_elements);
    return result + m_records;
}

std::array<std::array<double, 3>, 8> box_corners(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return {{{a[0], a[1], a[2]},
             {b[0], a[1], a[2]},
             {b[0], b[1], a[2]},
             {a[0], b[1], a[2]},
             {a[0], a[1], b[2]},
             {b[0], a[1], b[2]},
             {b[0], b[1], b[2]},
             {a[0], b[1], b[2]}}};
}
