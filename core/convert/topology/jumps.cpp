#include <core/convert/topology/jumps.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

JumpMeter::JumpMeter(const Topology& topology) : m_topology(topology), m_points(all_face_points()) {}

bool JumpMeter::needs_gradients(std::uint64_t element) const {
    if (m_topology.steps.empty()) {
        return false;
    }
    for (int local = 0; local < native::n_faces(static_cast<native::Shape>(m_topology.shapes[element])); ++local) {
        if (m_topology.steps.contains(face_side(element, local))) {
            return true;
        }
    }
    return false;
}

void JumpMeter::add(std::uint64_t element, std::size_t n_components, std::span<const double> values,
                    std::span<const double> gradients) {
    const FacePoints& points = m_points[m_topology.shapes[element]];
    std::vector<double> of_face;
    for (int local = 0; local < native::n_faces(static_cast<native::Shape>(m_topology.shapes[element])); ++local) {
        if (!m_topology.is_shared(element, local)) {
            continue;
        }
        const FaceSide side = face_side(element, local);
        const auto steps = gradients.empty() ? m_topology.steps.end() : m_topology.steps.find(side);
        of_face.clear();
        for (std::size_t component = 0; component < n_components; ++component) {
            std::size_t place = 0;
            for (const std::uint8_t point : points.order(local, m_topology.corners.of_element[element])) {
                const std::size_t at = component * points.n_points() + points.first_point(local) + point;
                double value = values[at];
                if (steps != m_topology.steps.end()) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        value += gradients[3 * at + axis] * steps->second[3 * place + axis];
                    }
                }
                of_face.push_back(value);
                ++place;
            }
        }
        const auto other = m_waiting.find(m_topology.other_side(element, local));
        if (other == m_waiting.end()) {
            m_waiting.emplace(side, of_face);
            continue;
        }
        for (std::size_t at = 0; at < of_face.size(); ++at) {
            const double jump = std::abs(of_face[at] - other->second[at]);
            // False for a jump that is not a number.
            m_largest = jump > m_largest ? jump : m_largest;
        }
        m_waiting.erase(other);
    }
}

} // namespace elvis
