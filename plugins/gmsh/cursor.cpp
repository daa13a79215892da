#include "cursor.hpp"

#include <filesystem>
#include <fstream>

namespace gmsh {

Cursor::Cursor(const std::string& path) : m_path(path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "is not a file that can be read");
    }
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be opened");
    }
    m_data.resize(size);
    if (!file.read(m_data.data(), static_cast<std::streamsize>(size))) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
    }
}

void Cursor::fail_at(std::size_t offset, const std::string& what) const {
    // Bytes of binary numbers can look like ends of lines: a line number would mislead.
    std::string place = "at byte " + std::to_string(offset);
    if (!m_is_binary) {
        const auto end = m_data.begin() + static_cast<std::ptrdiff_t>(offset);
        place = "in line " + std::to_string(1 + std::count(m_data.begin(), end, '\n'));
    }
    if (!m_section.empty()) {
        place.append(", in $").append(m_section);
    }
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, place.append(": ").append(what));
}

void Cursor::fail_number(bool is_integral) const {
    if (left() == 0) {
        fail("the file ends too early");
    }
    std::size_t length = 0;
    while (length < std::min<std::size_t>(left(), 20) && !is_blank(m_data[m_at + length])) {
        ++length;
    }
    std::string found(m_data.data() + m_at, length);
    std::replace_if(
        found.begin(), found.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    fail("'" + found + "' where " + (is_integral ? "a whole number" : "a number") + " of moderate size is expected");
}

void Cursor::skip_blanks() {
    while (left() > 0 && is_blank(m_data[m_at])) {
        ++m_at;
    }
}

std::string_view Cursor::line() {
    if (left() == 0) {
        fail("the file ends too early");
    }
    const std::string_view rest(m_data.data() + m_at, left());
    std::string_view found = rest.substr(0, rest.find('\n'));
    m_at += std::min(rest.size(), found.size() + 1);
    while (!found.empty() && is_blank(found.back())) {
        found.remove_suffix(1);
    }
    return found;
}

void Cursor::end_of_line() {
    const std::size_t begin = m_at;
    if (!line().empty()) {
        fail_at(begin, "more on this line than expected");
    }
}

std::string Cursor::quoted() {
    skip_blanks();
    if (left() == 0 || m_data[m_at] != '"') {
        return std::string(line());
    }
    const std::size_t begin = m_at + 1;
    const std::string_view rest(m_data.data() + begin, m_data.size() - begin);
    const std::size_t length = rest.find('"');
    if (length == std::string_view::npos || rest.substr(0, length).find('\n') != std::string_view::npos) {
        fail("a quotation mark is not closed");
    }
    m_at = begin + length + 1;
    return std::string(rest.substr(0, length));
}

void Cursor::skip_past_line(std::string_view mark) {
    const std::string_view rest(m_data.data() + m_at, left());
    std::size_t found = rest.substr(0, mark.size()) == mark ? 0 : std::string_view::npos;
    if (found == std::string_view::npos) {
        const std::size_t before = rest.find(std::string("\n").append(mark));
        if (before == std::string_view::npos) {
            fail("the section has no end");
        }
        found = before + 1;
    }
    m_at += found;
    line();
}

void Cursor::check_count(std::uint64_t count, std::size_t numbers, std::size_t bytes, const char* what) const {
    // A number in text takes a digit and a blank.
    const std::size_t least = m_is_binary ? bytes : 2 * numbers;
    // The last number of a file may lack its blank.
    if (count > (left() + 1) / least) {
        fail("the rest of the file cannot hold " + std::to_string(count) + " " + what);
    }
}

} // namespace gmsh
