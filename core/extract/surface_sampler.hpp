/**
 * @file surface_sampler.hpp
 * What the extraction of a surface asks of points of elements.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/integrate/element_sampler.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

/** A function of reference coordinates at a point. */
struct Sloped {
    double value = 0;
    Vector3 slope{};
};

struct SurfacePoint {
    Vector3 xi{}, position{};
    /** dx_i/dxi_j, row by row. */
    std::array<double, 9> jacobian{};
    /** The surface is where this is zero; what is no more than rounding is zero. */
    Sloped level;
    /** Whose contours are wanted. */
    Sloped contour;

    /** A slope in reference coordinates as one in the world: J^-T slope. */
    Vector3 world(const Vector3& slope) const;
    /** A step in the world as one in reference coordinates. */
    Vector3 reference(const Vector3& step) const;
    double determinant() const;
};

class SurfaceSampler {
public:
    /** A surface that is a face of elements has no `level`: its level's slope is what `at` is given. The volume must outlive
     * this. */
    SurfaceSampler(const RuntimeVolume& volume, std::shared_ptr<const Expression> level, double isovalue,
                   std::shared_ptr<const Expression> contour, std::uint32_t time_step);

    bool has_level() const { return m_level != nullptr; }
    bool has_contour() const { return m_contour != nullptr; }
    bool is_one_at_a_time() const;
    const std::shared_ptr<const Expression>& level() const { return m_level; }
    const std::shared_ptr<const Expression>& contour() const { return m_contour; }
    const RuntimeVolume& volume() const { return m_volume; }
    std::uint32_t time_step() const { return m_time_step; }

    /** One answer a point, in the same order. May be called by several threads at once. */
    std::vector<SurfacePoint> at(std::uint64_t element, std::span<const Vector3> xi, const Vector3& face_normal) const;
    std::uint64_t n_evaluations() const { return m_n_evaluations; }

private:
    const RuntimeVolume& m_volume;
    std::shared_ptr<const Expression> m_level, m_contour;
    double m_isovalue;
    std::uint32_t m_time_step;
    std::optional<ElementSampler> m_sampler;
    mutable std::atomic<std::uint64_t> m_n_evaluations{0};
};

} // namespace elvis
