/**
 * @file drawn_part.hpp
 * A part of a volume on a device.
 */
#pragma once

#include <core/parts/partition.hpp>
#include <core/render/renderer.hpp>
#include <core/session/volume/warped.hpp>

#include <elvis/native/serve.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** Some elements of a volume as a volume of their own, with what draws them. */
class DrawnElements {
public:
    /** `name` stands for the volume in messages; `bounds` are those of the whole. */
    DrawnElements(std::shared_ptr<const native::VolumeSource> source, const std::string& name, const Device& device,
                  Precision precision, const TaskControl* control, const std::array<double, 6>& bounds)
        : m_volume(serve_native(std::move(source), name, control, &m_served)),
          m_renderer(device, m_volume, precision, control, bounds) {}

    const RuntimeVolume& volume() const { return m_volume; }
    Renderer& renderer() { return m_renderer; }
    const Renderer& renderer() const { return m_renderer; }

    /** Values of these fields have changed. */
    void forget_fields(std::span<const std::uint32_t> fields) {
        native::forget_fields(m_served);
        for (const std::uint32_t field : fields) {
            m_renderer.forget_fields(field);
        }
    }

private:
    elvis_volume* m_served = nullptr;
    RuntimeVolume m_volume;
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
