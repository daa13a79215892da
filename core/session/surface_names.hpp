/**
 * @file surface_names.hpp
 * What surfaces are called in texts.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <string>

namespace elvis {

/** "cut plane", "boundary", "isosurface", "sphere". */
std::string kind_name(const SurfaceGeometry& geometry);

/**
 * "cut plane 0,0,1,5", "boundary 'inlet'", "sphere 'probe'": as the command line or the scene has it, without an isosurface's
 * values.
 */
std::string surface_name(const SceneSurface& surface);

} // namespace elvis
