#include "resolution.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::view {

void ResolutionChooser::measured(double scale, double milliseconds) {
    const double wanted = scale * std::clamp(std::sqrt(target_milliseconds / std::max(milliseconds, 1.0)), 0.5, 2.0);
    // Up only when there is room to spare, so that the size does not go up and down between two steps.
    constexpr double step = 1.25;
    if (wanted < m_scale || wanted > m_scale * step) {
        m_scale = wanted;
    }
    m_scale = std::clamp(m_scale, least_scale, 1.0);
}

} // namespace elvis::view
