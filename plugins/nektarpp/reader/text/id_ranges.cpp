#include "id_ranges.hpp"

#include <charconv>

namespace nektarpp {

namespace {

class Scanner {
public:
    Scanner(const XmlFile& file, const pugi::xml_node& node, std::string_view text)
        : m_file(file), m_node(node), m_text(text) {}

    bool at_end() {
        m_at = std::min(m_text.find_first_not_of(" \t\r\n", m_at), m_text.size());
        return m_at == m_text.size();
    }
    bool take(char wanted) {
        if (at_end() || m_text[m_at] != wanted) {
            return false;
        }
        ++m_at;
        return true;
    }
    char letter() {
        if (at_end() || m_text[m_at] < 'A' || m_text[m_at] > 'Z') {
            fail("a letter was expected");
        }
        return m_text[m_at++];
    }
    std::int64_t id() {
        at_end();
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(m_text.data() + m_at, m_text.data() + m_text.size(), value);
        if (error != std::errc() || value < 0) {
            fail("an id was expected");
        }
        m_at = static_cast<std::size_t>(end - m_text.data());
        return value;
    }
    std::vector<IdRange> ranges() {
        std::vector<IdRange> all;
        do {
            IdRange range;
            range.first = range.last = id();
            if (take('-')) {
                range.last = id();
            }
            if (range.last < range.first) {
                fail("a range that ends before it begins");
            }
            all.push_back(range);
        } while (take(','));
        return all;
    }
    [[noreturn]] void fail(const std::string& what) const {
        m_file.fail(m_node, "list of ids, character " + std::to_string(m_at + 1) + ": " + what);
    }

private:
    const XmlFile& m_file;
    pugi::xml_node m_node;
    std::string_view m_text;
    std::size_t m_at = 0;
};

} // namespace

std::vector<IdRange> parse_ranges(const XmlFile& file, const pugi::xml_node& node, std::string_view text) {
    Scanner scanner(file, node, text);
    std::vector<IdRange> ranges = scanner.ranges();
    if (!scanner.at_end()) {
        scanner.fail("a comma or the end was expected");
    }
    return ranges;
}

std::vector<IdGroup> parse_groups(const XmlFile& file, const pugi::xml_node& node, std::string_view text) {
    Scanner scanner(file, node, text);
    std::vector<IdGroup> groups;
    while (!scanner.at_end()) {
        IdGroup group;
        group.kind = scanner.letter();
        if (!scanner.take('[')) {
            scanner.fail("'[' was expected");
        }
        if (!scanner.take(']')) {
            group.ranges = scanner.ranges();
            if (!scanner.take(']')) {
                scanner.fail("']' was expected");
            }
        }
        // Commas between groups are optional.
        scanner.take(',');
        groups.push_back(std::move(group));
    }
    return groups;
}

} // namespace nektarpp
