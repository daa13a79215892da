/**
 * @file surface.hpp
 * A surface of a picture: where it lies and how it looks.
 */
#pragma once

#include <core/surface/shape.hpp>
#include <core/volume/element/element_selection.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace elvis {

/** Display values in [0, 1]. */
using Color = std::array<double, 4>;

/** A colour map, piecewise linear in display RGB: what the device interpolates. */
struct ColorTable {
    struct Point {
        double value = 0; ///< field value, ascending; two equal values make a step
        std::array<double, 3> rgb{};
    };
    std::vector<Point> points; ///< at least one
    Color below{};             ///< for values below the first point
    Color above{};
    Color nan{};
    /** Made for equal ratios of values: all values of the points are above 0, and what is not has the colour of NaN. */
    bool is_logarithmic = false;

    /** By how much a value may change without a change of a channel by more than `most`; steps are not counted. */
    double value_change(double most) const;
};

class Expression;

/** Which number is drawn: of a field, or an expression over fields. */
struct FieldChoice {
    std::uint32_t field = 0;
    /** Component, or -1 for the magnitude of a vector. A scalar has component 0. */
    std::int32_t component = 0;
    /** In place of the field, if there is one; of the same volume. */
    std::shared_ptr<const Expression> expression{};
    /**
     * Of a component: about which value single precision is to keep most digits, which the device then subtracts; the middle of
     * the range if absent. It is nothing that is drawn: equal choices may differ in it.
     */
    std::optional<double> offset{};
    /** In place of the field: the function that cuts elements, whose isosurface 0 is their own boundary (elvis_inside). */
    bool is_own_boundary = false;

    bool operator==(const FieldChoice& other) const;
};

/** The plane a x + b y + c z + d = 0; (a, b, c) need not be of unit length but not zero. */
struct CutPlane {
    std::array<double, 4> plane{};
};

/** Faces without neighbour: those of the named boundary groups, or all if there are none. */
struct BoundaryFaces {
    std::vector<std::string> groups;

    auto operator<=>(const BoundaryFaces&) const = default;
};

/** The elements of a two-dimensional volume. */
struct FlatElements {
    auto operator<=>(const FlatElements&) const = default;
};

/** Faces of chosen elements. */
struct ElementFaces {
    ElementSelection selection{};

    auto operator<=>(const ElementFaces&) const = default;
};

/** The geometries that are sets of faces. */
using FaceGeometry = std::variant<BoundaryFaces, FlatElements, ElementFaces>;

/** Edges of faces, as lines on the picture. They have no field: their colour is the map's for the value 0. */
struct WireFrame {
    FaceGeometry faces{};
    /** In pixels. 1: the pixels whose closed square meets an edge; else those with their centre within half of it. */
    double width = 1;
    /** Where they are without displacement, if the volume is displaced (RuntimeVolume::undeformed). */
    bool is_undeformed = false;
};

/** How crossings of rays with isosurfaces are found. */
enum class IsosurfaceMethod : std::uint8_t {
    /** By bounds that hold over whole intervals of rays; by the Bernstein form where those do not decide. */
    interval,
    /** By projection along rays, and roots from the Bernstein form or from the eigenvalues of the companion matrix. */
    bernstein,
    companion
};

/** Where a field takes one of these values. */
struct Isosurfaces {
    /** Whose isosurfaces they are; Surface::field is what colours them. */
    FieldChoice field{};
    /** Ascending; at least one. */
    std::vector<double> values{};
    /** Elements whose range holds no value are not looked at, where ranges are known: with equal pictures, but slower, without.
     */
    bool skips_by_range = true;
    IsosurfaceMethod method = IsosurfaceMethod::interval;
    /**
     * Not with intervals: each segment is one polynomial of this degree, 2 to 13, and its roots are taken as they are. 0: as
     * many polynomials and of such degree as it takes, and roots of the field itself.
     */
    std::uint32_t degree = 0;
};

using SurfaceGeometry = std::variant<CutPlane, BoundaryFaces, FlatElements, ElementFaces, WireFrame, CutShape, Isosurfaces>;

/** What kinds of surfaces differ in, but for how they are drawn (surface_drawing.hpp). */
struct SurfaceTraits {
    /** Of which volumes it can be: flat ones, others. */
    bool fits_flat = false, fits_solid = true;
    /** All of it lies in this plane: each ray meets it once, and its normal is known. */
    const CutPlane* plane = nullptr;
    /** It lies where a field takes values, and another field may colour it. */
    const Isosurfaces* isosurfaces = nullptr;
    /** It is nothing but lines: without field, light, contours and mesh lines. */
    const WireFrame* wires = nullptr;
    /** Its form does not come from the elements: parts of it may lie in none. */
    bool may_lie_outside = false;
    /** Each of its parts has a value of its own, in place of the field's at its points: no lines, conditions or outside. */
    bool has_own_values = false;
    /** All faces without neighbour. */
    bool is_whole_boundary = false;
    /** Of elements that are cut (elvis_inside) it shows faces alone, not where the cut ends them. */
    bool lacks_own_boundary = false;
};

/** What it points to is in `geometry`. */
SurfaceTraits traits_of(const SurfaceGeometry& geometry);

/** Holds at the points at which a field is above a value, or below it. */
struct Condition {
    FieldChoice field{};
    double value = 0;
    bool is_above = true;
    /** Whether it holds where the field takes the value, too. */
    bool takes_equal = false;
};

/** How lines on a surface are drawn. */
struct LineStyle {
    /** In pixels, at least 1: the pixels that meet the line, and those with their centre within half of it. */
    double width = 1;
    /** The colour map's at the isovalue where there is none. */
    std::optional<std::array<double, 3>> color;
    /** Of pixels for which it stays open whether they meet a line; if absent they are drawn as if they did. */
    std::optional<std::array<double, 3>> undecided_color;
};

/**
 * From which neighbours on, in rows and columns, nothing matters to the lines that a pixel shows: those where wide ones may
 * pass, and what these look at (shaders/picture/line_stretches.comp).
 */
inline int line_reach(double width) { return width > 1 ? static_cast<int>(0.5 * width + 0.7072) + 2 : 1; }

/** Lines on which the field takes given values. */
struct Contours {
    std::vector<double> values; ///< ascending
    LineStyle style;
    /**
     * Colour of each, in place of the style's, if there are any. Pixels for which it stays open whether they meet a line are
     * then not drawn unless they have a colour: a surface on which the field is constant would be nothing but line.
     */
    std::vector<std::array<double, 3>> inks{};

    /** Of contour `index`; any where that is the colour map's. */
    std::array<double, 3> color(std::size_t index) const {
        return inks.empty() ? style.color.value_or(std::array<double, 3>{}) : inks[index];
    }
};

/** Where the boundaries of elements meet the surface. */
struct MeshLines {
    LineStyle style{1, std::array<double, 3>{0, 0, 0}, std::nullopt};
};

/**
 * Line integral convolution: colours become darker, streak by streak along a vector field's part in the surface's tangent
 * plane. All lengths are in pixels (core/render/picture/lic_pass.hpp).
 */
struct Lic {
    /** The vector's components along x, y and z. */
    std::array<FieldChoice, 3> vectors{};
    /** Of the curve over which noise is averaged, on each side of a pixel. */
    double length = 20;
    /** In [0, 1]: colours are multiplied by 1 - contrast to 1. */
    double contrast = 0.6;
    /** Across one value of the noise. */
    std::uint32_t grain = 1;
};

struct Surface {
    SurfaceGeometry geometry;
    FieldChoice field{};
    /**
     * Of a prepared request (prepared_request.hpp): what is shown, if it is found by place; `field` is then one of the
     * device's, with which the surface is found.
     */
    std::optional<FieldChoice> by_place{};
    /** What people know the field by, if not by its own name or text. */
    std::string field_label{};
    ColorTable colors{};
    std::optional<Contours> contours{};
    std::optional<MeshLines> mesh_lines{};
    /** How often a pixel is halved at most to decide whether it meets a line; at most 12. */
    std::uint32_t subdivisions = 5;
    /** Points with a x + b y + c z + d < 0 for any of these are not drawn. */
    std::vector<std::array<double, 4>> clip{};
    /**
     * Points of elements at which one of these does not hold are not drawn. The whole boundary is then that of the part in
     * which all hold: where they cut elements, the surfaces on which their fields take their values belong to it.
     */
    std::vector<Condition> conditions{};
    /** In [0, 1]. */
    double opacity = 1;
    /** Of a CutShape: its colour where it lies in no element; without, it is seen through there. */
    std::optional<std::array<double, 3>> outside{};
    /** Whether the picture's lighting is for this surface, too. */
    bool is_lit = true;
    /** Not of wires, nor of what has values of its own. */
    std::optional<Lic> lic{};

    /** Whether something behind it can be seen through it. */
    bool is_see_through() const { return opacity < 1 || !clip.empty() || !conditions.empty(); }
    bool has_lines() const { return contours.has_value() || mesh_lines.has_value(); }
};

} // namespace elvis
