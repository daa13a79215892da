/**
 * @file demand_ranges.hpp
 * What a picture needs to know of a volume of which only some elements are read.
 */
#pragma once

#include <core/demand/box_blocks.hpp>
#include <core/demand/memory_need.hpp>
#include <core/demand/range_blocks.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
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

    /** What extrema() gives; null where it throws. */
    const FieldExtrema* found_extrema(const FieldChoice& field, std::uint32_t time_step, std::string& why_not);
    /** Of an expression, from samples: see range(). */
    FieldRange sampled_range(const FieldChoice& field, std::uint32_t time_step);

    /** Tells a renderer of some elements what pictures of the whole go by. */
    void tell(const FrameRequest& request, VolumeRanges& ranges);

    const RangeBlocks& blocks_of(std::uint32_t field, std::uint32_t time_step);
    /**
     * Whether the plugin proves the ranges of all elements, and what it bounds of derivatives: of some elements it says then
     * what it says of all.
     */
    bool are_proven(std::uint32_t field, std::uint32_t time_step);

private:
    struct Sample;

    std::optional<FieldExtrema> search(const FieldChoice& field, std::uint32_t time_step, std::string& why_not) const;
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
    std::map<std::pair<std::uint32_t, std::uint32_t>, RangeBlocks> m_blocks_of;
    std::map<std::pair<std::string, std::uint32_t>, FieldExtrema> m_extrema;
    /** Of expressions. */
    std::map<std::pair<std::string, std::uint32_t>, double> m_errors;
};

/** The same for people: where an answer would be an error, about what it is. */
class RoughDemandRanges final : public PictureRanges {
public:
    explicit RoughDemandRanges(DemandRanges& ranges) : m_ranges(ranges) {}

    const std::array<double, 6>& bounds() const override { return m_ranges.bounds(); }
    const std::vector<Vector3>& outline() override { return m_ranges.outline(); }
    const FieldExtrema& extrema(const FieldChoice& field, std::uint32_t time_step) override;
    FieldRange range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty = nullptr) override;
    double value_rounding(const FieldChoice& field, std::uint32_t time_step) override {
        return m_ranges.value_rounding(field, time_step);
    }

private:
    DemandRanges& m_ranges;
    /** Of the last question. */
    FieldExtrema m_enclosure{};
};

} // namespace elvis
