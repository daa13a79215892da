/**
 * @file cursor.hpp
 * An MSH file in memory, read front to back: text, or numbers in binary of either byte order. Every step is checked; failures
 * name the section, the line of a text section, and the byte.
 */
#pragma once

#include <elvis/plugin.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace gmsh {

class Cursor {
public:
    explicit Cursor(const std::string& path);

    const std::string& path() const { return m_path; }
    std::size_t at() const { return m_at; }
    /** Where the next number begins, for messages about it. */
    std::size_t next() {
        if (!m_is_binary) {
            skip_blanks();
        }
        return m_at;
    }
    std::size_t left() const { return m_data.size() - m_at; }

    /** Name of the section being read, for error messages. */
    void enter(std::string section) { m_section = std::move(section); }
    /** Says that numbers read by `value` are binary. */
    void set_binary(bool swap_bytes) {
        m_is_binary = true;
        m_swap_bytes = swap_bytes;
    }
    bool is_binary() const { return m_is_binary; }

    /** Fails at the present place. */
    [[noreturn]] void fail(const std::string& what) const { fail_at(m_at, what); }
    [[noreturn]] void fail_at(std::size_t offset, const std::string& what) const;

    void skip_blanks();
    /** The rest of the line without its end, which is passed. Fails at the end of the file. */
    std::string_view line();
    /** As `line`, for the end of a line that must be empty, before binary data. */
    void end_of_line();
    /** A text in quotation marks, or the rest of the line. */
    std::string quoted();
    /** Passes everything up to `mark` at the start of a line, and the mark's line. */
    void skip_past_line(std::string_view mark);

    /** A number in text, whatever the kind of file. */
    template <class Number> Number text() {
        skip_blanks();
        const char* begin = m_data.data() + m_at;
        const char* end = m_data.data() + m_data.size();
        if (begin != end && *begin == '+') {
            ++begin;
        }
        Number number{};
        const auto [after, error] = std::from_chars(begin, end, number);
        if (error != std::errc{} || (after != end && !is_blank(*after))) {
            fail_number(std::is_integral_v<Number>);
        }
        m_at = static_cast<std::size_t>(after - m_data.data());
        return number;
    }

    /** A number as the file stores its numbers: text, or binary in just this type. */
    template <class Number> Number value() {
        if (!m_is_binary) {
            return text<Number>();
        }
        if (left() < sizeof(Number)) {
            fail("the file ends too early");
        }
        std::array<char, sizeof(Number)> bytes{};
        std::memcpy(bytes.data(), m_data.data() + m_at, sizeof(Number));
        m_at += sizeof(Number);
        if (m_swap_bytes) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return std::bit_cast<Number>(bytes);
    }

    /**
     * Fails unless the rest of the file can hold `count` records, each of which takes at least so many numbers in text, and so
     * many bytes in binary.
     */
    void check_count(std::uint64_t count, std::size_t numbers, std::size_t bytes, const char* what) const;

private:
    static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
    [[noreturn]] void fail_number(bool is_integral) const;

    std::string m_path;
    std::vector<char> m_data;
    std::size_t m_at = 0;
    std::string m_section;
    bool m_is_binary = false;
    bool m_swap_bytes = false;
};

} // namespace gmsh
