#include <core/render/surface.hpp>

#include <core/expression/expression.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

struct TraitsOfKind {
    SurfaceTraits operator()(const CutPlane& plane) const { return {.plane = &plane, .may_lie_outside = true}; }
    SurfaceTraits operator()(const BoundaryFaces& boundary) const { return {.is_whole_boundary = boundary.groups.empty()}; }
    SurfaceTraits operator()(const FlatElements&) const { return {.fits_flat = true, .fits_solid = false}; }
    SurfaceTraits operator()(const ElementFaces&) const { return {.fits_flat = true, .lacks_own_boundary = true}; }
    SurfaceTraits operator()(const WireFrame& wires) const {
        const SurfaceTraits of_faces = std::visit(*this, wires.faces);
        return {.fits_flat = of_faces.fits_flat, .fits_solid = of_faces.fits_solid, .wires = &wires};
    }
    SurfaceTraits operator()(const CutShape& shape) const {
        const bool is_arrows = std::holds_alternative<ArrowSurface>(shape);
        return {.fits_flat = is_arrows, .may_lie_outside = !is_arrows, .has_own_values = is_arrows};
    }
    SurfaceTraits operator()(const Isosurfaces& isosurfaces) const { return {.isosurfaces = &isosurfaces}; }
};

} // namespace

double ColorTable::value_change(double most) const {
    const double extent = points.back().value - points.front().value;
    double change = extent > 0 ? most * extent : std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double width = points[i].value - points[i - 1].value;
        for (std::size_t channel = 0; channel < 3 && width > 0; ++channel) {
            const double rise = std::abs(points[i].rgb[channel] - points[i - 1].rgb[channel]);
            change = std::min(change, most * width / std::max(rise, 1e-300));
        }
    }
    return change;
}

bool FieldChoice::operator==(const FieldChoice& other) const {
    if (is_own_boundary || other.is_own_boundary) {
        return is_own_boundary == other.is_own_boundary;
    }
    if (expression && other.expression) {
        return expression == other.expression || expression->text() == other.expression->text();
    }
    return !expression && !other.expression && field == other.field && component == other.component;
}

SurfaceTraits traits_of(const SurfaceGeometry& geometry) { return std::visit(TraitsOfKind(), geometry); }

} // namespace elvis
