#include <core/base/error.hpp>
#include <core/shader/include.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace elvis {

namespace {

/** The name in an #include directive, or nothing if the line is none. */
std::string_view included_name(std::string_view line) {
    const auto skip_blanks = [&line] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
    skip_blanks();
    if (!line.starts_with('#')) {
        return {};
    }
    line.remove_prefix(1);
    skip_blanks();
    constexpr std::string_view directive = "include";
    if (!line.starts_with(directive)) {
        return {};
    }
    const std::size_t open = line.find('"');
    const std::size_t close = open == std::string_view::npos ? open : line.find('"', open + 1);
    return close == std::string_view::npos ? std::string_view{} : line.substr(open + 1, close - open - 1);
}

class Expander {
public:
    explicit Expander(const IncludeResolver& resolve) : m_resolve(resolve) {}

    void append(std::string_view text, const std::string& name) {
        if (std::find(m_open.begin(), m_open.end(), name) != m_open.end()) {
            throw Error(name, "includes itself");
        }
        // The outermost text may begin with what must stand first, such as #version.
        if (!m_open.empty()) {
            m_output += "#line 1 \"" + name + "\"\n";
        }
        m_open.push_back(name);
        std::size_t line_number = 1;
        for (std::size_t begin = 0; begin < text.size(); ++line_number) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            const std::string_view line = text.substr(begin, end - begin);
            if (const std::string_view included = included_name(line); !included.empty()) {
                append_included(included, name, line_number);
            } else {
                m_output.append(line);
                m_output += '\n';
            }
            begin = end + 1;
        }
        m_open.pop_back();
    }

    std::string take() { return std::move(m_output); }

private:
    void append_included(std::string_view included, const std::string& from, std::size_t line_number) {
        std::string_view text;
        try {
            text = m_resolve(included);
        } catch (const Error& error) {
            throw Error(from + ":" + std::to_string(line_number), error.cause());
        }
        append(text, std::string(included));
        m_output += "#line " + std::to_string(line_number + 1) + " \"" + from + "\"\n";
    }

    const IncludeResolver& m_resolve;
    std::vector<std::string> m_open;
    std::string m_output;
};

} // namespace

std::string expand_includes(std::string_view text, const std::string& name, const IncludeResolver& resolve) {
    Expander expander(resolve);
    expander.append(text, name);
    return expander.take();
}

} // namespace elvis
