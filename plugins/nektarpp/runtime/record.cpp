#include "record.hpp"

#include "../reader/field/mode_set.hpp"

#include <cmath>

namespace nektarpp {

namespace {

namespace native = elvis::native;

/** A space's modes as those of a file. */
ModeSet modes_of(const Space& space) {
    ModeSet set{space.shape, space.basis, {}};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        set.n_modes[direction] = space.order[direction] + 1;
    }
    return set;
}

/** Norm of Ortho_A, _B, _C over that of Jacobi's polynomials (README.md). */
double orthogonal_factor(Shape shape, const ModeIndex& index) {
    const auto [p, q, r] = index;
    const double a = std::sqrt(p + 0.5);
    switch (shape) {
    case Shape::quadrilateral:
        return a * std::sqrt(q + 0.5);
    case Shape::hexahedron:
        return a * std::sqrt(q + 0.5) * std::sqrt(r + 0.5);
    case Shape::triangle:
        return a * std::sqrt(p + q + 1.0);
    case Shape::prism:
        return a * std::sqrt(q + 0.5) * std::sqrt(p + r + 1.0);
    case Shape::pyramid:
        return a * std::sqrt(q + 0.5) * std::sqrt(p + q + r + 1.5);
    case Shape::tetrahedron:
        return a * std::sqrt(p + q + 1.0) * std::sqrt(p + q + r + 1.5);
    }
    return 1;
}

} // namespace

Record::Record(const Space& space, std::size_t width) : m_width(width) {
    const bool is_orthogonal = space.basis == Basis::orthogonal;
    const std::size_t n_modes = native::n_modes(space);
    const std::size_t n_slabs = space.shape == Shape::hexahedron ? space.order[2] + 1 : 1;
    const std::size_t n_in_slab = n_modes / n_slabs;
    m_slab_rows = (n_in_slab * width + 3) / 4;
    m_size = 4 * m_slab_rows * n_slabs;
    const bool has_vertices = space.basis == Basis::modified;
    m_one.assign(n_modes, has_vertices || is_orthogonal ? 0.0 : 1.0);
    for_each_mode(modes_of(space), [&](const ModeIndex& index) {
        const std::size_t mode = m_places.size();
        m_places.push_back((mode / n_in_slab) * 4 * m_slab_rows + mode % n_in_slab * width);
        m_factors.push_back(is_orthogonal ? orthogonal_factor(space.shape, index) : 1);
        for (int corner = 0; has_vertices && corner < native::n_corners(space.shape); ++corner) {
            m_one[mode] = index == corner_mode(space.shape, corner) ? 1 : m_one[mode];
        }
    });
    if (is_orthogonal) {
        m_one[0] = 1 / m_factors[0];
    }
}

void Record::write(std::span<const double> coefficients, double constant, std::size_t which, double* record) const {
    for (std::size_t mode = 0; mode < m_places.size(); ++mode) {
        record[m_places[mode] + which] = m_factors[mode] * (coefficients[mode] - constant * m_one[mode]);
    }
}

} // namespace nektarpp
