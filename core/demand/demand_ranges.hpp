/**
 * @file demand_ranges.hpp
 * What a picture needs to know of a volume of which only some elements are read.
 */
#pragma once

#include <core/demand/box_blocks.hpp>
#include <core/demand/memory_need.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/**
 * The same answers as VolumeRanges has of the whole, in bounded memory: ranges of fields come from the plugin, block by block,
 * and extrema from a plugin that tells them, or from the search for them where that fits the budget. Else they are errors,
 * which say what to give. Needs RuntimeVolume::has_field_ranges().
 */
class DemandRanges final : public PictureRanges {
public:
    /** All must outlive it. */
    DemandRanges(const Device& device, const RuntimeVolume& whole, Precision precision, const BoxBlocks& blocks,
                 const MemoryBudget& budget, const TaskControl* control);
    ~DemandRanges() override;

    const std::array<double, 6>& bounds() const override { return m_blocks.bounds(); }
    const std::vector<Vector3>& outline() override;
    const FieldExtrema& extrema(const FieldChoice& field, std::uint32_t time_step) override;
    FieldRange range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr) override;
    double value_rounding(const FieldChoice& field, std::uint32_t time_step) override;

    /** Tells a renderer of some elements what pictures of the whole go by. */
    void tell(const FrameRequest& request, VolumeRanges& ranges);

private:
    struct Sample;

    const VolumeRanges::Ranges& of_components(std::uint32_t field, std::uint32_t time_step);
    /** Of elements here and there, the same as those that rounding of expressions is sampled in. */
    VolumeRanges& sample(const FieldChoice& field, std::uint32_t time_step);

    const Device& m_device;
    const RuntimeVolume& m_whole;
    Precision m_precision;
    const BoxBlocks& m_blocks;
    MemoryBudget m_budget;
    const TaskControl* m_control;
    std::vector<Vector3> m_outline;
    std::unique_ptr<Sample> m_sample;
    std::map<std::pair<std::uint32_t, std::uint32_t>, VolumeRanges::Ranges> m_of_components;
    std::map<std::pair<std::string, std::uint32_t>, FieldExtrema> m_extrema;
    /** Of expressions. */
    std::map<std::pair<std::string, std::uint32_t>, double> m_errors;
};

} // namespace elvis
