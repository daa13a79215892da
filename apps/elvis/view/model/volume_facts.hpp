/**
 * @file volume_facts.hpp
 * What panels need to know of a volume, copied so that they never wait for those who work with it.
 */
#pragma once

#include <apps/elvis/view/scene/scene.hpp>

#include <core/base/vector3.hpp>

#include <elvis/elvis.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::view {

struct FieldFacts {
    std::string name, unit;
    std::uint32_t n_components = 1;
};

struct VolumeFacts {
    std::string path;
    std::string plugin;
    std::uint32_t dimension = 3;
    std::uint64_t n_elements = 0;
    std::array<double, 6> bounds{};       ///< min x y z, max x y z
    std::array<double, 6> shown_bounds{}; ///< with the scene's further volumes, where they stand
    std::vector<Vector3> outline;         ///< ELVIS_DESCRIBE_OUTLINE, of all these volumes
    std::vector<FieldFacts> fields;
    std::vector<double> times;
    std::vector<std::string> boundary_groups;
    bool has_faces = false;
    std::vector<std::string> shapes; ///< names, each once

    double diagonal() const;
    /** What its camera is to show; valid as long as these facts. */
    elvis_extent extent() const;
};

VolumeFacts facts_of(const data& volume, const context& library);

/** Lets the camera see the scene's further volumes, too. Opens those that are files. `folder`: that paths are relative to. */
void add_further_volumes(VolumeFacts& facts, const context& library, const Scene& scene, const std::string& folder = {});

} // namespace elvis::view
