#include "ini.hpp"

#include <sstream>

namespace elvis_pyfr {

namespace {

constexpr const char* blanks = " \t\r\n";

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

} // namespace

Ini::Ini(const std::string& text) {
    std::istringstream lines(text);
    std::string section;
    std::string* value = nullptr;
    for (std::string line; std::getline(lines, line);) {
        line.resize(std::min(line.find(';'), line.size()));
        const std::string content = trimmed(line);
        if (content.empty() || content.front() == '#') {
            continue;
        }
        const bool is_continued = line.find_first_not_of(blanks) > 0;
        const std::size_t equals = content.find_first_of("=:");
        if (is_continued && value) {
            *value += "\n" + content;
        } else if (content.front() == '[') {
            section = content.substr(1, content.find(']') - 1);
            value = nullptr;
        } else if (equals != std::string::npos) {
            value = &m_values[{section, trimmed(content.substr(0, equals))}];
            *value = trimmed(content.substr(equals + 1));
        }
    }
}

std::optional<std::string> Ini::find(const std::string& section, const std::string& key) const {
    const auto found = m_values.find({section, key});
    return found == m_values.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream rest(text);
    for (std::string part; std::getline(rest, part, separator);) {
        parts.push_back(trimmed(part));
    }
    return parts;
}

} // namespace elvis_pyfr
