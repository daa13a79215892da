/**
 * @file located_fields.hpp
 * Fields of a volume with other elements, found by place: what makes two solutions on different meshes comparable.
 *
 * A point of the first volume is looked for in the other volume's hierarchy; its mapping is inverted by Newton's method, and
 * its basis evaluated, in double precision on the processor. So values are exact but for rounding; what they are between points
 * is not known.
 */
#pragma once

#include <core/plugin_host/fields_by_place.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/element_finder.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

class LocatedFields : public FieldsByPlace {
public:
    /**
     * A field p of `other` becomes NAME.p. `time_step`: always this one; else the first volume's, or the only one.
     * `n_time_steps`: of the first volume. Throws Error for volumes that are not evaluated on the CPU, and for time steps that
     * are not there.
     */
    LocatedFields(const std::string& name, RuntimeVolume other, std::optional<std::uint32_t> time_step,
                  std::size_t n_time_steps);

    const std::vector<FieldInfo>& fields() const override { return m_fields; }
    /** Where several elements hold a position, one of them counts: that whose box has its middle nearest. */
    void evaluate(std::uint32_t field, std::uint32_t time_step, std::span<const double> positions, std::span<double> values,
                  std::span<double> gradients) const override;
    double jump(std::uint32_t field, std::uint32_t time_step, const std::array<double, 3>& position,
                double reach) const override;

private:
    std::uint32_t step_of(std::uint32_t time_step) const;
    /** In elements that hold the position within `reach`, the most likely one first; in that alone if it lies deeper in it. */
    std::vector<ReferencePoint> places_of(const Vector3& position, double reach) const;

    RuntimeVolume m_volume;
    ElementFinder m_finder;
    /** Of the elements' boxes. */
    std::vector<Vector3> m_middles;
    std::optional<std::uint32_t> m_time_step;
    std::vector<FieldInfo> m_fields;
};

} // namespace elvis
