/**
 * @file coverage.hpp
 * Which rows of a dataset have been written.
 */
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>

namespace elvis::native {

/** A set of rows, kept as disjoint intervals. */
class Coverage {
public:
    void add(std::uint64_t first, std::uint64_t count) {
        if (count == 0) {
            return;
        }
        std::uint64_t end = first + count;
        auto next = m_intervals.upper_bound(first);
        if (next != m_intervals.begin() && std::prev(next)->second >= first) {
            --next;
            first = next->first;
        }
        while (next != m_intervals.end() && next->first <= end) {
            end = std::max(end, next->second);
            next = m_intervals.erase(next);
        }
        m_intervals.emplace(first, end);
    }

    /** The first row below `n_rows` that is not in the set, or n_rows. */
    std::uint64_t first_missing(std::uint64_t n_rows) const {
        const auto first = m_intervals.begin();
        const bool starts_at_zero = first != m_intervals.end() && first->first == 0;
        return starts_at_zero ? std::min(first->second, n_rows) : 0;
    }

private:
    std::map<std::uint64_t, std::uint64_t> m_intervals; // first row -> row after the last
};

} // namespace elvis::native
