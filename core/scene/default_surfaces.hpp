/**
 * @file default_surfaces.hpp
 * What a picture shows of a volume of which nothing else is said.
 */
#pragma once

#include <core/render/field/picture_ranges.hpp>
#include <core/scene/scene.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** Whether the volume tells faces of any element, whichever process has it. */
bool has_faces(const RuntimeVolume& volume, PictureRanges& ranges);

/**
 * The elements of surfaces in two dimensions. Else the boundary, where the volume tells it; where the field hardly changes on
 * most of it (0.7 of its samples), as with a boundary condition of one value, cut open: a plane through the middle, and the
 * half of the boundary behind it as seen from the scene's eye. Without a boundary, the plane alone.
 */
std::vector<SceneSurface> default_surfaces(const SceneCamera& camera, const RuntimeVolume& volume, PictureRanges& ranges,
                                           const FieldChoice& field, std::uint32_t time_step);

} // namespace elvis
