/**
 * @file frame_read.hpp
 * From a drawn layer on the device to the frame that callers get.
 */
#pragma once

#include <core/render/picture/layer.hpp>
#include <core/render/renderer.hpp>
#include <core/render/surface_drawing.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace elvis {

/** What the picture's samples lack of a surface's. */
struct SurfaceFacts {
    double offset = 0;
    /** Of a plane. */
    std::optional<Vector3> normal;
};

SurfaceFacts surface_facts(const SurfaceDrawing& drawing);

/** Colours, and with `with_buffers` values, depths, normals, elements and flags, on their way from a layer into a frame. */
class LayerRead {
public:
    LayerRead(const Layer& from, Precision precision, bool with_buffers);

    /** Where they are to be read to. */
    std::vector<Buffer::Read> reads();
    /** Then: into a frame whose size and number of pixels are set. `facts`: by surface. */
    void fill(const std::vector<SurfaceFacts>& facts, Frame& frame) const;

private:
    const Layer& m_from;
    Precision m_precision;
    bool m_with_buffers;
    std::vector<std::byte> m_colors, m_marks, m_samples, m_normals;
};

/** What is seen where everything is hidden. */
Frame background_frame(const FrameRequest& request);

} // namespace elvis
