#include "mesh_file.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>

namespace elvis_nek5000 {

namespace {

constexpr std::uint64_t header_size = 80;
constexpr std::uint64_t first_element = 84;
/** Numbers of a curved side and of a condition. */
constexpr std::uint64_t record_words = 8;
/** Records that are read at once. */
constexpr std::uint64_t block_size = 16384;

} // namespace

MeshFile::MeshFile(const std::string& path) : m_file(path) { read_header(); }

void MeshFile::read_header() {
    const auto fail = [&](const std::string& cause) { throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_file.path(), cause); };
    const std::string text = m_file.text(0, first_element);
    const std::string version = text.substr(0, 5);
    const std::string_view header = std::string_view(text).substr(0, header_size);
    std::optional<std::int64_t> n_elements, dimension;
    if (version == "#v001" || version == "#v002" || version == "#v003") {
        n_elements = parse_integer(columns(header, 5, 9));
        dimension = parse_integer(columns(header, 14, 3));
    } else if (version == "#v004") {
        const auto word = words(header);
        n_elements = word.size() > 1 ? parse_integer(word[1]) : std::nullopt;
        dimension = word.size() > 2 ? parse_integer(word[2]) : std::nullopt;
        const auto n_fields = word.size() > 4 ? parse_integer(word[4]) : std::nullopt;
        // Negative: exactly that many.
        m_n_fields = n_fields && *n_fields != 0 ? static_cast<std::uint64_t>(std::abs(*n_fields)) : m_n_fields;
    } else {
        fail("does not begin with #v001, #v002, #v003 or #v004");
    }
    if (!n_elements || *n_elements < 1 || *n_elements > 9999999999 || !dimension || *dimension < 2 || *dimension > 3) {
        fail("header: a number of elements and 2 or 3 dimensions are expected");
    }
    m_n_elements = static_cast<std::uint64_t>(*n_elements);
    m_dimension = static_cast<std::uint32_t>(*dimension);
    m_format.real_size = version == "#v001" ? 4 : 8;
    const auto swapped = text.size() == first_element ? is_swapped(text.data() + header_size) : std::nullopt;
    if (!swapped) {
        fail("byte 80: the number 6.54321, which tells the byte order, is not there");
    }
    m_format.is_swapped = *swapped;
}

std::uint64_t MeshFile::take_count(std::uint64_t& place, std::uint64_t record_size) const {
    std::array<char, 8> bytes{};
    m_file.read(place, bytes.data(), m_format.real_size);
    double count = 0;
    if (m_format.real_size == 8) {
        decode(m_format, bytes.data(), std::span(&count, 1));
    } else {
        count = decode_integer(m_format, bytes.data());
    }
    const std::uint64_t first = place + m_format.real_size;
    const std::uint64_t most = (m_file.size() - std::min(m_file.size(), first)) / record_size;
    if (!(count >= 0 && count <= static_cast<double>(most) && count == std::floor(count))) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_file.path(),
                                "byte " + std::to_string(place) + ": " + std::to_string(count) +
                                    " records, but there is room for " + std::to_string(most));
    }
    place = first;
    return static_cast<std::uint64_t>(count);
}

FaceCondition MeshFile::parse_condition(const char* bytes) const {
    const std::size_t word = m_format.real_size;
    // Element, face, five numbers.
    std::array<double, 7> numbers{};
    if (word == 8) {
        decode(m_format, bytes, numbers);
    } else {
        numbers[0] = decode_integer(m_format, bytes);
        numbers[1] = decode_integer(m_format, bytes + word);
        decode(m_format, bytes + 2 * word, std::span(numbers).subspan(2));
    }
    const auto integer = [](double number) {
        return std::abs(number) < 1e15 && number == std::floor(number) ? static_cast<std::int64_t>(number) : 0;
    };
    FaceCondition condition;
    condition.element = static_cast<std::uint64_t>(integer(numbers[0]));
    condition.face = static_cast<std::uint32_t>(integer(numbers[1]));
    condition.tag = integer(numbers[6]);
    const std::string_view kind(bytes + 7 * word, 3);
    condition.kind = kind.substr(0, kind.find_first_of(std::string_view(" \0", 2)));
    return condition;
}

void MeshFile::for_each_condition(const std::function<void(const FaceCondition&)>& visit) const {
    const std::uint64_t word = m_format.real_size;
    const std::uint64_t record_size = record_words * word;
    const std::uint64_t n_corners = std::uint64_t{1} << m_dimension;
    std::uint64_t place = first_element + m_n_elements * (1 + m_dimension * n_corners) * word;
    place += take_count(place, record_size) * record_size;
    std::vector<char> bytes;
    for (std::uint64_t field = 0; field < m_n_fields && place + word <= m_file.size(); ++field) {
        const std::uint64_t n_conditions = take_count(place, record_size);
        for (std::uint64_t first = 0; first < n_conditions; first += block_size) {
            bytes.resize(std::min(block_size, n_conditions - first) * record_size);
            m_file.read(place, bytes.data(), bytes.size());
            place += bytes.size();
            for (std::uint64_t at = 0; at < bytes.size(); at += record_size) {
                visit(parse_condition(&bytes[at]));
            }
        }
    }
}

} // namespace elvis_nek5000
