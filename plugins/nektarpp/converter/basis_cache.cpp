#include "basis_cache.hpp"

#include <algorithm>
#include <mutex>

namespace nektarpp {

namespace {

/** More kinds of elements and point sets than usual meshes have. */
constexpr std::size_t most_entries = 64;
/** Larger matrices (16 MiB) cost more to keep than to make, fewer points than this more to look up. */
constexpr std::size_t most_numbers = 1u << 21;
constexpr std::size_t least_points = 8;

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
    if (xi.size() / 3 < least_points) {
        return std::make_shared<const ModeMatrix>(evaluate(modes, xi));
    }
    {
        const std::shared_lock lock(m_mutex);
        for (const Entry& entry : m_entries) {
            if (entry.modes == modes && std::ranges::equal(entry.xi, xi)) {
                return entry.values;
            }
        }
    }
    auto matrix = std::make_shared<const ModeMatrix>(evaluate(modes, xi));
    if (static_cast<std::size_t>(matrix->size()) <= most_numbers) {
        Entry entry{modes, {xi.begin(), xi.end()}, matrix};
        const std::unique_lock lock(m_mutex);
        if (m_entries.size() < most_entries) {
            m_entries.push_back(std::move(entry));
        } else {
            m_entries[m_next] = std::move(entry);
            m_next = (m_next + 1) % most_entries;
        }
    }
    return matrix;
}

} // namespace nektarpp
