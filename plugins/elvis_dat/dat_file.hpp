/**
 * @file dat_file.hpp
 * The Jacobi-extension volume format of the original ElVis (2012-2015): hexahedra and prisms with modal Jacobi coefficients.
 * README.md beside this file describes it.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace elvis_dat {

enum class Type : std::int32_t { hexahedron = 1, prism = 3 };

struct Element {
    Type type = Type::hexahedron;
    std::array<std::int32_t, 3> degree{};
    /** Eight corners, x y z each; a prism uses six. */
    std::array<double, 24> corners{};
    /** First of its coefficients in DatFile::coefficients. */
    std::size_t first_coefficient = 0;
};

/** A whole file in memory. Immutable after construction: any thread may read. */
class DatFile {
public:
    /** Reads and checks every record. Throws elvis::api::Error with the byte offset of what is wrong. */
    explicit DatFile(const std::string& path);

    const std::vector<Element>& elements() const { return m_elements; }
    std::span<const double> coefficients(const Element& element) const;

    /** Whether a file begins with the format's mark. */
    static bool has_mark(const char* path);

private:
    std::vector<Element> m_elements;
    std::vector<double> m_coefficients;
};

/** Number of coefficients of an element. */
std::size_t n_coefficients(Type type, const std::array<std::int32_t, 3>& degree);

/** Position of a reference point. */
std::array<double, 3> position(const Element& element, const double* xi);

/** Value of the field at a reference point. */
double value(const Element& element, std::span<const double> coefficients, const double* xi);

} // namespace elvis_dat
