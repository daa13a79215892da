/**
 * @file outline.hpp
 * How far a volume reaches in every direction.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace elvis {

/**
 * Points of the volume, one for each of some directions all around: the farthest of samples of its mapping. A picture that
 * shows all of them shows the volume, but for about three percent of its size. Of a plugin that evaluates no mappings on the
 * CPU they are corners of the elements' bounds, beyond which nothing is. The background fetches bounds.
 */
std::vector<Vector3> outline_points(const RuntimeVolume& volume, Background& background);

/** Positions of points of an element, as RuntimeVolume::evaluate_mapping gives them. */
using MappingReader = std::function<void(std::uint64_t element, std::span<const double> xi, std::span<double> positions)>;

/**
 * With bounds that are known: six numbers an element. `mapping`, if there is one, is asked in place of the volume, for the same
 * elements in the same order wherever the bounds are the same.
 */
std::vector<Vector3> outline_points(const RuntimeVolume& volume, const std::vector<double>& boxes,
                                    const MappingReader& mapping = {});

/** Bounds of elements that are read piece by piece, as often as they are wanted. */
class BoxPieces {
public:
    using Box = std::array<double, 6>;

    virtual ~BoxPieces() = default;

    /** Of all elements. */
    virtual const Box& bounds() const = 0;
    /**
     * Calls look(first element, six numbers for each) for pieces, ascending. Pieces may be left out of which `matters` is not
     * true of the box around them: it is not true of any box in it either.
     */
    virtual void for_each(const std::function<bool(const Box& around)>& matters,
                          const std::function<void(std::uint64_t first, std::span<const double> boxes)>& look) const = 0;
};

/** The same points, in the memory of a piece. */
std::vector<Vector3> outline_points(const RuntimeVolume& volume, const BoxPieces& pieces, const MappingReader& mapping = {});

} // namespace elvis
