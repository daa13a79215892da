/**
 * @file field.hpp
 * The analytic fields.
 */
#pragma once

#include "cell_split.hpp"
#include "parameters.hpp"

#include <optional>
#include <string>
#include <vector>

namespace generator {

/** A field as the host sees it; Taylor-Green flow makes two of one entry in the file. */
struct Field {
    enum class Function { polynomial, jump, sinc, velocity, pressure, waves, element, distance };

    std::string name;
    Function function = Function::polynomial;
    std::uint32_t n_components = 1;
    elvis_continuity continuity = ELVIS_CONTINUITY_CONTINUOUS;
    /** Of the polynomial part; empty if the field has none. */
    std::vector<Term> terms;
    std::optional<std::array<std::uint32_t, 3>> order;

    /** Highest i + j + k of the terms; no value if the field is not piecewise polynomial. */
    std::optional<std::uint32_t> degree() const;
    /** Highest exponent of each coordinate. */
    std::array<std::uint32_t, 3> degrees() const;

    /** Writes n_components values. */
    void evaluate(const Vec3& x, double time, std::uint64_t element, double* values) const;
};

std::vector<Field> make_fields(const std::vector<FieldParameters>& parameters);

} // namespace generator
