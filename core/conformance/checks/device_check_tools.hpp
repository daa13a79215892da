/**
 * @file device_check_tools.hpp
 * What the checks of snippets have in common.
 */
#pragma once

#include <core/conformance/check.hpp>
#include <core/conformance/device_sampler.hpp>
#include <core/conformance/differences.hpp>
#include <core/conformance/reference_points.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace elvis::conformance {

inline constexpr std::size_t n_elements_a_class = 8;
inline constexpr std::size_t n_points = 24;
/** Fields beyond these are not looked at: every one costs a compilation. */
inline constexpr std::size_t max_fields = 4;

/** At most five complaints a check: the first tell enough. */
class Complaints {
public:
    explicit Complaints(Context& context) : m_context(context) {}
    void add(const std::string& what) {
        if (m_n++ < 5) {
            m_context.fail(what);
        }
    }

private:
    Context& m_context;
    int m_n = 0;
};

inline std::uint32_t n_checked_fields(const RuntimeVolume& volume) {
    return static_cast<std::uint32_t>(std::min(volume.fields().size(), max_fields));
}

/** Points of some elements for a component; `interior`: those with room for differences. */
inline std::vector<SamplePoint> sample_points(const RuntimeVolume& volume, std::uint64_t seed, std::uint32_t n_components,
                                              bool interior) {
    std::vector<SamplePoint> points;
    for (const std::uint64_t element : some_elements(volume, n_elements_a_class, seed)) {
        const elvis_shape shape = volume.classes()[class_of(volume, element)].shape;
        std::uint32_t component = 0;
        for (const Point& xi :
             interior ? interior_points(shape, n_points, seed + element) : points_in(shape, n_points, seed + element)) {
            points.push_back({element, xi, component++ % n_components});
        }
    }
    return points;
}

inline std::string place(const RuntimeVolume& volume, const SamplePoint& point) {
    const std::uint32_t c = class_of(volume, point.element);
    return "element " + std::to_string(point.element) + " (class " + std::to_string(c) + ", " +
           shape_name(volume.classes()[c].shape) + ") at xi " + text_of(point.xi);
}

/** Sizes of what an element's functions give, for tolerances. */
struct Scales {
    double position = 0;
    double jacobian = 0;
    double value = 0;
    double gradient = 0;
};

inline std::map<std::uint64_t, Scales> scales_of(const std::vector<SamplePoint>& points, const std::vector<Sample>& samples) {
    std::map<std::uint64_t, Scales> scales;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Scales& scale = scales[points[i].element];
        for (std::size_t k = 0; k < 3; ++k) {
            scale.position = std::max(scale.position, std::abs(samples[i].position[k]));
            scale.gradient = std::max(scale.gradient, std::abs(samples[i].gradient[k]));
        }
        for (const double entry : samples[i].jacobian) {
            scale.jacobian = std::max(scale.jacobian, std::abs(entry));
        }
        scale.value = std::max(scale.value, std::abs(samples[i].value));
    }
    return scales;
}

/** Derivatives by xi_j of numbers that the snippets give, found by differences: a row of numbers a point. */
inline std::vector<std::vector<double>> differences_of(const DeviceSampler& sampler, const std::vector<SamplePoint>& points,
                                                       std::size_t j,
                                                       const std::function<std::vector<double>(const Sample&)>& numbers) {
    std::vector<Point> xi;
    for (const SamplePoint& point : points) {
        xi.push_back(point.xi);
    }
    return differences(xi, j, [&](const std::vector<Point>& at) {
        std::vector<SamplePoint> moved;
        for (std::size_t n = 0; n < at.size(); ++n) {
            // As many places for each point.
            const SamplePoint& point = points[n * points.size() / at.size()];
            moved.push_back({point.element, at[n], point.component});
        }
        std::vector<std::vector<double>> rows;
        for (const Sample& sample : sampler.sample(moved)) {
            rows.push_back(numbers(sample));
        }
        return rows;
    });
}

/** Capabilities that some class's snippet has. */
inline std::uint32_t capabilities_of(const RuntimeVolume& volume) {
    std::uint32_t all = 0;
    for (std::uint32_t c = 0; c < volume.classes().size(); ++c) {
        all |= volume.snippet(c).capabilities;
    }
    return all;
}

} // namespace elvis::conformance
