/**
 * @file drawn_part.hpp
 * A part of a volume on a device.
 */
#pragma once

#include <core/parts/parted_volume.hpp>
#include <core/parts/partition.hpp>
#include <core/render/renderer.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace elvis {

/** Some elements of a volume as a volume of their own, with what draws them. */
class DrawnElements {
public:
    /** `bounds` are those of the whole. */
    DrawnElements(OpenedElements opened, const Device& device, Precision precision, const TaskControl* control,
                  const std::array<double, 6>& bounds)
        : m_opened(std::move(opened)), m_renderer(device, m_opened.volume, precision, control, bounds) {}

    const RuntimeVolume& volume() const { return m_opened.volume; }
    Renderer& renderer() { return m_renderer; }
    const Renderer& renderer() const { return m_renderer; }

    /** Values of these fields have changed. */
    void forget_fields(std::span<const std::uint32_t> fields) {
        m_opened.forget_fields();
        for (const std::uint32_t field : fields) {
            m_renderer.forget_fields(field);
        }
    }

private:
    OpenedElements m_opened;
    Renderer m_renderer;
};

/** Whether elements are some of a part's own, by their numbers. */
class OwnNumbers {
public:
    OwnNumbers(const RuntimeVolume& whole, std::span<const Span> runs) {
        std::vector<std::int64_t> numbers;
        for (const Span& run : runs) {
            numbers.resize(numbers.size() + run.size());
            whole.element_numbers(run.first, run.size(), std::span(numbers).last(run.size()));
        }
        std::ranges::sort(numbers);
        m_numbers = std::make_shared<const std::vector<std::int64_t>>(std::move(numbers));
    }
    bool hold(std::int64_t number) const { return std::ranges::binary_search(*m_numbers, number); }
    /** Ascending. */
    const std::shared_ptr<const std::vector<std::int64_t>>& all() const { return m_numbers; }

private:
    std::shared_ptr<const std::vector<std::int64_t>> m_numbers;
};

/** A part that holds elements, drawn with those around them. */
struct DrawnPart {
    std::uint32_t part;
    OwnNumbers own;
    std::unique_ptr<DrawnElements> elements;
};

/** A part without the elements around it. */
struct BarePart {
    std::uint32_t part;
    std::unique_ptr<DrawnElements> elements;
};

} // namespace elvis
