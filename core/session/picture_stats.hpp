/**
 * @file picture_stats.hpp
 * What `elvis render` says of the pictures that it has drawn.
 */
#pragma once

#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <nlohmann/json.hpp>

#include <vector>

namespace elvis {

nlohmann::ordered_json counts_json(const FrameCounts& counts);

/** Of --stats; times of loading and of the whole in milliseconds, and those of repeated frames. */
nlohmann::ordered_json stats_json(const Device& device, Precision precision, const Frame& frame, const Renderer& renderer,
                                  double load, double total, const std::vector<double>& repeated);

} // namespace elvis
