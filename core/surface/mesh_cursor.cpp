#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/surface/mesh_cursor.hpp>

#include <charconv>
#include <cmath>

namespace elvis {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

/** For messages: what a file says may be long or no text at all. */
std::string quoted(std::string_view word) {
    std::string text = "'";
    for (const char c : word.substr(0, 40)) {
        text += c >= ' ' && c <= '~' ? c : '?';
    }
    return text + (word.size() > 40 ? "...'" : "'");
}

} // namespace

std::optional<std::string_view> MeshCursor::line() {
    if (m_position >= m_text.size()) {
        return std::nullopt;
    }
    const std::size_t end = m_text.find('\n', m_position);
    std::string_view found = m_text.substr(m_position, end == std::string_view::npos ? end : end - m_position);
    m_position = end == std::string_view::npos ? m_text.size() : end + 1;
    m_line = m_next_line++;
    while (!found.empty() && is_space(found.back())) {
        found.remove_suffix(1);
    }
    return found;
}

std::string_view MeshCursor::word() {
    while (m_position < m_text.size() && is_space(m_text[m_position])) {
        m_next_line += m_text[m_position] == '\n' ? 1 : 0;
        ++m_position;
    }
    m_line = m_next_line;
    const std::size_t begin = m_position;
    while (m_position < m_text.size() && !is_space(m_text[m_position])) {
        ++m_position;
    }
    return m_text.substr(begin, m_position - begin);
}

std::span<const char> MeshCursor::bytes(std::size_t count) {
    if (count > n_left()) {
        fail_at_byte("the file ends here, where " + std::to_string(count) + " more bytes are expected");
    }
    const std::string_view found = m_text.substr(m_position, count);
    m_position += count;
    return {found.data(), found.size()};
}

void MeshCursor::fail(const std::string& cause) const { throw Error(m_path + ":" + std::to_string(m_line), cause); }

void MeshCursor::fail_at_byte(const std::string& cause) const {
    throw Error(m_path + ", byte " + std::to_string(m_position), cause);
}

double MeshCursor::number(std::string_view word) const {
    const std::string_view digits = word.substr(0, 1) == "+" ? word.substr(1) : word;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    // Too small for a double is as good as zero.
    const bool is_tiny = error == std::errc::result_out_of_range && digits.find("e-") != std::string_view::npos;
    if ((error != std::errc() && !is_tiny) || end != digits.data() + digits.size() || digits.empty()) {
        fail(word.empty() ? "the file ends where a number is expected" : quoted(word) + " is no number");
    }
    return is_tiny ? 0.0 : value;
}

std::int64_t MeshCursor::integer(std::string_view word) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || word.empty()) {
        fail(word.empty() ? "a whole number is missing" : quoted(word) + " is no whole number");
    }
    return value;
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    std::size_t i = 0;
    while (i < line.size()) {
        while (i < line.size() && is_space(line[i])) {
            ++i;
        }
        const std::size_t begin = i;
        while (i < line.size() && !is_space(line[i])) {
            ++i;
        }
        if (i > begin) {
            words.push_back(line.substr(begin, i - begin));
        }
    }
    return words;
}

std::optional<std::string> MeshBuilder::fault_of(const Vector3& point) {
    for (const double coordinate : point) {
        // Not for NaN either.
        if (!(std::abs(coordinate) <= largest_mesh_coordinate)) {
            return "a coordinate is " + std::to_string(coordinate) + ", which is not finite or beyond 1e15";
        }
    }
    return std::nullopt;
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    if (mesh.triangles.size() >= (std::size_t{1} << 30u)) {
        m_cursor->fail("there are more triangles than 2^30");
    }
}

} // namespace elvis
