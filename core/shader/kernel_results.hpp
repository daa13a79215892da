/**
 * @file kernel_results.hpp
 * What several kernels compute for the host, with one wait for all of them.
 */
#pragma once

#include <core/shader/composer.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

class KernelResults {
public:
    /** Dispatches as ComposedKernel does; the first words of `output` are wanted. Kernel and buffer live until read(). */
    void dispatch(const ComposedKernel& kernel, std::span<const Buffer* const> bindings,
                  std::span<const std::byte> push_constants, std::uint32_t groups_x, const Buffer& output, std::size_t n_words);
    /** Waits. An Error if a driver has ended loops of one of them early. */
    void read();

    std::size_t size() const { return m_entries.size(); }
    /** Of a dispatch, in their order; once they were read. */
    const std::vector<std::uint32_t>& operator[](std::size_t i) const { return m_entries[i].words; }

private:
    struct Entry {
        const ComposedKernel* kernel;
        const Buffer* output;
        std::vector<std::uint32_t> words;
        std::uint32_t is_cut_short;
    };
    std::vector<Entry> m_entries;
};

} // namespace elvis
