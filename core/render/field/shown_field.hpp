/**
 * @file shown_field.hpp
 * From the field of a surface, or an expression over fields, to what the device needs of it, and its range.
 */
#pragma once

#include <core/render/picture/layer.hpp>
#include <core/render/surface.hpp>
#include <core/volume/device_volume.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

class ShownFields {
public:
    /** All must outlive it. */
    ShownFields(const Device& device, const RuntimeVolume& volume, DeviceVolume& data)
        : m_device(device), m_volume(volume), m_data(data) {}

    /** What kernels of the field are made of; equal for fields that share kernels. */
    static std::string key(const FieldChoice& field);
    /**
     * Fields lack the middle of their range, so that small variations of large values keep their digits; those of magnitudes
     * are whole.
     */
    FieldSelection selection(const FieldChoice& field, std::uint32_t time_step);
    /**
     * The same field with an offset near `value`: one of a few, so that a change of the value seldom takes another copy of the
     * field. Unchanged where that is not possible.
     */
    FieldChoice about(const FieldChoice& field, double value, std::uint32_t time_step);
    /** What the field lacks on the device, while it is selected there. */
    double offset(const FieldChoice& field) const;
    ShownComponent component(const FieldChoice& field) const;

    /**
     * Extrema of the field: what colours go by. find_extrema (core/volume/field/field_extrema.hpp), else refined samples on the
     * device (sampled_range.hpp), which then has another selection; always the latter of expressions.
     */
    const FieldExtrema& extrema(const FieldChoice& field, std::uint32_t time_step);

    /**
     * Encloses those: certified where the plugin says so, and several times wider. Expressions are sampled on the device, which
     * then has another selection.
     */
    FieldRange range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr);

    /**
     * Error of a value in single precision, lacking its offset on the device, about: relative to the largest for a field,
     * sampled for an expression, which then is selected.
     */
    double float32_error(const FieldChoice& field, std::uint32_t time_step, double offset);

private:
    using Ranges = std::pair<std::vector<FieldRange>, elvis_certainty>;
    FieldExtrema found_extrema(const FieldChoice& field, std::uint32_t time_step);
    std::vector<double> middles(std::uint32_t field, std::uint32_t time_step);
    const Ranges& of_components(std::uint32_t field, std::uint32_t time_step);
    std::vector<FieldRange> sampled(std::uint32_t field, std::uint32_t time_step);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    DeviceVolume& m_data;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Ranges> m_of_components;
    std::map<std::pair<std::string, std::uint32_t>, FieldExtrema> m_extrema;
    std::map<std::pair<std::string, std::uint32_t>, FieldRange> m_of_expressions;
    std::map<std::pair<std::string, std::uint32_t>, double> m_errors;
};

} // namespace elvis
