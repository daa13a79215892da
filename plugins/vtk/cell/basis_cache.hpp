/**
 * @file basis_cache.hpp
 * Shape functions at sets of points. The host asks for the same sets again and again, so they are kept.
 */
#pragma once

#include "basis.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <shared_mutex>
#include <span>
#include <vector>

namespace elvis_vtk {

/** Values of the functions: at(node)[point]. */
struct BasisTable {
    std::vector<double> xi;
    std::size_t n_points = 0;
    std::vector<double> values;

    const double* at(std::size_t node) const { return &values[node * n_points]; }
};

/** Any thread may ask. */
class BasisCache {
public:
    explicit BasisCache(const std::vector<CellKind>& kinds);

    const Basis& basis(std::uint32_t kind) const { return m_bases[kind]; }
    std::shared_ptr<const BasisTable> table(std::uint32_t kind, std::span<const double> xi) const;

private:
    std::vector<Basis> m_bases;
    mutable std::shared_mutex m_mutex;
    /** By kind and hash of the points. */
    mutable std::map<std::pair<std::uint32_t, std::uint64_t>, std::shared_ptr<const BasisTable>> m_tables;
    /** Numbers held in m_tables. */
    mutable std::size_t m_held = 0;
};

} // namespace elvis_vtk
