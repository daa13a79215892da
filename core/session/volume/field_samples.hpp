/**
 * @file field_samples.hpp
 * Values of a field at points spread evenly over the volume, so that each counts by the space it takes: what histograms and
 * percentiles are made of.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/quantile.hpp>
#include <core/probe/probe.hpp>
#include <core/scene/scene.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace elvis {

/** Points are taken in pieces of so many; all of them together are what percentiles rest on. */
inline constexpr std::size_t n_points_a_piece = 500;
inline constexpr unsigned n_pieces = 24;

/** A volume of three dimensions, or of two in a plane of constant z; or an Error. */
void need_samples(const RuntimeVolume& volume);

/**
 * Finite values at the scene's time step, of the points of one piece that lie in elements; the volume's first field if there is
 * no text. Equal pieces have equal points in equal bounds.
 */
std::vector<double> field_samples(Prober& prober, const RuntimeVolume& volume, const std::array<double, 6>& bounds,
                                  const Scene& scene, const std::optional<std::string>& field, unsigned piece);

/**
 * Values of the scene's field below which these parts of the volume lie, over the scene's range steps. Throws Error where
 * nothing of it could be sampled.
 */
std::vector<double> percentiles(Prober& prober, const RuntimeVolume& volume, const std::array<double, 6>& bounds,
                                const Scene& scene, std::span<const double> parts, const TaskControl& control);

} // namespace elvis
