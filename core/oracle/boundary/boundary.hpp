/**
 * @file boundary.hpp
 * The boundary of a volume as the isoparametric surface that it is, met by rays in double precision: dense samples, then
 * Newton's method from everywhere that a crossing may be.
 */
#pragma once

#include <core/oracle/element/volume.hpp>
#include <core/oracle/picture/ray.hpp>

#include <elvis/element.h>

#include <optional>
#include <random>
#include <span>
#include <vector>

namespace elvis::oracle {

class Boundary {
public:
    /** Those of `faces` that have no neighbour. The volume must outlive it. */
    Boundary(const Volume& volume, std::span<const elvis_face> faces);

    struct Hit {
        /** From the ray's origin. */
        double distance = 0;
        /** |normal . direction| */
        double facing = 0;
    };
    /** The nearest crossing in front of the ray's origin. */
    std::optional<Hit> hit(const Ray& ray) const;

    /** Distance of a point near the surface from it. */
    double distance(const Vector& point) const;

    struct EdgePoint {
        Vector position, normal;
    };
    /** A random point of a random edge of a random face, or one of its ends. */
    EdgePoint edge_point(std::mt19937& random, bool is_vertex) const;

    double size() const { return (m_upper - m_lower).norm(); }
    Vector centre() const { return 0.5 * (m_lower + m_upper); }

private:
    struct Face {
        std::size_t element;
        bool is_triangle;
        /** Reference coordinates of (u, v) = (-1, -1), and steps to (1, -1), (-1, 1), and what (1, 1) is off their sum. */
        Vector corner, along_u, along_v;
        Vector middle;
        double radius = 0;
        /** (n + 1)^2 positions. */
        std::vector<Vector> samples;
    };
    Vector point(const Face& face, double u, double v, Vector* x_u, Vector* x_v) const;

    const Volume& m_volume;
    std::vector<Face> m_faces;
    Vector m_lower, m_upper;
};

} // namespace elvis::oracle
