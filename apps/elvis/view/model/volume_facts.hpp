/**
 * @file volume_facts.hpp
 * What panels need to know of a volume, copied so that they never wait for those who work with it.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/resolve.hpp>

#include <elvis/elvis.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::view {

struct VolumeFacts {
    std::string path;
    std::string plugin;
    std::uint32_t dimension = 3;
    std::uint64_t n_elements = 0;
    std::array<double, 6> bounds{}; ///< min x y z, max x y z
    std::vector<Vector3> outline;   ///< ELVIS_DESCRIBE_OUTLINE
    std::vector<FieldInfo> fields;
    std::vector<double> times;
    std::vector<std::string> boundary_groups;
    bool has_faces = false;
    std::vector<std::uint32_t> shapes; ///< ELVIS_SHAPE_..., each once

    double diagonal() const;
    VolumeExtent extent() const { return {bounds, outline}; }
};

VolumeFacts facts_of(const data& volume, const context& library);

} // namespace elvis::view
