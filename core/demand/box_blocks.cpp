#include <core/demand/box_blocks.hpp>

#include <core/base/infinity.hpp>
#include <core/demand/elements_in_blocks.hpp>

#include <algorithm>

namespace elvis {

namespace {

/** 200 KiB of bounds; a ten-millionth of a volume of many elements. */
constexpr std::uint64_t elements_a_block = 4096;

constexpr ElementBox nowhere{infinity, infinity, infinity, -infinity, -infinity, -infinity};

void include(ElementBox& box, const ElementBox& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis] = std::min(box[axis], other[axis]);
        box[axis + 3] = std::max(box[axis + 3], other[axis + 3]);
    }
}

/** How far a box reaches along the axes, towards smaller coordinates first. */
double reach_of(const ElementBox& box, std::size_t direction) { return direction < 3 ? -box[direction] : box[direction]; }

ElementBox box_at(std::span<const double> boxes, std::uint64_t element) {
    ElementBox box{};
    std::copy_n(boxes.begin() + static_cast<std::ptrdiff_t>(6 * element), box.size(), box.begin());
    return box;
}

} // namespace

BoxBlocks::BoxBlocks(const RuntimeVolume& volume, Background& background, const TaskControl* control)
    : m_volume(volume), m_background(background), m_control(control), m_bounds(nowhere) {
    for (const ClassInfo& info : volume.classes()) {
        const std::size_t first_block = m_blocks.size();
        for (std::uint64_t done = 0; done < info.n_elements; done += elements_a_block) {
            m_blocks.push_back({info.first_element + done, std::min(elements_a_block, info.n_elements - done), nowhere});
        }
        const std::size_t n_blocks = m_blocks.size() - first_block;
        std::vector<Farthest> farthest(n_blocks);
        in_blocks(background, n_blocks, control,
                  [&](std::uint64_t index) { read(m_blocks[first_block + index], farthest[index]); });
        for (std::size_t direction = 0; direction < 6 && n_blocks > 0; ++direction) {
            const auto best = std::ranges::max_element(
                farthest, {}, [direction](const Farthest& of_block) { return of_block.reach[direction]; });
            m_farthest.push_back(best->elements[direction]);
        }
    }
    for (const Block& block : m_blocks) {
        include(m_bounds, block.box);
    }
    std::ranges::sort(m_farthest);
    const auto repeated = std::ranges::unique(m_farthest);
    m_farthest.erase(repeated.begin(), repeated.end());
}

void BoxBlocks::read(Block& block, Farthest& farthest) {
    std::vector<double> boxes(6 * block.count);
    m_volume.bounds(block.first, block.count, boxes);
    farthest.reach.fill(-infinity);
    for (std::uint64_t at = 0; at < block.count; ++at) {
        const ElementBox box = box_at(boxes, at);
        include(block.box, box);
        for (std::size_t direction = 0; direction < 6; ++direction) {
            if (reach_of(box, direction) > farthest.reach[direction]) {
                farthest.reach[direction] = reach_of(box, direction);
                farthest.elements[direction] = block.first + at;
            }
        }
    }
}

void BoxBlocks::for_each(const std::function<bool(const ElementBox& around)>& matters,
                         const std::function<void(std::uint64_t first, std::span<const double> boxes)>& look) const {
    std::vector<double> boxes;
    for (const Block& block : m_blocks) {
        if (matters(block.box)) {
            if (m_control != nullptr) {
                m_control->check();
            }
            boxes.resize(6 * block.count);
            m_volume.bounds(block.first, block.count, boxes);
            look(block.first, boxes);
        }
    }
}

std::vector<std::uint64_t> BoxBlocks::elements_that(const std::function<bool(const ElementBox&)>& meets,
                                                    std::uint64_t most) const {
    return elements_in_blocks(m_background, m_blocks.size(), most, m_control,
                              [&](std::uint64_t index, std::vector<std::uint64_t>& found) {
                                  const Block& block = m_blocks[index];
                                  if (!meets(block.box)) {
                                      return;
                                  }
                                  std::vector<double> boxes(6 * block.count);
                                  m_volume.bounds(block.first, block.count, boxes);
                                  for (std::uint64_t at = 0; at < block.count; ++at) {
                                      if (meets(box_at(boxes, at))) {
                                          found.push_back(block.first + at);
                                      }
                                  }
                              });
}

} // namespace elvis
