#include <core/shader/poison.hpp>

#include <core/shader/snippet_check.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

namespace elvis {

namespace {

/** Where line `line` (from 1) begins. */
std::size_t line_begin(std::string_view text, int line) {
    std::size_t at = 0;
    for (int i = 1; i < line && at < text.size(); ++i) {
        const std::size_t end = text.find('\n', at);
        at = end == std::string_view::npos ? text.size() : end + 1;
    }
    return at;
}

/** Assignments to the outputs of a parameter list. */
std::string assignments(std::string_view parameters) {
    std::string text;
    std::stringstream list{std::string(parameters)};
    for (std::string parameter; std::getline(list, parameter, ',');) {
        std::stringstream words(parameter);
        std::vector<std::string> all;
        for (std::string word; words >> word;) {
            all.push_back(word);
        }
        const auto out = std::find(all.begin(), all.end(), "out");
        if (out == all.end() || all.end() - out != 3) {
            continue;
        }
        const std::string& type = out[1];
        const std::string value = "elvis_real(1267650600228229401496703205376.0LF)"; // 2^100
        if (type == "elvis_real" || type == "elvis_vec3") {
            text += " " + out[2] + " = " + type + "(" + value + ");";
        } else if (type == "elvis_mat3") {
            const std::string column = "elvis_vec3(" + value + ")";
            text += " " + out[2] + " = elvis_mat3(" + column + ", " + column + ", " + column + ");";
        }
    }
    return text;
}

/** Places behind the opening braces of loops' bodies. */
std::vector<std::size_t> loop_bodies(std::string_view text) {
    std::vector<std::size_t> bodies;
    bool is_loop = false; // `for`, `while` or `do` was met, its body not yet
    int depth = 0;        // of parentheses since then
    for (std::size_t i = 0; i < text.size();) {
        if (text.substr(i, 2) == "//") {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.substr(i, 2) == "/*") {
            i = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
        } else if (continues_identifier(text[i])) {
            std::size_t end = i;
            while (end < text.size() && continues_identifier(text[end])) {
                ++end;
            }
            const std::string_view word = text.substr(i, end - i);
            if (word == "for" || word == "while" || word == "do") {
                is_loop = true;
                depth = 0;
            }
            i = end;
        } else {
            const char c = text[i++];
            depth += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (c == '{' && is_loop) {
                bodies.push_back(i);
            }
            // A ';' outside the parentheses ends a body without braces, or `do {} while ();`.
            is_loop = is_loop && c != '{' && !(c == ';' && depth == 0);
        }
    }
    return bodies;
}

} // namespace

std::string poison_outputs(std::string_view text, const GlslNames& names) {
    std::vector<std::pair<std::size_t, std::string>> insertions;
    for (const GlslDefinition& definition : names.definitions) {
        const auto& functions = snippet_functions();
        const bool is_interface = std::any_of(functions.begin(), functions.end(), [&](const SnippetFunction& function) {
            return definition.name == function.name;
        });
        if (definition.kind != GlslDefinition::Kind::function || !is_interface) {
            continue;
        }
        const std::size_t name = text.find(definition.name, line_begin(text, definition.line));
        const std::size_t open = text.find('(', name);
        const std::size_t close = text.find(')', open);
        const std::size_t body = text.find('{', close);
        if (body == std::string_view::npos) {
            continue;
        }
        insertions.emplace_back(body + 1, " core_loop_iterations = 0u;" + assignments(text.substr(open + 1, close - open - 1)));
    }
    for (const std::size_t body : loop_bodies(text)) {
        insertions.emplace_back(body, " if (++core_loop_iterations > 50000u) { core_is_endless = true; break; }");
    }
    std::string poisoned(text);
    std::sort(insertions.begin(), insertions.end());
    for (auto insertion = insertions.rbegin(); insertion != insertions.rend(); ++insertion) {
        poisoned.insert(insertion->first, insertion->second);
    }
    return poisoned;
}

} // namespace elvis
