/**
 * @file fields.hpp
 * The analytic fields.
 */
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace generator {

class AnalyticField {
public:
    virtual ~AnalyticField() = default;
    virtual std::string name() const = 0;
    virtual std::uint32_t n_components() const { return 1; }
    /** Total degree as a polynomial in x, y, z within one element; none if it is no polynomial. */
    virtual std::optional<std::uint32_t> degree() const { return std::nullopt; }
    virtual bool is_continuous() const { return true; }
    /** Value at a position, seen from an element. */
    virtual void evaluate(const std::array<double, 3>& x, std::uint64_t element, double* components) const = 0;
};

/** All names that a description may use. */
const std::vector<std::string>& field_names();

/** The field of that name; `degree` is for "polynomial". */
std::unique_ptr<const AnalyticField> make_field(const std::string& name, std::uint32_t degree);

} // namespace generator
