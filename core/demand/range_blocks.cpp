#include <core/demand/range_blocks.hpp>

#include <core/base/infinity.hpp>
#include <core/demand/elements_in_blocks.hpp>
#include <core/volume/isosurface/told_ranges.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace elvis {

namespace {

constexpr std::uint64_t ranges_a_block = 4096;
constexpr FieldRange no_values{infinity, -infinity};

void widen(FieldRange& range, const FieldRange& other) {
    range = {std::min(range.lower, other.lower), std::max(range.upper, other.upper)};
}

bool is_finite(const FieldRange& range) { return std::isfinite(range.lower) && std::isfinite(range.upper); }

} // namespace

RangeBlocks::RangeBlocks(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step, Background& background,
                         const TaskControl* control)
    : m_volume(volume), m_field(field), m_time_step(time_step), m_n_components(volume.fields()[field].n_components),
      m_background(background), m_control(control),
      m_blocks((volume.n_elements() + ranges_a_block - 1) / ranges_a_block * m_n_components, no_values),
      m_total(std::vector<FieldRange>(m_n_components, no_values), ELVIS_CERTIFIED) {
    std::mutex mutex;
    in_blocks(background, m_blocks.size() / m_n_components, control, [&](std::uint64_t block) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        const std::vector<FieldRange> ranges = read(block, certainty);
        std::vector<FieldRange> finite(m_n_components, no_values);
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            widen(m_blocks[block * m_n_components + i % m_n_components], ranges[i]);
            if (is_finite(ranges[i])) {
                widen(finite[i % m_n_components], ranges[i]);
            }
        }
        const std::lock_guard lock(mutex);
        m_total.second = std::max(m_total.second, certainty);
        for (std::size_t component = 0; component < m_n_components; ++component) {
            widen(m_total.first[component], finite[component]);
        }
    });
}

std::uint64_t RangeBlocks::n_in(std::uint64_t block) const {
    return std::min(ranges_a_block, m_volume.n_elements() - block * ranges_a_block);
}

std::vector<FieldRange> RangeBlocks::read(std::uint64_t block, elvis_certainty& certainty) const {
    std::vector<FieldRange> ranges(n_in(block) * m_n_components);
    certainty = m_volume.field_ranges(m_field, m_time_step, block * ranges_a_block, n_in(block), ranges);
    return ranges;
}

std::vector<std::uint64_t> RangeBlocks::elements_with(std::span<const double> values, std::int32_t component,
                                                      std::uint64_t most) const {
    // What it lacks at most: a value in its range, or one of the isovalues.
    double largest = std::max(std::abs(values.front()), std::abs(values.back()));
    for (const FieldRange& range : m_total.first) {
        largest = std::max({largest, std::abs(range.lower), std::abs(range.upper)});
    }
    const ToldField field{m_field, component, m_time_step, 0};
    // Twice that: what is lacking is rounded, too.
    const auto may_hold = [&](std::span<const FieldRange> ranges, std::size_t at) {
        const FieldRange own = field.range_of(ranges.subspan(at * m_n_components, m_n_components));
        return holds_any(beyond_rounding(own, 2 * largest), values);
    };
    return elements_in_blocks(m_background, m_blocks.size() / m_n_components, most, m_control,
                              [&](std::uint64_t block, std::vector<std::uint64_t>& found) {
                                  if (!may_hold(m_blocks, block)) {
                                      return;
                                  }
                                  elvis_certainty certainty = ELVIS_ESTIMATED;
                                  const std::vector<FieldRange> ranges = read(block, certainty);
                                  for (std::uint64_t i = 0; i < n_in(block); ++i) {
                                      if (may_hold(ranges, i)) {
                                          found.push_back(block * ranges_a_block + i);
                                      }
                                  }
                              });
}

} // namespace elvis
