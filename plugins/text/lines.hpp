/**
 * @file lines.hpp
 * Reads text files of statements, one a line: what the plugins with text formats of their own share.
 */
#pragma once

#include <elvis/plugin.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <string>
#include <type_traits>

namespace elvis::text {

/** Reads a file by lines with something on them, and these by words; comments begin with '#'. */
class Lines {
public:
    explicit Lines(const std::string& path) : m_path(path), m_file(path) {
        if (!m_file) {
            throw api::Error(ELVIS_ERROR_FILE, path, "cannot be read");
        }
    }

    /** The first line: the format's name and 1, its version. */
    void header(const std::string& name) {
        if (!next()) {
            fail("the file ends where the header is expected");
        }
        if (word("the header") != name || number<int>("version") != 1) {
            fail(std::string("the file must begin with '") + name + " 1'");
        }
        end();
    }

    bool next() {
        while (std::getline(m_file, m_line)) {
            ++m_number;
            m_line.resize(std::min(m_line.find('#'), m_line.size()));
            m_at = 0;
            if (!at_end()) {
                return true;
            }
        }
        return false;
    }

    /** Whether nothing but space is left on the line. */
    bool at_end() {
        m_at = std::min(m_line.find_first_not_of(" \t\r", m_at), m_line.size());
        return m_at == m_line.size();
    }

    std::string word(const std::string& what) {
        if (at_end()) {
            fail(what + " is missing");
        }
        const std::size_t first = m_at;
        m_at = std::min(m_line.find_first_of(" \t\r", m_at), m_line.size());
        return m_line.substr(first, m_at - first);
    }

    template <class Number> Number number(const std::string& what) {
        const std::string text = word(what);
        Number value{};
        const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        bool is_good = error == std::errc{} && after == text.data() + text.size();
        if constexpr (std::is_floating_point_v<Number>) {
            is_good = is_good && std::isfinite(value);
        }
        if (!is_good) {
            fail(std::string("'") + text + "' is no " + what);
        }
        return value;
    }

    /** A number from `least` to `most`. */
    std::size_t count(const std::string& what, std::size_t least, std::size_t most) {
        const auto value = number<std::int64_t>(what);
        if (value < static_cast<std::int64_t>(least) || value > static_cast<std::int64_t>(most)) {
            fail(what + " must be from " + std::to_string(least) + " to " + std::to_string(most) + ", and is " +
                 std::to_string(value));
        }
        return static_cast<std::size_t>(value);
    }

    /** A name that none of the items has yet. */
    template <class Items> std::string new_name(const std::string& kind, const Items& items) {
        const std::string name = word("the " + kind + "'s name");
        if (find_name(name, items) != items.end()) {
            fail(std::string("there is a ") + kind + " '" + name + "' above");
        }
        return name;
    }

    /** The name of one of the items: its position among them. */
    template <class Items> std::size_t known_name(const std::string& kind, const Items& items) {
        const std::string name = word("the " + kind + "'s name");
        const auto found = find_name(name, items);
        if (found == items.end()) {
            fail(std::string("there is no ") + kind + " '" + name + "' above");
        }
        return static_cast<std::size_t>(found - items.begin());
    }

    void end() {
        if (!at_end()) {
            fail(std::string("'") + word("") + "' is too much");
        }
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw api::Error(ELVIS_ERROR_FORMAT, m_path, "line " + std::to_string(m_number) + ": " + what);
    }

private:
    template <class Items> static auto find_name(const std::string& name, const Items& items) {
        return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
    }

    std::string m_path;
    std::ifstream m_file;
    std::string m_line;
    std::size_t m_at = 0;
    int m_number = 0;
};

/** Whether a file begins with this word: for `probe`. */
inline bool begins_with(const char* path, const std::string& header) {
    std::string word;
    return static_cast<bool>(std::ifstream(path) >> std::setw(32) >> word) && word == header;
}

} // namespace elvis::text
