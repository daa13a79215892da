/**
 * @file fields_by_place.hpp
 * Fields of another volume, which a volume has beside its own: their values are found by place.
 */
#pragma once

#include <core/plugin_host/field_info.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Any number of threads may ask. */
class FieldsByPlace {
public:
    virtual ~FieldsByPlace() = default;

    /** With the names that they have beside the volume's own. */
    virtual const std::vector<FieldInfo>& fields() const = 0;
    /**
     * At positions in the world, three numbers each; an empty span means "not wanted". Gradients are in the world, three
     * numbers a component. All are NaN where the other volume is not.
     */
    virtual void evaluate(std::uint32_t field, std::uint32_t time_step, std::span<const double> positions,
                          std::span<double> values, std::span<double> gradients) const = 0;
    /**
     * How far the values of elements that hold a position are apart, relative to the largest of them: 0 where one alone does.
     * Elements count that hold it within `reach` of their reference coordinates.
     */
    virtual double jump(std::uint32_t field, std::uint32_t time_step, const std::array<double, 3>& position,
                        double reach) const = 0;
};

} // namespace elvis
