/**
 * @file edge_set.hpp
 * Edges of faces as curves in the world.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/boundary/element_faces.hpp>
#include <core/volume/device_volume.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/**
 * The edges of chosen faces, each once if the elements at it conform. An edge is a polynomial of one parameter, -1 to 1,
 * through samples of the mapping that the device computes in the precision of `data`; of mappings that are no polynomials, one
 * of higher order.
 */
class EdgeSet {
public:
    /** A field must be selected in `data`. */
    EdgeSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, std::span<const ElementFace> faces,
            const TaskControl* control);
    /** In double precision, of a volume that is not on a device but evaluates on the CPU. */
    EdgeSet(const RuntimeVolume& volume, std::span<const ElementFace> faces, const TaskControl* control);

    struct Edge {
        /** Of the element that has it; of several the first one. */
        std::uint32_t number = 0;
        /** Coefficients of T_0 .. T_order, three numbers each, begin here. */
        std::size_t first = 0;
        std::uint32_t order = 1;
    };
    std::span<const Edge> edges() const { return m_edges; }
    std::span<const double> coefficients(const Edge& edge) const {
        return std::span<const double>(m_coefficients).subspan(edge.first, 3 * (std::size_t{edge.order} + 1));
    }
    /** Of positions, for what is judged by size. */
    double rounding() const { return m_rounding; }

private:
    template <class Sampler>
    void add(const RuntimeVolume& volume, std::span<const ElementFace> faces, const std::array<double, 6>& bounds,
             const TaskControl* control, const Sampler& sampled);

    std::vector<Edge> m_edges;
    std::vector<double> m_coefficients;
    double m_rounding = 0;
};

} // namespace elvis
