/**
 * @file scene_of_view.hpp
 * What a view of ParaView and a representation's settings say, as a scene.
 */
#pragma once

#include <array>
#include <string>
#include <vector>

class vtkPiecewiseFunction;
class vtkRenderer;
class vtkScalarsToColors;

namespace elvis_paraview {

/** What is seen of a volume. */
struct ShownItems {
    /** Of the volume: several, if it is a foreign data set. */
    std::vector<std::string> files;
    unsigned time_step = 0;
    /** A field or an expression; "": the volume's first field, in `color`. */
    std::string field;
    /** ParaView's map; null: all in `color`. */
    vtkScalarsToColors* colors = nullptr;
    std::array<double, 3> color{1, 1, 1};
    bool has_boundary = true, has_mesh_lines = false, is_lit = true, is_float64 = false;
    /** a, b, c, d of ax + by + cz + d = 0. */
    std::vector<std::array<double, 4>> cut_planes;
    /** As many parts of the space that is shown, ax + by + cz + d >= 0, of boundary and isosurfaces. */
    std::vector<std::array<double, 4>> clip_planes;
    /** Of `isosurface_field`, or of `field` if that is "". */
    std::vector<double> isovalues, contours;
    std::string isosurface_field;
    /** Of the volume itself, by values of the field; null: its light is not shown. */
    vtkPiecewiseFunction* opacity = nullptr;
    /** Length of a ray that opacity is over, in the world; 0: a twentieth of the diagonal of the bounds. */
    double unit_distance = 0;

    bool has_surfaces() const { return has_boundary || !cut_planes.empty() || !isovalues.empty(); }
};

/** Size of the renderer's viewport in pixels. */
std::array<int, 2> size_of(vtkRenderer& renderer);

enum class Part { all, surfaces, light };

/**
 * A scene as JSON: the renderer's camera and size, a background that is not seen, and a part of the items. `diagonal`: of the
 * volume's bounds.
 */
std::string scene_of_view(vtkRenderer& renderer, const ShownItems& items, double diagonal, Part part);

} // namespace elvis_paraview
