/**
 * @file buffer.hpp
 * Buffers on the device.
 */
#pragma once

#include <core/vulkan/device.hpp>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>

namespace elvis {

/** A storage (or uniform) buffer of bytes, device memory where possible, filled and read through staging. */
class Buffer {
public:
    enum class Use { storage, uniform };
    Buffer(const Device& device, std::uint64_t bytes, Use use = Use::storage);
    ~Buffer();
    Buffer(Buffer&&) noexcept;
    Buffer& operator=(Buffer&&) noexcept;

    VkBuffer handle() const;
    std::uint64_t bytes() const;
    Use use() const;
    /** As uvec4 texels; made at the first call. Only of storage buffers, where Device::uses_texel_buffers. */
    VkBufferView texels() const;

    void write(std::uint64_t offset, std::span<const std::byte> data) const;
    void read(std::uint64_t offset, std::span<std::byte> data) const;
    /** Fills with a repeated 32-bit word. */
    void fill(std::uint32_t word) const;

    template <class T> void write_items(std::span<const T> items, std::uint64_t first = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        write(first * sizeof(T), std::as_bytes(items));
    }
    template <class T> std::vector<T> read_items(std::size_t count, std::uint64_t first = 0) const {
        static_assert(std::is_trivially_copyable_v<T>);
        std::vector<T> items(count);
        read(first * sizeof(T), std::as_writable_bytes(std::span<T>(items)));
        return items;
    }

    struct Read {
        const Buffer* from;
        std::span<std::byte> data;
    };
    /**
     * The first word, and, if it is not 0, `n_behind` behind it, else perhaps none: with one wait if they are few. `also` is
     * read on this occasion.
     */
    std::vector<std::uint32_t> read_if_any(std::size_t n_behind, std::optional<Read> also = {}) const;

    /** The beginnings of buffers of one device, with as few waits as the device's memory asks for. */
    static void read_together(std::span<const Read> reads);
    static void read_together(std::initializer_list<Read> reads) { read_together(std::span(reads.begin(), reads.size())); }
    /** All of small buffers of one device, likewise. */
    static std::vector<std::vector<std::uint32_t>> read_words(std::initializer_list<const Buffer*> buffers);

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

enum class RecordKind { real, uint };

/**
 * A read-only array of records for shaders, split over as many allocations and bindings as the device's limits demand; no
 * record crosses a binding. Records are padded to a multiple of four numbers. Read through fetch macros
 * (core/shader/fetch.hpp), as texel buffers or storage buffers as Device::uses_texel_buffers says; a double travels as half a
 * uvec4 texel.
 */
class RecordBuffer {
public:
    RecordBuffer(const Device& device, RecordKind kind, Precision precision, std::uint64_t n_records,
                 std::uint32_t record_size);
    ~RecordBuffer();
    RecordBuffer(RecordBuffer&&) noexcept;
    RecordBuffer& operator=(RecordBuffer&&) noexcept;

    RecordKind kind() const;
    Precision precision() const;
    std::uint64_t n_records() const;
    /** As asked for, and as stored. */
    std::uint32_t record_size() const;
    std::uint32_t padded_record_size() const;
    std::uint64_t bytes() const;

    /** One for each binding. */
    std::uint32_t n_parts() const;
    std::uint64_t records_per_part() const;
    VkBuffer part(std::uint32_t part) const;
    /** VK_NULL_HANDLE when storage buffers are used. */
    VkBufferView part_view(std::uint32_t part) const;

    /** Writes records first .. of `record_size` numbers each, converting reals to the buffer's precision. */
    void write_reals(std::uint64_t first, std::span<const double> numbers) const;
    void write_uints(std::uint64_t first, std::span<const std::uint32_t> numbers) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
