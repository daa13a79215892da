/**
 * @file transfer.hpp
 * Transfer functions of scenes, from what is said of them in several ways.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <array>
#include <span>
#include <string>

namespace elvis {

/**
 * Reads {"color": [[value, r, g, b], ..], "density": [[value, density], ..]} or ParaView's JSON, by content. Throws Error
 * naming file, place and cause.
 */
TransferFunction read_transfer_file(const std::string& path);

/**
 * Adds the peaks' density to that of `transfer`, whose list of densities may be empty for none. Where a peak with a colour adds
 * to something else, the colour is the mean by density, within 1e-4.
 */
void add_peaks(std::span<const ScenePeak> peaks, TransferFunction& transfer);

/** Density at the upper end of the range if nothing is said of it: 5 % of the light are left after `diagonal`. */
double default_density(double diagonal);

/**
 * The transfer function of a scene's volume rendering. `map` with values from `range` colours it where no transfer function is
 * given as a whole; `diagonal` of the volume's bounds is for the default density.
 */
TransferFunction make_transfer_function(const SceneVolumeRendering& scene, const SceneColorMap& map,
                                        const std::array<double, 2>& range, double diagonal);

} // namespace elvis
