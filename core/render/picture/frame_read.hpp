/**
 * @file frame_read.hpp
 * From a drawn layer on the device to the frame that callers get.
 */
#pragma once

#include <core/render/picture/layer.hpp>
#include <core/render/renderer.hpp>

#include <optional>
#include <vector>

namespace elvis {

/** What the picture's samples lack of a surface's. */
struct SurfaceFacts {
    double offset = 0;
    /** Of a plane. */
    std::optional<Vector3> normal;
};

/**
 * Reads colours, and with `with_buffers` values, depths, normals, elements and flags, into `frame`, whose
 * size and number of pixels are set. `facts`: by surface.
 */
void read_frame(const Layer& from, Precision precision, const std::vector<SurfaceFacts>& facts, bool with_buffers,
                Frame& frame);

/** What is seen where everything is hidden. */
Frame background_frame(const FrameRequest& request);

} // namespace elvis
