#include <core/render/volume/simpler_colors.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace elvis {

namespace {

using Point = TransferFunction::ColorPoint;

/** The lines from a point that pass all points so far. */
class Swing {
public:
    Swing(const Point& from, double error) : m_from(from), m_error(error) {
        m_least.fill(-std::numeric_limits<double>::infinity());
        m_most.fill(std::numeric_limits<double>::infinity());
    }

    /** Whether one of them passes this point, too; then it is one of those. */
    bool take(const Point& point) {
        const double width = point.value - m_from.value;
        std::array<double, 3> least{}, most{};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double rise = point.rgb[channel] - m_from.rgb[channel];
            least[channel] = std::max(m_least[channel], (rise - m_error) / width);
            most[channel] = std::min(m_most[channel], (rise + m_error) / width);
            if (!(least[channel] <= most[channel])) {
                return false;
            }
        }
        m_least = least;
        m_most = most;
        return true;
    }

    /** Where the line ends that comes nearest to a point which was taken last. */
    Point end_at(const Point& point) const {
        const double width = point.value - m_from.value;
        Point end{point.value, {}};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double slope =
                std::clamp((point.rgb[channel] - m_from.rgb[channel]) / width, m_least[channel], m_most[channel]);
            end.rgb[channel] = m_from.rgb[channel] + slope * width;
        }
        return end;
    }

private:
    Point m_from;
    double m_error;
    std::array<double, 3> m_least{}, m_most{};
};

/** Of points without steps. */
void add_simpler(std::span<const Point> points, double error, std::vector<Point>& simpler) {
    simpler.push_back(points.front());
    Swing swing(simpler.back(), error);
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (!swing.take(points[i])) {
            // A line has taken at least one point: the next one begins there, and can take this one.
            simpler.push_back(swing.end_at(points[i - 1]));
            swing = Swing(simpler.back(), error);
            swing.take(points[i]);
        }
    }
    if (simpler.back().value < points.back().value) {
        simpler.push_back(swing.end_at(points.back()));
    }
}

} // namespace

std::vector<Point> simpler_colors(const std::vector<Point>& points, double error) {
    std::vector<Point> simpler;
    std::size_t begin = 0;
    for (std::size_t end = 1; end <= points.size(); ++end) {
        if (end == points.size() || points[end].value == points[end - 1].value) {
            add_simpler(std::span(points).subspan(begin, end - begin), error, simpler);
            begin = end;
        }
    }
    return simpler;
}

} // namespace elvis
