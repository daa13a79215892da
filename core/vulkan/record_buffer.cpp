#include <core/base/error.hpp>
#include <core/vulkan/buffer.hpp>
#include <core/vulkan/device_impl.hpp>
#include <core/vulkan/memory/allocation.hpp>
#include <core/vulkan/memory/buffer_view.hpp>

#include <algorithm>
#include <cassert>

namespace elvis {

namespace {

struct Part {
    Allocation allocation;
    std::unique_ptr<BufferView> view;
};

} // namespace

struct RecordBuffer::Impl {
    RecordKind kind;
    Precision precision;
    std::uint64_t n_records;
    std::uint32_t record_size;
    std::uint32_t padded_size;
    std::uint64_t number_bytes;
    std::uint64_t records_per_part;
    std::vector<Part> parts;

    std::uint64_t record_bytes() const { return padded_size * number_bytes; }

    /** Writes whole records, converting and padding, wherever the parts' borders lie. */
    template <class Stored, class Number> void write(std::uint64_t first, std::span<const Number> numbers) const {
        assert(sizeof(Stored) == number_bytes && record_size > 0 && numbers.size() % record_size == 0);
        const std::uint64_t count = numbers.size() / record_size;
        assert(first + count <= n_records);
        for (std::uint64_t done = 0; done < count;) {
            const std::uint64_t record = first + done;
            const std::uint64_t within = record % records_per_part;
            const std::uint64_t n = std::min(count - done, records_per_part - within);
            const auto& allocation = parts[static_cast<std::size_t>(record / records_per_part)].allocation;
            // Pieces end anywhere between numbers, because a record may be larger than the staging buffer.
            allocation.write(
                within * record_bytes(), n * record_bytes(), sizeof(Stored),
                [&](std::uint64_t from, std::span<std::byte> destination) {
                    convert(from / sizeof(Stored), numbers.subspan(static_cast<std::size_t>(done * record_size)),
                            std::span(reinterpret_cast<Stored*>(destination.data()), destination.size() / sizeof(Stored)));
                });
            done += n;
        }
    }

    /** Stored numbers `from ..` of padded records whose unpadded numbers are `numbers`. */
    template <class Stored, class Number>
    void convert(std::uint64_t from, std::span<const Number> numbers, std::span<Stored> out) const {
        std::uint64_t record = from / padded_size;
        std::uint64_t position = from % padded_size;
        for (std::size_t written = 0; written < out.size();) {
            const std::uint64_t n_left = std::min<std::uint64_t>(padded_size - position, out.size() - written);
            const std::uint64_t n_numbers =
                position < record_size ? std::min<std::uint64_t>(n_left, record_size - position) : 0;
            const Number* source = numbers.data() + record * record_size + position;
            Stored* destination = out.data() + written;
            for (std::uint64_t i = 0; i < n_numbers; ++i) {
                destination[i] = static_cast<Stored>(source[i]);
            }
            std::fill(destination + n_numbers, destination + n_left, Stored{});
            written += static_cast<std::size_t>(n_left);
            ++record;
            position = 0;
        }
    }
};

RecordBuffer::RecordBuffer(const Device& device, RecordKind kind, Precision precision, std::uint64_t n_records,
                           std::uint32_t record_size)
    : m_impl(std::make_unique<Impl>()) {
    const Device::Impl& impl = device.impl();
    m_impl->kind = kind;
    m_impl->precision = precision;
    m_impl->n_records = n_records;
    m_impl->record_size = record_size;
    m_impl->padded_size = (std::max(record_size, 1u) + 3u) / 4u * 4u;
    const bool is_double = kind == RecordKind::real && precision == Precision::float64;
    m_impl->number_bytes = is_double ? 8 : 4;
    if (is_double && !impl.summary.has_float64) {
        throw Error(impl.place(), "it has no double precision; use --precision float32");
    }
    if (n_records > UINT32_MAX) {
        throw Error(impl.place(), "a data buffer of " + std::to_string(n_records) + " records: shaders count up to 2^32 - 1");
    }
    const std::uint64_t record_bytes = m_impl->record_bytes();
    m_impl->records_per_part = impl.max_binding_bytes / record_bytes;
    if (m_impl->records_per_part == 0) {
        throw Error(impl.place(), "a record of " + std::to_string(record_bytes) + " bytes does not fit into one binding of " +
                                      std::to_string(impl.max_binding_bytes) + " bytes");
    }

    const VkBufferUsageFlags usage =
        impl.texel_buffers ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const VkFormat format =
        kind == RecordKind::real && !is_double ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32G32B32A32_UINT;
    std::uint64_t first = 0;
    do {
        const std::uint64_t n = std::min(m_impl->records_per_part, n_records - first);
        // An empty buffer is one record that nobody reads: a binding needs memory behind it.
        Part part{Allocation(device, std::max<std::uint64_t>(n, 1) * record_bytes, usage, "a data buffer"), nullptr};
        if (impl.texel_buffers) {
            part.view = std::make_unique<BufferView>(device, part.allocation.handle(), format);
        }
        m_impl->parts.push_back(std::move(part));
        first += n;
    } while (first < n_records);
}

RecordBuffer::~RecordBuffer() = default;
RecordBuffer::RecordBuffer(RecordBuffer&&) noexcept = default;
RecordBuffer& RecordBuffer::operator=(RecordBuffer&&) noexcept = default;

RecordKind RecordBuffer::kind() const { return m_impl->kind; }
Precision RecordBuffer::precision() const { return m_impl->precision; }
std::uint64_t RecordBuffer::n_records() const { return m_impl->n_records; }
std::uint32_t RecordBuffer::record_size() const { return m_impl->record_size; }
std::uint32_t RecordBuffer::padded_record_size() const { return m_impl->padded_size; }
std::uint64_t RecordBuffer::bytes() const { return m_impl->n_records * m_impl->record_bytes(); }
std::uint32_t RecordBuffer::n_parts() const { return static_cast<std::uint32_t>(m_impl->parts.size()); }
std::uint64_t RecordBuffer::records_per_part() const { return m_impl->records_per_part; }
VkBuffer RecordBuffer::part(std::uint32_t part) const { return m_impl->parts.at(part).allocation.handle(); }

VkBufferView RecordBuffer::part_view(std::uint32_t part) const {
    const auto& view = m_impl->parts.at(part).view;
    return view ? view->handle() : VK_NULL_HANDLE;
}

void RecordBuffer::write_reals(std::uint64_t first, std::span<const double> numbers) const {
    assert(m_impl->kind == RecordKind::real);
    if (m_impl->number_bytes == 8) {
        m_impl->write<double>(first, numbers);
    } else {
        m_impl->write<float>(first, numbers);
    }
}

void RecordBuffer::write_uints(std::uint64_t first, std::span<const std::uint32_t> numbers) const {
    assert(m_impl->kind == RecordKind::uint);
    m_impl->write<std::uint32_t>(first, numbers);
}

} // namespace elvis
