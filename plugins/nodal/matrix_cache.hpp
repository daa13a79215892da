/**
 * @file matrix_cache.hpp
 * Matrices of values at points, kept because the host asks for the same points in all elements of a kind.
 */
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <span>
#include <vector>

namespace elvis::nodal {

/** Row: point; column: function. */
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** By a key and points, three numbers each. Several threads may ask at once. */
template <class Key> class MatrixCache {
public:
    /** The matrix, made by `make()` if it is not there. */
    template <class Make> std::shared_ptr<const Matrix> get(const Key& key, std::span<const double> xi, Make make) {
        if (xi.size() / 3 < least_points) {
            return std::make_shared<const Matrix>(make());
        }
        {
            const std::shared_lock lock(m_mutex);
            for (const Entry& entry : m_entries) {
                if (entry.key == key && std::ranges::equal(entry.xi, xi)) {
                    return entry.matrix;
                }
            }
        }
        auto matrix = std::make_shared<const Matrix>(make());
        if (static_cast<std::size_t>(matrix->size()) <= most_numbers) {
            keep({key, {xi.begin(), xi.end()}, matrix});
        }
        return matrix;
    }

private:
    /** More kinds of elements and point sets than usual meshes have. */
    static constexpr std::size_t most_entries = 64;
    /** Larger matrices (16 MiB) cost more to keep than to make, fewer points than this more to look up. */
    static constexpr std::size_t most_numbers = std::size_t{1} << 21;
    static constexpr std::size_t least_points = 8;

    struct Entry {
        Key key;
        std::vector<double> xi;
        std::shared_ptr<const Matrix> matrix;
    };

    void keep(Entry entry) {
        const std::unique_lock lock(m_mutex);
        if (m_entries.size() < most_entries) {
            m_entries.push_back(std::move(entry));
        } else {
            m_entries[m_next] = std::move(entry);
            m_next = (m_next + 1) % most_entries;
        }
    }

    std::shared_mutex m_mutex;
    std::vector<Entry> m_entries;
    /** The entry that gives way next. */
    std::size_t m_next = 0;
};

} // namespace elvis::nodal
