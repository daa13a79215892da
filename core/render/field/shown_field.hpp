/**
 * @file shown_field.hpp
 * From the field of a surface, or an expression over fields, to what kernels need of it.
 */
#pragma once

#include <core/render/field/volume_ranges.hpp>
#include <core/render/picture/layer.hpp>

#include <string>

namespace elvis {

/** Whether neighbours may have different values on a face that they share. */
bool may_jump(const FieldChoice& field, const RuntimeVolume& volume);

class ShownFields {
public:
    /** All must outlive it. */
    ShownFields(const RuntimeVolume& volume, DeviceVolume& data, VolumeRanges& ranges)
        : m_volume(volume), m_data(data), m_ranges(ranges) {}

    /** What kernels of the field are made of; equal for fields that share kernels. */
    static std::string key(const FieldChoice& field);
    /**
     * The same field with an offset near `value`: one of a few, so that a change of the value seldom takes another copy of the
     * field. Unchanged where that is not possible.
     */
    FieldChoice about(const FieldChoice& field, double value, std::uint32_t time_step);
    /** Uploads the field if it is not on the device. Returns what it lacks there. */
    double upload(const FieldChoice& field, std::uint32_t time_step);
    ShownComponent component(const FieldChoice& field) const;
    /** See VolumeRanges::value_error. */
    double value_error(const FieldChoice& field, std::uint32_t time_step, double offset) {
        return m_ranges.value_error(field, time_step, offset);
    }

private:
    const RuntimeVolume& m_volume;
    DeviceVolume& m_data;
    VolumeRanges& m_ranges;
};

} // namespace elvis
