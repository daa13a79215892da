#include <core/base/cancel.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/boundary/element_faces.hpp>
#include <core/volume/element/element_selection.hpp>
#include <core/volume/element/jacobian_check.hpp>
#include <core/volume/field/field_extrema.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace elvis {

namespace {

/** Elements, or faces, asked of the plugin at once. */
constexpr std::uint64_t selection_block = 65536;

/** Calls `visit` with first and count of blocks; stops as `control` says. */
template <class Visit> void for_blocks(std::uint64_t n, const TaskControl* control, const Visit& visit) {
    for (std::uint64_t first = 0; first < n; first += selection_block) {
        if (control) {
            control->check();
        }
        visit(first, std::min(selection_block, n - first));
    }
}

void keep_numbers(const RuntimeVolume& volume, const ElementSelection& selection, std::vector<bool>& chosen,
                  const TaskControl* control) {
    std::vector<std::int64_t> numbers;
    for_blocks(volume.n_elements(), control, [&](std::uint64_t first, std::uint64_t count) {
        numbers.resize(count);
        volume.element_numbers(first, count, numbers);
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto number = static_cast<std::uint64_t>(numbers[i]);
            chosen[first + i] = chosen[first + i] && std::ranges::any_of(selection.numbers, [number](const auto& range) {
                                    return range[0] <= number && number <= range[1];
                                });
        }
    });
}

void keep_classes(const RuntimeVolume& volume, const ElementSelection& selection, std::vector<bool>& chosen) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        bool is_kept = selection.shapes.empty() || std::ranges::find(selection.shapes, info.shape) != selection.shapes.end();
        if (selection.orders) {
            const ClassFieldInfo field = volume.class_field(index, selection.field);
            const std::int32_t order = *std::max_element(field.order, field.order + 3);
            is_kept = is_kept && (*selection.orders)[0] <= order && order <= (*selection.orders)[1];
        }
        for (std::uint64_t element = info.first_element; !is_kept && element < info.first_element + info.n_elements;
             ++element) {
            chosen[element] = false;
        }
    }
}

void keep_values(const RuntimeVolume& volume, const ElementSelection& selection, std::vector<bool>& chosen,
                 const TaskControl* control) {
    if (!volume.has_field_ranges()) {
        throw Error(volume.path(), "does not tell the ranges of fields in its elements, so that none can be chosen by value");
    }
    const std::size_t n_components = volume.fields()[selection.field].n_components;
    std::vector<FieldRange> ranges;
    for_blocks(volume.n_elements(), control, [&](std::uint64_t first, std::uint64_t count) {
        ranges.resize(count * n_components);
        volume.field_ranges(selection.field, selection.time_step, first, count, ranges);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::span<const FieldRange> own = std::span<const FieldRange>(ranges).subspan(i * n_components, n_components);
            const FieldRange range =
                selection.component < 0 ? magnitude_range(own) : own[static_cast<std::size_t>(selection.component)];
            // Ranges that are not finite exclude nothing.
            const bool is_outside = range.upper < (*selection.value_range)[0] || range.lower > (*selection.value_range)[1];
            chosen[first + i] = chosen[first + i] && !is_outside;
        }
    });
}

void keep_box(const RuntimeVolume& volume, const ElementSelection& selection, std::vector<bool>& chosen,
              const TaskControl* control) {
    std::vector<double> bounds;
    for_blocks(volume.n_elements(), control, [&](std::uint64_t first, std::uint64_t count) {
        bounds.resize(6 * count);
        volume.bounds(first, count, bounds);
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const bool is_outside =
                    bounds[6 * i + 3 + axis] < (*selection.box)[axis] || bounds[6 * i + axis] > (*selection.box)[3 + axis];
                chosen[first + i] = chosen[first + i] && !is_outside;
            }
        }
    });
}

void keep_negative(const RuntimeVolume& volume, std::vector<bool>& chosen, const TaskControl* control) {
    if (!can_check_jacobians(volume)) {
        throw Error(volume.path(), "has no Jacobian determinants to choose elements by");
    }
    const JacobianReport report = check_jacobians(volume, default_jacobian_tolerance, control);
    for (std::uint64_t element = 0; element < chosen.size(); ++element) {
        chosen[element] = chosen[element] && report.signs[element] == ELVIS_JACOBIAN_NEGATIVE;
    }
}

/** Of a part: faces behind which an element of another part may be chosen. */
class OpenFaces {
public:
    OpenFaces(const RuntimeVolume& volume, const ElementSelection& selection) : m_volume(volume), m_selection(selection) {}

    bool hold(const elvis_face& face) const {
        if (!m_selection.own || m_selection.faces == ElementSelection::Faces::all ||
            face.neighbour != ELVIS_NEIGHBOUR_UNKNOWN) {
            return false;
        }
        std::int64_t number = 0;
        m_volume.element_numbers(static_cast<std::uint64_t>(face.element), 1, std::span(&number, 1));
        return !std::ranges::binary_search(*m_selection.own, number);
    }

private:
    const RuntimeVolume& m_volume;
    const ElementSelection& m_selection;
};

bool is_before(const ElementFace& a, const ElementFace& b) {
    return a.element != b.element ? a.element < b.element : a.local_face < b.local_face;
}

} // namespace

std::vector<bool> chosen_elements(const RuntimeVolume& volume, const ElementSelection& selection, const TaskControl* control) {
    std::vector<bool> chosen(volume.n_elements(), true);
    if (!selection.numbers.empty()) {
        keep_numbers(volume, selection, chosen, control);
    }
    keep_classes(volume, selection, chosen);
    if (selection.box) {
        keep_box(volume, selection, chosen, control);
    }
    if (selection.value_range) {
        keep_values(volume, selection, chosen, control);
    }
    if (selection.has_negative_jacobian) {
        keep_negative(volume, chosen, control);
    }
    return chosen;
}

std::vector<ElementFace> faces_of_elements(const RuntimeVolume& volume, const ElementSelection& selection,
                                           const TaskControl* control) {
    const std::vector<bool> chosen = chosen_elements(volume, selection, control);
    if (!selection.own && std::ranges::find(chosen, true) == chosen.end()) {
        throw Error(volume.path(), "has no element for which all conditions hold");
    }
    std::vector<ElementFace> result;
    if (volume.dimension() == 2) {
        for (std::uint64_t element = 0; element < chosen.size(); ++element) {
            if (chosen[element]) {
                result.push_back({element, 0, false});
            }
        }
        return result;
    }
    if (volume.n_faces() == 0) {
        throw Error(volume.path(), "does not tell its faces, so that none of them can be drawn");
    }
    const OpenFaces open(volume, selection);
    std::vector<elvis_face> faces;
    for_blocks(volume.n_faces(), control, [&](std::uint64_t first, std::uint64_t count) {
        faces.resize(count);
        volume.faces(first, count, faces);
        for (const elvis_face& face : faces) {
            const bool is_own = chosen[static_cast<std::size_t>(face.element)];
            const bool is_other = face.neighbour >= 0 && chosen[static_cast<std::size_t>(face.neighbour)];
            const bool is_inner = is_own && is_other;
            const bool is_wanted = (selection.faces == ElementSelection::Faces::all ||
                                    (selection.faces == ElementSelection::Faces::inner) == is_inner) &&
                                   !open.hold(face);
            // Both sides have the same points; where the field does not jump, one is enough.
            const bool are_both = is_inner && selection.is_two_sided;
            if (is_own && is_wanted) {
                result.push_back(
                    {static_cast<std::uint64_t>(face.element), static_cast<std::uint32_t>(face.local_face), are_both});
            }
            if (is_other && is_wanted && (!is_own || are_both)) {
                result.push_back({static_cast<std::uint64_t>(face.neighbour),
                                  static_cast<std::uint32_t>(face.neighbour_local_face), are_both});
            }
        }
    });
    std::ranges::sort(result, is_before);
    if (!selection.own && result.empty()) {
        throw Error(volume.path(), "has no such faces of the chosen elements");
    }
    return result;
}

} // namespace elvis
