/**
 * @file topology.hpp
 * Which faces of a mesh are shared by whom.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/convert/topology/corners.hpp>
#include <core/convert/topology/face_points.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace elvis {

/** Names a side of a face: an element and its local face. */
using FaceSide = std::uint64_t;
inline FaceSide face_side(std::uint64_t element, int local_face) {
    return 8 * element + static_cast<std::uint64_t>(local_face);
}

struct Topology {
    static constexpr std::uint32_t no_neighbour = 0xffffffffu;
    static constexpr std::uint32_t unknown_neighbour = 0xfffffffeu;

    std::vector<elvis_shape> shapes;
    Corners corners;
    /** By source element and local face: the element on the other side, or one of the codes above. */
    std::vector<std::array<std::uint32_t, 6>> neighbour;
    /** Its local face there. */
    std::vector<std::array<std::uint8_t, 6>> neighbour_face;
    /**
     * Shared faces whose maps coincide within the tolerance only: for the side with the higher number, the steps from its
     * positions at the face's points to those of the other side, three numbers a point in the agreed order (FacePoints::order).
     */
    std::unordered_map<FaceSide, std::vector<double>> steps;

    std::uint64_t n_faces = 0;
    std::uint64_t n_boundary = 0;
    std::uint64_t n_unknown = 0;

    bool is_shared(std::uint64_t element, int local_face) const {
        return neighbour[element][static_cast<std::size_t>(local_face)] < unknown_neighbour;
    }
    /** The other side of a shared face. */
    FaceSide other_side(std::uint64_t element, int local_face) const {
        const auto local = static_cast<std::size_t>(local_face);
        return face_side(neighbour[element][local], neighbour_face[element][local]);
    }
};

/**
 * Two faces with the same corners are one if their maps coincide at the face's points, within ten times the corner tolerance.
 * Where they do not, the neighbours are unknown; if they lie apart altogether, they are periodic partners and both boundary.
 * Where more than two meet, and where unpaired faces that belong to no boundary group cover each other (hanging nodes),
 * neighbours are unknown.
 */
Topology find_topology(const SourceVolume& source, std::vector<elvis_shape> shapes, const TaskControl& control);

} // namespace elvis
