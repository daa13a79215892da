#include <core/session/still_picture.hpp>

#include <core/render/bands.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/missed_surfaces.hpp>
#include <core/session/supersampled.hpp>

#include <fmt/format.h>

#include <utility>

namespace elvis {

std::vector<FrameRemark> remarks_on(const Scene& scene, const FrameRequest& request) {
    std::vector<FrameRemark> remarks;
    for (const std::string& text : request.remarks) {
        remarks.push_back({true, text});
    }
    if (request.volume && scene.volume_rendering->has_default_density()) {
        const auto& density = request.volume->transfer.density;
        remarks.push_back(
            {false, fmt::format("volume: density rises from {:.6g} at {:.6g} to {:.6g} at {:.6g}", density.front().density,
                                density.front().value, density.back().density, density.back().value)});
    }
    return remarks;
}

StillPicture draw_request(const Scene& scene, FrameRequest request, const RuntimeVolume& volume, Renderer& renderer,
                          const StillOptions& options, const TaskControl* control) {
    StillPicture still;
    still.request = std::move(request);
    still.request.with_buffers = options.with_buffers;
    still.request.sharing = options.sharing;
    still.request.hidden_from = options.hidden_from;
    std::vector<Renderer*> renderers{&renderer};
    renderers.insert(renderers.end(), options.others.begin(), options.others.end());
    still.frame = render_in_bands(renderers, still.request, control);
    if (scene.samples > 1) {
        // All but the colours is that of the picture itself: flags and counts are of its pixels.
        SupersampledColors fine = supersampled(renderers, still.request, scene.samples, control);
        still.frame.color = std::move(fine.color);
        still.frame.render_milliseconds += fine.render_milliseconds;
        still.frame.device_milliseconds += fine.device_milliseconds;
    }
    finish_still(scene, volume, still);
    return still;
}

void annotate_still(const AnnotationRequest& annotation, StillPicture& still) {
    still.annotation = plan_annotation(still.frame.width, still.frame.height, annotation);
    still.covered = covered_by(still.annotation, still.frame);
    paint(still.frame, still.annotation);
    for (const std::string& name : still.annotation.left_out) {
        still.remarks.push_back({true, "annotation: there is no room for the " + name});
    }
}

Frame without_annotation(const StillPicture& still) {
    Frame bare;
    bare.width = still.frame.width;
    bare.height = still.frame.height;
    bare.color = still.frame.color;
    uncover(bare, still.covered);
    return bare;
}

void finish_still(const Scene& scene, const RuntimeVolume& volume, StillPicture& still) {
    if (scene.annotation) {
        annotate_still(make_annotation_request(*scene.annotation, still.request, still.frame, volume), still);
    }
    for (FrameRemark& remark : remarks_on(still.frame.counts)) {
        still.remarks.push_back(std::move(remark));
    }
}

StillPicture draw_still(const Scene& scene, const RuntimeVolume& volume, Renderer& renderer, const StillOptions& options,
                        const TaskControl* control) {
    const FrameRequest request = make_frame_request(scene, volume, renderer.ranges());
    std::vector<FrameRemark> remarks = remarks_on(scene, request);
    StillPicture still = draw_request(scene, request, volume, renderer, options, control);
    still.remarks.insert(still.remarks.begin(), remarks.begin(), remarks.end());
    MissedSurfaces missed;
    missed.add(still.request, still.frame);
    for (const std::string& text : missed.remarks(scene, still.request, renderer.ranges())) {
        still.remarks.push_back({true, text});
    }
    return still;
}

} // namespace elvis
