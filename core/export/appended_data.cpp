#include <core/export/appended_data.hpp>

#include <core/base/error.hpp>

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>

namespace elvis {

namespace {

constexpr std::uint64_t block_size = std::uint64_t(1) << 20;
/** Of offsets that are written last. */
constexpr std::size_t offset_digits = 20;
static_assert(std::endian::native == std::endian::little);
static_assert(block_size % sizeof(double) == 0);

} // namespace

std::streampos reserve_offset(std::ostream& file) {
    const std::streampos place = file.tellp();
    file << std::string(offset_digits, '0');
    return place;
}

void fill_offset(std::ostream& file, std::streampos place, std::streampos begin) {
    const std::streampos here = file.tellp();
    const std::string offset = std::to_string(here - begin);
    file.seekp(place);
    file << std::string(offset_digits - offset.size(), '0') << offset;
    file.seekp(here);
}

AppendedArray::AppendedArray(std::ofstream& file, std::uint64_t n_bytes)
    : m_file(file), m_begin(file.tellp()), m_n_bytes(n_bytes) {
    const std::uint64_t partial = n_bytes % block_size;
    const std::uint64_t n_blocks = n_bytes / block_size + (partial > 0 ? 1 : 0);
    m_header.assign(3 + n_blocks, 0);
    m_header[0] = n_blocks;
    m_header[1] = block_size;
    m_header[2] = partial;
    m_block.reserve(block_size);
    m_compressed.resize(compressBound(block_size));
    // A place for the header, whose numbers follow.
    m_file.write(reinterpret_cast<const char*>(m_header.data()), static_cast<std::streamsize>(8 * m_header.size()));
}

void AppendedArray::append_bytes(std::span<const std::byte> bytes) {
    m_n_given += bytes.size();
    while (!bytes.empty()) {
        const std::size_t n = std::min<std::size_t>(bytes.size(), block_size - m_block.size());
        m_block.insert(m_block.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n));
        bytes = bytes.subspan(n);
        if (m_block.size() == block_size) {
            write_block();
        }
    }
}

void AppendedArray::write_block() {
    auto size = static_cast<uLongf>(m_compressed.size());
    // The lowest level: coefficients hardly compress, and time goes into higher ones.
    const int result = compress2(m_compressed.data(), &size, reinterpret_cast<const unsigned char*>(m_block.data()),
                                 static_cast<uLong>(m_block.size()), 1);
    if (result != Z_OK) {
        throw Error("zlib cannot compress a block of " + std::to_string(m_block.size()) + " bytes");
    }
    m_file.write(reinterpret_cast<const char*>(m_compressed.data()), static_cast<std::streamsize>(size));
    m_header[3 + m_n_written++] = size;
    m_block.clear();
}

void AppendedArray::finish() {
    if (!m_block.empty()) {
        write_block();
    }
    assert(m_n_given == m_n_bytes && m_n_written == m_header[0]);
    const std::streampos end = m_file.tellp();
    m_file.seekp(m_begin);
    m_file.write(reinterpret_cast<const char*>(m_header.data()), static_cast<std::streamsize>(8 * m_header.size()));
    m_file.seekp(end);
}

} // namespace elvis
