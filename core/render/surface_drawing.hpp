/**
 * @file surface_drawing.hpp
 * Draws one surface into a layer, whatever its kind. A new kind has an overload of each of the private functions.
 */
#pragma once

#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/render/field/shown_field.hpp>
#include <core/render/lines/edge_pass.hpp>
#include <core/render/lines/line_request.hpp>
#include <core/render/pass_set.hpp>
#include <core/render/picture/condition_pass.hpp>
#include <core/render/picture/lic_pass.hpp>

namespace elvis {

/** The rays of a picture, anchored at the plane, or at the middle of the volume where there is none. */
CutPlaneGeometry rays_of(const FrameRequest& request, const CutPlane* plane, const DeviceVolume& data);

class SurfaceDrawing {
public:
    /** Uploads the surface's field. All must outlive it. */
    SurfaceDrawing(const FrameRequest& request, const Surface& surface, const DeviceVolume& data, ShownFields& fields,
                   PassSet& passes);

    /** Compiles what is needed and not there yet. */
    void provide();
    /** Where each pixel's ray meets the surface first, and the field there. */
    void draw(const LayerTarget& target, FrameCounts& counts);
    /** What rests on that: lines, colours by another field or by what is found by place, and a plane where it lies in no
     * element. */
    void finish(const LayerTarget& target, FrameCounts& counts);
    /** Of all pixels that show the surface in `target`: values of another field, into the samples of `values`. */
    void draw_field(const FieldChoice& field, const LayerTarget& target, const Layer& values, FrameCounts& counts);
    /** What values of a condition's field are compared with. */
    ConditionLimit limit_of(const Condition& condition);
    /** Of the vectors whose components' values are drawn. */
    LicPass::Vectors vectors_of(const Lic& lic);

    const Surface& surface() const { return m_surface; }
    const SurfaceTraits& traits() const { return m_traits; }
    const CutPlaneGeometry& rays() const { return m_rays; }
    /** What its field lacks on the device. */
    double offset() const { return m_offset; }

private:
    void provide_values(const FieldChoice& field);
    void provide(const CutPlane& plane);
    void provide(const CutShape& shape);
    void provide(const Isosurfaces& isosurfaces);
    void provide(const WireFrame& wires);
    void provide(const FaceGeometry& faces);

    void draw(const CutPlane& plane, const LayerTarget& target, FrameCounts& counts);
    void draw(const CutShape& shape, const LayerTarget& target, FrameCounts& counts);
    void draw(const Isosurfaces& isosurfaces, const LayerTarget& target, FrameCounts& counts);
    void draw(const WireFrame& wires, const LayerTarget& target, FrameCounts& counts);
    void draw(const FaceGeometry& faces, const LayerTarget& target, FrameCounts& counts);

    void finish(const CutPlane& plane, const LayerTarget& target, FrameCounts& counts);
    void finish(const CutShape& shape, const LayerTarget& target, FrameCounts& counts);
    void finish(const Isosurfaces& isosurfaces, const LayerTarget& target, FrameCounts& counts);
    void finish(const WireFrame& wires, const LayerTarget& target, FrameCounts& counts);
    void finish(const FaceGeometry& faces, const LayerTarget& target, FrameCounts& counts);

    LinePass& lines_on(const CutShape& shape);
    LinePass& lines_on(const Isosurfaces& isosurfaces);
    LinePass& lines_on(const FaceGeometry& faces);
    template <class Kind> void provide_lines(const Kind& kind);
    template <class Kind>
    void draw_lines(const Kind& kind, const Buffer* bending, const Buffer* shape, const LayerTarget& target,
                    FrameCounts& counts);

    const FrameRequest& m_request;
    const Surface& m_surface;
    ShownFields& m_fields;
    PassSet& m_passes;
    SurfaceTraits m_traits;
    CutPlaneGeometry m_rays;
    double m_offset;
    ShownComponent m_component;
    LineRequest m_lines;
    /** Of the field that colours it. */
    FieldPasses& m_own;
    Precision m_precision;
    EdgePass m_edge_pass;
};

} // namespace elvis
