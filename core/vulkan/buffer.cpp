#include <core/vulkan/buffer.hpp>

#include <core/vulkan/memory/allocation.hpp>
#include <core/vulkan/memory/buffer_view.hpp>

#include <cassert>
#include <cstring>
#include <mutex>

namespace elvis {

namespace {

VkBufferUsageFlags usage_of(const Device& device, Buffer::Use use) {
    if (use == Buffer::Use::uniform) {
        return VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    }
    const VkBufferUsageFlags texels = device.uses_texel_buffers() ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : 0;
    return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | texels;
}

} // namespace

struct Buffer::Impl {
    const Device& device;
    Use use;
    Allocation allocation;
    std::once_flag has_texels;
    std::optional<BufferView> texels;

    Impl(const Device& on, std::uint64_t bytes, Use for_use)
        : device(on), use(for_use), allocation(on, bytes, usage_of(on, for_use), "a buffer") {}
};

Buffer::Buffer(const Device& device, std::uint64_t bytes, Use use) : m_impl(std::make_unique<Impl>(device, bytes, use)) {}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

VkBuffer Buffer::handle() const { return m_impl->allocation.handle(); }
std::uint64_t Buffer::bytes() const { return m_impl->allocation.bytes(); }
Buffer::Use Buffer::use() const { return m_impl->use; }

VkBufferView Buffer::texels() const {
    assert(m_impl->device.uses_texel_buffers() && m_impl->use == Use::storage);
    std::call_once(m_impl->has_texels, [this] {
        m_impl->texels.emplace(m_impl->device, m_impl->allocation.handle(), VK_FORMAT_R32G32B32A32_UINT);
    });
    return m_impl->texels->handle();
}

void Buffer::write(std::uint64_t offset, std::span<const std::byte> data) const {
    m_impl->allocation.write(offset, data.size(), 1, [&](std::uint64_t from, std::span<std::byte> destination) {
        std::memcpy(destination.data(), data.data() + from, destination.size());
    });
}

void Buffer::read(std::uint64_t offset, std::span<std::byte> data) const { m_impl->allocation.read(offset, data); }

std::vector<std::uint32_t> Buffer::read_if_any(std::size_t n_behind, std::optional<Read> also) const {
    // 256 KiB take no longer than a wait.
    constexpr std::size_t few = 1u << 16;
    std::vector<std::uint32_t> words(n_behind < few ? 1 + n_behind : 1);
    std::vector<Read> reads{{this, std::as_writable_bytes(std::span(words))}};
    if (also) {
        reads.push_back(*also);
    }
    read_together(reads);
    return words[0] == 0 || n_behind < few ? words : read_items<std::uint32_t>(1 + n_behind);
}

void Buffer::read_together(std::span<const Read> reads) {
    std::vector<Allocation::Read> parts;
    for (const Read& read : reads) {
        parts.push_back({&read.from->m_impl->allocation, read.data});
    }
    Allocation::read_together(parts);
}

std::vector<std::vector<std::uint32_t>> Buffer::read_words(std::initializer_list<const Buffer*> buffers) {
    std::vector<std::vector<std::uint32_t>> words;
    std::vector<Allocation::Read> reads;
    for (const Buffer* buffer : buffers) {
        words.emplace_back(static_cast<std::size_t>(buffer->bytes() / sizeof(std::uint32_t)));
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
        reads.push_back({&buffers.begin()[i]->m_impl->allocation, std::as_writable_bytes(std::span(words[i]))});
    }
    Allocation::read_together(reads);
    return words;
}

void Buffer::fill(std::uint32_t word) const { m_impl->allocation.fill(word); }

} // namespace elvis
