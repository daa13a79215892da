#include <core/session/screen_picture.hpp>

#include <core/annotation/plan.hpp>
#include <core/base/milliseconds.hpp>
#include <core/render/frame_stage.hpp>
#include <core/render/picture/screen_pass.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/missed_surfaces.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace elvis {

namespace {

constexpr std::size_t n_channels = 4;

std::size_t nearest(std::uint32_t place, std::uint32_t n_places, std::uint32_t n_pixels) {
    return static_cast<std::size_t>(std::uint64_t{place} * n_pixels / n_places);
}

/** A part of the frame as it would be with width times height pixels. */
Frame stretched_part(const Frame& frame, std::uint32_t width, std::uint32_t height, const PixelBox& box) {
    Frame part;
    part.width = static_cast<std::uint32_t>(box.width());
    part.height = static_cast<std::uint32_t>(box.height());
    part.color.reserve(n_channels * part.width * part.height);
    for (int row = box.top; row < box.bottom; ++row) {
        const std::size_t from_row = nearest(static_cast<std::uint32_t>(row), height, frame.height);
        for (int column = box.left; column < box.right; ++column) {
            const std::size_t from = from_row * frame.width + nearest(static_cast<std::uint32_t>(column), width, frame.width);
            for (std::size_t channel = 0; channel < n_channels; ++channel) {
                part.color.push_back(frame.screen[n_channels * from + channel] / 255.0);
            }
        }
    }
    return part;
}

std::vector<std::uint8_t> stretched(const Frame& frame, std::uint32_t width, std::uint32_t height) {
    std::vector<std::uint8_t> result(n_channels * width * height);
    const std::size_t row_bytes = n_channels * width;
    std::size_t drawn_row = frame.height; // None.
    for (std::uint32_t row = 0; row < height; ++row) {
        const std::size_t from_row = nearest(row, height, frame.height);
        std::uint8_t* to = &result[row * row_bytes];
        if (from_row == drawn_row) {
            std::copy_n(to - row_bytes, row_bytes, to);
            continue;
        }
        drawn_row = from_row;
        for (std::uint32_t column = 0; column < width; ++column) {
            const std::uint8_t* from =
                &frame.screen[n_channels * (from_row * frame.width + nearest(column, width, frame.width))];
            std::copy_n(from, n_channels, to + n_channels * column);
        }
    }
    return result;
}

/** Paints where the item is, and nowhere else: small frames are not made large for it. */
void write_item(const AnnotationPlan::Item& item, double halo_radius, const Frame& frame, ScreenPicture& picture) {
    PixelBox box = grown(item.drawing.box(), static_cast<int>(std::ceil(halo_radius)));
    box = {std::max(box.left, 0), std::max(box.top, 0), std::min(box.right, static_cast<int>(picture.width)),
           std::min(box.bottom, static_cast<int>(picture.height))};
    if (box.is_empty()) {
        return;
    }
    Frame part = stretched_part(frame, picture.width, picture.height, box);
    Drawing drawing = item.drawing;
    drawing.move(-box.left, -box.top);
    drawing.paint(part, item.ink, halo_radius);
    const std::size_t row_numbers = n_channels * part.width;
    for (std::size_t row = 0; row < part.height; ++row) {
        const std::size_t to = (static_cast<std::size_t>(box.top) + row) * picture.width + static_cast<std::size_t>(box.left);
        std::transform(&part.color[row * row_numbers], &part.color[row * row_numbers] + row_numbers,
                       &picture.rgba[n_channels * to], screen_level);
    }
}

/** Writes the picture's pixels; annotation has its size, whatever the frame's. */
void paint(const Frame& frame, const AnnotationPlan& annotation, ScreenPicture& picture) {
    const bool is_whole = frame.width == picture.width && frame.height == picture.height;
    picture.rgba = is_whole ? frame.screen : stretched(frame, picture.width, picture.height);
    for (const AnnotationPlan::Item& item : annotation.items) {
        write_item(item, annotation.halo_radius, frame, picture);
    }
    for (const std::string& name : annotation.left_out) {
        picture.remarks.push_back({true, "annotation: there is no room for the " + name});
    }
}

AnnotationPlan annotation_of(const Scene& scene, const FrameRequest& request, const Frame& frame, const RuntimeVolume& volume) {
    return scene.annotation ? plan_annotation(request.width, request.height,
                                              make_annotation_request(*scene.annotation, request, frame, volume))
                            : AnnotationPlan{};
}

} // namespace

ScreenPicture draw_for_screen(const Scene& scene, const RuntimeVolume& volume, Renderer& renderer, const ScreenOptions& options,
                              const TaskControl* control) {
    if (!options.is_coarse && scene.samples > 1) {
        StillOptions how;
        how.with_buffers = false;
        return shown_on_screen(draw_still(scene, volume, renderer, how, control), scene.size);
    }
    FrameRequest request = make_frame_request(scene, volume, renderer.ranges());
    request.for_screen = true;
    ScreenPicture picture;
    picture.width = request.width;
    picture.height = request.height;
    const FrameStage stage = options.is_coarse ? FrameStage::full : FrameStage::exact;
    picture.frame = renderer.render(request_for(request, stage, options.divisor, !options.has_no_lines), control);
    const auto drawn = std::chrono::steady_clock::now();
    picture.remarks = remarks_on(scene, request);
    paint(picture.frame, annotation_of(scene, request, picture.frame, volume), picture);
    if (options.divisor == 1) {
        MissedSurfaces missed;
        missed.add(request, picture.frame);
        for (const std::string& text : missed.remarks(scene, request, renderer.ranges())) {
            picture.remarks.push_back({true, text});
        }
    }
    for (FrameRemark& remark : remarks_on(picture.frame.counts)) {
        picture.remarks.push_back(std::move(remark));
    }
    picture.frame.screen.clear();
    picture.is_refinable = has_refinement(request) || scene.samples > 1;
    picture.milliseconds = picture.frame.render_milliseconds + milliseconds_since(drawn);
    return picture;
}

Scene coarser(const Scene& scene, const ScreenOptions& options) {
    Scene coarse = scene;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        coarse.size[axis] = std::max(1u, scene.size[axis] / options.divisor);
        coarse.camera.image_shift[axis] *= static_cast<double>(coarse.size[1]) / scene.size[1];
    }
    if (options.has_no_lines) {
        coarse.contours.reset();
        coarse.mesh_lines.reset();
        for (SceneSurface& surface : coarse.surfaces) {
            surface.contours.reset();
            surface.mesh_lines.reset();
        }
    }
    return coarse;
}

ScreenPicture shown_on_screen(StillPicture still, const std::array<std::uint32_t, 2>& size) {
    const auto start = std::chrono::steady_clock::now();
    ScreenPicture picture;
    picture.width = size[0];
    picture.height = size[1];
    picture.frame = std::move(still.frame);
    picture.remarks = std::move(still.remarks);
    std::vector<double>& color = picture.frame.color;
    picture.frame.screen.reserve(color.size());
    for (std::size_t at = 0; at < color.size(); at += n_channels) {
        const auto levels = on_screen({color[at], color[at + 1], color[at + 2], color[at + 3]});
        picture.frame.screen.insert(picture.frame.screen.end(), levels.begin(), levels.end());
    }
    color.clear();
    paint(picture.frame, {}, picture);
    picture.frame.screen.clear();
    picture.milliseconds = picture.frame.render_milliseconds + milliseconds_since(start);
    return picture;
}

} // namespace elvis
