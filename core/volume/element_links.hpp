/**
 * @file element_links.hpp
 * What rays on their way through the elements of a class read beside the hierarchy: neighbours, and what is in a node.
 */
#pragma once

#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/vulkan/buffer.hpp>

#include <memory>
#include <span>

namespace elvis {

struct ElementLinks {
    /** For each element, by local face, the neighbour's position in the class; all bits where there is none, or in another class;
     *  last the bits of its mapping's curvature. */
    std::unique_ptr<RecordBuffer> links;
    /** For each node: range of the field, as bits of floats, and 1 if an element has a face without such a neighbour. */
    std::unique_ptr<RecordBuffer> node_marks;
};

/**
 * `ranges`: lower and upper bound of the field in each element of the class, NaN where one is not known; none at all if there are
 * none.
 */
ElementLinks make_element_links(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                const Hierarchy& hierarchy, std::span<const float> curvatures,
                                std::span<const double> ranges, Precision precision);

} // namespace elvis
