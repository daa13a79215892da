#include "adf_container.hpp"

#include "trimmed.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace elvis_cgns {

namespace {

constexpr std::uint64_t block_size = 4096;
constexpr std::size_t pointer_digits = 12;
/** The first four bytes are "@(#)" with the highest bits set. */
constexpr std::string_view version_text = "ADF Database Version ";
constexpr std::size_t version_at = 4;

// The file's head.
constexpr std::uint64_t format_at = 0x64, root_at = 0x86, end_at = root_at + pointer_digits;

// A node: each field follows the one before.
constexpr std::size_t name_at = 4, name_size = 32, label_at = name_at + name_size, n_children_at = label_at + name_size,
                      n_entries_at = n_children_at + 8, table_at = n_entries_at + 8, type_at = table_at + pointer_digits,
                      n_dimensions_at = type_at + name_size, dimensions_at = n_dimensions_at + 2, most_dimensions = 12,
                      n_chunks_at = dimensions_at + 8 * most_dimensions, chunks_at = n_chunks_at + 4,
                      tail_at = chunks_at + pointer_digits, node_size = tail_at + 4;

/** Mark and pointer to the end, before what a table or a run of data holds. */
constexpr std::uint64_t frame_size = 4 + pointer_digits;

std::size_t size_of(const std::string& type) {
    return type == "C1"                                   ? 1
           : type == "I4" || type == "U4" || type == "R4" ? 4
           : type == "I8" || type == "U8" || type == "R8" ? 8
                                                          : 0;
}

template <class Stored, class Number> void decode(const std::string& bytes, bool is_swapped, std::span<Number> values) {
    for (std::size_t index = 0; index < values.size(); ++index) {
        std::array<char, sizeof(Stored)> one;
        std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(index * sizeof(Stored)), sizeof(Stored), one.begin());
        if (is_swapped) {
            std::ranges::reverse(one);
        }
        values[index] = static_cast<Number>(std::bit_cast<Stored>(one));
    }
}

} // namespace

bool AdfContainer::is_adf(const std::string& path) {
    std::array<char, version_at + version_text.size()> head{};
    std::ifstream file(path, std::ios::binary);
    return file.read(head.data(), head.size()) &&
           std::string_view(head.data() + version_at, version_text.size()) == version_text;
}

AdfContainer::File::File(const std::string& path) : m_descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
AdfContainer::File::~File() {
    if (m_descriptor >= 0) {
        ::close(m_descriptor);
    }
}

AdfContainer::AdfContainer(const std::string& path) : Container(path), m_file(path) {
    struct stat status {};
    if (m_file.descriptor() < 0 || fstat(m_file.descriptor(), &status) != 0) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
    }
    m_size = static_cast<std::uint64_t>(status.st_size);
    const char format = bytes(format_at, 1).front();
    if (format != 'L' && format != 'B') {
        fail(format_at, "the numbers are in the format '" + std::string(1, format) + "', which is not IEEE's");
    }
    m_is_big_endian = format == 'B';
    m_root = pointer(bytes(root_at, pointer_digits), root_at);
    // What follows only fills the last block.
    const std::uint64_t end = pointer(bytes(end_at, pointer_digits), end_at);
    if (end >= m_size) {
        fail(m_size, "the file ends here; it says that it has " + std::to_string(end + 1) + " bytes: it is cut off");
    }
}

void AdfContainer::fail(std::uint64_t address, const std::string& what) const {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, path(), "at byte " + std::to_string(address) + ": " + what);
}

std::string AdfContainer::bytes(std::uint64_t address, std::uint64_t size) const {
    if (address > m_size || size > m_size - address) {
        fail(address, "the file ends before " + std::to_string(size) + " bytes that should be here: it is cut or damaged");
    }
    std::string all(size, '\0');
    for (std::uint64_t done = 0; done < size;) {
        const ssize_t n = ::pread(m_file.descriptor(), &all[done], size - done, static_cast<off_t>(address + done));
        if (n <= 0) {
            fail(address, "cannot be read");
        }
        done += static_cast<std::uint64_t>(n);
    }
    return all;
}

void AdfContainer::expect(std::uint64_t address, const std::string& tag) const {
    if (bytes(address, tag.size()) != tag) {
        fail(address, "there is no '" + tag + "': the file is damaged");
    }
}

std::uint64_t AdfContainer::number(const std::string& digits, std::uint64_t address) const {
    std::uint64_t value = 0;
    for (const char digit : digits) {
        const char* const all = "0123456789ABCDEF";
        const char* const found = std::strchr(all, digit >= 'a' && digit <= 'f' ? digit - 'a' + 'A' : digit);
        if (found == nullptr || digit == '\0') {
            fail(address, "there is no number in hexadecimal digits: the file is damaged");
        }
        value = 16 * value + static_cast<std::uint64_t>(found - all);
    }
    return value;
}

std::uint64_t AdfContainer::pointer(const std::string& digits, std::uint64_t address) const {
    return number(digits.substr(0, 8), address) * block_size + number(digits.substr(8), address);
}

Node AdfContainer::read_node(std::uint64_t address, const Node* parent) const {
    const std::string all = bytes(address, node_size);
    if (!all.starts_with("NoDe") || !all.ends_with("TaiL")) {
        fail(address, "there is no node: the file is damaged");
    }
    Node node;
    node.name = trimmed(all.substr(name_at, name_size));
    node.label = trimmed(all.substr(label_at, name_size));
    node.type = trimmed(all.substr(type_at, name_size));
    node.path = parent ? parent->path + "/" + node.name : "";
    node.address = address;
    node.container = shared_from_this();
    const std::uint64_t n_dimensions = number(all.substr(n_dimensions_at, 2), address + n_dimensions_at);
    if (n_dimensions > most_dimensions) {
        fail(address + n_dimensions_at, "a node has " + std::to_string(n_dimensions) + " dimensions: the file is damaged");
    }
    for (std::size_t axis = 0; axis < n_dimensions; ++axis) {
        const std::size_t at = dimensions_at + 8 * axis;
        node.shape.push_back(number(all.substr(at, 8), address + at));
    }
    if (number(all.substr(n_chunks_at, 4), address + n_chunks_at) == 0) {
        node.shape.clear();
    }
    if (node.size() > m_size / std::max<std::size_t>(size_of(node.type), 1)) {
        node.fail("has more data than the file is long: the file is damaged");
    }
    return node;
}

Node AdfContainer::root() const { return read_node(m_root, nullptr); }

std::vector<Node> AdfContainer::children(const Node& parent) const {
    const std::string head = bytes(parent.address, node_size);
    const std::uint64_t n_children = number(head.substr(n_children_at, 8), parent.address + n_children_at);
    std::vector<Node> all;
    if (n_children == 0) {
        return all;
    }
    const std::uint64_t table = pointer(head.substr(table_at, pointer_digits), parent.address + table_at);
    expect(table, "SNTb");
    constexpr std::uint64_t entry_size = name_size + pointer_digits;
    if (n_children > m_size / entry_size) {
        fail(parent.address, parent.path + " has more children than the file can hold: it is damaged");
    }
    const std::string entries = bytes(table + frame_size, n_children * entry_size);
    for (std::uint64_t child = 0; child < n_children; ++child) {
        const std::uint64_t at = child * entry_size + name_size;
        all.push_back(read_node(pointer(entries.substr(at, pointer_digits), table + frame_size + at), &parent));
    }
    std::ranges::stable_sort(all, {}, &Node::name);
    return all;
}

std::vector<AdfContainer::Chunk> AdfContainer::chunks(const Node& node) const {
    const std::string head = bytes(node.address, node_size);
    const std::uint64_t n_chunks = number(head.substr(n_chunks_at, 4), node.address + n_chunks_at);
    const std::uint64_t first = pointer(head.substr(chunks_at, pointer_digits), node.address + chunks_at);
    std::vector<std::uint64_t> starts;
    if (n_chunks == 1) {
        starts.push_back(first);
    } else if (n_chunks > 1) {
        expect(first, "DCtb");
        const std::string table = bytes(first + frame_size, n_chunks * 2 * pointer_digits);
        for (std::uint64_t chunk = 0; chunk < n_chunks; ++chunk) {
            starts.push_back(pointer(table.substr(chunk * 2 * pointer_digits, pointer_digits), first));
        }
    }
    std::vector<Chunk> all;
    for (const std::uint64_t start : starts) {
        expect(start, "DaTa");
        const std::uint64_t end = pointer(bytes(start + 4, pointer_digits), start + 4);
        if (end < start + frame_size || end > m_size) {
            fail(start, "a run of data has no end: the file is damaged");
        }
        all.push_back({start + frame_size, end});
    }
    return all;
}

std::string AdfContainer::data(const Node& node, std::uint64_t first, std::uint64_t size) const {
    std::string all;
    for (const Chunk& chunk : chunks(node)) {
        const std::uint64_t length = chunk.end - chunk.begin;
        if (first < length && size > 0) {
            const std::uint64_t part = std::min(size, length - first);
            all += bytes(chunk.begin + first, part);
            first += part;
            size -= part;
        }
        first -= std::min(first, length);
    }
    if (size > 0) {
        node.fail("has less data than its dimensions say: the file is damaged");
    }
    return all;
}

template <class Number> void AdfContainer::read_numbers(const Node& node, std::uint64_t first, std::span<Number> values) const {
    const std::uint64_t size = node.size();
    if (first > size || values.size() > size - first) {
        node.fail("has " + std::to_string(size) + " numbers where " + std::to_string(first + values.size()) + " are needed");
    }
    if (values.empty()) {
        return;
    }
    const std::string all = data(node, first * size_of(node.type), values.size() * size_of(node.type));
    const bool is_swapped = m_is_big_endian != (std::endian::native == std::endian::big);
    if (node.type == "I4") {
        decode<std::int32_t>(all, is_swapped, values);
    } else if (node.type == "U4") {
        decode<std::uint32_t>(all, is_swapped, values);
    } else if (node.type == "I8") {
        decode<std::int64_t>(all, is_swapped, values);
    } else if (node.type == "U8") {
        decode<std::uint64_t>(all, is_swapped, values);
    } else if (node.type == "R4") {
        decode<float>(all, is_swapped, values);
    } else {
        decode<double>(all, is_swapped, values);
    }
}

void AdfContainer::read(const Node& node, std::uint64_t first, std::span<double> values) const {
    if (!node.holds_numbers()) {
        node.fail("does not hold numbers");
    }
    read_numbers(node, first, values);
}

void AdfContainer::read(const Node& node, std::uint64_t first, std::span<std::int64_t> values) const {
    if (!node.holds_integers()) {
        node.fail("does not hold integers");
    }
    read_numbers(node, first, values);
}

std::string AdfContainer::text(const Node& node) const {
    if (node.type != "C1" || node.shape.empty()) {
        node.fail("is no text");
    }
    return data(node, 0, node.size());
}

Link AdfContainer::link(const Node& node) const {
    const std::string all = trimmed(data(node, 0, node.size()));
    const std::size_t mark = all.find('>');
    if (mark == std::string::npos) {
        node.fail("is a link that does not say where to");
    }
    return {all.substr(0, mark), all.substr(mark + 1)};
}

} // namespace elvis_cgns
