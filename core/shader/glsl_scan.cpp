#include <core/shader/glsl_scan.hpp>

#include <cctype>

namespace elvis {

bool continues_identifier(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

namespace {

bool begins_identifier(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct Token {
    std::string_view text; ///< an identifier or number, or one character; empty at the end
    int line = 0;
    bool begins_line = false; ///< only blanks and comments stand before it on its line

    bool is_identifier() const { return !text.empty() && begins_identifier(text.front()); }
};

/** Splits into tokens, leaving out comments. A line ends at a newline that no backslash precedes. */
class Tokenizer {
public:
    explicit Tokenizer(std::string_view text) : m_text(text) {}

    Token next() {
        skip_blanks();
        Token token;
        token.line = m_line;
        token.begins_line = m_at_line_start;
        m_at_line_start = false;
        if (m_position == m_text.size()) {
            return token;
        }
        std::size_t end = m_position + 1;
        if (continues_identifier(m_text[m_position])) {
            while (end < m_text.size() && continues_identifier(m_text[end])) {
                ++end;
            }
        }
        token.text = m_text.substr(m_position, end - m_position);
        m_position = end;
        return token;
    }

private:
    bool at(std::string_view what) const { return m_text.substr(m_position, what.size()) == what; }

    void skip_blanks() {
        while (m_position < m_text.size()) {
            if (at("//")) {
                m_position = std::min(m_text.find('\n', m_position), m_text.size());
            } else if (at("/*")) {
                const std::size_t end = std::min(m_text.find("*/", m_position + 2), m_text.size() - 2);
                for (; m_position < end + 2; ++m_position) {
                    m_line += m_text[m_position] == '\n' ? 1 : 0;
                }
            } else if (at("\\\n")) {
                m_position += 2;
                ++m_line;
            } else if (m_text[m_position] == '\n') {
                ++m_position;
                ++m_line;
                m_at_line_start = true;
            } else if (std::isspace(static_cast<unsigned char>(m_text[m_position])) != 0) {
                ++m_position;
            } else {
                return;
            }
        }
    }

    std::string_view m_text;
    std::size_t m_position = 0;
    int m_line = 1;
    bool m_at_line_start = true;
};

class Scanner {
public:
    explicit Scanner(std::string_view text) : m_tokenizer(text) { advance(); }

    GlslNames scan() {
        while (!m_token.text.empty()) {
            if (m_token.text == "#" && m_token.begins_line) {
                scan_directive();
            } else {
                scan_code();
            }
        }
        return std::move(m_names);
    }

private:
    void advance() {
        m_token = m_tokenizer.next();
        if (m_token.is_identifier()) {
            m_names.identifiers.emplace(m_token.text);
        }
    }

    void forbid(std::string what, int line) {
        if (m_names.forbidden_line == 0) {
            m_names.forbidden = std::move(what);
            m_names.forbidden_line = line;
        }
    }

    void scan_directive() {
        advance();
        if (m_token.begins_line) {
            return; // A lone '#' does nothing.
        }
        const std::string keyword(m_token.text);
        if (keyword == "version" || keyword == "extension") {
            forbid("#" + keyword, m_token.line);
        } else if (keyword == "if" || keyword == "ifdef" || keyword == "ifndef") {
            m_depths.push_back(m_depth);
        } else if ((keyword == "else" || keyword == "elif") && !m_depths.empty()) {
            m_depth = m_depths.back(); // The branches are alternatives: each starts at the same depth.
        } else if (keyword == "endif" && !m_depths.empty()) {
            m_depths.pop_back();
        }
        bool is_first = true;
        while (!m_token.text.empty() && !m_token.begins_line) {
            advance();
            if (is_first && keyword == "define" && m_token.is_identifier() && !m_token.begins_line) {
                define(m_token, GlslDefinition::Kind::macro);
            }
            is_first = false;
        }
    }

    void define(const Token& token, GlslDefinition::Kind kind) {
        m_names.definitions.push_back({std::string(token.text), kind, token.line, {}, {}});
    }

    /** One token outside directives. `m_depth` counts open braces, brackets and parentheses alike. */
    void scan_code() {
        const Token token = m_token;
        if (token.text == "layout" && m_depth == 0) {
            forbid("layout", token.line);
        }
        advance();
        if (token.text == "{" || token.text == "(" || token.text == "[") {
            ++m_depth;
        } else if (token.text == "}" || token.text == ")" || token.text == "]") {
            --m_depth;
            if (m_depth == 0 && token.text == ")" && m_function_open) {
                end_parameter();
                m_function_open = false;
                m_names.definitions[m_function].kind =
                    m_token.text == "{" ? GlslDefinition::Kind::function : GlslDefinition::Kind::prototype;
            }
        } else if (m_depth == 1 && m_function_open) {
            scan_parameter(token);
        } else if (m_depth == 0 && (token.text == ";" || token.text == ",")) {
            m_in_initializer = false;
        } else if (m_depth == 0 && token.text == "=") {
            m_in_initializer = true;
        } else if (m_depth == 0 && token.is_identifier() && !m_in_initializer) {
            scan_outer_identifier(token);
        }
        m_previous = token.text;
        m_after_struct = token.text == "struct";
        // A comma at depth 0 leads to the next name of a declaration, as its type does to the first.
        m_after_identifier = token.is_identifier() || token.text == "]" || token.text == ",";
    }

    /** An identifier at depth 0 is defined here if it stands where a declarator's name stands. */
    void scan_outer_identifier(const Token& token) {
        const std::string_view following = m_token.text;
        if (m_after_struct) {
            define(token, GlslDefinition::Kind::type);
        } else if (m_after_identifier && following == "(") {
            m_function = m_names.definitions.size();
            m_function_open = true;
            define(token, GlslDefinition::Kind::prototype);
            m_names.definitions.back().type = m_previous;
        } else if (m_after_identifier && (following == "=" || following == "[" || following == ";" || following == ",")) {
            define(token, GlslDefinition::Kind::constant);
        }
    }

    /** A token within the parentheses of a function's parameters. */
    void scan_parameter(const Token& token) {
        if (token.text == ",") {
            end_parameter();
        } else if (token.text == "out" || token.text == "inout") {
            m_parameter = std::string(token.text) + " " + m_parameter;
        } else if (token.is_identifier() && token.text != "in" && token.text != "const" && token.text != "precise" &&
                   token.text != "highp" && token.text != "void" && !m_parameter_has_type) {
            m_parameter += token.text;
            m_parameter_has_type = true;
        }
    }

    void end_parameter() {
        if (m_parameter_has_type) {
            m_names.definitions[m_function].parameters.push_back(m_parameter);
        }
        m_parameter.clear();
        m_parameter_has_type = false;
    }

    Tokenizer m_tokenizer;
    Token m_token;
    GlslNames m_names;
    std::string_view m_previous;
    std::string m_parameter;
    bool m_parameter_has_type = false;
    int m_depth = 0;
    std::vector<int> m_depths; ///< at each open #if
    bool m_in_initializer = false;
    bool m_after_struct = false;
    bool m_after_identifier = false;
    bool m_function_open = false;
    std::size_t m_function = 0; ///< index of the definition whose parameters are being read
};

} // namespace

GlslNames scan_glsl(std::string_view text) { return Scanner(text).scan(); }

} // namespace elvis
