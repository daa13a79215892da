#include "call.hpp"

#include <core/base/memory.hpp>
#include <core/scene/color/transfer.hpp>
#include <core/scene/resolve.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/scene/write/write_scene.hpp>
#include <core/session/check_scene.hpp>

#include <elvis/editing.h>

#include <cmath>
#include <filesystem>

namespace elvis::library {

namespace {

using Json = nlohmann::json;

static_assert(pixel_flag::contour == ELVIS_PIXEL_CONTOUR && pixel_flag::contour_undecided == ELVIS_PIXEL_CONTOUR_UNDECIDED &&
              pixel_flag::mesh_line == ELVIS_PIXEL_MESH_LINE && pixel_flag::newton_failure == ELVIS_PIXEL_NEWTON_FAILURE &&
              pixel_flag::nan == ELVIS_PIXEL_NAN && pixel_flag::isosurface == ELVIS_PIXEL_ISOSURFACE &&
              pixel_flag::isosurface_undecided == ELVIS_PIXEL_ISOSURFACE_UNDECIDED &&
              pixel_flag::volume_tolerance == ELVIS_PIXEL_VOLUME_TOLERANCE && pixel_flag::undecided == ELVIS_PIXEL_UNDECIDED &&
              pixel_flag::mesh_line_undecided == ELVIS_PIXEL_MESH_LINE_UNDECIDED &&
              pixel_flag::work_limit == ELVIS_PIXEL_WORK_LIMIT && pixel_flag::estimated == ELVIS_PIXEL_ESTIMATED &&
              pixel_flag::range_too_fine == ELVIS_PIXEL_RANGE_TOO_FINE && pixel_flag::overlap == ELVIS_PIXEL_OVERLAP);

void check_finite(const double* numbers, std::uint64_t n, const char* name) {
    if (!std::all_of(numbers, numbers + n, [](double number) { return std::isfinite(number); })) {
        throw InvalidArgument(name, "has a number that is not finite");
    }
}

VolumeExtent extent_of(const elvis_extent& theirs) {
    VolumeExtent extent;
    check_finite(theirs.bounds, 6, "bounds");
    std::copy_n(theirs.bounds, 6, extent.bounds.begin());
    if (theirs.n_outline > 0) {
        need(theirs.outline, "outline");
        check_finite(theirs.outline, 3 * theirs.n_outline, "outline");
    }
    for (std::uint64_t i = 0; i < theirs.n_outline; ++i) {
        extent.outline.push_back({theirs.outline[3 * i], theirs.outline[3 * i + 1], theirs.outline[3 * i + 2]});
    }
    return extent;
}

/** What a camera looks at from its front: cut planes if the scene shows nothing else, or the plane of a flat volume. */
std::vector<CutPlane> planes_looked_at(const Scene& scene, const VolumeExtent& extent) {
    std::vector<CutPlane> planes = plane_of_flat(extent.bounds);
    if (!planes.empty()) {
        return planes;
    }
    for (const SceneSurface& surface : scene.surfaces) {
        if (const CutPlane* const plane = traits_of(surface.geometry).plane; plane != nullptr && surface.is_shown) {
            planes.push_back(*plane);
        }
    }
    return planes.size() == scene.surfaces.size() ? planes : std::vector<CutPlane>{};
}

void place(SceneState& state, const Camera& camera) {
    set_camera(state.scene.camera, camera);
    state.document["camera"] = Json::parse(scene_json(state.scene, state.file)["camera"].dump());
}

/** As scenes have it in "transfer". */
Json transfer_json(const TransferFunction& transfer) {
    Json json{{"color", Json::array()}, {"density", Json::array()}};
    for (const TransferFunction::ColorPoint& point : transfer.color) {
        json["color"].push_back({point.value, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    for (const TransferFunction::DensityPoint& point : transfer.density) {
        json["density"].push_back({point.value, point.density});
    }
    return json;
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_scene_write_text(const elvis_scene* scene, elvis_string folder, char** text) {
    return call(scene, [&] {
        need(text, "text");
        *text = nullptr;
        const std::filesystem::path file = std::filesystem::path(text_or_empty(folder)) / "scene";
        *text = text_for_caller(scene_json(scene->state.scene, file.string()).dump(2) + "\n");
    });
}

elvis_result elvis_scene_complete_camera(elvis_scene* scene, const elvis_extent* extent) {
    return call(scene, [&] {
        const VolumeExtent whole = extent_of(known_part(extent, "extent"));
        const Scene& own = scene->state.scene;
        place(scene->state, resolve_camera(own, whole, planes_looked_at(own, whole)));
    });
}

elvis_result elvis_scene_fit_camera(elvis_scene* scene, const elvis_extent* extent) {
    return call(scene, [&] {
        const VolumeExtent whole = extent_of(known_part(extent, "extent"));
        const Scene& own = scene->state.scene;
        const Camera camera = resolve_camera(own, whole, planes_looked_at(own, whole));
        place(scene->state, fitted(camera, whole, room_for_volume(own)));
    });
}

elvis_result elvis_data_check_scene(const elvis_data* data, const elvis_scene* scene) {
    return call(data, [&] {
        need(scene, "scene");
        check_scene(scene->state.scene, data->state->volume);
    });
}

elvis_result elvis_context_limit_memory(elvis_context* context, std::uint64_t bytes) {
    return call(context, [&] { context->state->limit_memory(bytes); });
}

elvis_result elvis_data_free_memory(elvis_data* data) {
    return call(data, [&] {
        {
            const DataTask task(*data->state, nullptr);
            data->state->forget_work();
        }
        data->state->context->forget_kernels();
        give_back_free_memory();
    });
}

elvis_result elvis_context_free_memory(elvis_context* context) {
    return call(context, [&] {
        context->state->forget_kernels();
        give_back_free_memory();
    });
}

elvis_result elvis_scene_write_expression(const elvis_scene* scene, elvis_string text, char** expression) {
    return call(scene, [&] {
        need(expression, "expression");
        *expression = nullptr;
        need(text, "text");
        *expression = text_for_caller(with_distances(text, scene->state.scene.surfaces));
    });
}

elvis_result elvis_scene_get_transfer(const elvis_scene* scene, const double range[2], double diagonal, char** text) {
    return call(scene, [&] {
        need(text, "text");
        *text = nullptr;
        need(range, "range");
        check_finite(range, 2, "range");
        if (!(range[0] <= range[1])) {
            throw InvalidArgument("range", "must go from a smaller to a larger value");
        }
        if (!(std::isfinite(diagonal) && diagonal > 0)) {
            throw InvalidArgument("diagonal", "must be above 0");
        }
        const Scene& own = scene->state.scene;
        const SceneVolumeRendering rendering = own.volume_rendering.value_or(SceneVolumeRendering{});
        const SceneColorMap& map = rendering.color_map ? *rendering.color_map : own.color_map;
        const auto ends = map.range.value_or(std::array<double, 2>{range[0], range[1]});
        *text = text_for_caller(transfer_json(make_transfer_function(rendering, map, ends, diagonal)).dump());
    });
}
