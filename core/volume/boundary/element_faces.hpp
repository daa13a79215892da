/**
 * @file element_faces.hpp
 * Faces of elements, chosen to be drawn.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

struct ElementFace {
    /** In the whole volume. */
    std::uint64_t element = 0;
    std::uint32_t local_face = 0;
    /** The face on the other side of it is among those drawn, too. */
    bool has_partner = false;
};

/**
 * Faces without a neighbour, of the named boundary groups or of all if there are none; an unknown name, and a volume that does
 * not tell its faces, are errors. In the order of elements.
 */
std::vector<ElementFace> boundary_faces(const RuntimeVolume& volume, const std::vector<std::string>& groups,
                                        const TaskControl* control);

/** The elements of a two-dimensional volume. */
std::vector<ElementFace> surface_elements(const RuntimeVolume& volume);

} // namespace elvis
