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
#include <core/volume/boundary/element_faces.hpp>

#include <array>
#include <cstddef>
#include <functional>
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

    /**
     * Points of a cubic lattice about the middle of the bounds; of a square one in a volume of two dimensions in a plane of
     * constant z. On a surface in space they are as on_faces() has them.
     */
    std::vector<ArrowSeed> in_volume(const std::array<double, 6>& bounds) const;
    /** Points of a square lattice about the bounds' middle as seen along the plane's normal. */
    std::vector<ArrowSeed> on_plane(const CutPlane& plane, const std::array<double, 6>& bounds) const;
    /**
     * Points of faces, or of elements of two dimensions, of which no two are nearer to each other than the spacing, and to one
     * of which every point is nearer than about 1.2 of it (even_points.hpp).
     */
    std::vector<ArrowSeed> on_faces(const std::vector<ElementFace>& faces) const;
    /** Likewise, of a shape where it lies in the volume; nothing for shapes that add_shape() does not know. */
    std::optional<std::vector<ArrowSeed>> on_shape(const CutShape& shape) const;
    /** Likewise, where the level takes one of the values; those of each value by themselves. */
    std::vector<ArrowSeed> on_levels(const std::shared_ptr<const Expression>& level, const std::vector<double>& values,
                                     std::uint32_t time_step) const;

private:
    /** Those in the volume. */
    std::vector<ArrowSeed> found(const std::vector<Vector3>& positions) const;
    /** Those of evenly spaced candidates; `make` of a candidate that may be chosen. */
    std::vector<ArrowSeed> chosen(const std::vector<Vector3>& candidates,
                                  const std::function<std::optional<ArrowSeed>(std::size_t candidate)>& make) const;
    /** Where elements hold a position. */
    std::optional<ArrowSeed> seed_at(const Vector3& position) const;
    std::optional<ArrowSeed> on_level(PointEvaluator& evaluator, const std::shared_ptr<const Expression>& level, double value,
                                      std::uint32_t time_step, Vector3 position) const;

    const RuntimeVolume& m_volume;
    double m_spacing;
    const TaskControl& m_control;
    ElementFinder m_finder;
};

} // namespace elvis
