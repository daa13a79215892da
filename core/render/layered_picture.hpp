/**
 * @file layered_picture.hpp
 * Surfaces one after the other into layers, with light and colours, and layers into a picture.
 */
#pragma once

#include <core/render/device/provide_buffer.hpp>
#include <core/render/frame.hpp>
#include <core/render/picture/color_pass.hpp>
#include <core/render/picture/flags_pass.hpp>
#include <core/render/picture/merge_pass.hpp>
#include <core/render/picture/occlusion_pass.hpp>
#include <core/render/surface_drawing.hpp>

#include <memory>
#include <optional>

namespace elvis {

class LayeredPicture {
public:
    LayeredPicture(const Device& device, Precision precision);

    /** Starts a picture that has something in these rows only; both must outlive the picture. */
    void begin(const FrameRequest& request, const PixelRows& rows, Frame& frame);

    /** Compiles what the surface's colours need and is not there yet. */
    void provide(const Surface& surface);
    /** The surface of this index in the request. `common_flags`: of each pixel that shows it. Opaque surfaces come first. */
    void draw(SurfaceDrawing& drawing, std::size_t index, std::uint32_t common_flags);
    /** Light of the volume, with its field, over and between all surfaces. */
    void draw(VolumePass& volume, const DeviceVolume& data);
    /** The same in place of colours: FrameRequest::gives_runs. */
    void give_runs(VolumePass& volume, const DeviceVolume& data);
    /** All surfaces are drawn, and no volume. */
    void finish();

    /** Of all that is drawn: flags as callers know them. Counts of pixels by them, and special values, are to be read. */
    std::vector<Buffer::Read> settle();
    /** Then: into the frame, with all counts that came late. */
    void count();

    const Layer& drawn() const { return m_is_alone ? *m_layer : m_merge_pass.picture(); }

private:
    /** How a surface is drawn beside the others. */
    struct Setting;
    Setting setting_of(const SurfaceDrawing& drawing);
    std::uint32_t draw_layer(SurfaceDrawing& drawing, const Setting& setting, const MergePass::Wanted& wanted,
                             const Buffer* beyond);
    void cut_where_conditions_fail(SurfaceDrawing& drawing, const LayerTarget& target);
    void convolve(SurfaceDrawing& drawing, const Setting& setting);
    /** By what colours of a surface with line integral convolution are multiplied. */
    const Buffer& shades() const;
    MergePass::Wanted merge(const SurfaceDrawing& drawing, std::size_t index);
    /** What is in the layer, with flags as callers know them. */
    Frame read_layer(const SurfaceDrawing& drawing);
    ViewStart start_of_view() const;
    bool is_lit(const Surface& surface) const { return m_request->lighting.has_value() && surface.is_lit; }

    const Device& m_device;
    Precision m_precision;
    ColorPass m_color_pass;
    MergePass m_merge_pass;
    OcclusionPass m_occlusion_pass;
    FlagsPass m_flags_pass;
    /** Kept from frame to frame: fresh memory costs a page fault for each page. */
    std::unique_ptr<Layer> m_layer;
    /** Of the layer's pixels. */
    std::optional<Buffer> m_places;
    /** FrameRequest::shades. */
    std::optional<Buffer> m_shades;
    /** Values of other fields than those that give colours, and what is done with them: there when a surface has conditions,
     * or line integral convolution. */
    std::unique_ptr<Layer> m_other_values;
    std::unique_ptr<ConditionPass> m_condition_pass;
    std::unique_ptr<LicPass> m_lic_pass;
    LateCounts m_late;
    std::vector<std::uint32_t> m_flag_words, m_special_words;
    const FrameRequest* m_request = nullptr;
    Frame* m_frame = nullptr;
    /** A single surface that hides what is behind it needs no merging. */
    bool m_is_alone = false;
};

} // namespace elvis
