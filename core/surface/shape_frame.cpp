#include <core/base/bounds.hpp>
#include <core/base/float_rounding.hpp>
#include <core/base/infinity.hpp>
#include <core/surface/quadric_level.hpp>
#include <core/surface/shape_frame.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;

Vector convert(const Vector3& v) { return {v[0], v[1], v[2]}; }

std::array<double, 4> row(const Vector& xyz, Real w) {
    return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2]), static_cast<double>(w)};
}

/** Rows: two directions across the axis, and the axis. */
Matrix across(const Vector& axis) {
    const Vector along = axis.normalized();
    Eigen::Index smallest = 0;
    along.cwiseAbs().minCoeff(&smallest);
    Matrix rows;
    rows.row(0) = Vector::Unit(smallest).cross(along).normalized();
    rows.row(1) = along.cross(Vector(rows.row(0)));
    rows.row(2) = along;
    return rows;
}

/** The function sum q_i z_i^2 + linear . z + level of z = to_local (y - origin); y is relative to the picture's reference
 * point. */
struct Form {
    Matrix to_local = Matrix::Identity();
    Vector origin = Vector::Zero();
    Vector q = Vector::Zero();
    Vector linear = Vector::Zero();
    Real level = 0;
    /** Ends along the third local direction; infinite where there are none. */
    Real low = -std::numeric_limits<Real>::infinity();
    Real high = std::numeric_limits<Real>::infinity();
    bool is_capped = false;

    Real value(const Vector& z) const { return q.cwiseProduct(z).dot(z) + linear.dot(z) + level; }
    Vector gradient(const Vector& z) const { return 2 * q.cwiseProduct(z) + linear; }
};

struct FormOf {
    const Vector reference;

    Form operator()(const Sphere& sphere) const {
        Form form;
        form.origin = convert(sphere.center) - reference;
        form.q = Vector::Constant(1 / (2 * static_cast<Real>(sphere.radius)));
        form.level = -static_cast<Real>(sphere.radius) / 2;
        return form;
    }
    Form operator()(const Cylinder& cylinder) const {
        return (*this)(Cone{cylinder.from, cylinder.to, cylinder.radius, cylinder.radius, cylinder.is_capped});
    }
    Form operator()(const Cone& cone) const {
        const Vector axis = convert(cone.to) - convert(cone.from);
        Form form;
        form.to_local = across(axis);
        form.origin = convert(cone.from) - reference;
        form.low = 0;
        form.high = axis.norm();
        form.is_capped = cone.is_capped;
        // zx^2 + zy^2 - (r + k zz)^2
        const Real r = cone.from_radius;
        const Real k = (static_cast<Real>(cone.to_radius) - r) / form.high;
        const Real scale = 1 / (2 * std::max(r, static_cast<Real>(cone.to_radius)));
        form.q = scale * Vector(1, 1, -k * k);
        form.linear = scale * Vector(0, 0, -2 * r * k);
        form.level = -scale * r * r;
        return form;
    }
    Form operator()(const Quadric& quadric) const {
        const auto& c = quadric.coefficients;
        Matrix matrix;
        matrix << c[0], c[3] / 2.0L, c[5] / 2.0L, c[3] / 2.0L, c[1], c[4] / 2.0L, c[5] / 2.0L, c[4] / 2.0L, c[2];
        const Vector linear(c[6], c[7], c[8]);
        const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix);
        Form form;
        form.to_local = solver.eigenvectors().transpose();
        form.q = solver.eigenvalues();
        // What is zero but for rounding would let a cylinder's far parts bend.
        const Real largest = form.q.cwiseAbs().maxCoeff();
        for (Real& q : form.q) {
            q = std::abs(q) <= 16 * std::numeric_limits<Real>::epsilon() * largest ? 0 : q;
        }
        form.linear = form.to_local * (linear + 2 * matrix * reference);
        form.level = quadric_level(quadric, {reference[0], reference[1], reference[2]});
        return form;
    }
    /** These have rows of their own. */
    Form operator()(const Torus&) const { return {}; }
    Form operator()(const ImplicitSurface&) const { return {}; }
    Form operator()(const MeshSurface&) const { return {}; }
    Form operator()(const BezierSurface&) const { return {}; }
    Form operator()(const TubeSurface&) const { return {}; }
    Form operator()(const RibbonSurface&) const { return {}; }
    Form operator()(const ArrowSurface&) const { return {}; }
};

/** A point of the surface near the reference point, in local coordinates: Newton's method along gradients. */
Vector point_near(const Form& form) {
    const Vector start = form.to_local * -form.origin;
    Vector z = start;
    const Real extent = std::max(start.norm(), std::abs(form.level));
    for (int step = 0; step < 60; ++step) {
        Vector gradient = form.gradient(z);
        const Real square = gradient.squaredNorm();
        if (square <= 1e-12L * form.q.squaredNorm() * std::max(extent * extent, std::numeric_limits<Real>::min())) {
            // At a centre or apex every direction is as good.
            z += std::max(extent, static_cast<Real>(1e-3)) * Vector(0.6L, 0.5L, 0.4L);
            continue;
        }
        const Vector change = -(form.value(z) / square) * gradient;
        z += change;
        if (change.norm() <= 1e-17L * z.norm()) {
            break;
        }
    }
    const bool is_found = z.allFinite() && std::abs(form.value(z)) <= 1e-9L * form.gradient(z).norm() * (z.norm() + 1e-30L);
    return is_found ? z : start;
}

/** Rows of shaders/surface/quadric.glsl. */
std::vector<std::array<double, 4>> quadric_rows(const Form& form) {
    Vector anchor = form.origin + form.to_local.transpose() * point_near(form);
    for (Real& coordinate : anchor) {
        coordinate = exact_in_float(static_cast<double>(coordinate));
    }
    const Vector z = form.to_local * (anchor - form.origin);
    const Vector gradient = form.gradient(z);
    // Of about unit gradient, so that values are distances; not possible at an apex.
    const Real steep = form.q.cwiseAbs().maxCoeff() * std::max<Real>(z.norm(), std::numeric_limits<Real>::min());
    const Real size = gradient.norm() > 1e-3L * steep ? gradient.norm() : std::max(steep, gradient.norm());
    const Real scale = size > 0 ? 1 / size : 1;
    const Vector q = scale * form.q;
    return {row(form.to_local.row(0), q[0]),
            row(form.to_local.row(1), q[1]),
            row(form.to_local.row(2), q[2]),
            row(anchor, scale * form.value(z)),
            row(scale * gradient, 2 * q.cwiseAbs().maxCoeff()),
            // No end is farther than single precision reaches.
            {static_cast<double>(std::max<Real>(form.low - z[2], -1e30L)),
             static_cast<double>(std::min<Real>(form.high - z[2], 1e30L)), form.is_capped ? 1.0 : 0.0, 0.0}};
}

/** Rows of shaders/surface/torus.glsl. */
std::vector<std::array<double, 4>> torus_rows(const Torus& torus, const Vector& reference) {
    const Matrix to_local = across(convert(torus.axis));
    const Vector center = convert(torus.center) - reference;
    Vector rounded;
    for (Eigen::Index i = 0; i < 3; ++i) {
        rounded[i] = exact_in_float(static_cast<double>(center[i]));
    }
    return {row(to_local.row(0), torus.major_radius), row(to_local.row(1), torus.minor_radius), row(to_local.row(2), 0),
            row(rounded, 0), row(center - rounded, 0)};
}

bool has_ends(const CutShape& shape) { return std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape); }

/** Of a ball. */
std::array<double, 6> box_of(const Vector3& center, double radius) {
    return {center[0] - radius, center[1] - radius, center[2] - radius,
            center[0] + radius, center[1] + radius, center[2] + radius};
}

std::array<double, 6> join(const std::array<double, 6>& a, const std::array<double, 6>& b) {
    return {std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2]),
            std::max(a[3], b[3]), std::max(a[4], b[4]), std::max(a[5], b[5])};
}

} // namespace

std::string shape_solver(const CutShape& shape) {
    return std::holds_alternative<MeshSurface>(shape)       ? "mesh"
           : std::holds_alternative<BezierSurface>(shape)   ? "bezier"
           : std::holds_alternative<TubeSurface>(shape)     ? "tubes"
           : std::holds_alternative<RibbonSurface>(shape)   ? "ribbons"
           : std::holds_alternative<ArrowSurface>(shape)    ? "arrows"
           : std::holds_alternative<ImplicitSurface>(shape) ? "implicit"
           : std::holds_alternative<Torus>(shape)           ? "torus"
           : has_ends(shape)                                ? "round"
                                                            : "quadric";
}

ShapeFrame shape_frame(const CutShape& shape, const Vector3& reference) {
    const std::string solver = shape_solver(shape);
    if (const auto* torus = std::get_if<Torus>(&shape)) {
        return {solver, torus_rows(*torus, convert(reference))};
    }
    if (solver == "implicit") {
        // The reference point is exact in single precision.
        return {solver, {row(convert(reference), 0)}};
    }
    if (solver == "mesh" || solver == "bezier" || solver == "ribbons") {
        return {solver, {row(convert(reference) - convert(shape_middle(shape)), 0)}};
    }
    if (const auto* surface = std::get_if<TubeSurface>(&shape)) {
        return {solver, {row(convert(reference) - convert(shape_middle(shape)), surface->tubes->radius)}};
    }
    if (solver == "arrows") {
        return {solver,
                {row(convert(reference) - convert(shape_middle(shape)), 0),
                 {ArrowSet::shaft_radius, ArrowSet::head_radius, ArrowSet::head_length, 0}}};
    }
    return {solver, quadric_rows(std::visit(FormOf{convert(reference)}, shape))};
}

Vector3 shape_middle(const CutShape& shape) {
    Vector3 middle = middle_of(shape_bounds(shape));
    std::ranges::transform(middle, middle.begin(), exact_in_float);
    return middle;
}

std::array<double, 6> shape_bounds(const CutShape& shape) {
    struct Bounds {
        std::array<double, 6> operator()(const Sphere& sphere) const { return box_of(sphere.center, sphere.radius); }
        std::array<double, 6> operator()(const Cylinder& cylinder) const {
            return join(box_of(cylinder.from, cylinder.radius), box_of(cylinder.to, cylinder.radius));
        }
        std::array<double, 6> operator()(const Cone& cone) const {
            return join(box_of(cone.from, cone.from_radius), box_of(cone.to, cone.to_radius));
        }
        std::array<double, 6> operator()(const Quadric&) const {
            return {-infinity, -infinity, -infinity, infinity, infinity, infinity};
        }
        std::array<double, 6> operator()(const ImplicitSurface&) const {
            return {-infinity, -infinity, -infinity, infinity, infinity, infinity};
        }
        std::array<double, 6> operator()(const MeshSurface& surface) const { return surface.mesh->bounds(); }
        std::array<double, 6> operator()(const BezierSurface& surface) const { return surface.mesh->bounds(); }
        std::array<double, 6> operator()(const TubeSurface& surface) const { return surface.tubes->bounds(); }
        std::array<double, 6> operator()(const RibbonSurface& surface) const { return surface.ribbons->bounds(); }
        std::array<double, 6> operator()(const ArrowSurface& surface) const { return surface.arrows->bounds(); }
        std::array<double, 6> operator()(const Torus& torus) const {
            return box_of(torus.center, torus.major_radius + torus.minor_radius);
        }
    };
    return std::visit(Bounds(), shape);
}

} // namespace elvis
