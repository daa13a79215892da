#include "basis_cache.hpp"

namespace nektarpp {

namespace {

ModeMatrix evaluate(const ModeSet& modes, std::span<const double> xi) {
    const elvis::native::Space space = native_space(modes);
    const std::vector<std::size_t> columns = native_modes(modes);
    std::vector<double> all(elvis::native::n_modes(space));
    ModeMatrix matrix(static_cast<Eigen::Index>(xi.size() / 3), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t point = 0; point < xi.size() / 3; ++point) {
        elvis::native::evaluate_modes(space, {xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]}, all);
        for (std::size_t column = 0; column < columns.size(); ++column) {
            matrix(static_cast<Eigen::Index>(point), static_cast<Eigen::Index>(column)) = all[columns[column]];
        }
    }
    return matrix;
}

} // namespace

std::shared_ptr<const ModeMatrix> BasisCache::values(const ModeSet& modes, std::span<const double> xi) {
    return m_matrices.get(modes, xi, [&] { return evaluate(modes, xi); });
}

} // namespace nektarpp
