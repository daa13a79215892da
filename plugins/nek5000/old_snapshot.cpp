#include "old_snapshot.hpp"

#include "old_header.hpp"

#include <elvis/plugin.hpp>

namespace elvis_nek5000 {

namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t mark_size = 4;
/** Width of a number in a line of text, 1pe14.6. */
constexpr std::size_t column_width = 14;
/** Of the numbers that follow the header of text, one an element, 6g11.4. */
constexpr std::uint64_t numbers_a_line = 6;

std::uint64_t numbers_in(const Content& content) { return content.n_elements * content.n_points() * content.n_components(); }

std::optional<bool> byte_order(const std::string& header) {
    return header.size() == header_size + mark_size ? is_swapped(header.data() + header_size) : std::nullopt;
}

/** Where the line begins that follows n lines. */
std::uint64_t skip_lines(const ByteFile& file, std::uint64_t n) {
    constexpr std::size_t at_once = 65536;
    for (std::uint64_t place = 0; n > 0;) {
        const std::string text = file.text(place, at_once);
        if (text.empty()) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(), "ends before the values of the first node");
        }
        for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', end + 1)) {
            if (--n == 0) {
                return place + end + 1;
            }
        }
        place += text.size();
    }
    return 0;
}

/** Whether the file has the size that the content asks for. */
bool fits(const ByteFile& file, OldLayout& layout) {
    const Content& content = layout.content;
    if (!layout.is_text) {
        layout.first_number = header_size + mark_size;
        return layout.first_number + 4 * numbers_in(content) == file.size();
    }
    // One more for lines that end like those of Windows.
    const std::uint64_t n_lines = content.n_elements * content.n_points();
    layout.line_size = column_width * content.n_components() + 1;
    if (n_lines * layout.line_size > file.size()) {
        return false;
    }
    layout.first_number = skip_lines(file, 1 + (content.n_elements + numbers_a_line - 1) / numbers_a_line);
    layout.line_size += layout.first_number + n_lines * (layout.line_size + 1) == file.size() ? 1 : 0;
    return layout.first_number + n_lines * layout.line_size == file.size();
}

std::string expected_size(const OldLayout& layout) {
    if (layout.is_text) {
        return std::to_string(layout.content.n_elements * layout.content.n_points()) + " lines of " +
               std::to_string(layout.content.n_components()) + " numbers of 14 columns behind its header";
    }
    return std::to_string(header_size + mark_size + 4 * numbers_in(layout.content));
}

OldLayout find_layout(const ByteFile& file) {
    const std::string header = file.text(0, header_size + mark_size);
    const std::vector<Content> contents = parse_old_header(std::string_view(header).substr(0, header_size));
    if (contents.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(),
                                "header: numbers of elements and nodes, time, step and letters of fields are expected");
    }
    OldLayout layout;
    const auto swapped = byte_order(header);
    layout.is_text = !swapped;
    layout.format = {4, swapped.value_or(false)};
    std::string cause;
    for (const Content& content : contents) {
        layout.content = content;
        if (std::string refused = refusal(content); !refused.empty()) {
            cause = cause.empty() ? "header: " + refused : cause;
        } else if (fits(file, layout)) {
            return layout;
        } else if (cause.empty()) {
            cause = "has " + std::to_string(file.size()) + " bytes; its header promises " + expected_size(layout);
        }
    }
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(), cause);
}

} // namespace

std::uint32_t probe_old_file(const ByteFile& file) {
    const std::string header = file.text(0, header_size + mark_size);
    if (parse_old_header(std::string_view(header).substr(0, header_size)).empty()) {
        return 0;
    }
    if (byte_order(header)) {
        return 100;
    }
    // Text: all versions end the line of the header with these words.
    return header.find("NELT,NX,N") != std::string::npos ? 90 : 0;
}

OldSnapshot::OldSnapshot(const std::string& path, OpenFiles& files)
    : OldSnapshot(path, find_layout(*files.open(path)), files) {}

OldSnapshot::OldSnapshot(const std::string& path, OldLayout layout, OpenFiles& files)
    : Snapshot(path, layout.content, 1), m_files(files), m_layout(std::move(layout)) {}

void OldSnapshot::read(std::size_t block, std::uint64_t element, std::span<double> values) const {
    const std::uint64_t first_component = content().n_components_before(block);
    if (m_layout.is_text) {
        read_text(first_component, element, values);
        return;
    }
    const std::uint64_t first = (element * content().n_components() + first_component) * content().n_points();
    std::vector<char> bytes(4 * values.size());
    m_files.open(path())->read(m_layout.first_number + 4 * first, bytes.data(), bytes.size());
    decode(m_layout.format, bytes.data(), values);
}

void OldSnapshot::read_text(std::size_t first_component, std::uint64_t element, std::span<double> values) const {
    const std::size_t n_points = content().n_points();
    const std::uint64_t place = m_layout.first_number + element * n_points * m_layout.line_size;
    std::string text(n_points * m_layout.line_size, '\0');
    m_files.open(path())->read(place, text.data(), text.size());
    for (std::size_t point = 0; point < n_points; ++point) {
        for (std::size_t component = 0; component < values.size() / n_points; ++component) {
            const std::size_t at = point * m_layout.line_size + column_width * (first_component + component);
            const auto value = parse_real(columns(text, at, column_width));
            if (!value) {
                throw elvis::api::Error(ELVIS_ERROR_FORMAT, path(),
                                        "byte " + std::to_string(place + at) + ": '" + text.substr(at, column_width) +
                                            "' is no number");
            }
            values[component * n_points + point] = *value;
        }
    }
}

} // namespace elvis_nek5000
