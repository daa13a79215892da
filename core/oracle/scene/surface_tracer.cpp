#include "surface_tracer.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

/** Turned towards the viewer. */
void set_normal(SurfacePoint& point, const Vector& normal, const Vector& direction) {
    const double cosine = normal.dot(direction);
    point.normal = cosine > 0 ? Vector(-normal) : normal;
    point.facing = std::abs(cosine);
}

class PlaneTracer : public SurfaceTracer {
public:
    PlaneTracer(const Model& model, const CutPlane& plane)
        : m_model(model), m_inverter(model.volume, model.enclosures),
          m_normal(Vector(plane.plane[0], plane.plane[1], plane.plane[2]).normalized()),
          m_offset(plane.plane[3] / Vector(plane.plane[0], plane.plane[1], plane.plane[2]).norm()) {}

    std::vector<SurfacePoint> trace(const Line& line, double near, const Perturbation& perturbation) override {
        SurfacePoint point;
        point.t = -(m_normal.dot(line.origin) + m_offset + perturbation.plane) / m_normal.dot(line.direction);
        if (!(point.t > near) || !std::isfinite(point.t))
            return {};
        // A perturbed plane lies where it lies. That of the scene may lie in faces, exactly but for rounding.
        const double inside = perturbation.plane == 0 ? 1e-13 : 0;
        const std::vector<Candidate> found = locate(m_model, m_inverter, line.at(point.t), line.direction, 0, inside);
        if (found.empty() || found.front().solution.excess > inside)
            return {};
        point.element = found.front().element;
        point.xi = found.front().solution.xi;
        set_normal(point, m_normal, line.direction);
        return {point};
    }

    std::uint64_t n_failures() const override { return m_inverter.counts().unresolved; }

private:
    const Model& m_model;
    Inverter m_inverter;
    Vector m_normal;
    double m_offset;
};

class FaceTracer : public SurfaceTracer {
public:
    FaceTracer(const Model& model, const SegmentFinder& finder, std::span<const elvis_face> faces)
        : m_model(model), m_finder(finder), m_inverter(model.volume, model.enclosures), m_constraints(model.enclosures.size()) {
        for (const elvis_face& face : faces) {
            const auto element = static_cast<std::size_t>(face.element);
            m_constraints[element].push_back(
                constraint_of_local_face(model.volume.shape(element), static_cast<std::size_t>(face.local_face)));
        }
    }

    std::vector<SurfacePoint> trace(const Line& line, double near, const Perturbation&) override {
        std::vector<SurfacePoint> points;
        for (const SegmentFinder::Entry& entry : m_finder.boxes(line))
            for (const std::size_t constraint : m_constraints[entry.element])
                for (const double t : m_finder.crossings(entry.element, constraint, line))
                    if (t > near)
                        add(entry.element, constraint, line, t, points);
        // Of faces that share an edge, the one of the element with the lowest number.
        std::sort(points.begin(), points.end(), [&](const SurfacePoint& a, const SurfacePoint& b) {
            return a.t != b.t ? a.t < b.t : m_model.volume.number(a.element) < m_model.volume.number(b.element);
        });
        return points;
    }

    std::uint64_t n_failures() const override { return m_failures + m_inverter.counts().unresolved; }

private:
    void add(std::size_t element, std::size_t constraint, const Line& line, double t, std::vector<SurfacePoint>& points) {
        // A crossing of a face lies within rounding of the element.
        const std::vector<Solution> found = m_inverter.find(element, line.at(t), 1e-7);
        if (found.empty()) {
            ++m_failures;
            return;
        }
        SurfacePoint point;
        point.t = t;
        point.element = element;
        point.xi = found.front().xi;
        const Vector in_xi = face_constraints(m_model.volume.shape(element))[constraint].normal;
        const Vector normal = found.front().jacobian.transpose().inverse() * in_xi;
        set_normal(point, normal.normalized(), line.direction);
        points.push_back(point);
    }

    const Model& m_model;
    const SegmentFinder& m_finder;
    Inverter m_inverter;
    /** Of each element: which of its faces are there. */
    std::vector<std::vector<std::size_t>> m_constraints;
    std::uint64_t m_failures = 0;
};

class IsosurfacePoints : public SurfaceTracer {
public:
    IsosurfacePoints(const Model& model, const Isosurface& isosurface) : m_tracer(model, isosurface) {}

    std::vector<SurfacePoint> trace(const Line& line, double near, const Perturbation& perturbation) override {
        std::vector<SurfacePoint> points;
        for (const Crossing& crossing : m_tracer.all(line, perturbation.field * m_tracer.range())) {
            if (crossing.t <= near)
                continue;
            SurfacePoint point;
            point.t = crossing.t;
            point.element = crossing.element;
            point.xi = crossing.xi;
            set_normal(point, crossing.normal, line.direction);
            points.push_back(point);
        }
        return points;
    }

    std::uint64_t n_failures() const override { return m_tracer.n_failures(); }

private:
    IsosurfaceTracer m_tracer;
};

} // namespace

std::unique_ptr<SurfaceTracer> plane_tracer(const Model& model, const CutPlane& plane) {
    return std::make_unique<PlaneTracer>(model, plane);
}

std::unique_ptr<SurfaceTracer> face_tracer(const Model& model, const SegmentFinder& finder, std::span<const elvis_face> faces) {
    return std::make_unique<FaceTracer>(model, finder, faces);
}

std::unique_ptr<SurfaceTracer> isosurface_tracer(const Model& model, const Isosurface& isosurface) {
    return std::make_unique<IsosurfacePoints>(model, isosurface);
}

} // namespace elvis::oracle
