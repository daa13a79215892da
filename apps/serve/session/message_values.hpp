/**
 * @file message_values.hpp
 * What messages of the page hold: numbers within bounds, points, sizes. Throws Error where they hold something else.
 */
#pragma once

#include <apps/elvis/view/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>

namespace elvis::serve {

/** Of pictures on the page, and of those that are saved: their memory is the server's. */
inline constexpr std::uint32_t most_pixels_across = 8192;

double number(const nlohmann::json& message, const char* key, double least, double most);
/** A coordinate in the picture, or a movement. */
double pixels(const nlohmann::json& message, const char* key);
PicturePoint place_of(const nlohmann::json& message, const char* key);
Vector3 vector_of(const nlohmann::json& message, const char* key);
Vector3 vector_of(const nlohmann::json& numbers);
/** Of "width" and "height". */
std::array<std::uint32_t, 2> size_of(const nlohmann::json& message);

/** A picture of that size must not have too many samples in all. */
void check_samples(const view::Scene& scene, const std::array<std::uint32_t, 2>& size);

} // namespace elvis::serve
