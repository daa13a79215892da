#include "tabulation.hpp"

#include <algorithm>
#include <mutex>

namespace elvis_mfem {

namespace {

/** Numbers in one table (16 MiB) and in all that are kept (64 MiB). */
constexpr std::size_t max_table = std::size_t{1} << 21;
constexpr std::size_t max_kept = std::size_t{1} << 23;
/** A conversion has two or three sets of points a class, and one for each way to look at a face. */
constexpr std::size_t max_entries = 96;

void apply(const double* shapes, std::size_t n_rows, std::span<const double> dofs, std::size_t n_copies, double* out) {
    const std::size_t n = dofs.size() / n_copies;
    for (std::size_t copy = 0; copy < n_copies; ++copy) {
        for (std::size_t row = 0; row < n_rows; ++row) {
            // Four sums, so that additions need not wait for one another.
            std::array<double, 4> sums{};
            const double* shape = shapes + row * n;
            const double* value = dofs.data() + copy * n;
            std::size_t i = 0;
            for (; i + 4 <= n; i += 4) {
                for (std::size_t lane = 0; lane < 4; ++lane) {
                    sums[lane] += shape[i + lane] * value[i + lane];
                }
            }
            for (; i < n; ++i) {
                sums[0] += shape[i] * value[i];
            }
            out[copy * n_rows + row] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        }
    }
}

} // namespace

void Tabulation::tabulate(std::span<const double> xi, double* values) const {
    const std::size_t row = m_element->n_components() * m_element->n_dofs();
    for (std::size_t at = 0; at + 3 <= xi.size(); at += 3, values += row) {
        m_element->evaluate(to_mfem(m_geometry, &xi[at]), values);
    }
}

std::shared_ptr<const Tabulation::Entry> Tabulation::find(std::span<const double> xi) const {
    const auto is_same = [&](const std::shared_ptr<const Entry>& entry) { return std::ranges::equal(entry->xi, xi); };
    {
        const std::shared_lock lock(m_mutex);
        const auto found = std::ranges::find_if(m_entries, is_same);
        if (found != m_entries.end()) {
            return *found;
        }
        if (m_entries.size() == max_entries || m_n_kept >= max_kept) {
            return nullptr;
        }
    }
    auto entry = std::make_shared<Entry>();
    entry->xi.assign(xi.begin(), xi.end());
    entry->values.resize(xi.size() / 3 * m_element->n_components() * m_element->n_dofs());
    tabulate(xi, entry->values.data());
    const std::unique_lock lock(m_mutex);
    if (m_entries.size() < max_entries && std::ranges::none_of(m_entries, is_same)) {
        m_entries.push_back(entry);
        m_n_kept += entry->values.size();
    }
    return entry;
}

void Tabulation::combine(std::span<const double> xi, std::span<const double> dofs, std::size_t n_copies, double* out,
                         std::size_t stride) const {
    const std::size_t n_points = xi.size() / 3;
    const std::size_t row = m_element->n_components() * m_element->n_dofs();
    // A single point is asked for by a probe, and rarely again.
    const auto entry = n_points > 1 && n_points * row <= max_table ? find(xi) : nullptr;
    std::vector<double> shapes(entry ? 0 : row);
    for (std::size_t point = 0; point < n_points; ++point) {
        if (!entry) {
            tabulate(xi.subspan(3 * point, 3), shapes.data());
        }
        const double* values = entry ? entry->values.data() + point * row : shapes.data();
        apply(values, m_element->n_components(), dofs, n_copies, out + point * stride);
    }
}

} // namespace elvis_mfem
