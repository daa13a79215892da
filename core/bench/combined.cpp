#include <core/bench/combined.hpp>

#include <core/base/bounds.hpp>
#include <core/bench/repeated_frame.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace elvis {

namespace {

constexpr int n_combined_runs = 2;

struct Part {
    std::string name;
    std::vector<Surface> surfaces;
    std::optional<VolumeRendering> volume;
};

/** Seen along a diagonal, so that the whole of it fits; the plane is across the first axis, through the middle. */
std::vector<Part> parts_of(const std::array<double, 6>& bounds, const FieldRange& range, std::optional<double> isovalue,
                           FrameRequest& request) {
    const Vector3 middle = middle_of(bounds);
    const double diagonal = diagonal_of(bounds);
    request.camera.look_at = middle;
    request.camera.eye = plus(middle, scaled({0.8, 0.45, 0.5}, diagonal));
    request.camera.up = {0, 1, 0};
    request.camera.field_of_view = 45;
    const double lower = range.lower, width = range.upper - range.lower;
    const auto surface_of = [&](const SurfaceGeometry& geometry, double opacity) {
        Surface surface;
        surface.geometry = geometry;
        surface.colors.points = {
            {lower, {0.2, 0.3, 0.9}}, {lower + 0.5 * width, {0.9, 0.9, 0.8}}, {lower + width, {0.8, 0.1, 0.1}}};
        surface.opacity = opacity;
        return surface;
    };
    Surface plane = surface_of(CutPlane{{1, 0, 0, -middle[0]}}, 1);
    plane.contours.emplace();
    for (int i = 1; i < 10; ++i) {
        plane.contours->values.push_back(lower + 0.1 * i * width);
    }
    plane.mesh_lines.emplace();
    Isosurfaces isosurfaces;
    isosurfaces.values = {isovalue.value_or(lower + 0.6 * width)};
    VolumeRendering volume;
    volume.transfer.color = {{lower, {0.2, 0.3, 0.9}}, {lower + width, {0.8, 0.1, 0.1}}};
    volume.transfer.density = {{lower, 0}, {lower + width, 6 / diagonal}};
    return {{"boundary", {surface_of(BoundaryFaces{}, 0.25)}, {}},
            {"plane with lines", {plane}, {}},
            {"isosurface", {surface_of(isosurfaces, 1)}, {}},
            {"volume", {}, volume}};
}

/** The fastest of some runs after the first. */
CombinedRow measure(Renderer& renderer, const FrameRequest& request, const std::string& name, Frame& frame) {
    CombinedRow row;
    row.name = name;
    RepeatedFrame repeated = render_repeatedly(renderer, request, n_combined_runs);
    row.milliseconds = repeated.milliseconds;
    row.wall_milliseconds = repeated.wall_milliseconds;
    frame = std::move(repeated.frame);
    row.counts = frame.counts;
    return row;
}

} // namespace

void bench_combined(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, const std::string& volume,
                    std::optional<double> isovalue, std::uint32_t size, const std::function<void(const CombinedRow&)>& report) {
    const RuntimeVolume opened =
        volume.empty() ? waves_volume(registry, folder, 16, 3) : RuntimeVolume(registry.runtime_for(volume), volume);
    Renderer renderer(device, opened, Precision::float32);
    FrameRequest request;
    request.width = request.height = size;
    request.background = {1, 1, 1, 1};
    request.with_buffers = false;
    const std::vector<Part> parts = parts_of(renderer.ranges().bounds(), renderer.ranges().range({}, 0), isovalue, request);
    CombinedRow sum;
    sum.name = "sum of the parts";
    FrameRequest all = request;
    Frame frame;
    for (const Part& part : parts) {
        FrameRequest alone = request;
        alone.surfaces = part.surfaces;
        alone.volume = part.volume;
        const CombinedRow row = measure(renderer, alone, part.name, frame);
        report(row);
        sum.milliseconds += row.milliseconds;
        sum.wall_milliseconds += row.wall_milliseconds;
        sum.counts.field_evaluations += row.counts.field_evaluations;
        sum.counts.volume_segments += row.counts.volume_segments;
        all.surfaces.insert(all.surfaces.end(), part.surfaces.begin(), part.surfaces.end());
        all.volume = part.volume ? part.volume : all.volume;
    }
    report(sum);
    std::vector<double> unshared;
    const auto draw_all = [&](const Sharing& sharing, const std::string& name) {
        all.sharing = sharing;
        CombinedRow row = measure(renderer, all, name, frame);
        unshared = unshared.empty() ? frame.color : unshared;
        for (std::size_t i = 0; i < frame.color.size(); ++i) {
            row.difference = std::max(row.difference, std::abs(frame.color[i] - unshared[i]));
        }
        report(row);
    };
    draw_all(Sharing::none(), "all, nothing shared");
    for (const auto& [name, sharing] : Sharing::each()) {
        draw_all(sharing, "all, sharing " + name);
    }
    draw_all(Sharing::all(), "all, everything shared");
}

} // namespace elvis
