#include "mode_table.hpp"

#include <algorithm>

namespace elvis::native_plugin {

namespace {

/** More than callers take turns with: the core's own points, in a volume of several classes. */
constexpr std::size_t most_tables = 8;

} // namespace

ModeTables::Table ModeTables::get(const native::Space& space, std::span<const double> xi) {
    const auto is_wanted = [&](const Entry& entry) { return entry.space == space && std::ranges::equal(entry.xi, xi); };
    // Tables of all volumes are alike. Most elements are asked about the same points as the one before: then threads do not
    // wait for one another.
    thread_local Entry last;
    if (!last.table || !is_wanted(last)) {
        last = {space, {xi.begin(), xi.end()}, get_from_all(space, xi, is_wanted)};
    }
    return last.table;
}

template <class IsWanted>
ModeTables::Table ModeTables::get_from_all(const native::Space& space, std::span<const double> xi, const IsWanted& is_wanted) {
    {
        const std::lock_guard lock(m_mutex);
        const auto found = std::ranges::find_if(m_entries, is_wanted);
        if (found != m_entries.end()) {
            m_entries.splice(m_entries.begin(), m_entries, found);
            return found->table;
        }
    }
    const std::size_t n_points = xi.size() / 3;
    std::vector<double> values(native::n_modes(space));
    auto table = std::make_shared<Eigen::MatrixXd>(n_points, values.size());
    for (std::size_t point = 0; point < n_points; ++point) {
        native::evaluate_modes(space, {xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]}, values);
        table->row(static_cast<Eigen::Index>(point)) =
            Eigen::Map<const Eigen::RowVectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    }
    const std::lock_guard lock(m_mutex);
    m_entries.push_front({space, {xi.begin(), xi.end()}, table});
    if (m_entries.size() > most_tables)
        m_entries.pop_back();
    return table;
}

} // namespace elvis::native_plugin
