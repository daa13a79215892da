/**
 * @file still_picture.hpp
 * One picture of a scene, annotated, with what people should know of it.
 */
#pragma once

#include <core/annotation/svg.hpp>
#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/scene.hpp>
#include <core/session/frame_remarks.hpp>

#include <memory>
#include <vector>

namespace elvis {

struct StillOptions {
    /** See FrameRequest. */
    bool with_buffers = true;
    Sharing sharing;
    std::shared_ptr<const std::vector<double>> hidden_from;
    /** Of the same volume, opened again, on other devices: they draw some of the rows. */
    std::vector<Renderer*> others;
};

struct StillPicture {
    FrameRequest request;
    /** With what is written on the picture in its colours. */
    Frame frame;
    std::vector<FrameRemark> remarks;
    /** What is written on the picture, and the colours below it. */
    AnnotationPlan annotation;
    std::vector<CoveredPart> covered;
};

/** The scene's picture; its animation is not looked at. Throws Error where the scene does not suit the volume, or Cancelled. */
StillPicture draw_still(const Scene& scene, const RuntimeVolume& volume, Renderer& renderer, const StillOptions& options,
                        const TaskControl* control = nullptr);

/** The picture of a request that was made of the scene. Remarks are those on this frame alone. */
StillPicture draw_request(const Scene& scene, FrameRequest request, const RuntimeVolume& volume, Renderer& renderer,
                          const StillOptions& options, const TaskControl* control);

/** Writes what the scene wants on a picture that is drawn, and adds remarks on its frame. */
void finish_still(const Scene& scene, const RuntimeVolume& volume, StillPicture& still);

/** Writes that on a picture that is drawn. */
void annotate_still(const AnnotationRequest& annotation, StillPicture& still);

/** Size and colours alone, of the picture below what is written on it. */
Frame without_annotation(const StillPicture& still);

/** What people should know of a request: what its makers say, and the density that people did not choose. */
std::vector<FrameRemark> remarks_on(const Scene& scene, const FrameRequest& request);

} // namespace elvis
