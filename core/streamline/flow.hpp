/**
 * @file flow.hpp
 * A vector field as what moves points in reference coordinates.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace elvis {

/** What the field does to a point of an element. */
struct FlowSample {
    Vector3 position{};
    /** In the world. */
    Vector3 velocity{};
    /** dxi/dt = J^-1 velocity; in two dimensions of the part in the surface, with 0 as its third. */
    Vector3 slope{};
    /** Jacobian of the mapping, row by row. */
    std::array<double, 9> jacobian{};
};

/** Throws Error for volumes in which lines cannot be followed. */
void need_evaluation(const RuntimeVolume& volume);

/** One step of time. The volume, which evaluates on the CPU, must outlive it. Several threads may use it. */
class Flow {
public:
    /** `field`: a vector by name or expression. Throws Error for what is none. */
    Flow(const RuntimeVolume& volume, const std::string& field, std::uint32_t time_step);

    /** Opposite to the field. */
    Flow reversed() const;

    FlowSample at(const ReferencePoint& point) const;
    const RuntimeVolume& volume() const { return *m_volume; }
    elvis_shape shape_of(std::uint64_t element) const;
    /** Only one thread may use it. */
    bool is_one_at_a_time() const;

private:
    Vector3 velocity(const ReferencePoint& point) const;

    const RuntimeVolume* m_volume;
    std::uint32_t m_time_step;
    /** A field as it stands, or else expressions. */
    std::optional<std::uint32_t> m_field;
    std::array<std::shared_ptr<const Expression>, 3> m_components;
    double m_sign = 1;
};

} // namespace elvis
