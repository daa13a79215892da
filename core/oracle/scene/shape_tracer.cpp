// Cut surfaces of their own form: where rays meet them, and which elements are there.
#include "formula.hpp"
#include "surface_tracer.hpp"

#include <core/base/infinity.hpp>
#include <core/surface/quadric_level.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <functional>

namespace elvis::oracle {
namespace {

/** A part of a shape: where a function of position vanishes and `holds`. */
struct ShapePart {
    std::function<double(const Vector& x)> value;
    std::function<Vector(const Vector& x)> gradient;
    std::function<bool(const Vector& x)> holds = [](const Vector&) { return true; };
    /** Of order four at most; other functions are sampled. */
    bool is_polynomial = true;
};

/** x.A x + b.x + c, about a middle. */
ShapePart quadric(const Vector& middle, const Matrix& a, const Vector& b, double c) {
    return {[=](const Vector& x) {
                const Vector d = x - middle;
                return d.dot(a * d) + b.dot(d) + c;
            },
            [=](const Vector& x) -> Vector { return 2 * (a * (x - middle)) + b; }};
}

ShapePart plane(const Vector& at, const Vector& normal, double radius) {
    return {[=](const Vector& x) { return normal.dot(x - at); }, [=](const Vector&) { return normal; },
            [=](const Vector& x) { return (x - at).squaredNorm() <= radius * radius; }};
}

std::vector<ShapePart> parts_of(const Sphere& sphere) {
    return {quadric(vector_of(sphere.center), Matrix::Identity(), Vector::Zero(), -sphere.radius * sphere.radius)};
}

/** About the middle of the volume, so that far from the origin digits are not lost. */
std::vector<ShapePart> parts_of(const Quadric& q, const Vector& middle) {
    const std::array<double, 10>& c = q.coefficients;
    Matrix a;
    a << c[0], c[3] / 2, c[5] / 2, c[3] / 2, c[1], c[4] / 2, c[5] / 2, c[4] / 2, c[2];
    const LongVector at = middle.cast<long double>(), b(c[6], c[7], c[8]), along = a.cast<long double>() * at;
    return {quadric(middle, a, (2 * along + b).cast<double>(), static_cast<double>(quadric_level(q, {at[0], at[1], at[2]})))};
}

/** Between two ends, where the radius changes evenly. */
std::vector<ShapePart> round_parts(const Vector& from, const Vector& to, double r0, double r1, bool is_capped) {
    const double length = (to - from).norm(), slope = (r1 - r0) / length;
    const Vector axis = (to - from) / length;
    // |d|^2 - (d.axis)^2 = (r0 + slope d.axis)^2
    const Matrix a = Matrix::Identity() - (1 + slope * slope) * axis * axis.transpose();
    ShapePart side = quadric(from, a, -2 * r0 * slope * axis, -r0 * r0);
    side.holds = [=](const Vector& x) {
        const double along = axis.dot(x - from);
        return along >= 0 && along <= length;
    };
    std::vector<ShapePart> parts{side};
    if (is_capped && r0 > 0)
        parts.push_back(plane(from, axis, r0));
    if (is_capped && r1 > 0)
        parts.push_back(plane(to, axis, r1));
    return parts;
}

std::vector<ShapePart> parts_of(const Cylinder& c) {
    return round_parts(vector_of(c.from), vector_of(c.to), c.radius, c.radius, c.is_capped);
}

std::vector<ShapePart> parts_of(const Cone& c) {
    return round_parts(vector_of(c.from), vector_of(c.to), c.from_radius, c.to_radius, c.is_capped);
}

/** (|d|^2 + R^2 - r^2)^2 = 4 R^2 (|d|^2 - (d.axis)^2) */
std::vector<ShapePart> parts_of(const Torus& torus) {
    const Vector middle = vector_of(torus.center), axis = vector_of(torus.axis).normalized();
    const double rr = torus.major_radius * torus.major_radius, k = rr - torus.minor_radius * torus.minor_radius;
    return {{[=](const Vector& x) {
                 const Vector d = x - middle;
                 const double along = axis.dot(d), sum = d.squaredNorm() + k;
                 return sum * sum - 4 * rr * (d.squaredNorm() - along * along);
             },
             [=](const Vector& x) -> Vector {
                 const Vector d = x - middle;
                 return 4 * (d.squaredNorm() + k) * d - 8 * rr * (d - axis.dot(d) * axis);
             }}};
}

/** A triangle is where its plane is within its edges. */
std::vector<ShapePart> parts_of(const MeshSurface& surface) {
    std::vector<ShapePart> parts;
    for (const auto& corners : surface.mesh->triangles) {
        const Vector a = vector_of(surface.mesh->points[corners[0]]), b = vector_of(surface.mesh->points[corners[1]]),
                     c = vector_of(surface.mesh->points[corners[2]]);
        const Vector normal = (b - a).cross(c - a).normalized();
        ShapePart part = plane(a, normal, infinity);
        part.holds = [=](const Vector& x) {
            return normal.dot((b - a).cross(x - a)) >= 0 && normal.dot((c - b).cross(x - b)) >= 0 &&
                   normal.dot((a - c).cross(x - c)) >= 0;
        };
        parts.push_back(std::move(part));
    }
    return parts;
}

std::vector<ShapePart> parts_of(const Quadric& q) { return parts_of(q, Vector::Zero()); }
std::vector<ShapePart> parts_of(const ImplicitSurface& surface) {
    const Formula formula = *parse_formula(surface.expression);
    ShapePart part{[=](const Vector& x) { return formula(x).value; }, [=](const Vector& x) { return formula(x).gradient; }};
    part.is_polynomial = false;
    return {part};
}
std::vector<ShapePart> parts_of(const BezierSurface&) { return {}; }
std::vector<ShapePart> parts_of(const TubeSurface&) { return {}; }
std::vector<ShapePart> parts_of(const RibbonSurface&) { return {}; }
std::vector<ShapePart> parts_of(const ArrowSurface&) { return {}; }

/** A ball that holds a shape with an end. */
struct Ball {
    Vector middle = Vector::Zero();
    double radius = infinity;
};

Ball ball_of(const CutShape& shape) {
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        return {vector_of(sphere->center), sphere->radius};
    if (const auto* torus = std::get_if<Torus>(&shape))
        return {vector_of(torus->center), torus->major_radius + torus->minor_radius};
    const auto between = [](const Vector3& from, const Vector3& to, double radius) {
        const Vector a = vector_of(from), b = vector_of(to);
        return Ball{0.5 * (a + b), 0.5 * (a - b).norm() + radius};
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return between(cylinder->from, cylinder->to, cylinder->radius);
    if (const auto* cone = std::get_if<Cone>(&shape))
        return between(cone->from, cone->to, std::max(cone->from_radius, cone->to_radius));
    if (const auto* mesh = std::get_if<MeshSurface>(&shape)) {
        const std::array<double, 6> b = mesh->mesh->bounds();
        return between({b[0], b[1], b[2]}, {b[3], b[4], b[5]}, 0);
    }
    return {};
}

class ShapeTracer : public SurfaceTracer {
public:
    ShapeTracer(const Model& model, const CutShape& shape, bool is_seen_outside)
        : m_model(model), m_inverter(model.volume, model.enclosures), m_is_seen_outside(is_seen_outside) {
        const Vector middle = 0.5 * (model.tree.lower() + model.tree.upper());
        if (const auto* quadric = std::get_if<Quadric>(&shape))
            m_parts = parts_of(*quadric, middle);
        else
            m_parts = std::visit([](const auto& one) { return parts_of(one); }, shape);
        const Ball ball = ball_of(shape);
        if (is_seen_outside && ball.radius < infinity) {
            m_lower = ball.middle.array() - 1.01 * ball.radius;
            m_upper = ball.middle.array() + 1.01 * ball.radius;
            return;
        }
        // Surfaces without end are drawn in a box three times that of the volume.
        const double factor = is_seen_outside ? 3 : 1;
        m_lower = middle + factor * (model.tree.lower() - middle);
        m_upper = middle + factor * (model.tree.upper() - middle);
    }

    std::vector<SurfacePoint> trace(const Line& line, double near, const Perturbation& perturbation) override {
        double from = 0, to = infinity;
        for (Eigen::Index d = 0; d < 3; ++d) {
            const double one = (m_lower[d] - line.origin[d]) / line.direction[d],
                         other = (m_upper[d] - line.origin[d]) / line.direction[d];
            if (std::isnan(one) || std::isnan(other))
                continue;
            from = std::max(from, std::min(one, other));
            to = std::min(to, std::max(one, other));
        }
        std::vector<SurfacePoint> points;
        if (!(from < to) || to == infinity)
            return points;
        for (const ShapePart& part : m_parts)
            add(part, line, from, to, near, perturbation, points);
        std::ranges::sort(points, {}, &SurfacePoint::t);
        return points;
    }

    std::uint64_t n_failures() const override { return m_inverter.counts().unresolved; }

private:
    void add(const ShapePart& part, const Line& line, double from, double to, double near, const Perturbation& perturbation,
             std::vector<SurfacePoint>& points) {
        constexpr std::size_t degree = 8, n_samples = 300;
        const auto t_of = [&](double s) { return 0.5 * ((1 - s) * from + (1 + s) * to); };
        const RealFunction along = [&](double s) {
            const Vector x = line.at(t_of(s));
            // A surface that is moved along its normal, to first order.
            return part.value(x) + (perturbation.plane == 0 ? 0 : perturbation.plane * part.gradient(x).norm());
        };
        std::vector<double> values;
        for (const double s : lobatto_points(part.is_polynomial ? degree : n_samples))
            values.push_back(along(s));
        Roots roots;
        if (part.is_polynomial) {
            const ChebyshevSeries series(values);
            roots = find_close_roots([&](double s) { return series(s); }, 0, lobatto_points(4 * degree), series.dense_values());
        } else {
            roots = find_roots(along, 0, lobatto_points(n_samples), values);
        }
        for (const double s : roots.at) {
            double t = t_of(s);
            // Newton's method takes away what the series leaves.
            for (int turn = 0; turn < 2 && perturbation.plane == 0; ++turn) {
                const double step = part.value(line.at(t)) / part.gradient(line.at(t)).dot(line.direction);
                t -= std::abs(step) < 1e-9 * (to - from) ? step : 0;
            }
            if (t > near && part.holds(line.at(t)))
                add_point(part, line, t, perturbation, points);
        }
    }

    void add_point(const ShapePart& part, const Line& line, double t, const Perturbation& perturbation,
                   std::vector<SurfacePoint>& points) {
        SurfacePoint point;
        point.t = t;
        const double inside = perturbation.plane == 0 ? 1e-13 : 0;
        const std::vector<Candidate> found = locate(m_model, m_inverter, line.at(t), line.direction, 0, inside);
        if (!found.empty() && found.front().solution.excess <= inside) {
            point.element = found.front().element;
            point.xi = found.front().solution.xi;
        } else if (!m_is_seen_outside) {
            return;
        }
        const Vector normal = part.gradient(line.at(t)).normalized();
        const double cosine = normal.dot(line.direction);
        point.normal = cosine > 0 ? Vector(-normal) : normal;
        point.facing = std::abs(cosine);
        points.push_back(point);
    }

    const Model& m_model;
    Inverter m_inverter;
    std::vector<ShapePart> m_parts;
    bool m_is_seen_outside;
    /** In which the surface is drawn. */
    Vector m_lower, m_upper;
};

} // namespace

bool is_known(const CutShape& shape) {
    if (const auto* surface = std::get_if<ImplicitSurface>(&shape))
        return parse_formula(surface->expression).has_value();
    return !std::holds_alternative<BezierSurface>(shape);
}

std::unique_ptr<SurfaceTracer> shape_tracer(const Model& model, const CutShape& shape, bool is_seen_outside) {
    return std::make_unique<ShapeTracer>(model, shape, is_seen_outside);
}

} // namespace elvis::oracle
