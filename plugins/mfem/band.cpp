#include "band.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace elvis_mfem {

namespace {

/** Of the largest extent of the curve. */
constexpr double relative_width = 0.05;

/** Degrees of freedom of a segment, along it: vertices come first in H1, then what is inside the segments, one after the other.
 */
std::vector<std::size_t> dofs_of(const Collection& collection, const Segments& segments, std::size_t segment) {
    const auto order = static_cast<std::size_t>(collection.order);
    std::vector<std::size_t> dofs;
    if (collection.family == Family::l2) {
        for (std::size_t i = 0; i <= order; ++i) {
            dofs.push_back(segment * (order + 1) + i);
        }
        return dofs;
    }
    dofs.push_back(static_cast<std::size_t>(segments.vertices[segment][0]));
    for (std::size_t i = 0; i + 1 < order; ++i) {
        dofs.push_back(segments.n_vertices + segment * (order - 1) + i);
    }
    dofs.push_back(static_cast<std::size_t>(segments.vertices[segment][1]));
    return dofs;
}

std::size_t n_dofs(const Collection& collection, const Segments& segments) {
    const auto order = static_cast<std::size_t>(collection.order);
    const std::size_t n = segments.vertices.size();
    return collection.family == Family::l2 ? n * (order + 1) : segments.n_vertices + n * (order - 1);
}

/** Linear nodes of vertices. */
GridFunction nodes_of(const Mesh& curve) {
    GridFunction nodes;
    nodes.n_components = 3;
    nodes.is_interleaved = true;
    nodes.values = curve.coordinates;
    return nodes;
}

/** Adds the band's width to nodes with three components, side by side. */
void widen(GridFunction& nodes) {
    std::array<double, 3> least{}, most{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        least[axis] = most[axis] = nodes.values[axis];
        for (std::size_t at = axis; at < nodes.values.size(); at += 3) {
            least[axis] = std::min(least[axis], nodes.values[at]);
            most[axis] = std::max(most[axis], nodes.values[at]);
        }
    }
    const auto extent = [&](std::size_t axis) { return most[axis] - least[axis]; };
    // In the plane, if that is as good.
    std::size_t across = 1;
    for (const std::size_t axis : {std::size_t{2}, std::size_t{0}}) {
        across = extent(axis) < extent(across) ? axis : across;
    }
    const double size = relative_width * std::max({extent(0), extent(1), extent(2)});
    const auto n = static_cast<std::size_t>(nodes.collection.order) + 1;
    const std::vector<double> places = points(nodes.collection.basis, static_cast<int>(n));
    for (std::size_t dof = 0; dof < nodes.values.size() / 3; ++dof) {
        nodes.values[3 * dof + across] += size * (places[dof / n % n] - 0.5);
    }
}

/** With three components, side by side. */
GridFunction in_space(const GridFunction& nodes) {
    const auto n_components = static_cast<std::size_t>(nodes.n_components);
    const std::size_t n = nodes.values.size() / n_components;
    GridFunction result{
        .collection = nodes.collection, .nurbs_order = 0, .n_components = 3, .is_interleaved = true, .values = {}};
    result.values.resize(3 * n);
    for (std::size_t dof = 0; dof < n; ++dof) {
        for (std::size_t component = 0; component < std::min<std::size_t>(3, n_components); ++component) {
            result.values[3 * dof + component] =
                nodes.is_interleaved ? nodes.values[dof * n_components + component] : nodes.values[component * n + dof];
        }
    }
    return result;
}

} // namespace

GridFunction on_band(const GridFunction& function, const Segments& segments) {
    const Collection& own = function.collection;
    if (own.is_vector() || function.nurbs_order > 0 || (own.dimension != 0 && own.dimension != 1)) {
        throw std::invalid_argument("on segments, H1 and L2 functions of one dimension are read");
    }
    const auto n_components = static_cast<std::size_t>(function.n_components);
    const std::size_t n = n_dofs(own, segments);
    if (function.values.size() != n * n_components) {
        throw std::invalid_argument("the file holds " + std::to_string(function.values.size()) +
                                    " values, but on these segments its space has " + std::to_string(n) +
                                    " degrees of freedom with " + std::to_string(n_components) + " component(s)");
    }
    GridFunction result{.collection = {.family = Family::l2, .dimension = 2, .order = own.order, .basis = own.basis},
                        .nurbs_order = 0,
                        .n_components = function.n_components,
                        .is_interleaved = true,
                        .values = {}};
    for (std::size_t segment = 0; segment < segments.vertices.size(); ++segment) {
        const std::vector<std::size_t> dofs = dofs_of(own, segments, segment);
        for (std::size_t across = 0; across < dofs.size(); ++across) {
            for (const std::size_t dof : dofs) {
                for (std::size_t component = 0; component < n_components; ++component) {
                    result.values.push_back(function.is_interleaved ? function.values[dof * n_components + component]
                                                                    : function.values[component * n + dof]);
                }
            }
        }
    }
    return result;
}

Mesh band_of(Mesh curve) {
    auto segments = std::make_shared<Segments>();
    segments->n_vertices = curve.n_vertices;
    for (const MeshElement& element : curve.elements) {
        segments->vertices.push_back({element.vertices[0], element.vertices[1]});
    }
    Mesh band = std::move(curve);
    const auto other = [n = static_cast<std::int32_t>(segments->n_vertices)](std::int32_t vertex) { return vertex + n; };
    for (MeshElement& element : band.elements) {
        element.geometry = Geometry::square;
        element.vertices[2] = other(element.vertices[1]);
        element.vertices[3] = other(element.vertices[0]);
    }
    for (BoundaryElement& point : band.boundary) {
        point.vertices[1] = other(point.vertices[0]);
    }
    GridFunction nodes = on_band(in_space(band.nodes ? *band.nodes : nodes_of(band)), *segments);
    widen(nodes);
    band.dimension = 2;
    band.space_dimension = 3;
    band.n_vertices = 2 * segments->n_vertices;
    band.coordinates.clear();
    band.nodes = std::move(nodes);
    if (band.solution) {
        band.solution = on_band(*band.solution, *segments);
    }
    band.segments = std::move(segments);
    return band;
}

} // namespace elvis_mfem
