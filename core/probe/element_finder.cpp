#include <core/probe/element_finder.hpp>

#include <core/plugin_host/all_bounds.hpp>
#include <core/probe/plate.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

ElementFinder::ElementFinder(const RuntimeVolume& volume) {
    const std::vector<double> boxes = all_bounds(volume);
    Vector3 lower{}, upper{};
    for (std::size_t d = 0; d < 3 && !boxes.empty(); ++d) {
        lower[d] = boxes[d];
        upper[d] = boxes[3 + d];
        for (std::size_t i = d; i < boxes.size(); i += 6) {
            lower[d] = std::min(lower[d], boxes[i]);
            upper[d] = std::max(upper[d], boxes[i + 3]);
        }
        // A few units in the last place of the coordinates.
        m_tolerance = std::max(m_tolerance, 1e-15 * std::max(std::abs(lower[d]), std::abs(upper[d])));
    }
    m_diagonal = length(minus(upper, lower));
    if (volume.dimension() == 2) {
        m_tolerance += on_surface * m_diagonal;
    }
    m_hierarchy = Hierarchy(boxes, scaled(plus(lower, upper), 0.5));
}

std::vector<ReferencePoint> ElementFinder::holders(const RuntimeVolume& volume, const Vector3& position) const {
    std::vector<std::uint32_t> elements;
    append_near(position, elements);
    std::ranges::sort(elements);
    std::vector<ReferencePoint> found;
    for (const std::uint32_t element : elements) {
        const Inversion inversion = SolidElement(volume, element).invert(std::span(&position, 1)).front();
        if (inversion.outcome == Inversion::Outcome::inside) {
            found.push_back({element, inversion.xi});
        }
    }
    return found;
}

} // namespace elvis
