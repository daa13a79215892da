#include <core/integrate/domain_parts.hpp>

#include <core/base/error.hpp>
#include <core/plugin_host/all_bounds.hpp>
#include <core/volume/boundary/element_faces.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace elvis {

namespace {

/** Elements whose boxes or ranges are asked of the plugin at once. */
constexpr std::uint64_t elements_at_once = 4096;

std::vector<DomainPart> all_elements(const RuntimeVolume& volume) {
    std::vector<DomainPart> parts;
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        for (std::uint64_t local = 0; local < info.n_elements; ++local) {
            parts.push_back({info.first_element + local, {info.shape, -1}, index});
        }
    }
    return parts;
}

std::uint32_t class_of(const RuntimeVolume& volume, std::uint64_t element) {
    std::uint32_t index = 0;
    while (element - volume.classes()[index].first_element >= volume.classes()[index].n_elements) {
        ++index;
    }
    return index;
}

std::vector<DomainPart> faces_of(const RuntimeVolume& volume, const std::vector<std::string>& groups,
                                 const TaskControl& control) {
    std::vector<DomainPart> parts;
    for (const ElementFace& face : boundary_faces(volume, groups, &control)) {
        const std::uint32_t index = class_of(volume, face.element);
        parts.push_back({face.element, {volume.classes()[index].shape, static_cast<int>(face.local_face)}, index});
    }
    return parts;
}

std::string plane_text(const std::array<double, 4>& plane) {
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "(%.17g) * x + (%.17g) * y + (%.17g) * z", plane[0], plane[1], plane[2]);
    return text.data();
}

/** The box of an element, against a plane. */
bool box_meets(std::span<const double> box, const std::array<double, 4>& plane) {
    double lower = plane[3], upper = plane[3], size = std::abs(plane[3]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double a = plane[axis] * box[axis], b = plane[axis] * box[3 + axis];
        lower += std::min(a, b);
        upper += std::max(a, b);
        size += std::max(std::abs(a), std::abs(b));
    }
    // Coordinates are rounded, and a box may end in the plane.
    const double rounding = 1e-12 * size;
    return lower <= rounding && upper >= -rounding;
}

/** Ranges of a field's component, elements_at_once by elements_at_once, when asked for in the order of elements. */
class Ranges {
public:
    Ranges(const RuntimeVolume& volume, const Expression::PlainField& field, std::uint32_t time_step)
        : m_volume(volume), m_field(field), m_time_step(time_step), m_n_components(volume.fields()[field.field].n_components) {}

    const FieldRange& of(std::uint64_t element) {
        if (element - m_first >= m_ranges.size() / m_n_components) {
            m_first = element;
            const std::uint64_t count = std::min(elements_at_once, m_volume.n_elements() - element);
            m_ranges.resize(count * m_n_components);
            m_is_certified = m_volume.field_ranges(m_field.field, m_time_step, element, count, m_ranges) == ELVIS_CERTIFIED;
        }
        return m_ranges[(element - m_first) * m_n_components + static_cast<std::size_t>(m_field.component)];
    }
    bool is_certified() const { return m_is_certified; }

private:
    const RuntimeVolume& m_volume;
    Expression::PlainField m_field;
    std::uint32_t m_time_step;
    std::size_t m_n_components;
    std::uint64_t m_first = 0;
    std::vector<FieldRange> m_ranges;
    bool m_is_certified = false;
};

std::vector<DomainPart> parts_in_plane_boxes(const RuntimeVolume& volume, const std::array<double, 4>& plane,
                                             const std::vector<DomainPart>& parts) {
    const std::vector<double> boxes = all_bounds(volume);
    std::vector<DomainPart> met;
    for (const DomainPart& part : parts) {
        if (box_meets(std::span(boxes).subspan(6 * part.element, 6), plane)) {
            met.push_back(part);
        }
    }
    return met;
}

} // namespace

std::vector<DomainPart> domain_parts(const RuntimeVolume& volume, const IntegralRequest& request, const TaskControl& control) {
    return request.domain == IntegralRequest::Domain::boundary ? faces_of(volume, request.groups, control)
                                                               : all_elements(volume);
}

LevelSet level_set(const RuntimeVolume& volume, const IntegralRequest& request) {
    const bool is_plane = request.domain == IntegralRequest::Domain::plane;
    const std::string text = is_plane ? plane_text(request.plane) : request.level_field;
    LevelSet level{std::make_shared<const Expression>(text, volume.fields(), volume.dimension()),
                   is_plane ? -request.plane[3] : request.isovalue};
    std::ranges::for_each(level.expression->fields(), [&](std::uint32_t field) { volume.need_own(field); });
    if (!level.expression->gradient()) {
        throw Error(text, "has no gradient that could be evaluated, which integrals over its isosurfaces need");
    }
    return level;
}

std::vector<DomainPart> met_parts(const RuntimeVolume& volume, const IntegralRequest& request, const LevelSet& level,
                                  std::vector<DomainPart> parts) {
    if (request.domain == IntegralRequest::Domain::plane) {
        return parts_in_plane_boxes(volume, request.plane, parts);
    }
    const std::optional<Expression::PlainField>& plain = level.expression->plain();
    if (!plain || plain->component < 0 || !volume.has_field_ranges()) {
        return parts;
    }
    Ranges ranges(volume, *plain, request.time_step);
    std::erase_if(parts, [&](const DomainPart& part) {
        const FieldRange& range = ranges.of(part.element);
        return ranges.is_certified() && (range.lower > level.isovalue || range.upper < level.isovalue);
    });
    return parts;
}

} // namespace elvis
