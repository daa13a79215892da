/**
 * @file range_blocks.hpp
 * Which values a field takes in all elements of a volume, in the memory of few: ranges of blocks of elements.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/volume_ranges.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

class RangeBlocks {
public:
    /** Reads the ranges of all elements, block by block. Needs RuntimeVolume::has_field_ranges(). All must outlive it. */
    RangeBlocks(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step, Background& background,
                const TaskControl* control);

    /** Of each component over all elements, but for those with values that are not finite. */
    const VolumeRanges::Ranges& total() const { return m_total; }

    /**
     * Elements in which a component, or the length of the vector (-1), may take one of the values (ascending), whatever it
     * lacks on the device (volume/isosurface/told_ranges.hpp). Ascending. Ranges are read again only where a block may. Throws
     * TooManyElements once there are more than `most`.
     */
    std::vector<std::uint64_t> elements_with(std::span<const double> values, std::int32_t component, std::uint64_t most) const;

private:
    /** Of a block's elements and their components. */
    std::vector<FieldRange> read(std::uint64_t block, elvis_certainty& certainty) const;
    std::uint64_t n_in(std::uint64_t block) const;

    const RuntimeVolume& m_volume;
    std::uint32_t m_field, m_time_step;
    std::size_t m_n_components;
    Background& m_background;
    const TaskControl* m_control;
    /** A range for each block and component. */
    std::vector<FieldRange> m_blocks;
    VolumeRanges::Ranges m_total;
};

} // namespace elvis
