/**
 * @file frame_request.hpp
 * From a scene, which leaves much open, to what the renderer is asked for.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/picture_ranges.hpp>
#include <core/scene/scene.hpp>

namespace elvis {

/**
 * A field by its name, or an expression over fields (core/expression/expression.hpp); the first field of the volume if there is
 * no text.
 */
FieldChoice choose_field(const RuntimeVolume& volume, const std::optional<std::string>& text);

/** The scene's surfaces that are drawn; what default_surfaces.hpp says if it shows nothing, or undeformed edges alone, before
 * them.
 */
std::vector<SceneSurface> drawn_surfaces(const Scene& scene, const RuntimeVolume& volume, PictureRanges& ranges);

/** The surface's geometry, with what it takes from its field and the volume. */
SurfaceGeometry complete_geometry(const SceneSurface& own, const Scene& scene, const RuntimeVolume& volume);

/**
 * The frame with everything decided. Without surfaces and volume rendering, the scene shows what default_surfaces.hpp says.
 * Throws Error where the scene does not suit the volume.
 */
FrameRequest make_frame_request(const Scene& scene, const RuntimeVolume& volume, PictureRanges& ranges);

} // namespace elvis
