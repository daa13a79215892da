/**
 * @file box_blocks.hpp
 * Where all elements of a volume lie, in the memory of few: boxes around blocks of elements.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/outline.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace elvis {

using ElementBox = BoxPieces::Box;

class BoxBlocks final : public BoxPieces {
public:
    /** Reads the bounds of all elements, block by block. All must outlive it. */
    BoxBlocks(const RuntimeVolume& volume, Background& background, const TaskControl* control);

    const ElementBox& bounds() const override { return m_bounds; }
    void for_each(const std::function<bool(const ElementBox& around)>& matters,
                  const std::function<void(std::uint64_t first, std::span<const double> boxes)>& look) const override;
    /**
     * Ascending: for each class and direction along an axis an element that reaches farthest. A selection with these has the
     * bounds of the whole, and each of its classes that of the class.
     */
    const std::vector<std::uint64_t>& farthest() const { return m_farthest; }

    /**
     * Elements whose box meets, ascending. `meets` is asked of blocks' boxes first, may be asked by several threads at once,
     * and is true of a box that holds one of which it is true. Bounds are read again only where a block meets. Throws
     * TooManyElements once there are more than `most`.
     */
    std::vector<std::uint64_t> elements_that(const std::function<bool(const ElementBox&)>& meets, std::uint64_t most) const;

private:
    struct Block {
        std::uint64_t first = 0, count = 0;
        ElementBox box{};
    };
    struct Farthest {
        std::array<double, 6> reach{};
        std::array<std::uint64_t, 6> elements{};
    };

    void read(Block& block, Farthest& farthest);

    const RuntimeVolume& m_volume;
    Background& m_background;
    const TaskControl* m_control;
    std::vector<Block> m_blocks;
    ElementBox m_bounds{};
    std::vector<std::uint64_t> m_farthest;
};

} // namespace elvis
