/**
 * @file block_cache.hpp
 * Coefficients of blocks of elements, read once and kept while there is room: evaluation asks for one element at a time.
 */
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace elvis::native_plugin {

/** What a block holds. `field` is the field's index, or -1 for geometry (time step 0). */
struct BlockKey {
    std::int64_t field = -1;
    std::size_t time_step = 0;
    std::size_t element_class = 0;
    std::uint64_t block = 0;

    friend auto operator<=>(const BlockKey&, const BlockKey&) = default;
    friend bool operator==(const BlockKey&, const BlockKey&) = default;
};

/** Least recently used blocks go first. All functions may be called from several threads. */
class BlockCache {
public:
    using Block = std::shared_ptr<const std::vector<double>>;

    explicit BlockCache(std::size_t max_numbers) : m_max_numbers(max_numbers) {}

    /** The block, made by `read()` (returns std::vector<double>) if it is not there. Two threads may both read it. */
    template <class Read> Block get(const BlockKey& key, Read read) {
        // Most elements come after others of their block: then threads do not wait for one another.
        thread_local std::array<Last, 2> last_of_thread;
        Last& last = last_of_thread[key.field < 0 ? 0 : 1];
        if (const std::uint64_t content = m_content; last.content != content || last.key != key) {
            last = {content, key, get_from_all(key, read)};
        }
        return last.block;
    }

    bool has(const BlockKey& key) {
        const std::lock_guard lock(m_mutex);
        return m_entries.contains(key);
    }

    void clear() {
        const std::lock_guard lock(m_mutex);
        m_order.clear();
        m_entries.clear();
        m_numbers = 0;
        m_content = next_content();
    }

private:
    /** What a thread got last, and from which content of which cache. */
    struct Last {
        std::uint64_t content = 0;
        BlockKey key;
        Block block;
    };

    /** Different for all caches, and before and after clear(). */
    static std::uint64_t next_content() {
        static std::atomic<std::uint64_t> n_contents = 0;
        return ++n_contents;
    }

    template <class Read> Block get_from_all(const BlockKey& key, Read read) {
        {
            const std::lock_guard lock(m_mutex);
            if (const auto found = m_entries.find(key); found != m_entries.end()) {
                m_order.splice(m_order.begin(), m_order, found->second);
                return found->second->second;
            }
        }
        Block block = std::make_shared<const std::vector<double>>(read());
        const std::lock_guard lock(m_mutex);
        if (const auto found = m_entries.find(key); found != m_entries.end())
            return found->second->second;
        m_order.emplace_front(key, block);
        m_entries[key] = m_order.begin();
        m_numbers += block->size();
        while (m_numbers > m_max_numbers && m_order.size() > 1) {
            m_numbers -= m_order.back().second->size();
            m_entries.erase(m_order.back().first);
            m_order.pop_back();
        }
        return block;
    }

    using Order = std::list<std::pair<BlockKey, Block>>;
    std::mutex m_mutex;
    Order m_order;
    std::map<BlockKey, Order::iterator> m_entries;
    std::size_t m_numbers = 0;
    std::size_t m_max_numbers;
    std::atomic<std::uint64_t> m_content = next_content();
};

} // namespace elvis::native_plugin
