#include "sample_files.hpp"

#include <core/base/error.hpp>
#include <core/base/output_file.hpp>

#include <zlib.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <limits>

namespace elvis::commands {

namespace {

static_assert(std::endian::native == std::endian::little);

/** Numbers of a ZIP file, little-endian (PKWARE's APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16). */
class ZipRecord {
public:
    ZipRecord& word(std::uint32_t number) { return append(number, 4); }
    ZipRecord& half(std::uint32_t number) { return append(number, 2); }
    const std::string& bytes() const { return m_bytes; }

private:
    ZipRecord& append(std::uint32_t number, int n_bytes) {
        for (int byte = 0; byte < n_bytes; ++byte) {
            m_bytes += static_cast<char>(number >> (8 * byte) & 0xffu);
        }
        return *this;
    }
    std::string m_bytes;
};

/** The header of a .npy file (numpy.lib.format, version 1.0), filled up to a multiple of 64 bytes. */
std::string npy_header(const NamedArray& array) {
    std::string text =
        std::string("{'descr': '") + (array.is_integer() ? "<i8" : "<f8") + "', 'fortran_order': False, 'shape': (";
    for (const std::size_t extent : array.shape) {
        text += std::to_string(extent) + ",";
    }
    text += "), }";
    constexpr std::size_t begin = 10, unit = 64;
    text.append(unit - (begin + text.size() + 1) % unit, ' ');
    text += '\n';
    return std::string("\x93NUMPY\x01\x00", 8) + ZipRecord().half(static_cast<std::uint32_t>(text.size())).bytes() + text;
}

/** One file in the archive. */
struct Entry {
    std::string name;
    std::uint32_t checksum = 0, size = 0, offset = 0;

    /** What local header and directory share: version, flags (names are UTF-8), no compression, 1980-01-01. */
    ZipRecord& describe(ZipRecord& record) const {
        constexpr std::uint32_t version = 20, utf8 = 0x0800, first_day = 0x21;
        return record.half(version).half(utf8).half(0).half(0).half(first_day).word(checksum).word(size).word(size).half(
            static_cast<std::uint32_t>(name.size()));
    }
    std::string local_header() const {
        ZipRecord record;
        record.word(0x04034b50);
        return describe(record).half(0).bytes() + name;
    }
    std::string directory_entry() const {
        ZipRecord record;
        record.word(0x02014b50).half(20);
        return describe(record).half(0).half(0).half(0).half(0).word(0).word(offset).bytes() + name;
    }
};

std::uint32_t checksum(const std::string& header, const NamedArray& array) {
    const auto* const numbers = static_cast<const Bytef*>(array.bytes());
    const uLong of_header = crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(header.data()), header.size());
    return static_cast<std::uint32_t>(array.n_bytes() > 0 ? crc32_z(of_header, numbers, array.n_bytes()) : of_header);
}

void write_archive(std::ofstream& file, const std::vector<NamedArray>& arrays, const std::string& path) {
    std::string directory;
    std::uint64_t offset = 0;
    for (const NamedArray& array : arrays) {
        const std::string header = npy_header(array);
        const std::uint64_t size = header.size() + array.n_bytes();
        if (offset + size + directory.size() > std::numeric_limits<std::int32_t>::max()) {
            throw Error(path,
                        "would be larger than 2 GiB, which this kind of archive is not written with; .h5 has no such limit");
        }
        const Entry entry{array.name + ".npy", checksum(header, array), static_cast<std::uint32_t>(size),
                          static_cast<std::uint32_t>(offset)};
        const std::string local = entry.local_header();
        file << local << header;
        file.write(static_cast<const char*>(array.bytes()), static_cast<std::streamsize>(array.n_bytes()));
        directory += entry.directory_entry();
        offset += local.size() + size;
    }
    const auto n = static_cast<std::uint32_t>(arrays.size());
    ZipRecord end;
    end.word(0x06054b50)
        .half(0)
        .half(0)
        .half(n)
        .half(n)
        .word(static_cast<std::uint32_t>(directory.size()))
        .word(static_cast<std::uint32_t>(offset))
        .half(0);
    file << directory << end.bytes();
}

} // namespace

void write_npz(const SampleTable& table, const std::string& path) {
    OutputFile output(path);
    std::ofstream file(output.temporary(), std::ios::binary);
    write_archive(file, arrays_of(table), path);
    file.close();
    if (!file) {
        throw Error(path, "cannot be written");
    }
    output.commit();
}

} // namespace elvis::commands
