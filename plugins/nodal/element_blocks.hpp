/**
 * @file element_blocks.hpp
 * Numbers of elements that lie in a file: read by blocks, because the host asks for one element at a time.
 */
#pragma once

#include <plugin_api/native/src/volume/block_cache.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace elvis::nodal {

/** Numbers of one element, valid as long as this is. */
class ElementNumbers {
public:
    ElementNumbers(std::shared_ptr<const std::vector<double>> block, std::size_t offset)
        : m_block(std::move(block)), m_first(m_block->data() + offset) {}

    const double* data() const { return m_first; }

private:
    std::shared_ptr<const std::vector<double>> m_block;
    const double* m_first;
};

/** What is being asked for. */
struct ElementsKey {
    /** Geometry, or values of a time step. */
    enum class What { geometry, values } what = What::geometry;
    std::size_t time_step = 0;
    /** Index of the set that the elements belong to. */
    std::size_t set = 0;
    std::uint64_t n_elements = 0;
    std::size_t numbers_an_element = 0;
};

/** Several threads may ask at once. Blocks have 2 MiB; 128 MiB are kept. */
class ElementBlocks {
public:
    /** `read(first, count)` gives the numbers of a range of the set's elements, element by element. */
    template <class Read> ElementNumbers get(const ElementsKey& key, std::uint64_t element, Read read) {
        const std::uint64_t size = std::max<std::uint64_t>(1, block_numbers / key.numbers_an_element);
        const std::uint64_t block = element / size, first = block * size;
        return {m_blocks.get({key.what == ElementsKey::What::geometry ? -1 : 0, key.time_step, key.set, block},
                             [&] { return read(first, std::min(size, key.n_elements - first)); }),
                (element - first) * key.numbers_an_element};
    }

private:
    static constexpr std::size_t block_numbers = std::size_t{1} << 18;
    static constexpr std::size_t most_numbers = std::size_t{1} << 24;

    native_plugin::BlockCache m_blocks{most_numbers};
};

} // namespace elvis::nodal
