/**
 * @file volume_ranges.hpp
 * Where a volume lies, and which values its fields take: what pictures go by before anything is drawn.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/render/field/picture_ranges.hpp>
#include <core/volume/device_volume.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** Found when first asked for, and kept. What only the device can tell is sampled there: `data` then has another selection. */
class VolumeRanges : public PictureRanges {
public:
    /** Of each component, and how sure that is. */
    using Ranges = std::pair<std::vector<FieldRange>, elvis_certainty>;

    /** All must outlive it. */
    VolumeRanges(const Device& device, const RuntimeVolume& volume, DeviceVolume& data)
        : m_device(device), m_volume(volume), m_data(data) {}

    /** Values of a field, or of all, have changed: what is known of them goes, and of all expressions. */
    void forget_fields(std::optional<std::uint32_t> only = {});

    /** Bounds of the whole volume: min x y z, max x y z. */
    const std::array<double, 6>& bounds() const override { return m_data.bounds(); }
    /** How far the volume reaches in every direction (core/volume/outline.hpp). */
    const std::vector<Vector3>& outline() override;

    /**
     * Extrema of a field (component, magnitude or expression) over the volume at a time step: what colours go by. Within a
     * thousandth of their distance where the plugin has bounds (core/volume/field/field_extrema.hpp), else of refined samples
     * (sampled_range.hpp); always the latter of expressions.
     */
    const FieldExtrema& extrema(const FieldChoice& field, std::uint32_t time_step) override;
    /** Encloses those: certified where the plugin says so, and several times wider. Expressions are sampled. */
    FieldRange range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr) override;

    /**
     * Error of a value in single precision, lacking its offset on the device, about: relative to the largest for a field,
     * sampled for an expression.
     */
    double float32_error(const FieldChoice& field, std::uint32_t time_step, double offset);
    /** The same in the precision in use. */
    double value_error(const FieldChoice& field, std::uint32_t time_step, double offset);
    /**
     * About what rounding costs its values, to tell whether the range is more than that. 0 for components of fields, which lack
     * the middle of their range on the device, and where the range is certainly more.
     */
    double value_rounding(const FieldChoice& field, std::uint32_t time_step) override;

    /** Certified where the plugin says so. */
    const Ranges& of_components(std::uint32_t field, std::uint32_t time_step);
    /** What of_components says from now on: of a part, those of the whole, which its values are drawn by. */
    void set_components(std::uint32_t field, std::uint32_t time_step, Ranges ranges) {
        m_of_components.insert_or_assign({field, time_step}, std::move(ranges));
    }
    /** The same for what rounding costs an expression. */
    void set_error(const FieldChoice& expression, std::uint32_t time_step, double error);

    /**
     * What the device needs of a field. Fields lack the middle of their range, so that small variations of large values keep
     * their digits; those of magnitudes are whole.
     */
    FieldSelection selection(const FieldChoice& field, std::uint32_t time_step);

private:
    FieldExtrema found_extrema(const FieldChoice& field, std::uint32_t time_step);
    std::vector<double> middles(std::uint32_t field, std::uint32_t time_step);
    std::vector<FieldRange> sampled(std::uint32_t field, std::uint32_t time_step);

    const Device& m_device;
    const RuntimeVolume& m_volume;
    DeviceVolume& m_data;
    std::vector<Vector3> m_outline;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Ranges> m_of_components;
    /** By field and component, or expression, and time step. */
    std::map<std::pair<std::string, std::uint32_t>, FieldExtrema> m_extrema;
    std::map<std::pair<std::string, std::uint32_t>, FieldRange> m_of_expressions;
    std::map<std::pair<std::string, std::uint32_t>, double> m_errors;
};

} // namespace elvis
