#include <core/session/volumes_together.hpp>

#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/render/bands.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/resolve.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/session/joined_pictures.hpp>
#include <core/session/missed_surfaces.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

namespace {

/** Of the diagonal: depths of single and of double precision. */
constexpr double depth_error_float32 = 1e-5, depth_error_float64 = 1e-10;

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
    throw Error(scene.volume, what + " cannot be drawn of several volumes; of one it can ('volumes' in the scene)");
}

/** The field or expression that colours a surface, or of no surface the scene. */
std::optional<std::string> coloring_field(const Scene& scene, const SceneSurface* surface) {
    if (surface != nullptr && (surface->color_field || surface->field)) {
        return surface->color_field ? surface->color_field : surface->field;
    }
    return scene.field;
}

/** Of that surface's field in all volumes, at their time steps; of no surface, of the scenes' fields. */
std::array<double, 2> common_range(std::span<const VolumeInPicture> volumes, std::optional<std::size_t> surface) {
    std::optional<FieldRange> all;
    for (const VolumeInPicture& one : volumes) {
        std::optional<std::string> text = coloring_field(one.scene, surface ? &one.scene.surfaces[*surface] : nullptr);
        text = text ? std::optional(with_distances(*text, one.scene.surfaces)) : std::nullopt;
        const FieldRange range = one.renderer->ranges().extrema(choose_field(*one.volume, text), one.scene.time_step).range();
        all = all ? FieldRange{std::min(all->lower, range.lower), std::max(all->upper, range.upper)} : range;
    }
    return {all->lower, all->upper};
}

/** Colours mean the same in all volumes: each surface's in its range in all of them, where no range is given. */
void set_ranges(Scene& scene, std::span<const VolumeInPicture> volumes) {
    for (std::size_t index = 0; index < scene.surfaces.size(); ++index) {
        SceneSurface& surface = scene.surfaces[index];
        surface.color_map = surface.color_map ? surface.color_map : scene.color_map;
        if (!surface.color_map->range) {
            surface.color_map->range = common_range(volumes, index);
        }
    }
    if (!scene.color_map.range) {
        scene.color_map.range = common_range(volumes, std::nullopt);
    }
}

std::array<double, 6> moved_box(const std::array<double, 6>& box, const Vector3& by) {
    return {box[0] + by[0], box[1] + by[1], box[2] + by[2], box[3] + by[0], box[4] + by[1], box[5] + by[2]};
}

/** Of all volumes where they are shown. */
VolumeExtent extent_of(std::span<const VolumeInPicture> volumes, bool with_outline) {
    VolumeExtent extent{moved_box(volumes.front().renderer->ranges().bounds(), volumes.front().offset), {}};
    for (const VolumeInPicture& one : volumes) {
        const std::array<double, 6> box = moved_box(one.renderer->ranges().bounds(), one.offset);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            extent.bounds[axis] = std::min(extent.bounds[axis], box[axis]);
            extent.bounds[axis + 3] = std::max(extent.bounds[axis + 3], box[axis + 3]);
        }
        for (const Vector3& point : with_outline ? one.renderer->ranges().outline() : std::vector<Vector3>()) {
            extent.outline.push_back(plus(point, one.offset));
        }
    }
    return extent;
}

std::vector<CutPlane> planes_of(const Scene& scene) {
    std::vector<CutPlane> planes;
    for (const SceneSurface& surface : scene.surfaces) {
        if (const auto* const plane = std::get_if<CutPlane>(&surface.geometry); plane != nullptr && surface.is_shown) {
            planes.push_back(*plane);
        }
    }
    return planes;
}

/** The volume is moved by moving what looks at it the other way. */
Scene viewed_from(Scene scene, const Camera& camera, const Vector3& offset) {
    Camera own = camera;
    own.eye = minus(camera.eye, offset);
    own.look_at = minus(camera.look_at, offset);
    set_camera(scene.camera, own);
    if (scene.lighting) {
        for (Light& light : scene.lighting->lights) {
            light.vector = light.type == Light::Type::point ? minus(light.vector, offset) : light.vector;
        }
    }
    return scene;
}

void need_opaque(const FrameRequest& request, const Scene& scene) {
    for (const Surface& surface : request.surfaces) {
        if (surface.opacity < 1) {
            refuse(scene, "a surface that can be seen through");
        }
        if (surface.outside) {
            refuse(scene, "a surface with a colour where it lies in no element");
        }
        if (traits_of(surface.geometry).wires != nullptr) {
            refuse(scene, "edges of elements as a surface of their own");
        }
    }
}

double widest_line(const FrameRequest& request, double width) {
    for (const Surface& surface : request.surfaces) {
        width = surface.contours ? std::max(width, surface.contours->style.width) : width;
        width = surface.mesh_lines ? std::max(width, surface.mesh_lines->style.width) : width;
    }
    return width;
}

/** Bars that are the same are one. */
void add_bars(AnnotationRequest& request, const AnnotationRequest& more) {
    for (const ColorBar& bar : more.color_bars) {
        const auto same = std::ranges::find_if(request.color_bars, [&](const ColorBar& other) {
            const auto points = [](const ColorBar& of) {
                std::vector<std::array<double, 4>> list;
                for (const ColorTable::Point& point : of.colors.points) {
                    list.push_back({point.value, point.rgb[0], point.rgb[1], point.rgb[2]});
                }
                return list;
            };
            return other.name == bar.name && other.unit == bar.unit && points(other) == points(bar);
        });
        if (same == request.color_bars.end()) {
            request.color_bars.push_back(bar);
            continue;
        }
        same->has_below = same->has_below || bar.has_below;
        same->has_above = same->has_above || bar.has_above;
        same->has_nan = same->has_nan || bar.has_nan;
    }
}

} // namespace

Scene scene_of_volume(const Scene& scene, std::size_t number) {
    Scene one = scene;
    one.volumes.clear();
    if (number == 0) {
        return one;
    }
    const SceneVolume& further = scene.volumes[number - 1];
    if (!further.path.empty()) {
        one.volume = further.path;
        one.more_files = further.more_files;
        one.plugin = further.plugin;
        one.plugin_options = further.plugin_options;
        one.warp.reset();
    }
    one.time_step = further.time_step.value_or(further.path.empty() ? scene.time_step : 0);
    one.field = further.field ? further.field : scene.field;
    return one;
}

void need_drawable_together(const Scene& scene) {
    if (scene.samples > 1) {
        refuse(scene, "several samples a pixel");
    }
    if (scene.volume_rendering && scene.volume_rendering->is_shown) {
        refuse(scene, "the volume itself");
    }
    if (scene.animation) {
        refuse(scene, "an animation");
    }
}

StillPicture draw_together(std::span<const VolumeInPicture> volumes, const StillOptions& options, const TaskControl* control) {
    const Scene& first = volumes.front().scene;
    const VolumeExtent extent = extent_of(volumes, !is_placed(first.camera));
    const Camera camera = resolve_camera(first, extent, planes_of(first));
    StillPicture still;
    std::vector<Frame> frames;
    AnnotationRequest annotation;
    double line_width = 0;
    for (const VolumeInPicture& one : volumes) {
        Scene scene = viewed_from(one.scene, camera, one.offset);
        set_ranges(scene, volumes);
        FrameRequest request = make_frame_request(scene, *one.volume, one.renderer->ranges());
        need_opaque(request, scene);
        request.sharing = options.sharing;
        line_width = widest_line(request, line_width);
        Renderer* renderer = one.renderer;
        frames.push_back(render_in_bands(std::span(&renderer, 1), request, control));
        MissedSurfaces missed;
        missed.add(request, frames.back());
        for (const std::vector<std::string>& texts : {request.remarks, missed.remarks(scene, request, renderer->ranges())}) {
            for (const std::string& text : texts) {
                still.remarks.push_back({true, std::string(one.volume->path()).append(": ").append(text)});
            }
        }
        if (first.annotation) {
            const AnnotationRequest own = make_annotation_request(*first.annotation, request, frames.back(), *one.volume);
            frames.size() == 1 ? void(annotation = own) : add_bars(annotation, own);
        }
        if (frames.size() == 1) {
            still.request = std::move(request);
        }
    }
    const double error =
        first.precision.value_or(Precision::float32) == Precision::float32 ? depth_error_float32 : depth_error_float64;
    still.frame = joined(frames, error * diagonal_of(extent.bounds), line_width);
    if (first.annotation) {
        annotate_still(annotation, still);
    }
    for (FrameRemark& remark : remarks_on(still.frame.counts)) {
        still.remarks.push_back(std::move(remark));
    }
    return still;
}

} // namespace elvis
