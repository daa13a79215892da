/**
 * @file topology.hpp
 * The faces of a mesh and who shares them.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/convert/corners.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <elvis/native/volume_file.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace elvis {

struct Topology {
    std::vector<native::Face> faces;
    /** Index of the face at each local face of each element; faces without one have no_face. */
    static constexpr std::uint32_t no_face = 0xffffffffu;
    std::vector<std::array<std::uint32_t, 6>> of_element;
    Corners corners;
    std::uint64_t n_unknown = 0;
};

/**
 * Two faces with the same corners are one face if their maps coincide at points inside it, within ten times the corner
 * tolerance; else, and where more than two meet, their neighbours are unknown. Boundary groups are taken from the source.
 */
Topology find_topology(const SourceVolume& source, const std::vector<elvis_shape>& shapes, const TaskControl& control);

} // namespace elvis
