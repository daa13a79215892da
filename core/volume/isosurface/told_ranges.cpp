#include <core/volume/isosurface/told_ranges.hpp>

#include <core/base/in_parts.hpp>
#include <core/base/infinity.hpp>
#include <core/volume/field/field_extrema.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Elements that a thread asks about at once. */
constexpr std::uint64_t elements_a_part = 16384;
/** Sixteen roundings in single precision: evaluations of orders up to 10 show eight. */
constexpr double roundings = 0x1p-20;

} // namespace

FieldRange ToldField::range_of(std::span<const FieldRange> components) const {
    return component < 0 ? magnitude_range(components) : components[static_cast<std::size_t>(component)];
}

bool holds_any(const FieldRange& range, std::span<const double> values) {
    const auto first = std::ranges::lower_bound(values, range.lower);
    return !(range.lower <= range.upper) || (first != values.end() && *first <= range.upper);
}

FieldRange beyond_rounding(const FieldRange& range, double offset) {
    const double beyond = roundings * (std::max(std::abs(range.lower), std::abs(range.upper)) + std::abs(offset));
    return {range.lower - beyond, range.upper + beyond};
}

std::vector<FieldRange> told_ranges(Background& background, const RuntimeVolume& volume, std::uint32_t element_class,
                                    const ToldField& field, const std::function<void()>& check) {
    if (!volume.has_field_ranges()) {
        return {};
    }
    const ClassInfo& info = volume.classes()[element_class];
    const std::size_t n_components = volume.fields()[field.field].n_components;
    std::vector<FieldRange> told(info.n_elements, FieldRange{-infinity, infinity});
    const auto ask = [&](std::uint64_t first, std::uint64_t count) {
        std::vector<FieldRange> ranges(count * n_components);
        if (volume.field_ranges(field.field, field.time_step, info.first_element + first, count, ranges) != ELVIS_CERTIFIED) {
            return;
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            const FieldRange own = field.range_of(std::span(ranges).subspan(i * n_components, n_components));
            const FieldRange wide = beyond_rounding(own, field.offset);
            told[first + i] = {wide.lower - field.offset, wide.upper - field.offset};
        }
    };
    in_parts(background, info.n_elements, elements_a_part, ask, check);
    return told;
}

} // namespace elvis
