/**
 * @file candidates.hpp
 * Points that cover a surface closely, from which evenly spaced ones are chosen.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace elvis {

/** Throws Error where there are more than are worth a look: too close to be told apart in any picture. */
void need_few(double n_points);

/** Of n + 1 points along each side of a face with three or four corners: weights of these, in their order round the face. */
std::vector<std::vector<double>> lattice_of_face(std::size_t n_corners, int n);
Vector3 weighted(const std::vector<Vector3>& corners, const std::vector<double>& weights);

class Candidates {
public:
    /** `step`: the most from one to the next, > 0. There is one at most in each cell of a lattice with half of it. */
    explicit Candidates(double step) : m_step(step) {}

    /** Whether there was none in its cell yet. */
    bool add(const Vector3& point);
    void add_triangle(const std::vector<Vector3>& corners);
    /** Circles about an axis of length 1, for a curve of radii (at least 0) and heights above the origin. */
    void add_rings(const Vector3& origin, const Vector3& axis, const std::vector<std::array<double, 2>>& curve);

    double step() const { return m_step; }
    const std::vector<Vector3>& points() const { return m_points; }

private:
    double m_step;
    std::set<std::array<std::int64_t, 3>> m_cells;
    std::vector<Vector3> m_points;
};

/** Two directions of length 1 across one, and each other. */
std::array<Vector3, 2> across(const Vector3& normal);

} // namespace elvis
