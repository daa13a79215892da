/**
 * @file threshold.hpp
 * Which part of the volume a scene shows: where comparisons of expressions hold.
 */
#pragma once

#include <core/render/surface.hpp>
#include <core/scene/scene.hpp>

#include <string>
#include <vector>

namespace elvis {

/**
 * The comparisons (< <= > >=) that `text` joins by &&; distances are to surfaces of the scene. Where one side is a number, the
 * field is the other side as it is, with the bounds that it has; else it is their difference. Throws Error for what is no
 * expression, and for one that is anything else.
 */
std::vector<Condition> threshold_conditions(const std::string& text, const Scene& scene, const RuntimeVolume& volume);

/**
 * What a picture shows ends where the scene's threshold does, if it has one. Edges stay whole, as an outline. Density is left
 * only where the threshold holds; an Error where that is not a matter of the field that volume rendering shows. A remark where
 * the threshold may leave what is shown open.
 */
void apply_threshold(const Scene& scene, const RuntimeVolume& volume, FrameRequest& request);

} // namespace elvis
