#include <core/shader/index_checks.hpp>

#include <core/shader/glsl_scan.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <vector>

namespace elvis {

namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/** A word, or one character of anything else, outside comments. */
struct PlacedToken {
    std::size_t begin = 0;
    std::string_view text;
    /** Of braces, before it. */
    int depth = 0;
};

std::vector<PlacedToken> tokens_of(std::string_view text) {
    std::vector<PlacedToken> tokens;
    int depth = 0;
    for (std::size_t i = 0; i < text.size();) {
        if (text.substr(i, 2) == "//") {
            i = std::min(text.find('\n', i), text.size());
        } else if (text.substr(i, 2) == "/*") {
            i = std::min(text.find("*/", i + 2), text.size() - 2) + 2;
        } else if (is_space(text[i])) {
            ++i;
        } else {
            std::size_t end = i + 1;
            while (continues_identifier(text[i]) && end < text.size() && continues_identifier(text[end])) {
                ++end;
            }
            tokens.push_back({i, text.substr(i, end - i), depth});
            depth += text[i] == '{' ? 1 : text[i] == '}' ? -1 : 0;
            i = end;
        }
    }
    return tokens;
}

bool is_name(const PlacedToken& token) {
    return continues_identifier(token.text[0]) && std::isdigit(static_cast<unsigned char>(token.text[0])) == 0;
}

bool is_type_word(const PlacedToken& token) {
    constexpr std::string_view others[] = {"return", "else", "case", "do"};
    return is_name(token) && std::find(std::begin(others), std::end(others), token.text) == std::end(others);
}

/** Of vectors and matrices, whose components have indices, too. */
bool is_vector_type(std::string_view word) {
    if (word.substr(0, 6) == "elvis_") {
        word.remove_prefix(6);
    }
    const std::size_t kind = word.find_first_not_of("diub");
    word.remove_prefix(std::min<std::size_t>(kind, 1));
    return (word.substr(0, 3) == "vec" || word.substr(0, 3) == "mat") && word.size() >= 4 && word.size() <= 6 &&
           std::isdigit(static_cast<unsigned char>(word[3])) != 0;
}

/** Tokens that are names being declared, with their types: "a" and "b" in "float a[2], b = a[0];". */
std::map<std::size_t, std::string_view> declarations(const std::vector<PlacedToken>& tokens) {
    std::map<std::size_t, std::string_view> declared;
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
        if (!is_name(tokens[i]) || !is_type_word(tokens[i - 1]) || declared.count(i) != 0) {
            continue;
        }
        const std::string_view type = tokens[i - 1].text;
        declared[i] = type;
        int depth = 0;
        for (std::size_t at = i + 1; at + 2 < tokens.size() && depth >= 0 && !(depth == 0 && tokens[at].text == ";"); ++at) {
            const char c = tokens[at].text[0];
            depth += c == '(' || c == '[' || c == '{' ? 1 : c == ')' || c == ']' || c == '}' ? -1 : 0;
            // In a list of parameters a type follows the comma.
            if (depth == 0 && c == ',' && is_name(tokens[at + 1]) && !is_name(tokens[at + 2])) {
                declared[at + 1] = type;
            }
        }
    }
    return declared;
}

/** Index of the bracket that closes the one at `open`, or the number of tokens. */
std::size_t closing(const std::vector<PlacedToken>& tokens, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
        depth += tokens[i].text == "[" ? 1 : tokens[i].text == "]" ? -1 : 0;
        if (depth == 0) {
            return i;
        }
    }
    return tokens.size();
}

bool is_literal(const std::vector<PlacedToken>& tokens, std::size_t open, std::size_t close) {
    return close == open + 2 && std::isdigit(static_cast<unsigned char>(tokens[open + 1].text[0])) != 0;
}

} // namespace

std::string check_indices(std::string_view text) {
    const std::vector<PlacedToken> tokens = tokens_of(text);
    const std::map<std::size_t, std::string_view> declared = declarations(tokens);
    std::set<std::string_view> names;
    for (const auto& [i, type] : declared) {
        if (i + 1 < tokens.size() && (tokens[i + 1].text == "[" || is_vector_type(type))) {
            names.insert(tokens[i].text);
        }
    }
    std::map<std::size_t, std::string> insertions;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        // Outside of functions only constants are allowed as indices.
        const bool is_use = tokens[i].depth > 0 && declared.count(i) == 0 && (i == 0 || tokens[i - 1].text != ".");
        if (!is_use || names.count(tokens[i].text) == 0) {
            continue;
        }
        std::string indexed(tokens[i].text);
        for (std::size_t open = i + 1; open < tokens.size() && tokens[open].text == "[";) {
            const std::size_t close = closing(tokens, open);
            if (close == tokens.size()) {
                break;
            }
            if (!is_literal(tokens, open, close)) {
                insertions[tokens[open].begin + 1] += "core_index(";
                insertions[tokens[close].begin] += ", " + indexed + ".length(), __LINE__)";
            }
            indexed += "[0]";
            open = close + 1;
        }
    }
    std::string checked(text);
    for (auto insertion = insertions.rbegin(); insertion != insertions.rend(); ++insertion) {
        checked.insert(insertion->first, insertion->second);
    }
    return checked;
}

} // namespace elvis
