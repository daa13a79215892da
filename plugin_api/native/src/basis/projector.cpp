#include "projector.hpp"

#include <cassert>

namespace elvis::native::device {

using native::Shape;

Projector::Projector(const DeviceSpace& space, std::uint32_t degree_3)
    : m_n_1(space.p_max + 1), m_n_2(space.q_max + 1), m_n_3(static_cast<Eigen::Index>(degree_3) + 1) {
    const GaussPoints nodes_1(static_cast<std::size_t>(m_n_1));
    const GaussPoints nodes_2(static_cast<std::size_t>(m_n_2));
    const GaussPoints nodes_3(static_cast<std::size_t>(m_n_3));
    for (const double eta1 : nodes_1.points)
        for (const double eta2 : nodes_2.points)
            for (const double eta3 : nodes_3.points)
                // A prism's functions may be wanted in its triangle of directions 1 and 3 only.
                m_grid.push_back({eta1, space.shape == Shape::prism && space.q_max == 0 ? -1 : eta2, eta3});

    // Weights: what the collapsed map multiplies the volume by.
    const bool tetrahedron = space.shape == Shape::tetrahedron;
    const auto weight_2 = [tetrahedron](double eta) { return tetrahedron ? 1 - eta : 1; };
    const auto weight_3 = [&space](double eta) { return space.shape == Shape::prism ? 1 - eta : (1 - eta) * (1 - eta); };
    m_first = fit_matrix(nodes_1, static_cast<std::size_t>(m_n_1),
                         [&](std::size_t p, double eta) { return space.a(static_cast<int>(p), eta); });
    for (int p = 0; p <= space.p_max; ++p) {
        m_second.push_back(fit_matrix(
            nodes_2, static_cast<std::size_t>(space.n_q(p)),
            [&](std::size_t q, double eta) { return space.b(p, static_cast<int>(q), eta); }, weight_2));
        for (int q = 0; q < space.n_q(p); ++q)
            m_third.push_back(fit_matrix(
                nodes_3, static_cast<std::size_t>(space.n_r(p, q)),
                [&](std::size_t r, double eta) { return space.c(p, q, static_cast<int>(r), eta); }, weight_3));
    }
}

void Projector::project(std::span<const double> values, std::span<double> coefficients) const {
    using Eigen::Index;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    assert(values.size() == m_grid.size());
    const RowMajor by_p = m_first * Eigen::Map<const RowMajor>(values.data(), m_n_1, m_n_2 * m_n_3);
    std::size_t pair = 0;
    std::size_t place = 0;
    for (Index p = 0; p < m_n_1; ++p) {
        const RowMajor by_q =
            m_second[static_cast<std::size_t>(p)] * Eigen::Map<const RowMajor>(by_p.data() + p * m_n_2 * m_n_3, m_n_2, m_n_3);
        for (Index q = 0; q < by_q.rows(); ++q, ++pair) {
            const Eigen::VectorXd by_r = m_third[pair] * by_q.row(q).transpose();
            for (Index r = 0; r < by_r.size(); ++r)
                coefficients[place++] = by_r[r];
        }
    }
    assert(place == coefficients.size());
}

} // namespace elvis::native::device
