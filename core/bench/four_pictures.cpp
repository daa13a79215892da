#include <core/bench/four_pictures.hpp>

#include <core/base/bounds.hpp>
#include <core/bench/repeated_frame.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/color/transfer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace elvis {

namespace {

constexpr int n_picture_runs = 3;

struct View {
    std::array<double, 6> bounds{};
    FieldRange range;
    SceneColorMap colors;
};

FrameRequest looking_at(const View& view, std::uint32_t size) {
    constexpr double field_of_view = 30;
    const Vector3 direction{1, 0.8, 0.6};
    const double distance = 0.5 * diagonal_of(view.bounds) / std::sin(0.5 * field_of_view * std::numbers::pi / 180);
    FrameRequest request;
    request.width = request.height = size;
    request.camera.look_at = middle_of(view.bounds);
    request.camera.eye = plus(request.camera.look_at, scaled(direction, distance / length(direction)));
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = field_of_view;
    request.background = {1, 1, 1, 1};
    request.with_buffers = false;
    request.for_screen = true;
    return request;
}

FrameRequest with_surface(FrameRequest request, const SurfaceGeometry& geometry, const View& view) {
    Surface surface;
    surface.geometry = geometry;
    surface.colors = make_color_table(view.colors, {view.range.lower, view.range.upper});
    request.surfaces = {surface};
    return request;
}

FrameRequest slice(const View& view, std::uint32_t size) {
    // Slightly turned against the axes, so that it does not lie in faces.
    const Vector3 normal{1, 0.3, 0.25}, middle = middle_of(view.bounds);
    return with_surface(looking_at(view, size), CutPlane{{normal[0], normal[1], normal[2], -dot(normal, middle)}}, view);
}

FrameRequest lit(FrameRequest request) {
    request.lighting = Lighting{};
    return request;
}

FrameRequest volume_itself(const View& view, std::uint32_t size) {
    SceneVolumeRendering scene;
    // A hundred samples, each as opaque as leaves 0.7^0.1.
    scene.density = {{view.range.lower, 0}, {view.range.upper, -10 * std::log(0.7) / diagonal_of(view.bounds)}};
    FrameRequest request = looking_at(view, size);
    request.volume.emplace();
    request.volume->transfer =
        make_transfer_function(scene, view.colors, {view.range.lower, view.range.upper}, diagonal_of(view.bounds));
    return request;
}

} // namespace

std::vector<NamedFrame> four_pictures(Renderer& renderer, std::uint32_t size) {
    View view{renderer.ranges().bounds(), renderer.ranges().range({}, 0), {}};
    view.colors.name = "coolwarm";
    Isosurfaces middle;
    middle.values = {0.5 * (view.range.lower + view.range.upper)};
    return {{"slice", slice(view, size)},
            {"boundary", lit(with_surface(looking_at(view, size), BoundaryFaces{}, view))},
            {"isosurface", lit(with_surface(looking_at(view, size / 2), middle, view))},
            {"volume", volume_itself(view, size / 2)}};
}

void bench_four_pictures(const Device& device, const PluginRegistry& registry, const std::string& volume, std::uint32_t size,
                         const std::function<void(const PictureRow&)>& report) {
    const RuntimeVolume opened(registry.runtime_for(volume), volume);
    Renderer renderer(device, opened, Precision::float32);
    for (const NamedFrame& picture : four_pictures(renderer, size)) {
        const RepeatedFrame repeated = render_repeatedly(renderer, picture.request, n_picture_runs);
        const FrameCounts& counts = repeated.frame.counts;
        report({picture.name, picture.request.width, repeated.milliseconds, repeated.wall_milliseconds, counts,
                std::max(counts.hit_pixels, counts.volume_pixels)});
    }
}

} // namespace elvis
