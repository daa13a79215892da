/**
 * @file text.hpp
 * A text file in memory, read word by word; every complaint names the file and the line.
 */
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace elvis_mfem {

class Text {
public:
    /** Reads the whole file, which may be compressed by gzip. Throws elvis::api::Error. */
    explicit Text(const std::string& path);

    const std::string& path() const { return m_path; }

    /** Whether only blanks and comments (from '#' to the end of the line) follow. */
    bool at_end();
    /** The next word, which stays unread; empty at the end. */
    std::string_view peek();
    /** The next word; `what` it should be is for the message if the file ends. */
    std::string_view word(const char* what);
    /** Reads the next word, which must be this one. */
    void expect(std::string_view word);
    /** Reads the next word if it is this one. */
    bool accept(std::string_view word);
    std::int64_t integer(const char* what, std::int64_t least, std::int64_t most);
    double real(const char* what);
    /** A number of items to come, each of which takes at least `bytes` of the rest of the file. */
    std::size_t count(const char* what, std::size_t bytes);
    /** What stands between quotes, or the next word if it is not quoted. */
    std::string_view quoted(const char* what);
    /** Whether the next word is on the line of the last one. */
    bool has_more_on_line();
    /** Whether the next word can be a number. */
    bool is_number_next();
    /** Bytes that are not read yet. */
    std::size_t left() const { return m_content.size() - m_at; }

    /** Most significant decimal digits of any real() so far. */
    int max_digits() const { return m_max_digits; }

    /** Throws an error at the line of the last word. */
    [[noreturn]] void fail(const std::string& message) const;

private:
    void skip_blanks();

    std::string m_path;
    std::string m_content;
    std::size_t m_at = 0;
    std::size_t m_word_begin = 0;
    int m_max_digits = 0;
};

/** A word of a file as messages show it: in quotes, and not longer than 40 characters. */
std::string shown(std::string_view word);

} // namespace elvis_mfem
