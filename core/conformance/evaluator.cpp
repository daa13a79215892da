#include <core/conformance/evaluator.hpp>

namespace elvis::conformance {

namespace {

std::vector<SamplePoint> points_of(std::uint64_t element, const std::vector<Point>& xi, std::uint32_t component) {
    std::vector<SamplePoint> points;
    for (const Point& point : xi) {
        points.push_back({element, point, component});
    }
    return points;
}

} // namespace

Evaluator::Evaluator(Context& context, const RuntimeVolume& volume) : m_volume(volume) {
    if (!volume.has_evaluation()) {
        context.progress("setting up the device");
        m_device = std::make_unique<DeviceSampler>(volume, context.subject().device, Precision::float64);
        m_device->select(0, 0);
    }
}

std::vector<Point> Evaluator::positions(std::uint64_t element, const std::vector<Point>& xi) const {
    std::vector<Point> found(xi.size());
    if (!m_device) {
        const std::vector<double> points = flat(xi);
        std::vector<double> numbers(points.size());
        m_volume.evaluate_mapping(element, points, numbers, {});
        for (std::size_t i = 0; i < xi.size(); ++i) {
            found[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
        }
        return found;
    }
    const auto samples = m_device->sample(points_of(element, xi, 0));
    const Point origin = m_device->origin(element);
    for (std::size_t i = 0; i < xi.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            found[i][axis] = samples[i].position[axis] + origin[axis];
        }
    }
    return found;
}

void Evaluator::select(std::uint32_t field) {
    m_field = field;
    if (m_device) {
        m_device->select(field, 0);
    }
}

std::vector<std::pair<double, Point>> Evaluator::values(std::uint64_t element, const std::vector<Point>& xi,
                                                        std::uint32_t component) const {
    std::vector<std::pair<double, Point>> found(xi.size());
    if (!m_device) {
        const std::uint32_t n = m_volume.fields()[m_field].n_components;
        const std::vector<double> points = flat(xi);
        std::vector<double> values(n * xi.size());
        std::vector<double> gradients(3 * n * xi.size());
        m_volume.evaluate_field(m_field, 0, element, points, values, gradients);
        for (std::size_t i = 0; i < xi.size(); ++i) {
            const double* g = &gradients[3 * (n * i + component)];
            found[i] = {values[n * i + component], {g[0], g[1], g[2]}};
        }
        return found;
    }
    const auto samples = m_device->sample(points_of(element, xi, component));
    for (std::size_t i = 0; i < xi.size(); ++i) {
        found[i] = {samples[i].value, samples[i].gradient};
    }
    return found;
}

} // namespace elvis::conformance
