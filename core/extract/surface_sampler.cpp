#include <core/extract/surface_sampler.hpp>

#include <core/probe/newton.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {

Vector3 SurfacePoint::world(const Vector3& slope) const {
    Vector3 gradient = slope;
    to_world_gradients(jacobian, gradient);
    return gradient;
}

Vector3 SurfacePoint::reference(const Vector3& step) const {
    const std::array<double, 9> m = invert_matrix(jacobian);
    return {m[0] * step[0] + m[1] * step[1] + m[2] * step[2], m[3] * step[0] + m[4] * step[1] + m[5] * step[2],
            m[6] * step[0] + m[7] * step[1] + m[8] * step[2]};
}

double SurfacePoint::determinant() const {
    const Vector3 first{jacobian[0], jacobian[3], jacobian[6]}, second{jacobian[1], jacobian[4], jacobian[7]},
        third{jacobian[2], jacobian[5], jacobian[8]};
    return dot(first, cross(second, third));
}

SurfaceSampler::SurfaceSampler(const RuntimeVolume& volume, std::shared_ptr<const Expression> level, double isovalue,
                               std::shared_ptr<const Expression> contour, std::uint32_t time_step)
    : m_volume(volume), m_level(std::move(level)), m_contour(std::move(contour)), m_isovalue(isovalue), m_time_step(time_step) {
    std::vector<std::shared_ptr<const Expression>> expressions;
    for (const auto& one : {m_level, m_contour}) {
        if (one) {
            expressions.push_back(one);
        }
    }
    if (!expressions.empty()) {
        m_sampler.emplace(volume, std::move(expressions), time_step);
    }
}

bool SurfaceSampler::is_one_at_a_time() const {
    return (m_level && m_level->needs_element_facts()) || (m_contour && m_contour->needs_element_facts());
}

std::vector<SurfacePoint> SurfaceSampler::at(std::uint64_t element, std::span<const Vector3> xi,
                                             const Vector3& face_normal) const {
    std::vector<SurfacePoint> points(xi.size());
    if (xi.empty()) {
        return points;
    }
    m_n_evaluations += xi.size();
    std::vector<double> numbers, positions(3 * xi.size()), jacobians(9 * xi.size());
    for (const Vector3& one : xi) {
        numbers.insert(numbers.end(), one.begin(), one.end());
    }
    m_volume.evaluate_mapping(element, numbers, positions, jacobians);
    ElementSamples samples;
    if (m_sampler) {
        m_sampler->sample_slopes(element, numbers, samples);
    }
    const std::size_t n = m_sampler ? m_sampler->n_expressions() : 0;
    for (std::size_t i = 0; i < xi.size(); ++i) {
        SurfacePoint& point = points[i];
        point.xi = xi[i];
        point.position = {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
        std::copy_n(&jacobians[9 * i], 9, point.jacobian.begin());
        const auto sloped = [&](std::size_t expression) {
            const double* const slope = &samples.slopes[3 * (n * i + expression)];
            return Sloped{samples.values[n * i + expression], {slope[0], slope[1], slope[2]}};
        };
        point.level.slope = face_normal;
        if (m_level) {
            point.level = sloped(0);
            // A surface in a face between elements is that of one of them: rounding must not decide of which.
            const Vector3& slope = point.level.slope;
            const double size = std::abs(point.level.value) + std::abs(m_isovalue) + std::abs(slope[0]) + std::abs(slope[1]) +
                                std::abs(slope[2]);
            point.level.value -= m_isovalue;
            if (std::abs(point.level.value) <= 64 * std::numeric_limits<double>::epsilon() * size) {
                point.level.value = 0;
            }
        }
        if (m_contour) {
            point.contour = sloped(n - 1);
        }
    }
    return points;
}

} // namespace elvis
