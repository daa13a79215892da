#include <core/render/color_pass.hpp>
#include <core/render/cut_plane_geometry.hpp>
#include <core/render/cut_plane_pass.hpp>
#include <core/render/device_time.hpp>
#include <core/render/edge_pass.hpp>
#include <core/render/face_pass.hpp>
#include <core/render/isosurface_pass.hpp>
#include <core/render/layer.hpp>
#include <core/render/line_pass.hpp>
#include <core/render/merge_pass.hpp>
#include <core/render/occlusion_pass.hpp>
#include <core/render/point_value_pass.hpp>
#include <core/render/renderer.hpp>
#include <core/render/shown_field.hpp>
#include <core/render/surface_pass.hpp>
#include <core/render/volume_pass.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace elvis {

namespace {

using Clock = std::chrono::steady_clock;
double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/** What a colour channel may be off. */
constexpr double channel_tolerance = 1e-3;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/** What the picture's samples lack of a surface's. */
struct SurfaceFacts {
    double offset = 0;
    /** Of a plane. */
    std::optional<Vector3> normal;
};

/** The geometries that are sets of faces. */
using FaceGeometry = std::variant<BoundaryFaces, FlatElements, ElementFaces>;

std::optional<FaceGeometry> face_geometry(const Surface& surface) {
    return std::visit(
        [](const auto& geometry) -> std::optional<FaceGeometry> {
            if constexpr (std::is_constructible_v<FaceGeometry, decltype(geometry)>) {
                return geometry;
            } else {
                return std::nullopt;
            }
        },
        surface.geometry);
}
/** The passes that show one field. */
struct FieldPasses {
    std::optional<CutPlanePass> cut_planes, cut_planes_with_lines;
    std::map<FaceGeometry, FacePass> faces;
    std::optional<SurfacePass> cut_shapes;
    std::map<FaceGeometry, LinePass> lines_on_faces;
    /** By SurfaceSolver::quadric_rows(). */
    std::map<std::uint32_t, LinePass> lines_on_shapes;
    std::optional<LinePass> lines_on_own_boundary;
    std::optional<IsosurfacePass> isosurfaces;
    std::optional<PointValuePass> point_values;
    std::optional<VolumePass> volume;
};

/** Opaque ones first: they hide parts of the others. */
std::vector<std::size_t> drawing_order(const std::vector<Surface>& surfaces) {
    std::vector<std::size_t> order(surfaces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(), [&](std::size_t index) { return !surfaces[index].is_see_through(); });
    return order;
}

bool is_lit(const FrameRequest& request, const Surface& surface) { return request.lighting.has_value() && surface.is_lit; }

/** Solvers kept for later frames: some hold large meshes. */
constexpr std::size_t most_solvers = 32;

/** Crossings of one ray with one see-through surface that are drawn: far more than people can tell apart. */
constexpr std::uint32_t max_rounds = 64;

} // namespace

struct Renderer::Impl {
    const Device& device;
    const RuntimeVolume& volume;
    Precision precision;
    const TaskControl* control;
    DeviceVolume data;
    ColorPass color_pass;
    MergePass merge_pass;
    OcclusionPass occlusion_pass;
    ShownFields fields;
    /** Of the geometry that has this version. */
    std::map<FaceGeometry, FaceSet> face_sets;
    std::map<FaceGeometry, EdgeSet> edge_sets;
    std::uint64_t faces_version = 0;
    std::optional<EdgePass> edge_pass;
    /** By what they show: ShownFields::key. Those of the last frame, and of its time step. */
    std::map<std::string, FieldPasses> passes;
    /** Of the selected field. */
    FieldPasses* current = nullptr;
    std::uint32_t passes_step = 0;
    /** By solver_key(); of no field. */
    std::map<std::string, SurfaceSolver> solvers;
    RendererTimes times;
    /** Kept from frame to frame: fresh memory costs a page fault for each page. */
    std::unique_ptr<Layer> layer;
    /** Of the layer's pixels, for lines. */
    std::optional<Buffer> places;

    Impl(const Device& on, const RuntimeVolume& of, Precision with, const TaskControl* task)
        : device(on), volume(of), precision(with), control(task), data(on, of, with, task), color_pass(on, with),
          merge_pass(on, with), occlusion_pass(on, with), fields(on, of, data) {
        times.hierarchy_milliseconds = data.hierarchy_milliseconds();
    }

    FrameRequest with_offsets(FrameRequest request);
    FrameRequest with_own_boundaries(FrameRequest request) const;
    void keep_fields(const FrameRequest& request);
    void select(const FieldChoice& field, std::uint32_t time_step);
    std::uint32_t flags_of_range(const Surface& surface, std::uint32_t time_step, double offset);
    void check(const FrameRequest& request) const;
    void provide_passes(const FrameRequest& request, const Surface& surface);
    CutPlanePass& cut_plane_pass(bool with_lines);
    void follow_geometry();
    FacePass& face_pass(const FaceGeometry& faces);
    const FaceSet& face_set(const FaceGeometry& faces);
    LinePass& line_pass(const Surface& surface);
    IsosurfacePass& isosurface_pass(const Isosurfaces& wanted);
    void draw_isosurfaces(const FrameRequest& request, const Surface& surface, const Isosurfaces& wanted,
                          const LayerTarget& target, FrameCounts& counts);
    void provide_volume_pass(const FrameRequest& request);
    void draw_volume(const FrameRequest& request, FrameCounts& counts);
    const EdgeSet& edge_set(const FaceGeometry& faces);
    std::vector<ElementFace> chosen_faces(const FaceGeometry& faces) const;
    void draw_surface(const FrameRequest& request, std::size_t index, bool is_alone, Frame& frame,
                      std::vector<SurfaceFacts>& facts);
    void draw_geometry(const FrameRequest& request, const Surface& surface, const LayerTarget& target, FrameCounts& counts);
    template <class Real>
    void read(const Layer& from, const std::vector<SurfaceFacts>& facts, bool with_buffers, Frame& frame) const;
    CutPlaneGeometry view(const FrameRequest& request, const SurfaceGeometry& geometry) const;
    double offset_of(const Surface& surface) const { return fields.offset(surface.field); }
    bool is_flat() const { return volume.dimension() == 2; }
    std::uint64_t n_cut_elements() const;
};

void Renderer::Impl::check(const FrameRequest& request) const {
    const std::uint64_t n_pixels = std::uint64_t{request.width} * request.height;
    if (n_pixels == 0 || n_pixels >= 0x7fffffffu) {

        throw Error("image", "a picture of " + std::to_string(request.width) + " x " + std::to_string(request.height) +
                                 " pixels cannot be drawn");
    }
    if (request.surfaces.empty() && !request.volume) {
        throw Error("picture", "has nothing to show");
    }
    for (const Surface& surface : request.surfaces) {
        const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry);
        if (isosurfaces && (isosurfaces->values.empty() || !std::is_sorted(isosurfaces->values.begin(), isosurfaces->values.end()))) {
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
        if (wires && n_cut_elements() > 0) {
            throw Error(volume.path(), "has elements that are only parts of their reference shape (elvis_inside): their edges cannot be "
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
    const std::size_t n_surfaces = n_cut_elements() > 0 ? request.surfaces.size() : 0;
    for (std::size_t index = 0; index < n_surfaces; ++index) {
        const auto* boundary = std::get_if<BoundaryFaces>(&request.surfaces[index].geometry);
        if (boundary && boundary->groups.empty()) {
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

/** Elements that are only parts of their reference shape. */
std::uint64_t Renderer::Impl::n_cut_elements() const {
    std::uint64_t count = 0;
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        count += volume.is_cut(index) ? volume.classes()[index].n_elements : 0;
    }
    return count;
}

CutPlanePass& Renderer::Impl::cut_plane_pass(bool with_lines) {
    std::optional<CutPlanePass>& pass = with_lines ? current->cut_planes_with_lines : current->cut_planes;
    if (!pass) {
        if (with_lines) {
            data.provide_derivative_bounds();
        }
        pass.emplace(device, volume, data, with_lines);
    }
    return *pass;
}

/** Of surfaces other than planes. */
LinePass& Renderer::Impl::line_pass(const Surface& surface) {
    data.provide_derivative_bounds();
    if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
        const std::uint32_t rows = solvers.at(solver_key(*shape)).quadric_rows();
        return current->lines_on_shapes.try_emplace(rows, device, volume, data, nullptr, false, rows).first->second;
    }
    if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
        if (isosurfaces->field.is_own_boundary) {
            if (!current->lines_on_own_boundary) {
                current->lines_on_own_boundary.emplace(device, volume, data, nullptr, false, 0, true);
            }
            return *current->lines_on_own_boundary;
        }
        return current->lines_on_shapes.try_emplace(0, device, volume, data, nullptr, false, 0).first->second;
    }
    follow_geometry();
    const FaceGeometry faces = *face_geometry(surface);
    const auto* boundary = std::get_if<BoundaryFaces>(&faces);
    // Where elements are cut, rays pass between faces and what the cut leaves out.
    const bool is_whole_boundary = boundary != nullptr && boundary->groups.empty() && n_cut_elements() == 0;
    return current->lines_on_faces.try_emplace(faces, device, volume, data, &face_set(faces), is_whole_boundary, 0)
        .first->second;
}

/** Drops what belongs to another shape of the elements. */
void Renderer::Impl::follow_geometry() {
    if (data.geometry_version() != faces_version) {
        for (auto& [key, of_field] : passes) {
            of_field.faces.clear();
            of_field.lines_on_faces.clear();
        }
        face_sets.clear();
        edge_sets.clear();
        faces_version = data.geometry_version();
    }
}

/** For the selected field, which is that of `wanted`. */
IsosurfacePass& Renderer::Impl::isosurface_pass(const Isosurfaces& wanted) {
    if (!current->isosurfaces) {
        data.provide_derivative_bounds();
        current->isosurfaces.emplace(device, volume, data);
    }
    current->isosurfaces->choose(wanted, fields.offset(wanted.field), fields.component(wanted.field));
    return *current->isosurfaces;
}

const EdgeSet& Renderer::Impl::edge_set(const FaceGeometry& faces) {
    follow_geometry();
    auto found = edge_sets.find(faces);
    if (found == edge_sets.end()) {
        found = edge_sets.try_emplace(faces, device, volume, data, chosen_faces(faces), control).first;
    }
    return found->second;
}

const FaceSet& Renderer::Impl::face_set(const FaceGeometry& faces) {
    auto set = face_sets.find(faces);
    if (set == face_sets.end()) {
        set = face_sets.try_emplace(faces, device, volume, data, chosen_faces(faces), control).first;
    }
    return set->second;
}

FacePass& Renderer::Impl::face_pass(const FaceGeometry& faces) {
    follow_geometry();
    auto found = current->faces.find(faces);
    if (found == current->faces.end()) {
        found = current->faces.try_emplace(faces, device, volume, data, face_set(faces)).first;
    }
    return found->second;
}

std::vector<ElementFace> Renderer::Impl::chosen_faces(const FaceGeometry& faces) const {
    if (const auto* boundary = std::get_if<BoundaryFaces>(&faces)) {
        return boundary_faces(volume, boundary->groups, control);
    }
    if (const auto* elements = std::get_if<ElementFaces>(&faces)) {
        return faces_of_elements(volume, elements->selection, control);
    }
    return surface_elements(volume);
}

/** Compiles what the surface needs and is not there yet. */
void Renderer::Impl::provide_passes(const FrameRequest& request, const Surface& surface) {
    const Clock::time_point start = Clock::now();
    color_pass.provide(is_lit(request, surface), surface.has_lines());
    if (std::holds_alternative<CutPlane>(surface.geometry)) {
        cut_plane_pass(surface.has_lines());
    } else if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
        if (!current->cut_shapes) {
            current->cut_shapes.emplace(device, volume, data);
        }
        const std::string key = solver_key(*shape);
        if (solvers.size() >= most_solvers && !solvers.contains(key)) {
            solvers.clear();
        }
        solvers.try_emplace(key, device, precision, *shape);
    } else if (const auto* wires = std::get_if<WireFrame>(&surface.geometry)) {
        edge_set(wires->faces);
    } else if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
        if (surface.field != isosurfaces->field && !current->point_values) {
            current->point_values.emplace(device, volume, data);
        }
        select(isosurfaces->field, request.time_step);
        isosurface_pass(*isosurfaces);
        select(surface.field, request.time_step);
    } else {
        face_pass(*face_geometry(surface));
    }
    if (surface.has_lines() && !std::holds_alternative<CutPlane>(surface.geometry) &&
        !std::holds_alternative<WireFrame>(surface.geometry)) {
        line_pass(surface).provide(surface.contours && !surface.contours->values.empty());
    }
    times.compile_milliseconds += milliseconds_since(start);
}

/** Level sets are found with the digits that differences from their values have. */
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

/** Drops what the frame's surfaces do not need. */
void Renderer::Impl::keep_fields(const FrameRequest& request) {
    std::vector<FieldSelection> selections;
    std::set<std::string> keys;
    for (const Surface& surface : request.surfaces) {
        selections.push_back(fields.selection(surface.field, request.time_step));
        keys.insert(ShownFields::key(surface.field));
        if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
            selections.push_back(fields.selection(isosurfaces->field, request.time_step));
            keys.insert(ShownFields::key(isosurfaces->field));
        }
    }
    if (request.volume) {
        selections.push_back(fields.selection(request.volume->field, request.time_step));
        keys.insert(ShownFields::key(request.volume->field));
    }
    // Bounds of derivatives, on which passes rest, are made anew for another step.
    const bool is_other_step = passes_step != request.time_step;
    std::erase_if(passes, [&](const auto& entry) { return is_other_step || !keys.contains(entry.first); });
    data.keep(selections);
    passes_step = request.time_step;
    current = nullptr;
}

void Renderer::Impl::select(const FieldChoice& field, std::uint32_t time_step) {
    data.select(fields.selection(field, time_step));
    times.upload_milliseconds = data.upload_milliseconds();
    current = &passes[ShownFields::key(field)];
}

std::uint32_t Renderer::Impl::flags_of_range(const Surface& surface, std::uint32_t time_step, double offset) {
    if (precision == Precision::float64 || surface.colors.points.size() < 2) {
        return 0;
    }
    const double extent = surface.colors.points.back().value - surface.colors.points.front().value;
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

void Renderer::Impl::draw_isosurfaces(const FrameRequest& request, const Surface& surface, const Isosurfaces& wanted,
                                      const LayerTarget& target, FrameCounts& counts) {
    constexpr std::uint32_t first = 1;
    const CutPlaneGeometry rays = view(request, surface.geometry);
    IsosurfacePass& pass = *passes.at(ShownFields::key(wanted.field)).isosurfaces;
    pass.draw(rays, first, target, counts);
    target.after_samples();
    const ShownComponent component = fields.component(surface.field);
    if (surface.field != wanted.field) {
        current->point_values->draw(component, target, counts);
    }
    if (surface.has_lines()) {
        // No quadric: the frame stands for its rows.
        line_pass(surface).draw(rays, component, line_request(surface, offset_of(surface)), &pass.bending(), &pass.frame(), target,
                                counts);
    }
}

void Renderer::Impl::provide_volume_pass(const FrameRequest& request) {
    const VolumeRendering& wanted = *request.volume;
    select(wanted.field, request.time_step);
    const Clock::time_point start = Clock::now();
    if (!current->volume) {
        data.provide_derivative_bounds();
        current->volume.emplace(device, volume, data);
    }
    current->volume->choose(wanted, fields.offset(wanted.field), fields.component(wanted.field));
    times.compile_milliseconds += milliseconds_since(start);
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
    current->volume->draw(view(request, BoundaryFaces{}), start, merge_pass, request.sharing.parts, counts);
}

void Renderer::Impl::draw_geometry(const FrameRequest& request, const Surface& surface, const LayerTarget& target,
                                   FrameCounts& counts) {
    const CutPlaneGeometry rays = view(request, surface.geometry);
    const ShownComponent component = fields.component(surface.field);
    // A layer holds one surface; each class of faces counts as one, so that the nearest wins.
    constexpr std::uint32_t first = 1;
    const LineRequest lines = line_request(surface, offset_of(surface));
    if (std::holds_alternative<CutPlane>(surface.geometry)) {
        cut_plane_pass(surface.has_lines()).draw(rays, first, component, lines, surface.outside.has_value(), target, counts);
    } else if (const auto* shape = std::get_if<CutShape>(&surface.geometry)) {
        current->cut_shapes->draw(rays, solvers.at(solver_key(*shape)), *shape, first, component, surface.outside.has_value(),
                                  target, counts);
        target.after_samples();
        if (surface.has_lines()) {
            line_pass(surface).draw(rays, component, lines, &current->cut_shapes->bending(),
                                    &solvers.at(solver_key(*shape)).rows(), target, counts);
        }
    } else if (const auto* isosurfaces = std::get_if<Isosurfaces>(&surface.geometry)) {
        draw_isosurfaces(request, surface, *isosurfaces, target, counts);
    } else if (const auto* wires = std::get_if<WireFrame>(&surface.geometry)) {
        if (!edge_pass) {
            edge_pass.emplace(precision);
        }
        edge_pass->draw(edge_set(wires->faces), request.camera, wires->width, -offset_of(surface), first, target);
    } else {
        face_pass(*face_geometry(surface)).draw(rays, first, component, target, counts);
        counts.half_drawn_elements = std::holds_alternative<ElementFaces>(surface.geometry) ? n_cut_elements() : 0;
        target.after_samples();
        if (surface.has_lines()) {
            line_pass(surface).draw(rays, component, lines, nullptr, nullptr, target, counts);
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
    const bool wants_places =
        (surface.has_lines() && !is_plane) || std::holds_alternative<Isosurfaces>(surface.geometry);
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
    for (std::uint32_t round = 0; wanted.n_pixels > 0 && round < max_rounds; ++round) {
        layer->marks.fill(0);
        if (is_occluded) {
            occlusion_pass.begin(*layer, *opaque);
        }
        const auto after_samples = [&] {
            frame.counts.hidden_pixels += is_occluded ? occlusion_pass.end(*layer, *opaque) : 0;
        };
        const bool wants_normals = request.with_buffers || is_lit(request, surface) || surface.has_lines();
        draw_geometry(request, surface,
                      {*layer, beyond, wants_normals, wants_places ? &*places : nullptr, wanted.first_row, wanted.end_row,
                       after_samples},
                      frame.counts);
        if (opaque != nullptr) {
            occlusion_pass.hide(*layer, *opaque);
        }
        color_pass.draw(*layer, surface, index, rays, is_alone ? request.background : Color{}, offset, common_flags,
                        is_lit(request, surface) ? &*request.lighting : nullptr);
        wanted = is_alone ? MergePass::Wanted{}
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
        beyond = &merge_pass.beyond();
    }
    frame.counts.work_limit_pixels += wanted.n_pixels;
}

template <class Real>
void Renderer::Impl::read(const Layer& from, const std::vector<SurfaceFacts>& facts, bool with_buffers, Frame& frame) const {
    const std::size_t n_pixels = frame.counts.pixels;
    const std::vector<Real> colors = from.colors.read_items<Real>(4 * n_pixels);
    frame.color.assign(colors.begin(), colors.end());
    std::vector<Mark> marks = from.marks.read_items<Mark>(n_pixels);
    FrameCounts& counts = frame.counts;
    for (Mark& mark : marks) {
        // The upper half: of surfaces that are not seen there (shaders/kernels/merge.comp).
        mark.flags = (mark.flags | (mark.flags >> 16u)) & 0xffffu;
        // One element may decide what another leaves open.
        mark.flags &= (mark.flags & pixel_flag::contour) != 0 ? ~pixel_flag::contour_undecided : ~0u;
        mark.flags &= (mark.flags & pixel_flag::mesh_line) != 0 ? ~pixel_flag::mesh_line_undecided : ~0u;
        const auto has = [&mark](std::uint32_t flag) { return (mark.flags & flag) != 0 ? 1u : 0u; };
        counts.hit_pixels += mark.surface() != 0 ? 1 : 0;
        counts.undecided_pixels += has(pixel_flag::undecided);
        counts.nan_pixels += has(pixel_flag::nan);
        counts.work_limit_pixels += has(pixel_flag::work_limit);
        counts.estimated_pixels += has(pixel_flag::estimated);
        counts.isosurface_pixels += has(pixel_flag::isosurface);
        counts.undecided_isosurface_pixels += has(pixel_flag::isosurface_undecided);
        counts.inexact_volume_pixels += has(pixel_flag::volume_tolerance);
        counts.contour_pixels += has(pixel_flag::contour);
        counts.undecided_contour_pixels += has(pixel_flag::contour_undecided);
        counts.mesh_line_pixels += has(pixel_flag::mesh_line);
        counts.undecided_mesh_line_pixels += has(pixel_flag::mesh_line_undecided);
    }
    if (!with_buffers) {
        return;
    }
    const std::vector<Sample<Real>> samples = from.samples.read_items<Sample<Real>>(n_pixels);
    const std::vector<Real> normals = from.normals.read_items<Real>(3 * n_pixels);
    frame.value.assign(n_pixels, not_a_number);
    frame.depth.assign(n_pixels, not_a_number);
    frame.normal.assign(3 * n_pixels, not_a_number);
    frame.element.assign(n_pixels, -1);
    frame.flags.resize(n_pixels);
    for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
        const Mark& mark = marks[pixel];
        frame.flags[pixel] = mark.flags;
        if (mark.surface() != 0) {
            // A picture of one surface may number its classes of faces.
            const SurfaceFacts& surface = facts[std::min<std::size_t>(mark.surface(), facts.size()) - 1];
            frame.value[pixel] = static_cast<double>(samples[pixel].value) + surface.offset;
            frame.depth[pixel] = static_cast<double>(samples[pixel].depth);
            const std::uint32_t number = samples[pixel].number;
            frame.element[pixel] = number == no_number ? -1 : static_cast<std::int64_t>(number);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                frame.normal[3 * pixel + axis] =
                    surface.normal ? (*surface.normal)[axis] : static_cast<double>(normals[3 * pixel + axis]);
            }
        }
    }
}

Renderer::Renderer(const Device& device, const RuntimeVolume& volume, Precision precision, const TaskControl* control) {
    m_impl = std::make_unique<Impl>(device, volume, precision, control);
}

Renderer::~Renderer() = default;

std::array<double, 6> Renderer::bounds() const { return m_impl->data.bounds(); }

FieldRange Renderer::field_range(const FieldChoice& field, std::uint32_t time_step, elvis_certainty* certainty) {
    return m_impl->fields.range(field, time_step, certainty);
}

Frame Renderer::render(const FrameRequest& wanted, const TaskControl* control) {
    Impl& impl = *m_impl;
    impl.check(wanted);
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
    if (!is_alone) {
        impl.merge_pass.begin(request.width, request.height, request.background);
    }
    impl.keep_fields(request);
    impl.color_pass.begin(request.surfaces.size());
    std::vector<SurfaceFacts> facts(request.surfaces.size());
    double wall = 0, device = 0;
    for (const std::size_t index : drawing_order(request.surfaces)) {
        impl.select(request.surfaces[index].field, request.time_step);
        impl.provide_passes(request, request.surfaces[index]);
        const DeviceTimer timer(impl.device);
        impl.draw_surface(request, index, is_alone, frame, facts);
        wall += timer.wall_milliseconds();
        device += timer.milliseconds();
    }
    if (request.volume) {
        impl.provide_volume_pass(request);
    }
    const DeviceTimer timer(impl.device);
    if (request.volume) {
        impl.draw_volume(request, frame.counts);
    } else if (!is_alone) {
        impl.merge_pass.finish();
    }
    frame.render_milliseconds = wall + timer.wall_milliseconds();
    frame.device_milliseconds = device + timer.milliseconds();

    frame.special_values = impl.color_pass.special_values();
    const Layer& drawn = is_alone ? *impl.layer : impl.merge_pass.picture();
    if (impl.precision == Precision::float64) {
        impl.read<double>(drawn, facts, request.with_buffers, frame);
    } else {
        impl.read<float>(drawn, facts, request.with_buffers, frame);
    }
    return frame;
}

const RendererTimes& Renderer::times() const { return m_impl->times; }

RendererMemory Renderer::memory() const {
    return {m_impl->data.field_bytes(), m_impl->data.geometry_bytes(), m_impl->data.hierarchy_bytes()};
}

} // namespace elvis
