/**
 * @file basis_cache.hpp
 * Matrices of mode values at points, kept because the same points recur for all elements of a kind.
 */
#pragma once

#include "../reader/field/mode_set.hpp"

#include <Eigen/Core>

#include <memory>
#include <shared_mutex>
#include <span>

namespace nektarpp {

/** Row: point; column: mode in the order of coefficients. */
using ModeMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** May be used by several threads at once. */
class BasisCache {
public:
    /** Values of the modes at points, three numbers a point. */
    std::shared_ptr<const ModeMatrix> values(const ModeSet& modes, std::span<const double> xi);

private:
    struct Entry {
        ModeSet modes;
        std::vector<double> xi;
        std::shared_ptr<const ModeMatrix> values;
    };

    std::shared_mutex m_mutex;
    std::vector<Entry> m_entries;
    /** The entry that gives way next. */
    std::size_t m_next = 0;
};

} // namespace nektarpp
