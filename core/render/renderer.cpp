#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/device/device_time.hpp>
#include <core/render/pass_set.hpp>
#include <core/render/picture/color_pass.hpp>
#include <core/render/picture/frame_read.hpp>
#include <core/render/picture/merge_pass.hpp>
#include <core/render/picture/occlusion_pass.hpp>
#include <core/render/picture/picture_rows.hpp>
#include <core/render/renderer.hpp>

#include <core/base/bounds.hpp>
#include <core/base/error.hpp>
#include <core/volume/outline.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>

namespace elvis {

namespace {

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/** What a colour channel may be off. */
constexpr double channel_tolerance = 1e-3;

/** Opaque ones first: they hide parts of the others. */
std::vector<std::size_t> drawing_order(const std::vector<Surface>& surfaces) {
    std::vector<std::size_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(), [&](std::size_t index) { return !surfaces[index].is_see_through(); });
    return order;
}

bool is_whole_boundary(const Surface& surface) {
    const auto* boundary = std::get_if<BoundaryFaces>(&surface.geometry);
    return boundary && boundary->groups.empty();
}

bool is_lit(const FrameRequest& request, const Surface& surface) { return request.lighting.has_value() && surface.is_lit; }

/** Crossings of one ray with one see-through surface that are drawn: far more than people can tell apart. */
constexpr std::uint32_t max_rounds = 64;

} // namespace

struct Renderer::Impl {
    const Device& device;
    const RuntimeVolume& volume;
    Precision precision;
    DeviceVolume data;
    ColorPass color_pass;
    MergePass merge_pass;
    OcclusionPass occlusion_pass;
    ShownFields fields;
    PassSet passes;
    RendererTimes times;
    /** Kept from frame to frame: fresh memory costs a page fault for each page. */
    std::unique_ptr<Layer> layer;
    /** Of the layer's pixels, for lines. */
    std::optional<Buffer> places;
    /** Empty until it is asked for. */
    std::vector<Vector3> outline;

    Impl(const Device& on, const RuntimeVolume& of, Precision with, const TaskControl* task)
        : device(on), volume(of), precision(with), data(on, of, with, task), color_pass(on, with), merge_pass(on, with),
          occlusion_pass(on, with), fields(on, of, data), passes(on, of, data, fields, task) {
        times.hierarchy_milliseconds = data.hierarchy_milliseconds();
    }

    void check(const FrameRequest& request) const;
    FrameRequest with_offsets(FrameRequest request);
    FrameRequest with_own_boundaries(FrameRequest request) const;
    void provide(const FrameRequest& request, const Surface& surface);
    void provide_volume(const FrameRequest& request);
    void draw_surface(const FrameRequest& request, std::size_t index, bool is_alone, Frame& frame,
                      std::vector<SurfaceFacts>& facts);
    void draw_geometry(const FrameRequest& request, const Surface& surface, const LayerTarget& target, FrameCounts& counts);
    void draw_isosurfaces(const FrameRequest& request, const Surface& surface, const Isosurfaces& wanted,
                          const LayerTarget& target, FrameCounts& counts);
    void draw_volume(const FrameRequest& request, FrameCounts& counts);
    std::uint32_t flags_of_range(const Surface& surface, std::uint32_t time_step, double offset);
    CutPlaneGeometry view(const FrameRequest& request, const SurfaceGeometry& geometry) const;
    PixelRows rows_of(const FrameRequest& request) const;
    double offset_of(const Surface& surface) const { return fields.offset(surface.field); }
    bool is_flat() const { return volume.dimension() == 2; }
};

void Renderer::Impl::check(const FrameRequest& request) const {
    const std::uint64_t n_pixels = std::uint64_t{request.width} * request.height;
    if (n_pixels == 0 || n_pixels >= 0x7fffffffu) {
        throw Error("image", "a picture of " + std::to_string(request.width) + " x " + std::to_string(request.height) +
                                 " pixels cannot be drawn");
    }
    for (const Surface& surface : request.surfaces) {
        const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry);
        if (isosurfaces &&
            (isosurfaces->values.empty() || !std::is_sorted(isosurfaces->values.begin(), isosurfaces->values.end()))) {
            throw Error("isosurface", "needs values, in ascending order");
        }
    }
    if (request.volume && is_flat()) {
        throw Error(volume.path(), "is two-dimensional: there is no volume to be rendered");
    }
    for (const Surface& surface : request.surfaces) {
        const auto* wires = std::get_if<WireFrame>(&surface.geometry);
        const bool fits_both = std::holds_alternative<ElementFaces>(surface.geometry) ||
                               (wires && std::holds_alternative<ElementFaces>(wires->faces));
        const bool is_for_flat = std::holds_alternative<FlatElements>(surface.geometry) ||
                                 (wires && std::holds_alternative<FlatElements>(wires->faces));
        if (wires && passes.n_cut_elements() > 0) {
            throw Error(volume.path(),
                        "has elements that are only parts of their reference shape (elvis_inside): their edges cannot be "
                        "drawn; mesh lines on a surface can");
        }
        if (!fits_both && is_flat() != is_for_flat) {
            throw Error(volume.path(), is_flat() ? "is two-dimensional: it is drawn as a surface, without planes or boundary"
                                                 : "is no surface: planes through it or its boundary can be drawn");
        }
    }
}

/** The boundary of elements that are cut is where they are, too: a surface of its own, that looks the same. */
FrameRequest Renderer::Impl::with_own_boundaries(FrameRequest request) const {
    const std::size_t n_surfaces = passes.n_cut_elements() > 0 ? request.surfaces.size() : 0;
    for (std::size_t index = 0; index < n_surfaces; ++index) {
        if (is_whole_boundary(request.surfaces[index])) {
            Surface surface = request.surfaces[index];
            Isosurfaces own;
            own.field.is_own_boundary = true;
            own.values = {0};
            surface.geometry = own;
            request.surfaces.push_back(std::move(surface));
        }
    }
    return request;
}

/** Isosurfaces are found with the digits that differences from their values have. */
FrameRequest Renderer::Impl::with_offsets(FrameRequest request) {
    for (Surface& surface : request.surfaces) {
        if (auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
            const double middle = 0.5 * (isosurfaces->values.front() + isosurfaces->values.back());
            const bool is_own_color = surface.field == isosurfaces->field;
            isosurfaces->field = fields.about(isosurfaces->field, middle, request.time_step);
            surface.field = is_own_color ? isosurfaces->field : surface.field;
        }
    }
    return request;
}

/** Compiles what the surface needs and is not there yet. */
void Renderer::Impl::provide(const FrameRequest& request, const Surface& surface) {
    passes.select(surface.field, request.time_step);
    const Clock::time_point start = Clock::now();
    color_pass.provide(is_lit(request, surface), surface.has_lines());
    passes.provide(request, surface);
    times.compile_milliseconds += milliseconds_since(start);
}

void Renderer::Impl::provide_volume(const FrameRequest& request) {
    passes.select(request.volume->field, request.time_step);
    const Clock::time_point start = Clock::now();
    passes.provide_volume(*request.volume);
    times.compile_milliseconds += milliseconds_since(start);
}

std::uint32_t Renderer::Impl::flags_of_range(const Surface& surface, std::uint32_t time_step, double offset) {
    if (precision == Precision::float64 || surface.colors.points.size() < 2) {
        return 0;
    }
    const double lower = surface.colors.points.front().value, upper = surface.colors.points.back().value;
    // Over which all colours come if they change as fast as anywhere: at the lower end of a logarithmic scale.
    const double extent = surface.colors.is_logarithmic ? lower * (std::log(upper) - std::log(lower)) : upper - lower;
    const double error = fields.float32_error(surface.field, time_step, offset);
    return error > channel_tolerance * extent ? pixel_flag::range_too_fine : 0;
}

/** The rays of the picture, anchored at the surface if it is a plane, else at the middle of the volume. */
CutPlaneGeometry Renderer::Impl::view(const FrameRequest& request, const SurfaceGeometry& geometry) const {
    CutPlane plane;
    if (const auto* given = std::get_if<CutPlane>(&geometry)) {
        plane = *given;
    } else {
        const std::array<double, 6>& bounds = data.bounds();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            plane.plane[axis] = request.camera.look_at[axis] - request.camera.eye[axis];
            plane.plane[3] -= plane.plane[axis] * 0.5 * (bounds[axis] + bounds[axis + 3]);
        }
    }
    return cut_plane_geometry(plane, request.camera, request.width, request.height, data.centre());
}

/** Rows in which surfaces may be seen. */
PixelRows Renderer::Impl::rows_of(const FrameRequest& request) const {
    // Bounds that are estimated may be a little too narrow; pixels beside those that are met may have a line, too.
    constexpr double widening = 1.0 / 64;
    double margin = 2;
    bool is_bounded = request.sharing.parts;
    for (const Surface& surface : request.surfaces) {
        const auto* wires = std::get_if<WireFrame>(&surface.geometry);
        margin = std::max(margin, wires ? 2 + wires->width : 0);
        is_bounded = is_bounded && !surface.outside;
    }
    if (!is_bounded) {
        return {0, request.height};
    }
    std::array<double, 6> box = data.bounds();
    const double wider = widening * diagonal_of(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis] -= wider;
        box[axis + 3] += wider;
    }
    return rows_of_box(box, request.camera, request.height, margin);
}

void Renderer::Impl::draw_isosurfaces(const FrameRequest& request, const Surface& surface, const Isosurfaces& wanted,
                                      const LayerTarget& target, FrameCounts& counts) {
    constexpr std::uint32_t first = 1;
    const CutPlaneGeometry rays = view(request, surface.geometry);
    IsosurfacePass& pass = passes.isosurfaces(wanted.field);
    pass.draw(rays, first, target, counts);
    target.after_samples();
    const ShownComponent component = fields.component(surface.field);
    if (surface.field != wanted.field) {
        passes.point_values().draw(component, target, counts);
    }
    if (surface.has_lines()) {
        // No quadric: the frame stands for its rows.
        passes.lines(surface).draw(rays, component, line_request(surface, offset_of(surface)), &pass.bending(), &pass.frame(),
                                   target, counts);
    }
}

void Renderer::Impl::draw_volume(const FrameRequest& request, FrameCounts& counts) {
    const Camera& camera = request.camera;
    ViewStart start{camera.eye, std::nullopt};
    if (camera.orthographic) {
        Vector3 along{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            along[axis] = camera.look_at[axis] - camera.eye[axis];
        }
        const double size = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
        start.direction = Vector3{along[0] / size, along[1] / size, along[2] / size};
    }
    merge_pass.fill_empty();
    passes.volume().draw(view(request, BoundaryFaces{}), start, merge_pass, request.sharing.parts, counts);
}

void Renderer::Impl::draw_geometry(const FrameRequest& request, const Surface& surface, const LayerTarget& target,
                                   FrameCounts& counts) {
    const CutPlaneGeometry rays = view(request, surface.geometry);
    const ShownComponent component = fields.component(surface.field);
    // A layer holds one surface; each class of faces counts as one, so that the nearest wins.
    constexpr std::uint32_t first = 1;
    const LineRequest lines = line_request(surface, offset_of(surface));
    if (std::holds_alternative<CutPlane>(surface.geometry)) {
        passes.cut_planes(surface.has_lines()).draw(rays, first, component, lines, surface.outside.has_value(), target, counts);
    } else if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
        SurfacePass& pass = passes.cut_shapes();
        SurfaceSolver& solver = passes.solver(*shape);
        pass.draw(rays, solver, *shape, first, component, surface.outside.has_value(), target, counts);
        target.after_samples();
        if (surface.has_lines()) {
            passes.lines(surface).draw(rays, component, lines, &pass.bending(), &solver.rows(), target, counts);
        }
    } else if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
        draw_isosurfaces(request, surface, *isosurfaces, target, counts);
    } else if (const auto* wires = std::get_if<WireFrame>(&surface.geometry)) {
        passes.edge_pass().draw(passes.edges(wires->faces), request.camera, wires->width, -offset_of(surface), first, target);
    } else {
        passes.faces(*face_geometry(surface)).draw(rays, first, component, target, counts);
        counts.half_drawn_elements = std::holds_alternative<ElementFaces>(surface.geometry) ? passes.n_cut_elements() : 0;
        target.after_samples();
        if (surface.has_lines()) {
            passes.lines(surface).draw(rays, component, lines, nullptr, nullptr, target, counts);
        }
    }
}

void Renderer::Impl::draw_surface(const FrameRequest& request, std::size_t index, bool is_alone, Frame& frame,
                                  std::vector<SurfaceFacts>& facts) {
    const Surface& surface = request.surfaces[index];
    const double offset = offset_of(surface);
    const CutPlaneGeometry rays = view(request, surface.geometry);
    const bool is_plane = std::holds_alternative<CutPlane>(surface.geometry);
    facts[index] = {offset, is_plane ? std::optional<Vector3>(rays.normal) : std::nullopt};
    const std::uint32_t common_flags = flags_of_range(surface, request.time_step, offset);
    const bool is_wire_frame = std::holds_alternative<WireFrame>(surface.geometry);
    const bool wants_places = (surface.has_lines() && !is_plane) || std::holds_alternative<Isosurfaces>(surface.geometry);
    if (wants_places && (!places || places->bytes() != layer->n_pixels() * place_bytes(precision))) {
        places.reset();
        places.emplace(device, layer->n_pixels() * place_bytes(precision));
    }
    // Edges are nothing behind which much would be hidden from them.
    const Buffer* const opaque = is_alone || is_wire_frame ? nullptr : merge_pass.depths();
    // Lines look at neighbouring pixels, hidden ones included.
    const bool is_occluded = opaque != nullptr && request.sharing.depths && !surface.has_lines();
    const Buffer* beyond = nullptr;
    MergePass::Wanted wanted{1, 0, layer->height};
    std::uint64_t n_hidden = 0;
    for (std::uint32_t round = 0; wanted.n_pixels > 0 && round < max_rounds; ++round) {
        layer->marks.fill(0);
        if (is_occluded) {
            occlusion_pass.begin(*layer, *opaque);
        }
        const auto after_samples = [&] {
            const std::uint32_t n_spared = is_occluded ? occlusion_pass.end(*layer, *opaque) : 0;
            frame.counts.hidden_pixels += n_spared;
            n_hidden += n_spared;
        };
        const bool wants_normals = request.with_buffers || is_lit(request, surface) || surface.has_lines();
        draw_geometry(
            request, surface,
            {*layer, beyond, wants_normals, wants_places ? &*places : nullptr, wanted.first_row, wanted.end_row, after_samples},
            frame.counts);
        if (opaque != nullptr) {
            n_hidden += occlusion_pass.hide(*layer, *opaque);
        }
        color_pass.draw(*layer, surface, index, rays, is_alone ? request.background : Color{}, offset, common_flags,
                        is_lit(request, surface) ? &*request.lighting : nullptr);
        wanted = is_alone
                     ? MergePass::Wanted{}
                     : merge_pass.merge(*layer, static_cast<std::uint32_t>(index) + 1, !is_plane, surface.is_see_through());
        // A plane is met once, and what edges hide of others is nothing.
        if (is_plane || is_wire_frame) {
            wanted = {};
        }
        if (wanted.n_pixels > 0 && request.sharing.parts) {
            frame.counts.spared_pixels += std::uint64_t{layer->width} * (layer->height - (wanted.end_row - wanted.first_row));
        } else {
            wanted = {wanted.n_pixels, 0, layer->height};
        }
        beyond = merge_pass.beyond();
    }
    frame.counts.work_limit_pixels += wanted.n_pixels;
    // Where nothing was looked for behind others, it may have been there.
    frame.is_met[index] = n_hidden > 0;
}

Renderer::Renderer(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control) {
    m_impl = std::make_unique<Impl>(device, volume, precision, control);
}

Renderer::~Renderer() = default;

std::array<double, 6> Renderer::bounds() const { return m_impl->data.bounds(); }

FieldExtrema Renderer::field_extrema(const FieldChoice& field, std::uint32_t time_step) {
    return m_impl->fields.extrema(field, time_step);
}

const std::vector<Vector3>& Renderer::outline() {
    if (m_impl->outline.empty()) {
        m_impl->outline = outline_points(m_impl->volume);
    }
    return m_impl->outline;
}

FieldRange Renderer::field_range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    return m_impl->fields.range(field, time_step, certainty);
}

double Renderer::value_rounding(const FieldChoice& field, std::uint32_t time_step) {
    if (!field.expression && (field.component >= 0 || field.is_own_boundary)) {
        return 0;
    }
    const bool is_double = m_impl->precision == Precision::float64;
    if (is_double) {
        // Rare, and not worth a kernel else.
        constexpr double narrow = 1e-6;
        const FieldRange range = field_range(field, time_step);
        if (range.upper - range.lower > narrow * std::max({1.0, std::abs(range.lower), std::abs(range.upper)})) {
            return 0;
        }
    }
    const double error = m_impl->fields.float32_error(field, time_step, 0);
    return is_double && !field.expression ? 0x1p-29 * error : error;
}

Frame Renderer::render(const FrameRequest& wanted, const TaskControl* control) {
    Impl& impl = *m_impl;
    impl.check(wanted);
    if (wanted.surfaces.empty() && !wanted.volume) {
        return background_frame(wanted);
    }
    const DeviceTask task(impl.device, control);
    const FrameRequest request = impl.with_own_boundaries(impl.with_offsets(wanted));
    Frame frame;
    frame.width = request.width;
    frame.height = request.height;
    frame.counts.pixels = std::uint64_t{request.width} * request.height;
    if (!impl.layer || impl.layer->width != request.width || impl.layer->height != request.height) {
        impl.layer.reset();
        impl.layer = std::make_unique<Layer>(impl.device, impl.precision, request.width, request.height);
    }
    // A single surface that hides what is behind it needs no merging.
    const bool is_alone = request.surfaces.size() == 1 && !request.surfaces[0].is_see_through() && !request.volume;
    impl.layer->rows = is_alone ? PixelRows{0, request.height} : impl.rows_of(request);
    if (!is_alone) {
        impl.merge_pass.begin(request.width, request.height, impl.layer->rows, request.background);
        frame.counts.spared_pixels +=
            std::uint64_t{request.width} * (request.height - (impl.layer->rows.end - impl.layer->rows.first));
    }
    impl.passes.keep(request);
    impl.color_pass.begin(request.surfaces.size());
    frame.is_met.resize(request.surfaces.size());
    std::vector<SurfaceFacts> facts(request.surfaces.size());
    double wall = 0, device = 0;
    for (const std::size_t index : drawing_order(request.surfaces)) {
        impl.provide(request, request.surfaces[index]);
        const DeviceTimer timer(impl.device);
        impl.draw_surface(request, index, is_alone, frame, facts);
        wall += timer.wall_milliseconds();
        device += timer.milliseconds();
    }
    if (request.volume) {
        impl.provide_volume(request);
    }
    const DeviceTimer timer(impl.device);
    if (request.volume) {
        impl.draw_volume(request, frame.counts);
    } else if (!is_alone) {
        impl.merge_pass.finish();
    }
    frame.render_milliseconds = wall + timer.wall_milliseconds();
    frame.device_milliseconds = device + timer.milliseconds();

    impl.times.upload_milliseconds = impl.data.upload_milliseconds();
    frame.special_values = impl.color_pass.special_values();
    for (std::size_t index = 0; index < frame.is_met.size(); ++index) {
        frame.is_met[index] = frame.is_met[index] || frame.special_values[index].is_shown;
    }
    // A boundary with_own_boundaries added belongs to the surface that asked for it.
    for (std::size_t index = 0, added = wanted.surfaces.size(); added < frame.is_met.size(); ++index) {
        if (is_whole_boundary(request.surfaces[index])) {
            frame.is_met[index] = frame.is_met[index] || frame.is_met[added];
            ++added;
        }
    }
    frame.is_met.resize(wanted.surfaces.size());
    const Layer& drawn = is_alone ? *impl.layer : impl.merge_pass.picture();
    read_frame(drawn, impl.precision, facts, request.with_buffers, frame);
    return frame;
}

const RendererTimes& Renderer::times() const { return m_impl->times; }

RendererMemory Renderer::memory() const {
    return {m_impl->data.field_bytes(), m_impl->data.geometry_bytes(), m_impl->data.hierarchy_bytes()};
}

} // namespace elvis
