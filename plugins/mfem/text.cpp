#include "text.hpp"

#include "file_content.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace elvis_mfem {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/** Digits of a decimal number from its first that is not zero to the last before the exponent. */
int significant_digits(std::string_view number) {
    int digits = 0;
    for (char c : number) {
        if (c == 'e' || c == 'E') {
            break;
        }
        if (std::isdigit(static_cast<unsigned char>(c)) && (digits > 0 || c != '0')) {
            ++digits;
        }
    }
    return digits;
}

} // namespace

Text::Text(const std::string& path) : m_path(path), m_content(read_content(path)) {}

void Text::skip_blanks() {
    while (m_at < m_content.size()) {
        if (m_content[m_at] == '#') {
            m_at = std::min(m_content.find('\n', m_at), m_content.size());
        } else if (is_blank(m_content[m_at])) {
            ++m_at;
        } else {
            return;
        }
    }
}

bool Text::at_end() {
    skip_blanks();
    return m_at == m_content.size();
}

std::string_view Text::peek() {
    skip_blanks();
    std::size_t end = m_at;
    while (end < m_content.size() && !is_blank(m_content[end])) {
        ++end;
    }
    return std::string_view(m_content).substr(m_at, end - m_at);
}

std::string_view Text::word(const char* what) {
    const std::string_view next = peek();
    m_word_begin = m_at;
    if (next.empty()) {
        fail(std::string("the file ends where ") + what + " should stand");
    }
    m_at += next.size();
    return next;
}

void Text::expect(std::string_view expected) {
    const std::string what = shown(expected);
    const std::string_view found = word(what.c_str());
    if (found != expected) {
        fail(what + " should stand where " + shown(found) + " is");
    }
}

bool Text::accept(std::string_view expected) {
    if (peek() != expected) {
        return false;
    }
    word("a word");
    return true;
}

std::int64_t Text::integer(const char* what, std::int64_t least, std::int64_t most) {
    const std::string_view text = word(what);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
        fail(std::string(what) + " should be an integer, but is " + shown(text));
    }
    if (value < least || value > most) {
        fail(std::string(what) + " is " + std::to_string(value) + ", which is not in " + std::to_string(least) + ".." +
             std::to_string(most));
    }
    return value;
}

double Text::real(const char* what) {
    std::string_view text = word(what);
    if (text.front() == '+') {
        text.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || (error != std::errc() && error != std::errc::result_out_of_range)) {
        fail(std::string(what) + " should be a number, but is " + shown(text));
    }
    if (error == std::errc::result_out_of_range) {
        // Too large or too small for a double: what the C library makes of it (infinity, zero or a subnormal).
        value = std::strtod(std::string(text).c_str(), nullptr);
    }
    m_max_digits = std::max(m_max_digits, significant_digits(text));
    return value;
}

std::size_t Text::count(const char* what, std::size_t bytes) {
    const auto value = static_cast<std::size_t>(integer(what, 0, INT32_MAX));
    if (value > left() / bytes + 1) {
        fail(std::string(what) + " is " + std::to_string(value) + ", more than the rest of the file can hold");
    }
    return value;
}

std::string_view Text::quoted(const char* what) {
    const std::string_view next = peek();
    if (!next.starts_with('"')) {
        return word(what);
    }
    m_word_begin = m_at;
    const std::size_t end = m_content.find_first_of("\"\n", m_at + 1);
    if (end == std::string::npos || m_content[end] != '"') {
        fail(std::string("the quotes around ") + what + " are not closed");
    }
    const std::string_view name = std::string_view(m_content).substr(m_at + 1, end - m_at - 1);
    m_at = end + 1;
    return name;
}

bool Text::has_more_on_line() {
    while (m_at < m_content.size() && is_blank(m_content[m_at]) && m_content[m_at] != '\n') {
        ++m_at;
    }
    return m_at < m_content.size() && m_content[m_at] != '\n' && m_content[m_at] != '#';
}

bool Text::is_number_next() {
    const std::string_view next = peek();
    if (next.empty()) {
        return false;
    }
    const std::string_view digits = next.substr(next.front() == '-' || next.front() == '+' ? 1 : 0);
    return !digits.empty() && (std::isdigit(static_cast<unsigned char>(digits.front())) || digits.front() == '.' ||
                               digits == "nan" || digits == "inf");
}

void Text::fail(const std::string& message) const {
    const auto line = 1 + std::count(m_content.begin(), m_content.begin() + static_cast<std::ptrdiff_t>(m_word_begin), '\n');
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, "line " + std::to_string(line) + ": " + message);
}

std::string shown(std::string_view word) {
    std::string text("'");
    text.append(word.substr(0, 40));
    text.push_back('\'');
    return text;
}

} // namespace elvis_mfem
