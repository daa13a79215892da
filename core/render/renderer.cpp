#include <core/base/bounds.hpp>
#include <core/base/milliseconds.hpp>
#include <core/probe/overlaps.hpp>
#include <core/render/device/device_time.hpp>
#include <core/render/layered_picture.hpp>
#include <core/render/picture/frame_read.hpp>
#include <core/render/picture/picture_rows.hpp>
#include <core/render/picture/screen_pass.hpp>
#include <core/render/prepared_request.hpp>
#include <core/render/renderer.hpp>
#include <core/render/volume/volume_pass.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <vector>

namespace elvis {

namespace {

using Clock = std::chrono::steady_clock;

/** What a colour channel may be off. */
constexpr double channel_tolerance = 1e-3;

/** Opaque ones first: they hide parts of the others. */
std::vector<std::size_t> drawing_order(const std::vector<Surface>& surfaces) {
    std::vector<std::size_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(), [&](std::size_t index) { return !surfaces[index].is_see_through(); });
    return order;
}

/** Rows in which surfaces may be seen. */
PixelRows rows_of(const FrameRequest& request, std::array<double, 6> box) {
    // Bounds that are estimated may be a little too narrow; pixels beside those that are met may have a line, too.
    constexpr double widening = 1.0 / 64;
    double margin = 2;
    bool is_bounded = request.sharing.rows;
    for (const Surface& surface : request.surfaces) {
        const WireFrame* const wires = traits_of(surface.geometry).wires;
        margin = std::max(margin, wires != nullptr ? 2 + wires->width : 0);
        is_bounded = is_bounded && !surface.outside && !traits_of(surface.geometry).has_own_values &&
                     !(wires != nullptr && wires->is_undeformed);
    }
    if (!is_bounded) {
        return {0, request.height};
    }
    const double wider = widening * diagonal_of(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis] -= wider;
        box[axis + 3] += wider;
    }
    const auto [first_row, of_height] = request.place();
    const PixelRows rows = rows_of_box(box, request.camera, of_height, margin);
    const auto within = [&](std::uint32_t row) { return std::clamp(row, first_row, first_row + request.height) - first_row; };
    return {within(rows.first), within(rows.end)};
}

/** Elements of which surfaces show faces, but not where a cut ends them, once for each such surface. */
std::uint64_t n_half_drawn(const FrameRequest& request, const RuntimeVolume& volume) {
    std::uint64_t n_cut_elements = 0;
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        n_cut_elements += volume.is_cut(index) ? volume.classes()[index].n_elements : 0;
    }
    const auto n_surfaces = std::ranges::count_if(
        request.surfaces, [](const Surface& surface) { return traits_of(surface.geometry).lacks_own_boundary; });
    return n_cut_elements * static_cast<std::uint64_t>(n_surfaces);
}

} // namespace

struct Renderer::Impl {
    const Device& device;
    const RuntimeVolume& volume;
    DeviceVolume data;
    VolumeRanges ranges;
    ShownFields fields;
    PassSet passes;
    LayeredPicture picture;
    std::optional<ScreenPass> screen;
    RendererTimes times;
    std::uint64_t n_overlapping = 0;

    Impl(const Device& on, const RuntimeVolume& of, Precision with, const TaskControl* task,
         const std::optional<std::array<double, 6>>& bounds_of_whole, bool expects_overlaps)
        : device(on), volume(of), data(on, of, with, task, bounds_of_whole), ranges(on, of, data), fields(of, data, ranges),
          passes(on, of, data, ranges, task), picture(on, with) {
        if (expects_overlaps) {
            data.expect_overlaps();
        } else {
            find_overlaps(task);
        }
        times.hierarchy_milliseconds = data.hierarchy_milliseconds();
    }

    void find_overlaps(const TaskControl* task);
    ScreenPass& screen_pass() { return screen ? *screen : screen.emplace(device, data.precision()); }
    std::vector<SurfaceFacts> draw_surfaces(const FrameRequest& request, Frame& frame);
    void draw_volume(const FrameRequest& request, Frame& frame);
    std::uint32_t flags_of_range(const Surface& surface, std::uint32_t time_step, double offset);
};

void Renderer::Impl::find_overlaps(const TaskControl* task) {
    if (can_find_overlaps(volume)) {
        const Clock::time_point start = Clock::now();
        std::vector<const Hierarchy*> hierarchies;
        for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
            hierarchies.push_back(&data.hierarchy(index));
        }
        n_overlapping = overlapping_elements(volume, hierarchies, device.background(), task).size();
        times.overlaps_milliseconds = milliseconds_since(start);
        if (n_overlapping > 0) {
            data.expect_overlaps();
        } else {
            data.exclude_overlaps();
        }
    }
}

std::uint32_t Renderer::Impl::flags_of_range(const Surface& surface, std::uint32_t time_step, double offset) {
    // What is found by place comes in double precision.
    if (data.precision() == Precision::float64 || surface.colors.points.size() < 2 || surface.by_place) {
        return 0;
    }
    const double lower = surface.colors.points.front().value, upper = surface.colors.points.back().value;
    // Over which all colours come if they change as fast as anywhere: at the lower end of a logarithmic scale.
    const double extent = surface.colors.is_logarithmic ? lower * (std::log(upper) - std::log(lower)) : upper - lower;
    const double error = ranges.float32_error(surface.field, time_step, offset);
    return error > channel_tolerance * extent ? pixel_flag::range_too_fine : 0;
}

std::vector<SurfaceFacts> Renderer::Impl::draw_surfaces(const FrameRequest& request, Frame& frame) {
    std::vector<SurfaceFacts> facts(request.surfaces.size());
    for (const std::size_t index : drawing_order(request.surfaces)) {
        const Surface& surface = request.surfaces[index];
        SurfaceDrawing drawing(request, surface, data, fields, passes);
        const Clock::time_point start = Clock::now();
        picture.provide(surface);
        drawing.provide();
        const DeviceTimer timer(device, false);
        times.compile_milliseconds += milliseconds_since(start);

        facts[index] = surface_facts(drawing);
        picture.draw(drawing, index, flags_of_range(surface, request.time_step, drawing.offset()));
        frame.render_milliseconds += timer.wall_milliseconds();
        frame.device_milliseconds += timer.milliseconds();
    }
    return facts;
}

void Renderer::Impl::draw_volume(const FrameRequest& request, Frame& frame) {
    const VolumeRendering& wanted = *request.volume;
    const double offset = fields.upload(wanted.field, request.time_step);
    const Clock::time_point start = Clock::now();
    VolumePass& pass = passes.of(wanted.field).volume();
    pass.choose(wanted, offset, fields.component(wanted.field));
    const DeviceTimer timer(device, false);
    times.compile_milliseconds += milliseconds_since(start);

    if (request.gives_runs) {
        picture.give_runs(pass, data);
    } else {
        picture.draw(pass, data);
    }
    frame.render_milliseconds += timer.wall_milliseconds();
    frame.device_milliseconds += timer.milliseconds();
}

Renderer::Renderer(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control,
                   const std::optional<std::array<double, 6>>& bounds_of_whole, bool expects_overlaps) {
    m_impl = std::make_unique<Impl>(device, volume, precision, control, bounds_of_whole, expects_overlaps);
}

Renderer::~Renderer() = default;

VolumeRanges& Renderer::ranges() { return m_impl->ranges; }

std::uint64_t Renderer::most_pixels(const FrameRequest& request) const {
    // The largest buffer: of colours, of two crossings with isosurfaces a pixel, of states of rays in a volume.
    const Precision precision = m_impl->data.precision();
    const std::size_t of_surfaces = std::max(4 * real_bytes(precision), 2 * sample_bytes(precision));
    return m_impl->device.max_binding_bytes() / (request.volume ? volume_state_bytes(precision) : of_surfaces);
}

Frame Renderer::render(const FrameRequest& asked, const TaskControl* control) {
    Impl& impl = *m_impl;
    check_request(asked, impl.volume);
    if (asked.surfaces.empty() && !asked.volume) {
        return background_frame(asked);
    }
    const DeviceTask task(impl.device, control);
    const DeviceWork before = impl.device.work();
    const FrameRequest request = prepared(asked, impl.volume, impl.fields);
    Frame frame;
    frame.width = request.width;
    frame.height = request.height;
    frame.counts.pixels = std::uint64_t{request.width} * request.height;
    frame.counts.overlapping_elements = impl.n_overlapping;
    frame.counts.half_drawn_elements += n_half_drawn(request, impl.volume);
    frame.is_met.resize(request.surfaces.size());
    impl.passes.keep(request);
    impl.picture.begin(request, rows_of(request, impl.data.bounds()), frame);
    const std::vector<SurfaceFacts> facts = impl.draw_surfaces(request, frame);
    if (request.volume) {
        impl.draw_volume(request, frame);
    }
    // Waits for all of it.
    const DeviceTimer timer(impl.device, false);
    if (!request.volume) {
        impl.picture.finish();
    }
    std::vector<Buffer::Read> reads = impl.picture.settle();
    const auto take_time = [&] {
        frame.render_milliseconds += timer.wall_milliseconds();
        frame.device_milliseconds += timer.milliseconds();
    };
    // Where nothing is pending, reading is not the device's work.
    const bool is_pending = impl.device.collects_submissions();
    if (!is_pending) {
        take_time();
    }
    std::optional<LayerRead> layer;
    if (request.for_screen) {
        frame.screen.resize(sizeof(std::uint32_t) * frame.counts.pixels);
        reads.push_back({&impl.screen_pass().draw(impl.picture.drawn()), std::as_writable_bytes(std::span(frame.screen))});
    } else {
        layer.emplace(impl.picture.drawn(), impl.data.precision(), request.with_buffers);
        std::ranges::copy(layer->reads(), std::back_inserter(reads));
    }
    Buffer::read_together(reads);
    if (is_pending) {
        take_time();
    }
    impl.picture.count();
    impl.times.upload_milliseconds = impl.data.upload_milliseconds();
    for (std::size_t index = 0; index < frame.is_met.size(); ++index) {
        frame.is_met[index] = frame.is_met[index] || frame.special_values[index].is_shown;
    }
    frame.is_met = met_as_asked(asked, impl.volume, std::move(frame.is_met));
    if (layer) {
        layer->fill(facts, frame);
    }
    const DeviceWork after = impl.device.work();
    frame.submissions = after.submissions - before.submissions;
    frame.host_waits = after.host_waits - before.host_waits;
    return frame;
}

void Renderer::forget_fields(std::optional<std::uint32_t> only) {
    m_impl->passes.forget_fields();
    m_impl->ranges.forget_fields(only);
    m_impl->data.forget_fields(only);
}

const RendererTimes& Renderer::times() const { return m_impl->times; }

RendererMemory Renderer::memory() const {
    return {m_impl->data.field_bytes(), m_impl->data.geometry_bytes(), m_impl->data.hierarchy_bytes()};
}

} // namespace elvis
