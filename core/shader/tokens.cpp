#include <core/shader/tokens.hpp>

#include <algorithm>
#include <cctype>

namespace elvis {

namespace {

bool is_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_part(char c) { return is_start(c) || std::isdigit(static_cast<unsigned char>(c)); }

/** End of a comment that starts at `at`, or `at` if none does. */
std::size_t skip_comment(std::string_view text, std::size_t at) {
    if (text.compare(at, 2, "//") == 0) {
        return std::min(text.find('\n', at), text.size());
    }
    if (text.compare(at, 2, "/*") == 0) {
        const std::size_t end = text.find("*/", at + 2);
        return end == std::string_view::npos ? text.size() : end + 2;
    }
    return at;
}

/** Calls `found(name)` for each identifier in turn. */
template <class Found> void for_each_identifier(std::string_view text, Found&& found) {
    for (std::size_t at = 0; at < text.size();) {
        if (const std::size_t after = skip_comment(text, at); after != at) {
            at = after;
        } else if (is_start(text[at])) {
            std::size_t end = at;
            while (end < text.size() && is_part(text[end])) {
                ++end;
            }
            found(text.substr(at, end - at));
            at = end;
        } else if (std::isdigit(static_cast<unsigned char>(text[at]))) {
            // A number with its suffix is no identifier.
            while (at < text.size() && is_part(text[at])) {
                ++at;
            }
        } else {
            ++at;
        }
    }
}

} // namespace

std::set<std::string> identifiers(std::string_view text) {
    std::set<std::string> names;
    for_each_identifier(text, [&](std::string_view name) { names.emplace(name); });
    return names;
}

std::set<std::string> defined_macros(std::string_view text) {
    std::set<std::string> names;
    bool after_define = false;
    for_each_identifier(text, [&](std::string_view name) {
        if (after_define) {
            names.emplace(name);
        }
        after_define = name == "define";
    });
    return names;
}

} // namespace elvis
