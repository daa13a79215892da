#include <core/shader/includes.hpp>

#include <core/base/error.hpp>

#include <optional>

namespace elvis {

namespace {

/** Deeper nesting than anyone writes; a file that includes itself gets here. */
constexpr int max_depth = 32;

std::string line_directive(std::size_t line, const std::string& name) {
    return "#line " + std::to_string(line) + " \"" + name + "\"\n";
}

/** Whether a block comment is open after this line, given whether one was before. */
bool comment_is_open_after(std::string_view line, bool is_open) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::string_view two = line.substr(i, 2);
        if (is_open) {
            if (two == "*/") {
                is_open = false;
                ++i;
            }
        } else if (two == "//") {
            break;
        } else if (two == "/*") {
            is_open = true;
            ++i;
        }
    }
    return is_open;
}

std::string_view trim_left(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    return begin == std::string_view::npos ? std::string_view{} : text.substr(begin);
}

/** The line after '#' and `keyword`, or nothing if it is no such directive. */
std::optional<std::string_view> directive(std::string_view line, std::string_view keyword) {
    line = trim_left(line);
    if (line.substr(0, 1) != "#") {
        return std::nullopt;
    }
    line = trim_left(line.substr(1));
    if (line.substr(0, keyword.size()) != keyword) {
        return std::nullopt;
    }
    return trim_left(line.substr(keyword.size()));
}

void expand(std::string_view text, const std::string& name, const IncludeResolver& resolve, int depth, std::string& out) {
    bool in_comment = false;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        ++number;
        const auto argument = in_comment ? std::nullopt : directive(line, "include");
        if (argument) {
            const std::string place = name + ":" + std::to_string(number);
            const std::size_t close = argument->find('"', 1);
            if (argument->substr(0, 1) != "\"" || close == std::string_view::npos) {
                throw Error(place, "#include wants a file name in quotation marks");
            }
            const std::string file(argument->substr(1, close - 1));
            if (depth == max_depth) {
                throw Error(place, "#include is nested too deeply; does '" + file + "' include itself?");
            }
            std::string_view content;
            try {
                content = resolve(file);
            } catch (const Error& error) {
                throw Error(place, error.what());
            }
            out += line_directive(1, file);
            expand(content, file, resolve, depth + 1, out);
            out += line_directive(number + 1, name);
            continue;
        }
        in_comment = comment_is_open_after(line, in_comment);
        out.append(line).append("\n");
        if (number == 1 && directive(line, "version")) {
            out += "#extension GL_GOOGLE_cpp_style_line_directive : require\n" + line_directive(2, name);
        }
    }
}

} // namespace

std::string expand_includes(std::string_view text, const std::string& name, const IncludeResolver& resolve) {
    std::string out;
    out.reserve(text.size() * 2);
    if (!directive(text.substr(0, text.find('\n')), "version")) {
        out += line_directive(1, name);
    }
    expand(text, name, resolve, 0, out);
    return out;
}

} // namespace elvis
