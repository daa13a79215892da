#include <core/shader/kernel_results.hpp>

namespace elvis {

void KernelResults::dispatch(const ComposedKernel& kernel, std::span<const Buffer* const> bindings,
                             std::span<const std::byte> push_constants, std::uint32_t groups_x, const Buffer& output,
                             std::size_t n_words) {
    kernel.dispatch_unchecked(bindings, push_constants, groups_x, 1, 1);
    m_entries.push_back({&kernel, &output, std::vector<std::uint32_t>(n_words), 0});
}

void KernelResults::read() {
    std::vector<Buffer::Read> reads;
    for (Entry& entry : m_entries) {
        reads.push_back({entry.output, std::as_writable_bytes(std::span(entry.words))});
        entry.kernel->add_watch(reads, entry.is_cut_short);
    }
    Buffer::read_together(reads);
    for (const Entry& entry : m_entries) {
        entry.kernel->check_watch(entry.is_cut_short);
    }
}

} // namespace elvis
