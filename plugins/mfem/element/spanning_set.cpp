#include "spanning_set.hpp"

#include "index.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace elvis_mfem {

namespace {

namespace native = elvis::native;

using Line = std::array<double, max_order + 2>;

/** Legendre polynomials P_0 .. P_n of x/t scaled by t^i: homogeneous in x, t; x in [0, t] is mapped to [-1, 1]. */
Line scaled_legendre(int n, double x, double t) {
    Line values{};
    values[0] = 1;
    const double z = 2 * x - t;
    if (n >= 1) {
        values[1] = z;
    }
    for (int i = 2; i <= n; ++i) {
        values[index(i)] = ((2 * i - 1) * z * values[index(i - 1)] - (i - 1) * t * t * values[index(i - 2)]) / i;
    }
    return values;
}

/** Their integrals over x that vanish at 0 and t, from index 2 on: (P_i - t^2 P_{i-2}) / (4 i - 2). */
Line integrated_legendre(int n, double x, double t) {
    const Line legendre = scaled_legendre(n, x, t);
    Line values{};
    for (int i = 2; i <= n; ++i) {
        values[index(i)] = (legendre[index(i)] - t * t * legendre[index(i - 2)]) / (4 * i - 2);
    }
    return values;
}

/** Orthogonal polynomials of total degree `order` on the triangle (z ignored) or tetrahedron. */
class SimplexSet : public SpanningSet {
public:
    SimplexSet(native::Shape shape, int order) : SimplexSet(space_of(shape, order)) {}

    void evaluate(const Point& x, double* values) const override {
        if (m_space.order[0] == 0) {
            values[0] = 1;
            return;
        }
        const bool is_flat = m_space.shape == native::Shape::triangle;
        native::evaluate_modes(m_space, {2 * x[0] - 1, 2 * x[1] - 1, is_flat ? 0 : 2 * x[2] - 1}, std::span(values, size()));
    }

private:
    explicit SimplexSet(const native::Space& space) : SpanningSet(native::n_modes(space), 1), m_space(space) {}

    static native::Space space_of(native::Shape shape, int order) {
        const auto n = static_cast<std::uint32_t>(order);
        return {shape, native::Basis::orthogonal, {n, n, shape == native::Shape::triangle ? 0 : n}};
    }

    native::Space m_space;
};

/**
 * Nedelec space of order p = degree + 1: all polynomial vectors of `degree` and (x - c) x q with q of just that degree.
 * Raviart-Thomas space of order `degree`: all polynomial vectors and (x - c) q. The same in two dimensions for prisms.
 */
class VectorSimplexSet : public SpanningSet {
public:
    VectorSimplexSet(Family family, int degree, std::size_t dimension)
        : SpanningSet(n_functions(family, degree, dimension), dimension),
          m_scalars(dimension == 2 ? native::Shape::triangle : native::Shape::tetrahedron, degree), m_family(family),
          m_degree(degree) {}

    void evaluate(const Point& x, double* values) const override {
        const std::size_t dimension = n_components();
        std::fill_n(values, dimension * size(), 0.0);
        std::size_t function = 0;
        std::vector<double> scalars(m_scalars.size());
        m_scalars.evaluate(x, scalars.data());
        for (double scalar : scalars) {
            for (std::size_t c = 0; c < dimension; ++c) {
                values[c * size() + function++] = scalar;
            }
        }
        // Distances from the centroid, and products of Legendre polynomials of just this degree.
        Point r{};
        std::array<Line, 3> lines;
        for (std::size_t d = 0; d < 3; ++d) {
            r[d] = x[d] - 1.0 / static_cast<double>(dimension + 1);
            lines[d] = scaled_legendre(m_degree, x[d], 1);
        }
        const auto add = [&](double factor, const Point& vector) {
            for (std::size_t c = 0; c < dimension; ++c) {
                values[c * size() + function] = factor * vector[c];
            }
            ++function;
        };
        for (int k = 0; k <= (dimension == 3 ? m_degree : 0); ++k) {
            for (int j = 0; j + k <= m_degree; ++j) {
                const int i = m_degree - j - k;
                const double q = lines[0][index(i)] * lines[1][index(j)] * (k > 0 ? lines[2][index(k)] : 1);
                if (m_family == Family::rt) {
                    add(q, r);
                    continue;
                }
                add(q, {r[1], -r[0], 0});
                if (dimension == 3) {
                    add(q, {r[2], 0, -r[0]});
                    // Of the third rotation only what the first two do not span already.
                    if (i == 0) {
                        add(q, {0, r[2], -r[1]});
                    }
                }
            }
        }
    }

private:
    static std::size_t n_functions(Family family, int degree, std::size_t dimension) {
        const std::size_t p = index(degree);
        const std::size_t n_top = dimension == 2 ? p + 1 : (p + 1) * (p + 2) / 2;
        const std::size_t n_scalars = dimension == 2 ? (p + 1) * (p + 2) / 2 : (p + 1) * (p + 2) * (p + 3) / 6;
        const std::size_t n_extra = family == Family::rt || dimension == 2 ? n_top : 2 * n_top + p + 1;
        return dimension * n_scalars + n_extra;
    }

    SimplexSet m_scalars;
    Family m_family;
    int m_degree;
};

/** Prisms: vectors of the triangle times polynomials in z, and polynomials of the triangle times others in z. */
class VectorPrismSet : public SpanningSet {
public:
    VectorPrismSet(Family family, int degree)
        : VectorPrismSet(family, degree, std::make_unique<VectorSimplexSet>(family, degree, 2),
                         std::make_unique<SimplexSet>(native::Shape::triangle, family == Family::nd ? degree + 1 : degree)) {}

    void evaluate(const Point& x, double* values) const override {
        std::fill_n(values, 3 * size(), 0.0);
        std::vector<double> plane(2 * m_plane->size()), axial(m_axial->size());
        m_plane->evaluate(x, plane.data());
        m_axial->evaluate(x, axial.data());
        const Line line = scaled_legendre(std::max(m_plane_degree, m_axial_degree), x[2], 1);
        std::size_t function = 0;
        for (int k = 0; k <= m_plane_degree; ++k) {
            for (std::size_t i = 0; i < m_plane->size(); ++i, ++function) {
                values[function] = line[index(k)] * plane[i];
                values[size() + function] = line[index(k)] * plane[m_plane->size() + i];
            }
        }
        for (int k = 0; k <= m_axial_degree; ++k) {
            for (std::size_t i = 0; i < m_axial->size(); ++i, ++function) {
                values[2 * size() + function] = line[index(k)] * axial[i];
            }
        }
    }

private:
    VectorPrismSet(Family family, int degree, std::unique_ptr<const SpanningSet> plane,
                   std::unique_ptr<const SpanningSet> axial)
        : SpanningSet(plane->size() * index(plane_degree(family, degree) + 1) +
                          axial->size() * index(axial_degree(family, degree) + 1),
                      3),
          m_plane(std::move(plane)), m_axial(std::move(axial)), m_plane_degree(plane_degree(family, degree)),
          m_axial_degree(axial_degree(family, degree)) {}

    static int plane_degree(Family family, int degree) { return family == Family::nd ? degree + 1 : degree; }
    static int axial_degree(Family family, int degree) { return family == Family::nd ? degree : degree + 1; }

    std::unique_ptr<const SpanningSet> m_plane;
    std::unique_ptr<const SpanningSet> m_axial;
    int m_plane_degree;
    int m_axial_degree;
};

/** In collapsed coordinates (X, Y, z) all functions are polynomials, so that the apex needs no care. */
class FuentesSet : public SpanningSet {
public:
    explicit FuentesSet(int order) : SpanningSet(index(order * (order * order + 3) + 1), 1), m_order(order) {}

    void evaluate(const Point& x, double* values) const override {
        const int p = m_order;
        const auto [a, b, z] = collapsed(x);
        const double w = 1 - z;
        // Affine functions of the pyramid's corners.
        const std::array<double, 5> lambda{(1 - a) * (1 - b) * w, a * (1 - b) * w, a * b * w, (1 - a) * b * w, z};
        values = std::ranges::copy(lambda, values).out;
        const Line in_a = integrated_legendre(p, a, 1), in_b = integrated_legendre(p, b, 1),
                   in_z = integrated_legendre(p, z, 1);
        const Line legendre = scaled_legendre(p, z, 1);
        std::array<double, max_order + 1> power{1};
        for (int i = 1; i <= p; ++i) {
            power[index(i)] = power[index(i - 1)] * w;
        }
        const std::array<double, 2> blend_a{1 - a, a}, blend_b{1 - b, b};
        for (int i = 2; i <= p; ++i) {
            // Base edges.
            for (std::size_t side = 0; side < 2; ++side) {
                *values++ = blend_b[side] * power[index(i)] * in_a[index(i)];
                *values++ = blend_a[side] * power[index(i)] * in_b[index(i)];
            }
        }
        for (std::size_t corner = 0; corner < 4; ++corner) {
            // Edges to the apex.
            const Line edge = integrated_legendre(p, z, lambda[corner] + z);
            values = std::copy(edge.begin() + 2, edge.begin() + p + 1, values);
        }
        for (int j = 2; j <= p; ++j) {
            for (int i = 2; i <= p; ++i) {
                const double bubble = in_a[index(i)] * in_b[index(j)];
                // Base, then interior.
                *values++ = w * bubble;
                for (int k = 2; k <= p; ++k) {
                    *values++ = bubble * in_z[index(k)];
                }
            }
        }
        for (int i = 2; i < p; ++i) {
            for (int j = 1; i + j <= p; ++j) {
                // Triangles.
                const double rise = power[index(i)] * z * legendre[index(j - 1)];
                for (std::size_t side = 0; side < 2; ++side) {
                    *values++ = blend_b[side] * in_a[index(i)] * rise;
                    *values++ = blend_a[side] * in_b[index(i)] * rise;
                }
            }
        }
    }

private:
    int m_order;
};

} // namespace

std::unique_ptr<const SpanningSet> make_triangle_set(int order) {
    return std::make_unique<SimplexSet>(native::Shape::triangle, order);
}

std::unique_ptr<const SpanningSet> make_tetrahedron_set(int order) {
    return std::make_unique<SimplexSet>(native::Shape::tetrahedron, order);
}

std::unique_ptr<const SpanningSet> make_vector_set(const Collection& collection, Geometry geometry) {
    const int degree = collection.family == Family::nd ? collection.order - 1 : collection.order;
    if (geometry == Geometry::tetrahedron || geometry == Geometry::triangle) {
        return std::make_unique<VectorSimplexSet>(collection.family, degree, static_cast<std::size_t>(dimension(geometry)));
    }
    return std::make_unique<VectorPrismSet>(collection.family, degree);
}

std::unique_ptr<const SpanningSet> make_fuentes_set(int order) { return std::make_unique<FuentesSet>(order); }

Point collapsed(const Point& x) {
    const double w = 1 - x[2];
    return w > 0 ? Point{x[0] / w, x[1] / w, x[2]} : Point{0, 0, 1};
}

} // namespace elvis_mfem
