#include "functionals.hpp"

#include <utility>

namespace elvis_mfem {

namespace {

using Points = std::vector<double>;

Point combine(const Point& a, double factor, const Point& b) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Point difference(const Point& a, const Point& b) { return combine(a, -1, b); }

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/** Calls visit(x, y) with first <= i, j and i + j <= n - first, i fastest: c_i, c_j over c_i + c_j + c_(n-i-j). */
template <class Visit> void for_triangle(const Points& c, int first, Visit&& visit) {
    const int n = static_cast<int>(c.size()) - 1;
    const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
    for (int j = first; j <= n - first; ++j) {
        for (int i = first; i + j <= n - first; ++i) {
            const double w = at(i) + at(j) + at(n - i - j);
            visit(at(i) / w, at(j) / w);
        }
    }
}

/** The same in the tetrahedron. */
template <class Visit> void for_tetrahedron(const Points& c, int first, Visit&& visit) {
    const int n = static_cast<int>(c.size()) - 1;
    const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
    for (int k = first; k <= n - first; ++k) {
        for (int j = first; j + k <= n - first; ++j) {
            for (int i = first; i + j + k <= n - first; ++i) {
                const double w = at(i) + at(j) + at(k) + at(n - i - j - k);
                visit(Point{at(i) / w, at(j) / w, at(k) / w});
            }
        }
    }
}

/** Points without the first and the last. */
Points inner(const Points& closed) { return closed.size() < 3 ? Points{} : Points(closed.begin() + 1, closed.end() - 1); }

/** Calls visit over the product of three sets of points, the first fastest. */
template <class Visit> void for_box(const Points& x, const Points& y, const Points& z, Visit&& visit) {
    for (double c : z) {
        for (double b : y) {
            for (double a : x) {
                visit(Point{a, b, c});
            }
        }
    }
}

/** What stands for the points of the third direction in two dimensions. */
const Points plane{0};

/** Gauss-Legendre points, the only open ones of triangles and tetrahedra in ND and RT. */
Points open_points(int n) { return n > 0 ? points(Basis::gauss_legendre, n) : Points{}; }

void scalar_interior(const Points& c, bool is_whole, Geometry geometry, std::vector<Functional>& out) {
    const Points line = is_whole ? c : inner(c);
    const int first = is_whole ? 0 : 1;
    switch (geometry) {
    case Geometry::triangle:
        for_triangle(c, first, [&](double x, double y) { out.push_back({{x, y, 0}, {}}); });
        break;
    case Geometry::square:
        for_box(line, line, plane, [&](const Point& x) { out.push_back({x, {}}); });
        break;
    case Geometry::cube:
        for_box(line, line, line, [&](const Point& x) { out.push_back({x, {}}); });
        break;
    case Geometry::pyramid:
        for_box(line, line, line, [&](const Point& x) { out.push_back({{x[0] * (1 - x[2]), x[1] * (1 - x[2]), x[2]}, {}}); });
        break;
    case Geometry::tetrahedron:
        for_tetrahedron(c, first, [&](const Point& x) { out.push_back({x, {}}); });
        break;
    case Geometry::prism:
        for (double z : line) {
            for_triangle(c, first, [&](double x, double y) { out.push_back({{x, y, z}, {}}); });
        }
        break;
    }
}

constexpr Point axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

void nd_interior(const Collection& collection, Geometry geometry, std::vector<Functional>& out) {
    const int p = collection.order;
    const Points closed = points(collection.basis, p + 1);
    const Points middle = inner(closed);
    const Points open = points(collection.open_basis, p);
    if (geometry == Geometry::cube || geometry == Geometry::square) {
        const auto n_axes = static_cast<std::size_t>(dimension(geometry));
        for (std::size_t axis = 0; axis < n_axes; ++axis) {
            const auto along = [&](std::size_t d) { return d >= n_axes ? plane : d == axis ? open : middle; };
            for_box(along(0), along(1), along(2), [&](const Point& x) { out.push_back({x, axes[axis]}); });
        }
    } else if (geometry == Geometry::triangle) {
        for_triangle(open_points(p - 1), 0, [&](double x, double y) {
            out.push_back({{x, y, 0}, axes[0]});
            out.push_back({{x, y, 0}, axes[1]});
        });
    } else if (geometry == Geometry::tetrahedron) {
        for_tetrahedron(open_points(p - 2), 0, [&](const Point& x) {
            for (const Point& axis : axes) {
                out.push_back({x, axis});
            }
        });
    } else {
        for (double z : middle) {
            for_triangle(open_points(p - 1), 0, [&](double x, double y) {
                out.push_back({{x, y, z}, axes[0]});
                out.push_back({{x, y, z}, axes[1]});
            });
        }
        for (double z : open) {
            for_triangle(closed, 1, [&](double x, double y) { out.push_back({{x, y, z}, axes[2]}); });
        }
    }
}

/** Signs as in cubes, but if p is odd those of the middle nodes i = (p+1)/2 change halfway across: format.md, section 4. */
void rt_square_interior(const Collection& collection, std::vector<Functional>& out) {
    const auto p = static_cast<std::size_t>(collection.order);
    const Points middle = inner(points(collection.basis, collection.order + 2));
    const Points open = points(collection.open_basis, collection.order + 1);
    const auto sign = [&](std::size_t inner_node, bool is_middle_inward) {
        const bool is_middle = 2 * inner_node == p + 1;
        return (is_middle ? is_middle_inward : inner_node <= p / 2) ? -1.0 : 1.0;
    };
    for (std::size_t j = 0; j < open.size(); ++j) {
        for (std::size_t i = 0; i < middle.size(); ++i) {
            out.push_back({{middle[i], open[j], 0}, {sign(i + 1, j > p / 2), 0, 0}});
        }
    }
    for (std::size_t j = 0; j < middle.size(); ++j) {
        for (std::size_t i = 0; i < open.size(); ++i) {
            out.push_back({{open[i], middle[j], 0}, {0, sign(j + 1, i <= p / 2), 0}});
        }
    }
}

void rt_interior(const Collection& collection, Geometry geometry, std::vector<Functional>& out) {
    const int p = collection.order;
    if (geometry == Geometry::square) {
        rt_square_interior(collection, out);
        return;
    }
    if (geometry == Geometry::triangle) {
        for_triangle(open_points(p), 0, [&](double x, double y) {
            out.push_back({{x, y, 0}, {0, -1, 0}});
            out.push_back({{x, y, 0}, {-1, 0, 0}});
        });
        return;
    }
    const Points middle = inner(points(collection.basis, p + 2));
    const Points open = points(collection.open_basis, p + 1);
    if (geometry == Geometry::cube) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto along = [&](std::size_t d) { return d == axis ? middle : open; };
            std::size_t count = 0;
            const std::size_t stride = axis == 0 ? 1 : axis == 1 ? open.size() : open.size() * open.size();
            for_box(along(0), along(1), along(2), [&](const Point& x) {
                // Inner node i (from 1) along the axis: inward, as on the face beside it, up to i = p/2.
                const std::size_t i = 1 + count++ / stride % middle.size();
                const double sign = i <= static_cast<std::size_t>(p) / 2 ? -1 : 1;
                out.push_back({x, combine({}, sign, axes[axis])});
            });
        }
    } else if (geometry == Geometry::tetrahedron) {
        for_tetrahedron(open_points(p), 0, [&](const Point& x) {
            for (const Point& axis : axes) {
                out.push_back({x, combine({}, -1, axis)});
            }
        });
    } else {
        for (double z : open) {
            for_triangle(open_points(p), 0, [&](double x, double y) {
                out.push_back({{x, y, z}, {0, -1, 0}});
                out.push_back({{x, y, z}, {-1, 0, 0}});
            });
        }
        for (double z : middle) {
            for_triangle(open, 0, [&](double x, double y) { out.push_back({{x, y, z}, axes[2]}); });
        }
    }
}

} // namespace

std::vector<FrameFunctional> edge_functionals(const Collection& collection) {
    std::vector<FrameFunctional> result;
    if (collection.family == Family::h1) {
        for (double s : inner(points(collection.basis, collection.order + 1))) {
            result.push_back({.s = s});
        }
    } else if (collection.family == Family::nd) {
        for (double s : points(collection.open_basis, collection.order)) {
            result.push_back({.s = s, .ds = 1});
        }
    } else if (collection.family == Family::rt && collection.dimension == 2) {
        for (double s : points(collection.open_basis, collection.order + 1)) {
            result.push_back({.s = s});
        }
    }
    return result;
}

std::vector<FrameFunctional> face_functionals(const Collection& collection, int n_corners) {
    std::vector<FrameFunctional> result;
    const int p = collection.order;
    const bool is_triangle = n_corners == 3;
    const auto for_square = [](const Points& x, const Points& y, auto&& visit) {
        for (double t : y) {
            for (double s : x) {
                visit(s, t);
            }
        }
    };
    const auto add = [&](double s, double t) { result.push_back({.s = s, .t = t}); };
    const auto add_first = [&](double s, double t) { result.push_back({.s = s, .t = t, .ds = 1}); };
    const auto add_last = [&](double s, double t) { result.push_back({.s = s, .t = t, .dt = 1}); };
    switch (collection.family) {
    case Family::l2:
        break;
    case Family::h1: {
        const Points closed = points(collection.basis, p + 1);
        is_triangle ? for_triangle(closed, 1, add) : for_square(inner(closed), inner(closed), add);
        break;
    }
    case Family::nd:
        if (is_triangle) {
            for_triangle(open_points(p - 1), 0, [&](double s, double t) {
                add_first(s, t);
                add_last(s, t);
            });
        } else {
            const Points middle = inner(points(collection.basis, p + 1));
            const Points open = points(collection.open_basis, p);
            for_square(open, middle, add_first);
            for_square(middle, open, add_last);
        }
        break;
    case Family::rt: {
        const Points open = points(collection.open_basis, p + 1);
        is_triangle ? for_triangle(open, 0, add) : for_square(open, open, add);
        break;
    }
    }
    return result;
}

std::vector<Functional> functionals(const Collection& collection, Geometry geometry) {
    std::vector<Functional> result;
    const auto corners = vertices(geometry);
    const auto corner = [&](int vertex) { return corners[static_cast<std::size_t>(vertex)]; };
    if (collection.family == Family::h1) {
        for (const Point& vertex : corners) {
            result.push_back({vertex, {}});
        }
    }
    Collection of_edges = collection;
    if (geometry == Geometry::triangle) {
        of_edges.open_basis = Basis::gauss_legendre;
    }
    const auto on_edge = edge_functionals(of_edges);
    for (const auto& edge : edges(geometry)) {
        const Point along = difference(corner(edge[1]), corner(edge[0]));
        for (const FrameFunctional& f : on_edge) {
            const Point direction = collection.family == Family::rt ? Point{along[1], -along[0], 0} : combine({}, f.ds, along);
            result.push_back({combine(corner(edge[0]), f.s, along), direction});
        }
    }
    const auto on_triangle = face_functionals(collection, 3);
    const auto on_square = face_functionals(collection, 4);
    for (const FaceVertices& face : faces(geometry)) {
        const bool is_triangle = n_corners(face) == 3;
        const Point origin = corner(face[0]);
        const Point first = difference(corner(face[1]), origin);
        const Point last = difference(corner(face[is_triangle ? 2 : 3]), origin);
        for (const FrameFunctional& f : is_triangle ? on_triangle : on_square) {
            const Point node = combine(combine(origin, f.s, first), f.t, last);
            const Point tangent = combine(combine({}, f.ds, first), f.dt, last);
            result.push_back({node, collection.family == Family::rt ? cross(first, last) : tangent});
        }
    }
    switch (collection.family) {
    case Family::h1:
    case Family::l2:
        scalar_interior(points(collection.basis, collection.order + 1), collection.family == Family::l2, geometry, result);
        if (collection.is_first_cubic && geometry == Geometry::cube) {
            // The eight interior nodes go round like the vertices: the last two of each layer change places.
            std::swap(result[58], result[59]);
            std::swap(result[62], result[63]);
        }
        break;
    case Family::nd:
        nd_interior(collection, geometry, result);
        break;
    case Family::rt:
        rt_interior(collection, geometry, result);
        break;
    }
    return result;
}

} // namespace elvis_mfem
