/**
 * @file jumps.hpp
 * The largest jump of a field across shared faces.
 */
#pragma once

#include <core/convert/topology/face_points.hpp>
#include <core/convert/topology/topology.hpp>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace elvis {

/**
 * Compares the two sides of every shared face. The first side to come leaves its values for the second, so that memory holds
 * the front of what has been visited, not the mesh.
 */
class JumpMeter {
public:
    explicit JumpMeter(const Topology& topology);

    /**
     * Adds an element: values[component * n_points + point] at the points of all its faces, `gradients` of the same layout with
     * three world derivatives each, needed where needs_gradients() and empty otherwise. Where the two sides of a face lie apart
     * by a step within the tolerance, the value of one side is carried over by its gradient: jumps are between values at the
     * same position.
     */
    void add(std::uint64_t element, std::size_t n_components, std::span<const double> values,
             std::span<const double> gradients);

    /** Whether a face of the element asks for gradients. */
    bool needs_gradients(std::uint64_t element) const;

    /** So far; not a number is no jump. */
    double largest() const { return m_largest; }

private:
    const Topology& m_topology;
    std::array<FacePoints, native::n_shapes> m_points;
    std::unordered_map<FaceSide, std::vector<double>> m_waiting;
    double m_largest = 0;
};

} // namespace elvis
