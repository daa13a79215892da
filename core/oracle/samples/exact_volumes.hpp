/**
 * @file exact_volumes.hpp
 * Volumes made in memory from formulas.
 */
#pragma once

#include <core/oracle/element/volume.hpp>

#include <Eigen/QR>

#include <functional>
#include <vector>

namespace elvis::oracle {

/** World position of a reference point, and the field at a position. */
using Map = std::function<Vector(const Vector& xi)>;
using Function = std::function<double(const Vector& x)>;

/** Least-squares coefficients in a space: exact where the function lies in it. */
class Fit {
public:
    explicit Fit(const native::Space& space);
    std::vector<double> operator()(const std::function<double(const Vector& xi)>& function) const;

private:
    std::vector<Vector> m_points;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> m_modes;
};

native::Space space_of(native::Shape shape, std::uint32_t order);

/** One class, whose elements are numbered from `first_number`. */
ClassData make_class(const native::Space& geometry, const native::Space& field, const std::vector<Map>& maps,
                     const Function& function, std::int64_t first_number = 0);

/** Maps of n[0] * n[1] * n[2] equal boxes, first direction fastest, as hexahedra. */
std::vector<Map> boxes(const Vector& lower, const Vector& upper, const std::array<int, 3>& n);

/** A quadratic tetrahedron, the unit one but for the middle of the edge from (0,0,0) to (1,0,0), which is displaced. */
Map twisted_tetrahedron(const Vector& displacement);

} // namespace elvis::oracle
