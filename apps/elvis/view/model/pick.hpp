/**
 * @file pick.hpp
 * What is known of a point that the user clicked on.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace elvis::view {

struct Picked {
    bool is_hit = false;
    /** If it is hit. */
    Vector3 position{};
    /** For people. */
    std::string text;
};

/** From what elvis_data_pick answers. */
Picked picked_of(const nlohmann::json& answer);

} // namespace elvis::view
