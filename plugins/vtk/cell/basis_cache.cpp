#include "basis_cache.hpp"

#include <algorithm>
#include <bit>
#include <mutex>

namespace elvis_vtk {

namespace {

/** Numbers that the cache may hold: 128 MiB. */
constexpr std::size_t capacity = std::size_t(1) << 24;

std::uint64_t hash(std::span<const double> numbers) {
    // FNV-1a over 64-bit words, the high bits folded down because coordinates differ there.
    std::uint64_t value = 14695981039346656037u;
    for (const double number : numbers) {
        value = (value ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211u;
        value ^= value >> 32;
    }
    return value;
}

std::shared_ptr<const BasisTable> make_table(const Basis& basis, std::span<const double> xi) {
    auto table = std::make_shared<BasisTable>();
    table->xi.assign(xi.begin(), xi.end());
    table->n_points = xi.size() / 3;
    table->values.resize(basis.size() * table->n_points);
    std::vector<double> values(basis.size());
    for (std::size_t point = 0; point < table->n_points; ++point) {
        basis.evaluate(&xi[3 * point], values);
        for (std::size_t node = 0; node < basis.size(); ++node) {
            table->values[node * table->n_points + point] = values[node];
        }
    }
    return table;
}

} // namespace

BasisCache::BasisCache(const std::vector<CellKind>& kinds) {
    for (const CellKind& kind : kinds) {
        m_bases.emplace_back(kind);
    }
}

std::shared_ptr<const BasisTable> BasisCache::table(std::uint32_t kind, std::span<const double> xi) const {
    const std::pair key(kind, hash(xi));
    {
        const std::shared_lock lock(m_mutex);
        const auto found = m_tables.find(key);
        if (found != m_tables.end() && std::ranges::equal(found->second->xi, xi)) {
            return found->second;
        }
    }
    std::shared_ptr<const BasisTable> table = make_table(m_bases[kind], xi);
    const std::size_t size = table->values.size();
    const std::unique_lock lock(m_mutex);
    if (size <= capacity / 4) {
        if (m_held + size > capacity) {
            m_tables.clear();
            m_held = 0;
        }
        m_held += m_tables.try_emplace(key, table).second ? size : 0;
    }
    return table;
}

} // namespace elvis_vtk
