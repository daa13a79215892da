/**
 * @file dat_writer.hpp
 * Writes small files in the format of the original ElVis.
 */
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class DatWriter {
public:
    explicit DatWriter(bool big_endian = true) : m_big_endian(big_endian) {}

    /** `corners`: six or eight; `type` as in the file. */
    void add(std::int32_t type, std::vector<std::array<double, 3>> corners, const std::array<std::int32_t, 3>& degree,
             const std::vector<double>& coefficients);
    /** A hexahedron of degree 1 with the field 1 + r. */
    void add_box(const std::array<double, 3>& lower, const std::array<double, 3>& upper);

    std::string bytes() const;

private:
    template <class Number> void append(std::string& bytes, Number number) const;

    bool m_big_endian;
    std::int32_t m_n_elements = 0;
    std::string m_records;
};

/** Corners of a box in the format's order. */
std::array<std::array<double, 3>, 8> box_corners(const std::array<double, 3>& lower, const std::array<double, 3>& upper);
