/**
 * @file edge_pass.hpp
 * Draws edges of elements, curved as they are, as lines on the picture.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/volume/boundary/edge_set.hpp>

namespace elvis {

/**
 * On the host, in double precision: edges are divided until their chords are within a thousandth of a pixel of them, and the
 * pixels that the chords meet are marked exactly but for that.
 *
 * Edges lie in the surfaces that they bound, so that neither can be told to be in front: an edge is drawn as if it were nearer
 * by depth_tolerance times its width. Of edges in one pixel the nearest is drawn.
 */
class EdgePass {
public:
    /** In the size of a pixel at the edge's depth: what a surface's depth may vary by under the line, unless seen at less than
     * 14 degrees. */
    static constexpr double depth_tolerance = 4;

    explicit EdgePass(Precision precision) : m_precision(precision) {}

    /**
     * The given value, the number of an element at the edge, a depth in the edge less the tolerance, a normal towards the
     * viewer. Flags: mesh_line where the pixel's closed square meets an edge from the camera's `near` on, mesh_line_undecided
     * where that is within the chords' error. `width`: see WireFrame.
     */
    void draw(const EdgeSet& edges, const Camera& camera, const PicturePart& part, double width, double value,
              std::uint32_t surface, const LayerTarget& target) const;

private:
    Precision m_precision;
};

} // namespace elvis
