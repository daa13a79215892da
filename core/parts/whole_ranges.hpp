/**
 * @file whole_ranges.hpp
 * What a picture needs to know of a volume that several processes have in parts.
 */
#pragma once

#include <core/base/team.hpp>
#include <core/parts/parted_volume.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/picture_ranges.hpp>
#include <core/render/renderer.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/**
 * Each question is answered by all members of the team together, who have to ask the same ones in the same order; the answers
 * are the same on all.
 */
class WholeRanges final : public PictureRanges {
public:
    /**
     * `boxes`: of all elements, six numbers each. `parts`: draw the parts of this member. All must outlive it; of the whole
     * only what is far out is read, and extrema that it tells.
     */
    WholeRanges(const PartedVolume& volume, const std::vector<double>& boxes, std::span<Renderer* const> parts, Team& team);

    const std::array<double, 6>& bounds() const override { return m_bounds; }
    const std::vector<Vector3>& outline() override;
    const FieldExtrema& extrema(const FieldChoice& field, std::uint32_t time_step) override;
    FieldRange range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr) override;
    double value_rounding(const FieldChoice& field, std::uint32_t time_step) override;
    void take_minima(std::span<double> numbers) override { m_team.minimum(numbers); }

    /** Of each component of a field over all parts. */
    VolumeRanges::Ranges of_components(std::uint32_t field, std::uint32_t time_step);

    /** Values of fields have changed. */
    void forget_fields();

private:
    FieldExtrema found_extrema(const FieldChoice& field, std::uint32_t time_step);
    std::pair<FieldRange, elvis_certainty> found_range(const FieldChoice& field, std::uint32_t time_step);

    const PartedVolume& m_volume;
    const RuntimeVolume& m_whole;
    const std::vector<double>& m_boxes;
    std::span<Renderer* const> m_parts;
    Team& m_team;
    std::array<double, 6> m_bounds{};
    std::vector<Vector3> m_outline;
    /** By field and component, or expression, and time step. */
    std::map<std::pair<std::string, std::uint32_t>, FieldExtrema> m_extrema;
    std::map<std::pair<std::string, std::uint32_t>, std::pair<FieldRange, elvis_certainty>> m_ranges;
};

} // namespace elvis
