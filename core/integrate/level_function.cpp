#include <core/integrate/level_function.hpp>

#include <cmath>
#include <limits>

namespace elvis {

// A surface in a face between elements is met by the one on its lower side, and not by the other: rounding must not decide.
// What the value changes by in the element tells its size, too: it may be a sum of large numbers.
bool LevelFunction::is_rounding(double value, const Vector3& slope) const {
    const double size = std::abs(value) + std::abs(m_isovalue) + std::abs(slope[0]) + std::abs(slope[1]) + std::abs(slope[2]);
    return std::abs(value - m_isovalue) <= 64 * std::numeric_limits<double>::epsilon() * size;
}

const std::vector<LevelSample>& LevelFunction::at(std::span<const Vector3> points) {
    m_xi.clear();
    m_places.clear();
    for (const Vector3& s : points) {
        m_places.push_back(m_block.at(s));
        m_xi.insert(m_xi.end(), m_places.back().xi.begin(), m_places.back().xi.end());
    }
    if (!points.empty()) {
        m_sampler.sample_slopes(m_element, m_xi, m_samples);
    }
    m_n_evaluations += points.size();
    m_answers.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [xi, tangents] = m_places[i];
        const double value = m_samples.values[i];
        LevelSample& answer = m_answers[i];
        answer.xi = xi;
        answer.reference_slope = {m_samples.slopes[3 * i], m_samples.slopes[3 * i + 1], m_samples.slopes[3 * i + 2]};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            answer.slope[axis] = dot(answer.reference_slope, tangents[axis]);
        }
        answer.value = is_rounding(value, answer.reference_slope) ? 0 : value - m_isovalue;
        answer.volume = std::abs(dot(tangents[0], cross(tangents[1], tangents[2])));
    }
    return m_answers;
}

} // namespace elvis
