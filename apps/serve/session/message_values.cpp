#include "message_values.hpp"

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace elvis::serve {

namespace {

using nlohmann::json;

/** With all samples of a pixel: full HD with 8 by 8. */
constexpr std::uint64_t most_samples = 128u << 20u;
/** Farther out of the picture is no hand. */
constexpr double most_pixels_away = 1e5;

} // namespace

double number(const json& message, const char* key, double least, double most) {
    const json& value = message.at(key);
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < least ||
        value.get<double>() > most) {
        throw Error("'" + std::string(key) + "' is no number from " + json(least).dump() + " to " + json(most).dump());
    }
    return value.get<double>();
}

double pixels(const json& message, const char* key) { return number(message, key, -most_pixels_away, most_pixels_away); }

PicturePoint place_of(const json& message, const char* key) {
    const auto numbers = message.at(key).get<std::vector<double>>();
    // What is no number compares false.
    if (numbers.size() != 2 || !std::ranges::all_of(numbers, [](double x) { return std::abs(x) <= most_pixels_away; })) {
        throw Error("'" + std::string(key) + "' is no place in the picture");
    }
    return {numbers[0], numbers[1]};
}

Vector3 vector_of(const json& numbers) {
    const auto all = numbers.get<std::vector<double>>();
    if (all.size() != 3 || !std::ranges::all_of(all, [](double x) { return std::isfinite(x); })) {
        throw Error(numbers.dump() + " are not three numbers");
    }
    return {all[0], all[1], all[2]};
}

Vector3 vector_of(const json& message, const char* key) {
    try {
        return vector_of(message.at(key));
    } catch (const Error& error) {
        throw Error("'" + std::string(key) + "': " + error.what());
    }
}

std::array<std::uint32_t, 2> size_of(const json& message) {
    return {static_cast<std::uint32_t>(number(message, "width", 1, most_pixels_across)),
            static_cast<std::uint32_t>(number(message, "height", 1, most_pixels_across))};
}

void check_samples(const view::Scene& scene, const std::array<std::uint32_t, 2>& size) {
    const std::uint64_t samples = view::part_of(scene, "image").value("samples", 1u);
    if (std::uint64_t{size[0]} * size[1] * samples * samples > most_samples) {
        throw Error("the picture would have too many samples: 'image.samples' times its size");
    }
}

} // namespace elvis::serve
