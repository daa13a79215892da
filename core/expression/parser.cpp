#include <core/base/nearest_word.hpp>
#include <core/expression/parser.hpp>
#include <core/expression/values.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numbers>
#include <string_view>

namespace elvis {

namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || (c & 0x80) != 0; }
bool is_in_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

/** Recursive descent; each function reads what its name says and leaves m_at behind it. */
class Parser {
public:
    Parser(const std::string& text, const ParserScope& scope, Graph& graph)
        : m_text(text), m_scope(scope), m_graph(graph), m_values(text, scope, graph) {}

    ParsedExpression parse() {
        if (peek() == '\0') {
            m_values.fail(m_at, "there is nothing to evaluate");
        }
        const Value value = choice();
        if (peek() != '\0') {
            m_values.fail(m_at, peek() == ')' || peek() == ']' ? std::string("'") + peek() + "' closes nothing"
                                                               : "expected an operator, found '" + word_at(m_at) + "'");
        }
        ParsedExpression result;
        result.value = m_values.number(value);
        result.plain_field = value.field;
        const bool is_scalar = value.field && m_scope.fields[*value.field].n_components == 1;
        result.plain_component = is_scalar ? 0 : value.component;
        return result;
    }

private:
    // ---- characters

    char peek() {
        while (m_at < m_text.size() && std::isspace(static_cast<unsigned char>(m_text[m_at])) != 0) {
            ++m_at;
        }
        // A null character in the text is no end of it.
        return m_at == m_text.size() ? '\0' : m_text[m_at] == '\0' ? '\1' : m_text[m_at];
    }
    bool take(std::string_view token) {
        peek();
        const bool is_there = m_text.compare(m_at, token.size(), token) == 0;
        m_at += is_there ? token.size() : 0;
        return is_there;
    }
    void expect(char token, std::size_t opened, const char* what) {
        if (!take(std::string_view(&token, 1))) {
            const std::string found = m_at == m_text.size() ? "the end" : std::string("'") + word_at(m_at) + "'";
            m_values.fail(m_at, std::string("expected '") + token + "' after " + what + " at column " +
                                    std::to_string(opened + 1) + ", found " + found);
        }
    }
    std::string word_at(std::size_t place) const {
        std::size_t end = place;
        while (end < m_text.size() && is_in_name(m_text[end])) {
            ++end;
        }
        return m_text.substr(place, std::max<std::size_t>(1, end - place));
    }
    std::string name() {
        const std::string word = word_at(m_at);
        m_at += word.size();
        return word;
    }

    /** Bounds the depth of recursion. */
    struct Level {
        explicit Level(Parser& parser) : of(parser) {
            if (++of.m_depth > 200) {
                of.m_values.fail(of.m_at, "is nested too deeply");
            }
        }
        ~Level() { --of.m_depth; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        Parser& of;
    };

    // ---- grammar, from the weakest operator to the strongest

    Value choice() {
        const Level level(*this);
        const Value condition = either();
        const std::size_t place = m_at;
        if (!take("?")) {
            return condition;
        }
        const Value yes = choice();
        expect(':', place, "the '?'");
        const Value no = choice();
        return m_values.choose(condition, yes, no);
    }

    Value either() {
        Value left = both();
        while (take("||")) {
            const Value right = both();
            left = m_values.truth_value(m_graph.select(m_values.truth(left), m_graph.constant(1), m_values.truth(right)),
                                        left.place);
        }
        return left;
    }
    Value both() {
        Value left = comparison();
        while (take("&&")) {
            const Value right = comparison();
            left = m_values.truth_value(m_graph.select(m_values.truth(left), m_values.truth(right), m_graph.constant(0)),
                                        left.place);
        }
        return left;
    }
    Value comparison() {
        const Value left = sum();
        peek();
        for (const char* const sign : {"<=", ">=", "==", "!=", "<", ">"}) {
            if (!take(sign)) {
                continue;
            }
            const Value right = sum();
            const NodeId a = m_values.number(left), b = m_values.number(right);
            const bool has_equal = sign[1] == '=';
            NodeId result = 0;
            if (sign[0] == '<' || sign[0] == '>') {
                const Operation operation = has_equal ? Operation::less_equal : Operation::less;
                result = sign[0] == '<' ? m_graph.binary(operation, a, b) : m_graph.binary(operation, b, a);
            } else {
                result = m_graph.binary(Operation::equal, a, b);
                result = sign[0] == '!' ? m_graph.select(result, m_graph.constant(0), m_graph.constant(1)) : result;
            }
            peek();
            if (m_at < m_text.size() && (m_text[m_at] == '<' || m_text[m_at] == '>')) {
                m_values.fail(m_at, "comparisons do not chain; join them with &&");
            }
            return m_values.truth_value(result, left.place);
        }
        return left;
    }
    Value sum() {
        Value left = product();
        while (true) {
            if (take("+")) {
                left = m_values.combine(Operation::add, left, product());
            } else if (take("-")) {
                left = m_values.combine(Operation::subtract, left, product());
            } else {
                return left;
            }
        }
    }
    Value product() {
        Value left = sign();
        while (true) {
            if (take("*")) {
                left = m_values.combine(Operation::multiply, left, sign());
            } else if (take("/")) {
                left = m_values.combine(Operation::divide, left, sign());
            } else {
                return left;
            }
        }
    }
    Value sign() {
        const Level level(*this);
        peek();
        const std::size_t place = m_at;
        if (take("-")) {
            Value result = m_values.each(sign(), [&](NodeId entry) { return m_graph.unary(Operation::negate, entry); });
            result.place = place;
            return result;
        }
        if (take("+")) {
            return sign();
        }
        if (m_text.compare(m_at, 2, "!=") != 0 && take("!")) {
            return m_values.truth_value(m_graph.binary(Operation::equal, m_values.number(sign()), m_graph.constant(0)), place);
        }
        return power();
    }
    Value power() {
        const Value base = indexed();
        if (take("^")) {
            // -x^2 = -(x^2), 2^-1 = 2^(-1), a^b^c = a^(b^c).
            const Value exponent = sign();
            return m_values.number_value(m_graph.power(m_values.number(base), m_values.number(exponent)), base.place);
        }
        return base;
    }
    Value indexed() {
        Value value = primary();
        while (peek() == '[') {
            const std::size_t place = m_at++;
            peek();
            std::uint32_t index = 0;
            const char* const first = m_text.data() + m_at;
            const auto [after, error] = std::from_chars(first, m_text.data() + m_text.size(), index);
            if (error != std::errc{}) {
                m_values.fail(m_at, "expected the number of a component, counted from 0");
            }
            m_at += static_cast<std::size_t>(after - first);
            expect(']', place, "the '['");
            value = m_values.component(value, index, place);
        }
        return value;
    }

    Value primary() {
        const char c = peek();
        const std::size_t place = m_at;
        if (c == '\0') {
            m_values.fail(place, "the text ends where a value is expected");
        }
        if (c == '(') {
            ++m_at;
            Value value = choice();
            expect(')', place, "the '('");
            value.place = place;
            return value;
        }
        if (c == '"' || c == '\'') {
            const std::size_t end = m_text.find(c, place + 1);
            if (end == std::string::npos) {
                m_values.fail(place, "this quotation does not end");
            }
            m_at = end + 1;
            return m_values.field(m_text.substr(place + 1, end - place - 1), place);
        }
        if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
            return literal();
        }
        if (c == '@') {
            ++m_at;
            if (!begins_name(peek())) {
                m_values.fail(place, "expected a name after '@'");
            }
            return m_values.built_in(name(), place);
        }
        if (!begins_name(c)) {
            m_values.fail(place, "expected a value, found '" + word_at(place) + "'");
        }
        std::string word = name();
        if (peek() == '(') {
            return call(word, place);
        }
        word += joined_name(word);
        const auto is_named = [&](const FieldInfo& info) { return info.name == word; };
        return std::any_of(m_scope.fields.begin(), m_scope.fields.end(), is_named) ? m_values.field(word, place)
                                                                                   : m_values.built_in(word, place);
    }

    /** `.FIELD` behind the name of a joined volume, if there is such a field; else nothing is read. */
    std::string joined_name(const std::string& word) {
        const std::size_t before = m_at;
        if (peek() == '.' && m_at + 1 < m_text.size() && begins_name(m_text[m_at + 1])) {
            ++m_at;
            const std::string joined = "." + name();
            if (std::ranges::any_of(m_scope.fields, [&](const FieldInfo& info) { return info.name == word + joined; })) {
                return joined;
            }
        }
        m_at = before;
        return {};
    }

    Value literal() {
        const std::size_t place = m_at;
        double value = 0;
        const char* const first = m_text.data() + m_at;
        const auto [after, error] = std::from_chars(first, m_text.data() + m_text.size(), value);
        if (error == std::errc::result_out_of_range) {
            m_values.fail(place, "this number is beyond double precision");
        }
        if (error != std::errc{}) {
            m_values.fail(place, "expected a number");
        }
        m_at += static_cast<std::size_t>(after - first);
        return m_values.number_value(m_graph.constant(value), place);
    }

    // ---- functions

    std::vector<Value> arguments(const std::string& word, std::size_t place, std::size_t least, std::size_t most) {
        std::vector<Value> values;
        ++m_at; // the parenthesis
        if (peek() != ')') {
            do {
                values.push_back(choice());
            } while (take(","));
        }
        expect(')', place, ("the arguments of '" + word + "'").c_str());
        if (values.size() < least || values.size() > most) {
            m_values.fail(place, std::string("'") + word + "' wants " + std::to_string(least) +
                                     (most == least ? ""
                                      : most > 99   ? " or more"
                                                    : " or " + std::to_string(most)) +
                                     (most == 1 ? " argument" : " arguments") + ", not " + std::to_string(values.size()));
        }
        return values;
    }

    Value call(const std::string& word, std::size_t place) {
        const Level level(*this);
        for (const UnaryFunction& function : unary_functions()) {
            if (word == function.name) {
                const NodeId of = m_values.number(arguments(word, place, 1, 1)[0]);
                return m_values.number_value(m_graph.unary(function.operation, of), place);
            }
        }
        if (word == "d") {
            return derivative(place);
        }
        if (word == "order" && !m_scope.is_implicit) {
            return order(place);
        }
        if (word == "log10") {
            const NodeId of = m_values.number(arguments(word, place, 1, 1)[0]);
            const NodeId log10_e = m_graph.constant(std::numbers::log10e);
            return m_values.number_value(m_graph.binary(Operation::multiply, log10_e, m_graph.unary(Operation::logarithm, of)),
                                         place);
        }
        if (word == "min" || word == "max") {
            const std::vector<Value> values = arguments(word, place, 2, 100);
            NodeId result = m_values.number(values[0]);
            for (std::size_t i = 1; i < values.size(); ++i) {
                result =
                    m_graph.binary(word == "min" ? Operation::minimum : Operation::maximum, result, m_values.number(values[i]));
            }
            return m_values.number_value(result, place);
        }
        if (word == "atan2" || word == "pow") {
            const std::vector<Value> values = arguments(word, place, 2, 2);
            const Operation operation = word == "pow" ? Operation::power : Operation::arctangent2;
            return m_values.number_value(m_graph.binary(operation, m_values.number(values[0]), m_values.number(values[1])),
                                         place);
        }
        if (word == "modulus" || word == "argument") {
            // Of a complex number, real part first.
            const std::vector<Value> parts = arguments(word, place, 2, 2);
            const NodeId real = m_values.number(parts[0]), imaginary = m_values.number(parts[1]);
            return m_values.number_value(word == "modulus" ? m_graph.length(real, imaginary, m_graph.constant(0))
                                                           : m_graph.binary(Operation::arctangent2, imaginary, real),
                                         place);
        }
        if (word == "norm") {
            const Value value = arguments(word, place, 1, 1)[0];
            return m_values.number_value(value.rank == 0 ? m_graph.unary(Operation::absolute, value.entries[0])
                                                         : m_values.magnitude(value.entries),
                                         place);
        }
        if (word == "dot" || word == "cross") {
            const std::vector<Value> values = arguments(word, place, 2, 2);
            return word == "dot" ? m_values.dot(values, place) : m_values.cross(values, place);
        }
        if (is_field_function(word) && word != "order") {
            return m_values.of_field(word, arguments(word, place, 1, 1)[0], place);
        }
        m_values.fail(place, std::string("'") + word + "' is no function; the nearest is '" +
                                 nearest_word(word, m_values.functions()) + "'");
    }

    /** d(expression, coordinate) */
    Value derivative(std::size_t place) {
        ++m_at;
        const Value value = choice();
        expect(',', place, "the first argument of 'd'");
        peek();
        const std::size_t at = m_at;
        const std::string axis = begins_name(peek()) ? name() : std::string();
        if (!is_coordinate(axis)) {
            m_values.fail(at, "expected x, y or z: what the derivative is by");
        }
        expect(')', place, "the arguments of 'd'");
        Value result = m_values.each(
            value, [&](NodeId entry) { return m_values.slope(entry, static_cast<std::uint8_t>(axis[0] - 'x'), place); });
        result.place = place;
        return result;
    }

    Value order(std::size_t place) {
        ++m_at;
        peek();
        const std::size_t at = m_at;
        const Value value = indexed();
        expect(')', place, "the argument of 'order'");
        if (!value.field) {
            m_values.fail(at, "'order' wants a field");
        }
        return m_values.number_value(m_graph.field_leaf(Operation::order, *value.field, 0), place);
    }

    const std::string& m_text;
    const ParserScope& m_scope;
    Graph& m_graph;
    ValueBuilder m_values;
    std::size_t m_at = 0;
    int m_depth = 0;
};

} // namespace

ParsedExpression parse_expression(const std::string& text, const ParserScope& scope, Graph& graph) {
    return Parser(text, scope, graph).parse();
}

} // namespace elvis
