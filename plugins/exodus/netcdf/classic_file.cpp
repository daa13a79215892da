/*
 * The classic formats of netCDF (CDF-1, CDF-2 with 64-bit offsets, CDF-5 with 64-bit lengths), by "NetCDF Classic Format
 * Specification" (Unidata): a header of lists, then each variable's numbers in one piece, but for those along the unlimited
 * dimension, whose records alternate. All numbers are big-endian.
 */
#include "netcdf.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>

namespace elvis_exodus {

namespace {

enum class Type : std::uint32_t {
    byte = 1,
    character = 2,
    int16 = 3,
    int32 = 4,
    float32 = 5,
    float64 = 6,
    uint8 = 7,
    uint16 = 8,
    uint32 = 9,
    int64 = 10,
    uint64 = 11
};

std::size_t n_bytes(Type type) {
    constexpr std::size_t sizes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return sizes[static_cast<std::size_t>(type)];
}

bool is_real(Type type) { return type == Type::float32 || type == Type::float64; }

constexpr std::uint64_t padded(std::uint64_t size) { return (size + 3) / 4 * 4; }

template <class Number> Number from_bytes(const std::uint8_t* bytes) {
    std::array<std::uint8_t, sizeof(Number)> turned;
    std::reverse_copy(bytes, bytes + sizeof(Number), turned.begin());
    return std::bit_cast<Number>(turned);
}

/** A number of any type as one of ours. */
template <class Number> Number number_from(Type type, const std::uint8_t* bytes) {
    switch (type) {
    case Type::byte:
        return static_cast<Number>(static_cast<std::int8_t>(*bytes));
    case Type::character:
    case Type::uint8:
        return static_cast<Number>(*bytes);
    case Type::int16:
        return static_cast<Number>(from_bytes<std::int16_t>(bytes));
    case Type::uint16:
        return static_cast<Number>(from_bytes<std::uint16_t>(bytes));
    case Type::int32:
        return static_cast<Number>(from_bytes<std::int32_t>(bytes));
    case Type::uint32:
        return static_cast<Number>(from_bytes<std::uint32_t>(bytes));
    case Type::int64:
        return static_cast<Number>(from_bytes<std::int64_t>(bytes));
    case Type::uint64:
        return static_cast<Number>(from_bytes<std::uint64_t>(bytes));
    case Type::float32:
        return static_cast<Number>(from_bytes<float>(bytes));
    case Type::float64:
        break;
    }
    return static_cast<Number>(from_bytes<double>(bytes));
}

struct Variable {
    Extents shape;
    /** Its first index counts records. */
    bool is_of_records = false;
    Type type = Type::byte;
    std::uint64_t begin = 0;
    std::map<std::string, std::string> texts;

    /** All, or a record. */
    std::uint64_t n_entries() const {
        std::uint64_t n = 1;
        for (std::size_t i = is_of_records ? 1 : 0; i < shape.size(); ++i) {
            n *= shape[i];
        }
        return n;
    }
};

/** Reads the header's bytes one after the other. */
class Header {
public:
    Header(const std::string& path, std::ifstream& file, std::uint64_t file_size)
        : m_path(path), m_file(file), m_left(file_size) {}

    void bytes(void* target, std::uint64_t n) {
        if (n > m_left || !m_file.read(static_cast<char*>(target), static_cast<std::streamsize>(n))) {
            fail("the file ends in its header");
        }
        m_left -= n;
    }
    void skip(std::uint64_t n) {
        if (n > m_left || !m_file.seekg(static_cast<std::streamoff>(n), std::ios::cur)) {
            fail("the file ends in its header");
        }
        m_left -= n;
    }
    std::uint64_t number(std::size_t size) {
        std::array<std::uint8_t, 8> raw{};
        bytes(raw.data(), size);
        return size == 8 ? from_bytes<std::uint64_t>(raw.data()) : from_bytes<std::uint32_t>(raw.data());
    }
    /** How many items of at least `size` bytes follow. */
    std::uint64_t count(std::size_t width, std::uint64_t size) {
        const std::uint64_t n = number(width);
        if (n > m_left / size) {
            fail("a list in the header is longer than the file");
        }
        return n;
    }
    std::string text(std::size_t width) {
        std::string text(count(width, 1), '\0');
        bytes(text.data(), text.size());
        skip(padded(text.size()) - text.size());
        return text;
    }
    [[noreturn]] void fail(const std::string& what) const { throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, what); }

private:
    const std::string& m_path;
    std::ifstream& m_file;
    std::uint64_t m_left;
};

std::string trimmed(std::string text) {
    text.resize(std::min(text.size(), text.find('\0')));
    text.resize(text.find_last_not_of(' ') + 1);
    return text;
}

class ClassicFile : public NetCdf {
public:
    explicit ClassicFile(const std::string& path) : NetCdf(path), m_file(path, std::ios::binary | std::ios::ate) {
        if (!m_file) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be opened");
        }
        m_size = static_cast<std::uint64_t>(m_file.tellg());
        m_file.seekg(0);
        Header header(path, m_file, m_size);
        read_header(header);
    }

    std::optional<std::uint64_t> dimension(const std::string& name) const override {
        for (const auto& [own, length] : m_dimensions) {
            if (own == name) {
                return length;
            }
        }
        return std::nullopt;
    }
    bool has(const std::string& variable) const override { return m_variables.contains(variable); }
    Extents shape(const std::string& variable) const override { return find(variable).shape; }
    unsigned mantissa_bits(const std::string& variable) const override {
        const Type type = find(variable).type;
        return type == Type::float32 ? 24 : type == Type::float64 ? 53 : static_cast<unsigned>(8 * n_bytes(type));
    }
    void read(const std::string& variable, const Extents& start, const Extents& count,
              std::span<double> numbers) const override {
        read_box(variable, start, count, numbers);
    }
    void read(const std::string& variable, const Extents& start, const Extents& count,
              std::span<std::int64_t> numbers) const override {
        if (is_real(find(variable).type)) {
            fail(variable, "holds no integers");
        }
        read_box(variable, start, count, numbers);
    }
    std::vector<std::string> texts(const std::string& variable) const override {
        const Variable& found = find(variable);
        if (found.type != Type::character || found.shape.empty() || found.shape.size() > 2) {
            fail(variable, "is no list of texts");
        }
        const std::uint64_t width = found.shape.back();
        std::vector<std::int64_t> letters = integers(variable);
        std::vector<std::string> rows;
        for (std::uint64_t at = 0; width > 0 && at < letters.size(); at += width) {
            std::string row;
            for (std::uint64_t i = 0; i < width; ++i) {
                row.push_back(static_cast<char>(letters[at + i]));
            }
            rows.push_back(trimmed(std::move(row)));
        }
        return rows;
    }
    std::optional<std::string> attribute(const std::string& variable, const std::string& name) const override {
        const auto& texts = find(variable).texts;
        const auto found = texts.find(name);
        return found != texts.end() ? std::optional(found->second) : std::nullopt;
    }

private:
    const Variable& find(const std::string& name) const {
        const auto found = m_variables.find(name);
        if (found == m_variables.end()) {
            fail(name, "is missing");
        }
        return found->second;
    }

    void read_header(Header& header) {
        std::array<char, 4> magic{};
        header.bytes(magic.data(), magic.size());
        const bool is_known =
            magic[0] == 'C' && magic[1] == 'D' && magic[2] == 'F' && (magic[3] == 1 || magic[3] == 2 || magic[3] == 5);
        if (!is_known) {
            header.fail("this is no netCDF file");
        }
        m_width = magic[3] == 5 ? 8 : 4;
        const std::size_t offset_width = magic[3] == 1 ? 4 : 8;
        const std::uint64_t n_records = header.number(m_width);
        const bool is_open_ended = n_records == (m_width == 8 ? ~std::uint64_t{0} : 0xffffffffu);
        read_dimensions(header);
        read_attributes(header);
        read_variables(header, offset_width);
        find_record_size();
        m_n_records = is_open_ended ? records_in_file() : n_records;
        set_records();
    }

    /** The tag of a list and the number of its items; none if it is absent. */
    std::uint64_t begin_list(Header& header, std::uint32_t tag, std::uint64_t least_bytes) {
        const std::uint64_t found = header.number(4);
        const std::uint64_t n = header.count(m_width, least_bytes);
        if (found != tag && (found != 0 || n != 0)) {
            header.fail("a list in the header is not of the kind that belongs there");
        }
        return n;
    }

    void read_dimensions(Header& header) {
        const std::uint64_t n = begin_list(header, 10, 8);
        for (std::uint64_t i = 0; i < n; ++i) {
            std::string name = header.text(m_width);
            const std::uint64_t length = header.number(m_width);
            m_dimensions.emplace_back(std::move(name), length);
        }
    }

    std::map<std::string, std::string> read_attributes(Header& header) {
        std::map<std::string, std::string> texts;
        const std::uint64_t n = begin_list(header, 12, 12);
        for (std::uint64_t i = 0; i < n; ++i) {
            std::string name = header.text(m_width);
            const Type type = read_type(header);
            const std::uint64_t n_values = header.count(m_width, n_bytes(type));
            if (type == Type::character) {
                std::string text(n_values, '\0');
                header.bytes(text.data(), text.size());
                header.skip(padded(text.size()) - text.size());
                texts[std::move(name)] = trimmed(std::move(text));
            } else {
                header.skip(padded(n_values * n_bytes(type)));
            }
        }
        return texts;
    }

    static Type read_type(Header& header) {
        const std::uint64_t type = header.number(4);
        if (type < 1 || type > 11) {
            header.fail("the header has a type of numbers that does not exist");
        }
        return static_cast<Type>(type);
    }

    void read_variables(Header& header, std::size_t offset_width) {
        const std::uint64_t n = begin_list(header, 11, 24);
        for (std::uint64_t i = 0; i < n; ++i) {
            std::string name = header.text(m_width);
            Variable variable;
            const std::uint64_t rank = header.count(m_width, m_width);
            for (std::uint64_t axis = 0; axis < rank; ++axis) {
                const std::uint64_t dimension = header.number(m_width);
                if (dimension >= m_dimensions.size()) {
                    header.fail("'" + name + "' has a dimension that does not exist");
                }
                const std::uint64_t length = m_dimensions[dimension].second;
                variable.is_of_records = variable.is_of_records || (axis == 0 && length == 0);
                variable.shape.push_back(length);
            }
            variable.texts = read_attributes(header);
            variable.type = read_type(header);
            header.number(m_width); // The size, which its shape tells, too.
            variable.begin = header.number(offset_width);
            n_numbers(*this, name, variable.shape); // Not too many to be counted.
            m_variables.emplace(std::move(name), std::move(variable));
        }
    }

    void find_record_size() {
        std::uint64_t n_variables = 0, last = 0;
        for (const auto& [name, variable] : m_variables) {
            if (variable.is_of_records) {
                last = variable.n_entries() * n_bytes(variable.type);
                m_record_size += padded(last);
                ++n_variables;
            }
        }
        // One variable alone is not padded.
        m_record_size = n_variables == 1 ? last : m_record_size;
    }

    std::uint64_t records_in_file() const {
        std::uint64_t first = m_size;
        for (const auto& [name, variable] : m_variables) {
            first = variable.is_of_records ? std::min(first, variable.begin) : first;
        }
        return m_record_size > 0 ? (m_size - first) / m_record_size : 0;
    }

    void set_records() {
        for (auto& [name, length] : m_dimensions) {
            length = length == 0 ? m_n_records : length;
        }
        for (auto& [name, variable] : m_variables) {
            if (variable.is_of_records) {
                variable.shape.front() = m_n_records;
            }
            n_numbers(*this, name, variable.shape);
            check_end(name, variable);
        }
    }

    void check_end(const std::string& name, const Variable& variable) const {
        const std::uint64_t size = variable.n_entries() * n_bytes(variable.type);
        const std::uint64_t n_before = variable.is_of_records && m_n_records > 0 ? m_n_records - 1 : 0;
        const bool is_empty = size == 0 || (variable.is_of_records && m_n_records == 0);
        const bool fits = variable.begin <= m_size && size <= m_size - variable.begin &&
                          (n_before == 0 || n_before <= (m_size - variable.begin - size) / m_record_size);
        if (!is_empty && !fits) {
            fail(name, "lies beyond the end of the file, which is cut off");
        }
    }

    std::uint64_t place(const Variable& variable, std::uint64_t record, std::uint64_t entry) const {
        return variable.begin + record * m_record_size + entry * n_bytes(variable.type);
    }

    template <class Number>
    void read_box(const std::string& name, const Extents& start, const Extents& count, std::span<Number> numbers) const {
        const Variable& variable = find(name);
        check_box(name, variable.shape, start, count, numbers.size());
        if (numbers.empty()) {
            return;
        }
        // Numbers along the last index lie side by side, but for records.
        const std::size_t rank = variable.shape.size();
        const std::size_t n_outer = rank == 1 && variable.is_of_records ? 1 : rank > 0 ? rank - 1 : 0;
        const std::uint64_t run = n_outer < rank ? count.back() : 1;
        std::vector<std::uint8_t> bytes(run * n_bytes(variable.type));
        Extents at = start;
        for (std::uint64_t done = 0; done < numbers.size(); done += run) {
            std::uint64_t entry = 0;
            for (std::size_t axis = variable.is_of_records ? 1 : 0; axis < rank; ++axis) {
                entry = entry * variable.shape[axis] + at[axis];
            }
            read_bytes(name, place(variable, variable.is_of_records ? at[0] : 0, entry), bytes);
            for (std::uint64_t i = 0; i < run; ++i) {
                numbers[done + i] = number_from<Number>(variable.type, &bytes[i * n_bytes(variable.type)]);
            }
            // The next row: as an odometer goes on.
            for (std::size_t axis = n_outer; axis-- > 0;) {
                if (++at[axis] < start[axis] + count[axis]) {
                    break;
                }
                at[axis] = start[axis];
            }
        }
    }

    void read_bytes(const std::string& name, std::uint64_t offset, std::vector<std::uint8_t>& bytes) const {
        if (offset > m_size || bytes.size() > m_size - offset) {
            fail(name, "lies beyond the end of the file, which is cut off");
        }
        const std::lock_guard lock(m_mutex);
        m_file.seekg(static_cast<std::streamoff>(offset));
        if (!m_file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
            m_file.clear();
            fail(name, "cannot be read");
        }
    }

    mutable std::mutex m_mutex;
    mutable std::ifstream m_file;
    std::uint64_t m_size = 0;
    /** Bytes of the numbers that count things in the header. */
    std::size_t m_width = 4;
    std::vector<std::pair<std::string, std::uint64_t>> m_dimensions;
    std::map<std::string, Variable> m_variables;
    std::uint64_t m_record_size = 0, m_n_records = 0;
};

} // namespace

bool is_classic(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<char, 4> magic{};
    return file.read(magic.data(), magic.size()) && magic[0] == 'C' && magic[1] == 'D' && magic[2] == 'F' &&
           (magic[3] == 1 || magic[3] == 2 || magic[3] == 5);
}

bool names_blocks(const std::string& path) {
    constexpr std::size_t most = 65536;
    std::ifstream file(path, std::ios::binary);
    std::string head(most, '\0');
    file.read(head.data(), most);
    return head.find("num_el_blk") != std::string::npos;
}

std::unique_ptr<const NetCdf> open_classic(const std::string& path) { return std::make_unique<ClassicFile>(path); }

} // namespace elvis_exodus
