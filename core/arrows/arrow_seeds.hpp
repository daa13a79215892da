/**
 * @file arrow_seeds.hpp
 * Where arrows stand: points of a volume or of a surface in it, evenly spaced.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/element_finder.hpp>
#include <core/render/surface.hpp>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** A point of an element. Of several elements that hold it, the one of the least index. */
struct ArrowSeed {
    ReferencePoint place{};
    Vector3 position{};
};

/** The volume evaluates on the CPU, and outlives this. */
class ArrowSeeds {
public:
    /** `spacing`: in the world, > 0. */
    ArrowSeeds(const RuntimeVolume& volume, double spacing, const TaskControl& control);

    /** Points of a cubic lattice about the middle of the bounds. */
    std::vector<ArrowSeed> in_volume(const std::array<double, 6>& bounds) const;
    /** Points of a square lattice about the bounds' middle as seen along the plane's normal. */
    std::vector<ArrowSeed> on_plane(const CutPlane& plane, const std::array<double, 6>& bounds) const;
    /**
     * Points of the faces of which no two are nearer to each other than the spacing, and to one of which every point is nearer
     * than about 1.3 of it.
     */
    std::vector<ArrowSeed> on_boundary(const BoundaryFaces& boundary) const;
    /** Likewise, where the level takes one of the values. */
    std::vector<ArrowSeed> on_isosurfaces(const std::shared_ptr<const Expression>& level, const std::vector<double>& values,
                                          std::uint32_t time_step) const;

private:
    /** Those in the volume. */
    std::vector<ArrowSeed> found(const std::vector<Vector3>& positions) const;
    std::optional<ArrowSeed> on_level(PointEvaluator& evaluator, const std::shared_ptr<const Expression>& level, double value,
                                      std::uint32_t time_step, Vector3 position) const;

    const RuntimeVolume& m_volume;
    double m_spacing;
    const TaskControl& m_control;
    ElementFinder m_finder;
};

} // namespace elvis
