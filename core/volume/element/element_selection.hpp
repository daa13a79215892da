/**
 * @file element_selection.hpp
 * Elements chosen by number or by what they are, and their faces.
 */
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace elvis {

class RuntimeVolume;
struct TaskControl;
struct ElementFace;

/** Elements for which all conditions hold that are given; all elements if none is. */
struct ElementSelection {
    /** Of the chosen elements: all faces, those to elements that are not chosen, those between chosen ones. */
    enum class Faces { all, outer, inner };
    Faces faces = Faces::all;

    /** First and last of each range of element numbers. */
    std::vector<std::array<std::uint64_t, 2>> numbers{};
    /** ELVIS_SHAPE_... */
    std::vector<std::uint32_t> shapes{};
    /** Least and largest order of `field`: of an element, the largest over its directions. */
    std::optional<std::array<std::int32_t, 2>> orders{};
    /** The Jacobian determinant is negative somewhere for sure (core/volume/element/jacobian_check.hpp). */
    bool has_negative_jacobian = false;
    /** The range of `field` in the element meets this one; whatever certainty the plugin's ranges have. */
    std::optional<std::array<double, 2>> value_range{};
    /** Bounds of the element meet this box: two corners. */
    std::optional<std::array<double, 6>> box{};

    /** Of the orders and the value range. Component -1: the length of the vector. */
    std::uint32_t field = 0;
    std::int32_t component = 0;
    std::uint32_t time_step = 0;
    /** Values on the two sides of a face may differ: then both sides are drawn, and the viewer's one is seen. */
    bool is_two_sided = false;
    /**
     * Of a part of a volume: numbers of its own elements, ascending. Faces of those around them of which the other side is not
     * in the part are not drawn, since that side may be chosen; and no element need be.
     */
    std::shared_ptr<const std::vector<std::int64_t>> own{};

    auto operator<=>(const ElementSelection&) const = default;
};

/** One flag an element. An Error if the volume does not tell what a condition needs. */
std::vector<bool> chosen_elements(const RuntimeVolume& volume, const ElementSelection& selection, const TaskControl* control);

/**
 * Faces of the chosen elements, in the order of elements; of two-dimensional volumes the elements themselves. An Error if no
 * element is chosen, or if the volume does not tell its faces.
 */
std::vector<ElementFace> faces_of_elements(const RuntimeVolume& volume, const ElementSelection& selection,
                                           const TaskControl* control);

} // namespace elvis
