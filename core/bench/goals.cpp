#include <core/bench/goals.hpp>

#include <core/base/bounds.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/color/transfer.hpp>
#include <core/vulkan/device_clock.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr int n_goal_runs = 9;

constexpr std::uint32_t full_width = 1800;

std::uint32_t scaled_side(std::uint32_t side, std::uint32_t width) {
    return width == 0 ? side : std::max(1u, side * width / full_width);
}

/** Where elements are smallest, around the canister: the view of its picture in tests/data/gallery. */
FrameRequest around_canister(std::uint32_t width, std::uint32_t height) {
    FrameRequest request;
    request.width = width;
    request.height = height;
    request.camera.eye = {1.7, 0.75, 0.3};
    request.camera.look_at = {0, -0.06, 1.08};
    request.camera.up = {0, 1, 0};
    request.camera.field_of_view = 50;
    request.background = {1, 1, 1, 1};
    request.for_screen = true;
    return request;
}

/** Faces of 956 elements lie in it. */
FrameRequest middle_plane(std::uint32_t width) {
    FrameRequest request = around_canister(scaled_side(full_width, width), scaled_side(800, width));
    Surface surface;
    surface.geometry = CutPlane{{1, 0, 0, 0}};
    surface.colors = make_color_table(SceneColorMap{}, {-0.15, 0.15});
    request.surfaces = {surface};
    return request;
}

/** Dense where the field is far from 0 on either side. */
FrameRequest volume_itself(std::uint32_t width, const std::array<double, 6>& bounds) {
    SceneVolumeRendering scene;
    scene.density = {{-0.1, 4}, {-0.02, 0}, {0.02, 0}, {0.1, 4}};
    FrameRequest request = around_canister(scaled_side(1720, width), scaled_side(860, width));
    request.volume.emplace();
    request.volume->transfer = make_transfer_function(scene, SceneColorMap{}, {-0.15, 0.15}, diagonal_of(bounds));
    return request;
}

void draw(const Device& device, Renderer& renderer, const FrameRequest& request, GoalRow& row) {
    renderer.render(request);
    const std::map<std::string, double> first = device_times(device);
    for (int run = 0; run < n_goal_runs; ++run) {
        const std::optional<double> before = busy_milliseconds(device);
        const Frame frame = renderer.render(request);
        const double wall = frame.render_milliseconds;
        row.wall_milliseconds = run == 0 ? wall : std::min(row.wall_milliseconds, wall);
        if (before) {
            const double busy = *busy_milliseconds(device) - *before;
            row.device_milliseconds = std::min(row.device_milliseconds.value_or(busy), busy);
        }
        row.covered_pixels = std::max(frame.counts.hit_pixels, frame.counts.volume_pixels);
    }
    for (const auto& [name, milliseconds] : device_times(device)) {
        const auto before = first.find(name);
        const double part = (milliseconds - (before != first.end() ? before->second : 0)) / n_goal_runs;
        if (part > 0) {
            row.parts[name] = part;
        }
    }
}

} // namespace

void bench_goals(const Device& device, const PluginRegistry& registry, const std::string& volume, std::uint32_t width,
                 const std::function<void(const GoalRow&)>& report) {
    const RuntimeVolume opened(registry.runtime_for(volume), volume);
    Renderer renderer(device, opened, Precision::float32);
    const auto measure = [&](const char* name, const FrameRequest& request, double goal) {
        GoalRow row;
        row.name = name;
        row.width = request.width;
        row.height = request.height;
        row.goal_milliseconds = goal;
        draw(device, renderer, request, row);
        report(row);
    };
    measure("cut plane", middle_plane(width), 0.25);
    measure("volume", volume_itself(width, renderer.ranges().bounds()), 20);
}

} // namespace elvis
