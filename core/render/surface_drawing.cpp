#include <core/base/bounds.hpp>
#include <core/render/surface_drawing.hpp>

#include <cmath>

namespace elvis {

namespace {

/** The number of what is drawn: a layer holds one surface. Each class of faces counts as one, so that the nearest wins. */
constexpr std::uint32_t first_surface = 1;

ShownComponent shown_component(const Surface& surface, const ShownFields& fields, Precision precision) {
    ShownComponent component = fields.component(surface.field);
    component.value_tolerance = static_cast<float>(surface.colors.value_change(precision == Precision::float64 ? 1e-9 : 1e-3));
    return component;
}

} // namespace

CutPlaneGeometry rays_of(const FrameRequest& request, const CutPlane* plane, const DeviceVolume& data) {
    const Camera& camera = request.camera;
    CutPlane across;
    if (plane == nullptr) {
        const std::array<double, 6>& bounds = data.bounds();
        const Vector3 along = minus(camera.look_at, camera.eye);
        across.plane = {along[0], along[1], along[2], 0};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            across.plane[3] -= along[axis] * 0.5 * (bounds[axis] + bounds[axis + 3]);
        }
    }
    const auto [first_row, of_height] = request.place();
    CutPlaneGeometry geometry =
        cut_plane_geometry(plane != nullptr ? *plane : across, camera, request.width, of_height, data.centre());
    geometry.set_most_error(most_error_along_ray * diagonal_of(data.bounds()));
    geometry.begin_at(first_row);
    return geometry;
}

SurfaceDrawing::SurfaceDrawing(const FrameRequest& request, const Surface& surface, const DeviceVolume& data,
                               ShownFields& fields, PassSet& passes)
    : m_request(request), m_surface(surface), m_fields(fields), m_passes(passes), m_traits(traits_of(surface.geometry)),
      m_rays(rays_of(request, m_traits.plane, data)), m_offset(fields.upload(surface.field, request.time_step)),
      m_component(shown_component(surface, fields, data.precision())), m_lines(line_request(surface, m_offset)),
      m_own(passes.of(surface.field)), m_precision(data.precision()), m_edge_pass(data.precision()) {}

void SurfaceDrawing::provide() {
    std::visit([this](const auto& kind) { provide(kind); }, m_surface.geometry);
    for (const Condition& condition : m_surface.conditions) {
        provide_values(condition.field);
    }
    if (m_surface.lic) {
        for (const FieldChoice& component : m_surface.lic->vectors) {
            provide_values(component);
        }
    }
}

/** What draw_field() needs. */
void SurfaceDrawing::provide_values(const FieldChoice& field) {
    FieldPasses& passes = m_passes.of(field);
    if (m_traits.plane != nullptr) {
        passes.cut_planes(false);
    } else {
        passes.point_values();
    }
}

void SurfaceDrawing::draw(const LayerTarget& target, FrameCounts& counts) {
    std::visit([&](const auto& kind) { draw(kind, target, counts); }, m_surface.geometry);
}

void SurfaceDrawing::finish(const LayerTarget& target, FrameCounts& counts) {
    std::visit([&](const auto& kind) { finish(kind, target, counts); }, m_surface.geometry);
    if (m_surface.by_place) {
        m_passes.by_place().draw(m_surface, m_request, m_offset, m_precision, target);
    }
}

void SurfaceDrawing::draw_field(const FieldChoice& field, const LayerTarget& target, const Layer& values, FrameCounts& counts) {
    m_fields.upload(field, m_request.time_step);
    const ShownComponent component = m_fields.component(field);
    FieldPasses& passes = m_passes.of(field);
    if (m_traits.plane == nullptr) {
        passes.point_values().draw(component, target, values.samples, counts);
        return;
    }
    // Planes write no places: the same points are found again.
    values.marks.fill(0);
    passes.cut_planes(false).draw(m_rays, first_surface, component, {}, {.layer = values, .wants_normals = false}, counts);
}

ConditionLimit SurfaceDrawing::limit_of(const Condition& condition) {
    const double offset = m_fields.upload(condition.field, m_request.time_step);
    return {condition.value - offset, m_fields.value_error(condition.field, m_request.time_step, offset), condition.is_above,
            condition.takes_equal};
}

LicPass::Vectors SurfaceDrawing::vectors_of(const Lic& lic) {
    LicPass::Vectors vectors;
    for (std::size_t i = 0; i < lic.vectors.size(); ++i) {
        vectors.offsets[i] = m_fields.upload(lic.vectors[i], m_request.time_step);
        // The offset is added again: errors are those of whole values.
        vectors.error = std::hypot(vectors.error, m_fields.value_error(lic.vectors[i], m_request.time_step, 0));
    }
    return vectors;
}

LinePass& SurfaceDrawing::lines_on(const CutShape& shape) {
    return m_own.lines_on_shapes(m_passes.solver(shape).quadric_rows());
}

LinePass& SurfaceDrawing::lines_on(const Isosurfaces& isosurfaces) {
    return isosurfaces.field.is_own_boundary ? m_own.lines_on_own_boundary() : m_own.lines_on_shapes(0);
}

LinePass& SurfaceDrawing::lines_on(const FaceGeometry& faces) {
    return m_own.lines_on_faces(m_passes.faces(faces), m_traits.is_whole_boundary);
}

template <class Kind> void SurfaceDrawing::provide_lines(const Kind& kind) {
    if (m_surface.has_lines()) {
        lines_on(kind).provide(!m_lines.isovalues.empty());
    }
}

template <class Kind>
void SurfaceDrawing::draw_lines(const Kind& kind, const Buffer* bending, const Buffer* shape, const LayerTarget& target,
                                FrameCounts& counts) {
    if (m_surface.has_lines()) {
        lines_on(kind).draw(m_rays, m_component, m_lines, bending, shape, target, counts);
    }
}

void SurfaceDrawing::provide(const CutPlane&) { m_own.cut_planes(m_surface.has_lines()); }

void SurfaceDrawing::draw(const CutPlane&, const LayerTarget& target, FrameCounts& counts) {
    m_own.cut_planes(m_surface.has_lines()).draw(m_rays, first_surface, m_component, m_lines, target, counts);
}

void SurfaceDrawing::finish(const CutPlane&, const LayerTarget& target, FrameCounts& counts) {
    CutPlanePass& pass = m_own.cut_planes(m_surface.has_lines());
    if (m_surface.has_lines()) {
        pass.draw_lines(m_component, m_lines, target, counts);
    }
    if (m_surface.outside) {
        pass.draw_outside(m_rays, first_surface, target);
    }
}

void SurfaceDrawing::provide(const CutShape& shape) {
    SurfacePass& pass = m_own.cut_shapes();
    if (!m_passes.solver(shape).has_own_values()) {
        pass.provide_elements();
    }
    provide_lines(shape);
}

void SurfaceDrawing::draw(const CutShape& shape, const LayerTarget& target, FrameCounts& counts) {
    m_own.cut_shapes().draw(m_rays, m_passes.solver(shape), shape, first_surface, m_component, m_surface.outside.has_value(),
                            target, counts);
}

void SurfaceDrawing::finish(const CutShape& shape, const LayerTarget& target, FrameCounts& counts) {
    draw_lines(shape, &m_own.cut_shapes().bending(), &m_passes.solver(shape).rows(), target, counts);
}

void SurfaceDrawing::provide(const Isosurfaces& isosurfaces) {
    if (m_surface.field != isosurfaces.field) {
        m_own.point_values();
    }
    const double offset = m_fields.upload(isosurfaces.field, m_request.time_step);
    m_passes.of(isosurfaces.field)
        .isosurfaces()
        .choose(isosurfaces, m_request.time_step, offset, m_fields.component(isosurfaces.field));
    provide_lines(isosurfaces);
}

void SurfaceDrawing::draw(const Isosurfaces& isosurfaces, const LayerTarget& target, FrameCounts& counts) {
    m_passes.of(isosurfaces.field).isosurfaces().draw(m_rays, m_surface.clip, first_surface, target, counts);
}

void SurfaceDrawing::finish(const Isosurfaces& isosurfaces, const LayerTarget& target, FrameCounts& counts) {
    const IsosurfacePass& pass = m_passes.of(isosurfaces.field).isosurfaces();
    if (m_surface.field != isosurfaces.field) {
        m_own.point_values().draw(m_component, target, target.layer.samples, counts);
    }
    // No quadric: the frame stands for its rows.
    draw_lines(isosurfaces, &pass.bending(), &pass.frame(), target, counts);
}

void SurfaceDrawing::provide(const WireFrame& wires) { m_passes.edges(wires); }

void SurfaceDrawing::draw(const WireFrame& wires, const LayerTarget& target, FrameCounts&) {
    m_edge_pass.draw(m_passes.edges(wires), m_request.camera, m_request.place(), wires.width, -m_offset, first_surface, target);
}

void SurfaceDrawing::finish(const WireFrame&, const LayerTarget&, FrameCounts&) {}

void SurfaceDrawing::provide(const FaceGeometry& faces) {
    m_own.faces(m_passes.faces(faces));
    provide_lines(faces);
}

void SurfaceDrawing::draw(const FaceGeometry& faces, const LayerTarget& target, FrameCounts& counts) {
    m_own.faces(m_passes.faces(faces)).draw(m_rays, first_surface, m_component, target, counts);
}

void SurfaceDrawing::finish(const FaceGeometry& faces, const LayerTarget& target, FrameCounts& counts) {
    draw_lines(faces, nullptr, nullptr, target, counts);
}

} // namespace elvis
