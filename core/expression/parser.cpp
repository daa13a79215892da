#include <core/base/error.hpp>
#include <core/base/nearest_word.hpp>
#include <core/expression/parser.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numbers>
#include <string_view>

namespace elvis {

namespace {

/** A number (rank 0), a vector (1) or a matrix of rows of three (2); entries row by row. */
struct Value {
    int rank = 0;
    std::vector<NodeId> entries;
    /** Where it stands in the text. */
    std::size_t place = 0;
    /** Set for a field or its component, as it stands. */
    std::optional<std::uint32_t> field;
    std::int32_t component = -1;
    /** Surely 1 or 0. */
    bool is_truth = false;

    bool is_vector() const { return rank == 1; }
};

std::string named(const Value& value) {
    return value.rank == 0   ? "a number"
           : value.rank == 1 ? "a vector of " + std::to_string(value.entries.size())
                             : "a matrix of " + std::to_string(value.entries.size() / 3) + " x 3";
}

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || (c & 0x80) != 0; }
bool is_in_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0; }

struct Unary {
    const char* name;
    Operation operation;
};
constexpr Unary unary_functions[] = {
    {"sqrt", Operation::square_root}, {"abs", Operation::absolute},    {"sin", Operation::sine},
    {"cos", Operation::cosine},       {"tan", Operation::tangent},     {"asin", Operation::arcsine},
    {"acos", Operation::arccosine},   {"atan", Operation::arctangent}, {"exp", Operation::exponential},
    {"log", Operation::logarithm},
};

const std::vector<std::string> field_functions{"d", "grad", "div", "curl", "vorticity", "laplacian", "q_criterion", "order"};
const std::vector<std::string> other_functions{"min", "max", "atan2", "log10", "pow", "norm", "dot", "cross"};
const std::vector<std::string> coordinates{"x", "y", "z"};
const std::vector<std::string> element_names{"jacobian", "scaled_jacobian", "order", "element"};

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/** Recursive descent; each function reads what its name says and leaves m_at behind it. */
class Parser {
public:
    Parser(const std::string& text, const ParserScope& scope, Graph& graph) : m_text(text), m_scope(scope), m_graph(graph) {}

    ParsedExpression parse() {
        if (peek() == '\0') {
            fail(m_at, "there is nothing to evaluate");
        }
        const Value value = choice();
        if (peek() != '\0') {
            fail(m_at, peek() == ')' || peek() == ']' ? std::string("'") + peek() + "' closes nothing"
                                                      : "expected an operator, found '" + word_at(m_at) + "'");
        }
        ParsedExpression result;
        result.value = number(value);
        result.plain_field = value.field;
        const bool is_scalar = value.field && m_scope.fields[*value.field].n_components == 1;
        result.plain_component = is_scalar ? 0 : value.component;
        return result;
    }

private:
    [[noreturn]] void fail(std::size_t place, const std::string& cause) const {
        throw Error("expression '" + m_text + "', column " + std::to_string(place + 1), cause);
    }

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
            const std::string found = m_at == m_text.size() ? "the end" : "'" + word_at(m_at) + "'";
            fail(m_at, std::string("expected '") + token + "' after " + what + " at column " + std::to_string(opened + 1) +
                           ", found " + found);
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
                of.fail(of.m_at, "is nested too deeply");
            }
        }
        ~Level() { --of.m_depth; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;
        Parser& of;
    };

    // ---- values

    Value number_value(NodeId id, std::size_t place) const { return {0, {id}, place, {}, -1, false}; }
    Value vector_value(std::vector<NodeId> entries, std::size_t place) const {
        return {1, std::move(entries), place, {}, -1, false};
    }

    NodeId magnitude(const std::vector<NodeId>& entries) {
        const NodeId zero = m_graph.constant(0);
        NodeId result = entries.size() == 1   ? m_graph.unary(Operation::absolute, entries[0])
                        : entries.size() == 2 ? m_graph.length(entries[0], entries[1], zero)
                                              : m_graph.length(entries[0], entries[1], entries[2]);
        for (std::size_t i = 3; i < entries.size(); i += 2) {
            result = m_graph.length(result, entries[i], i + 1 < entries.size() ? entries[i + 1] : zero);
        }
        return result;
    }

    /** A vector alone means its magnitude. */
    NodeId number(const Value& value) {
        if (value.rank == 2) {
            fail(value.place, "is " + named(value) + ", where a number is wanted; take its norm or an entry [i][j]");
        }
        return value.rank == 0 ? value.entries[0] : magnitude(value.entries);
    }
    const Value& vector(const Value& value, std::size_t least, std::size_t most, const char* of) const {
        if (value.rank != 1 || value.entries.size() < least || value.entries.size() > most) {
            fail(value.place, "is " + named(value) + ", where " + of + " wants a vector" +
                                  (most > 3        ? ""
                                   : least == most ? " of " + std::to_string(most)
                                                   : " of " + std::to_string(least) + " or " + std::to_string(most)));
        }
        return value;
    }

    Value each(const Value& value, const auto& function) const {
        Value result{value.rank, {}, value.place, {}, -1, false};
        for (const NodeId entry : value.entries) {
            result.entries.push_back(function(entry));
        }
        return result;
    }

    Value combine(Operation operation, const Value& a, const Value& b) {
        const bool is_sum = operation == Operation::add || operation == Operation::subtract;
        if (is_sum && a.rank == b.rank && a.rank > 0) {
            if (a.entries.size() != b.entries.size()) {
                fail(b.place, "is " + named(b) + ", which cannot be combined with " + named(a));
            }
            Value result{a.rank, {}, a.place, {}, -1, false};
            for (std::size_t i = 0; i < a.entries.size(); ++i) {
                result.entries.push_back(m_graph.binary(operation, a.entries[i], b.entries[i]));
            }
            return result;
        }
        if (operation == Operation::multiply && (a.rank == 0) != (b.rank == 0)) {
            const Value& many = a.rank == 0 ? b : a;
            const NodeId one = a.rank == 0 ? a.entries[0] : b.entries[0];
            Value result = each(many, [&](NodeId entry) { return m_graph.binary(Operation::multiply, one, entry); });
            result.place = a.place;
            return result;
        }
        if (operation == Operation::divide && a.rank > 0 && b.rank == 0) {
            return each(a, [&](NodeId entry) { return m_graph.binary(Operation::divide, entry, b.entries[0]); });
        }
        return number_value(m_graph.binary(operation, number(a), number(b)), a.place);
    }

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
        const NodeId decides = truth(condition);
        if (yes.rank > 0 && yes.rank == no.rank && yes.entries.size() == no.entries.size()) {
            Value result{yes.rank, {}, condition.place, {}, -1, false};
            for (std::size_t i = 0; i < yes.entries.size(); ++i) {
                result.entries.push_back(m_graph.select(decides, yes.entries[i], no.entries[i]));
            }
            return result;
        }
        return number_value(m_graph.select(decides, number(yes), number(no)), condition.place);
    }

    /** 1 where a number is not 0, else 0. */
    NodeId truth(const Value& value) {
        const NodeId zero = m_graph.constant(0), one = m_graph.constant(1);
        return value.is_truth ? value.entries[0]
                              : m_graph.select(m_graph.binary(Operation::equal, number(value), zero), zero, one);
    }
    Value truth_value(NodeId id, std::size_t place) const { return {0, {id}, place, {}, -1, true}; }

    Value either() {
        Value left = both();
        while (take("||")) {
            const Value right = both();
            left = truth_value(m_graph.select(truth(left), m_graph.constant(1), truth(right)), left.place);
        }
        return left;
    }
    Value both() {
        Value left = comparison();
        while (take("&&")) {
            const Value right = comparison();
            left = truth_value(m_graph.select(truth(left), truth(right), m_graph.constant(0)), left.place);
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
            const NodeId a = number(left), b = number(right);
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
                fail(m_at, "comparisons do not chain; join them with &&");
            }
            return truth_value(result, left.place);
        }
        return left;
    }
    Value sum() {
        Value left = product();
        while (true) {
            if (take("+")) {
                left = combine(Operation::add, left, product());
            } else if (take("-")) {
                left = combine(Operation::subtract, left, product());
            } else {
                return left;
            }
        }
    }
    Value product() {
        Value left = sign();
        while (true) {
            if (take("*")) {
                left = combine(Operation::multiply, left, sign());
            } else if (take("/")) {
                left = combine(Operation::divide, left, sign());
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
            Value result = each(sign(), [&](NodeId entry) { return m_graph.unary(Operation::negate, entry); });
            result.place = place;
            return result;
        }
        if (take("+")) {
            return sign();
        }
        if (m_text.compare(m_at, 2, "!=") != 0 && take("!")) {
            return truth_value(m_graph.binary(Operation::equal, number(sign()), m_graph.constant(0)), place);
        }
        return power();
    }
    Value power() {
        const Value base = indexed();
        if (take("^")) {
            // -x^2 = -(x^2), 2^-1 = 2^(-1), a^b^c = a^(b^c).
            const Value exponent = sign();
            return number_value(m_graph.power(number(base), number(exponent)), base.place);
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
                fail(m_at, "expected the number of a component, counted from 0");
            }
            m_at += static_cast<std::size_t>(after - first);
            expect(']', place, "the '['");
            // A field of one component may be written with it.
            const bool has_components = value.rank == 1 || (value.field && value.component < 0);
            const std::size_t n = value.rank == 2 ? value.entries.size() / 3 : has_components ? value.entries.size() : 0;
            if (n == 0) {
                fail(place, "a number has no components");
            }
            if (index >= n) {
                fail(place, "there is no component " + std::to_string(index) + "; components are counted from 0 to " +
                                std::to_string(n - 1));
            }
            if (value.rank == 2) {
                const auto row = value.entries.begin() + 3 * static_cast<std::ptrdiff_t>(index);
                value = vector_value({row, row + 3}, value.place);
            } else {
                const bool is_whole_field = value.field && value.component < 0;
                const std::optional<std::uint32_t> field = is_whole_field ? value.field : std::nullopt;
                value = number_value(value.entries[index], value.place);
                value.field = field;
                value.component = static_cast<std::int32_t>(index);
            }
        }
        return value;
    }

    Value primary() {
        const char c = peek();
        const std::size_t place = m_at;
        if (c == '\0') {
            fail(place, "the text ends where a value is expected");
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
                fail(place, "this quotation does not end");
            }
            m_at = end + 1;
            return field(m_text.substr(place + 1, end - place - 1), place);
        }
        if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') {
            return literal();
        }
        if (c == '@') {
            ++m_at;
            if (!begins_name(peek())) {
                fail(place, "expected a name after '@'");
            }
            return built_in(name(), place);
        }
        if (!begins_name(c)) {
            fail(place, "expected a value, found '" + word_at(place) + "'");
        }
        const std::string word = name();
        if (peek() == '(') {
            return call(word, place);
        }
        const auto is_named = [&](const FieldInfo& info) { return info.name == word; };
        return std::any_of(m_scope.fields.begin(), m_scope.fields.end(), is_named) ? field(word, place) : built_in(word, place);
    }

    Value literal() {
        const std::size_t place = m_at;
        double value = 0;
        const char* const first = m_text.data() + m_at;
        const auto [after, error] = std::from_chars(first, m_text.data() + m_text.size(), value);
        if (error == std::errc::result_out_of_range) {
            fail(place, "this number is beyond double precision");
        }
        if (error != std::errc{}) {
            fail(place, "expected a number");
        }
        m_at += static_cast<std::size_t>(after - first);
        return number_value(m_graph.constant(value), place);
    }

    Value field(const std::string& word, std::size_t place) {
        for (std::uint32_t index = 0; index < m_scope.fields.size(); ++index) {
            if (m_scope.fields[index].name != word) {
                continue;
            }
            Value value{0, {}, place, index, -1, false};
            for (std::uint32_t component = 0; component < m_scope.fields[index].n_components; ++component) {
                value.entries.push_back(m_graph.field_leaf(Operation::field, index, component));
            }
            value.rank = value.entries.size() == 1 ? 0 : 1;
            return value;
        }
        fail(place, "there is no field '" + word + "'" + field_list());
    }

    /** For messages. */
    std::string field_list() const {
        std::string list;
        for (const FieldInfo& info : m_scope.fields) {
            list += (list.empty() ? "; the fields are '" : "', '") + info.name;
        }
        return list.empty() ? list : list + "'";
    }

    Value built_in(const std::string& word, std::size_t place) {
        if (word == "pi") {
            return number_value(m_graph.constant(std::numbers::pi), place);
        }
        if (contains(coordinates, word)) {
            return number_value(m_graph.leaf(Operation::position, static_cast<std::uint8_t>(word[0] - 'x')), place);
        }
        if (contains(element_names, word) && !m_scope.is_implicit) {
            if (word == "order") {
                return number_value(m_graph.field_leaf(Operation::order, any_field, 0), place);
            }
            return number_value(word == "element" ? m_graph.leaf(Operation::element) : jacobian(word, place), place);
        }
        std::vector<std::string> known;
        for (const FieldInfo& info : m_scope.fields) {
            known.push_back(info.name);
        }
        known.insert(known.end(), coordinates.begin(), coordinates.end());
        known.emplace_back("pi");
        if (!m_scope.is_implicit) {
            known.insert(known.end(), element_names.begin(), element_names.end());
        }
        const bool is_function = contains(functions(), word);
        if (is_function) {
            fail(place, "'" + word + "' is a function: it wants its arguments in parentheses");
        }
        fail(place, "'" + word + "' is unknown; the nearest name is '" + nearest_word(word, known) + "'" + field_list());
    }

    NodeId jacobian(const std::string& word, std::size_t place) {
        if (m_scope.dimension != 3) {
            fail(place, "'" + word + "' is for volumes; this one is two-dimensional");
        }
        const auto j = [&](std::uint8_t row, std::uint8_t column) { return m_graph.leaf(Operation::jacobian, row, column); };
        const auto times = [&](NodeId a, NodeId b) { return m_graph.binary(Operation::multiply, a, b); };
        const auto minor = [&](std::uint8_t row0, std::uint8_t row1) {
            return m_graph.binary(Operation::subtract, times(j(row0, 1), j(row1, 2)), times(j(row1, 1), j(row0, 2)));
        };
        NodeId result = times(j(0, 0), minor(1, 2));
        result = m_graph.binary(Operation::add, result, times(j(1, 0), minor(2, 0)));
        result = m_graph.binary(Operation::add, result, times(j(2, 0), minor(0, 1)));
        for (std::uint8_t column = 0; column < 3 && word == "scaled_jacobian"; ++column) {
            result = m_graph.binary(Operation::divide, result, m_graph.length(j(0, column), j(1, column), j(2, column)));
        }
        return result;
    }

    // ---- functions

    std::vector<std::string> functions() const {
        std::vector<std::string> names(other_functions);
        for (const Unary& function : unary_functions) {
            names.emplace_back(function.name);
        }
        names.insert(names.end(), field_functions.begin(), field_functions.end());
        return names;
    }

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
            fail(place, "'" + word + "' wants " + std::to_string(least) +
                            (most == least ? ""
                             : most > 99   ? " or more"
                                           : " or " + std::to_string(most)) +
                            (most == 1 ? " argument" : " arguments") + ", not " + std::to_string(values.size()));
        }
        return values;
    }

    Value call(const std::string& word, std::size_t place) {
        const Level level(*this);
        for (const Unary& function : unary_functions) {
            if (word == function.name) {
                const NodeId of = number(arguments(word, place, 1, 1)[0]);
                return number_value(m_graph.unary(function.operation, of), place);
            }
        }
        if (word == "d") {
            return derivative(place);
        }
        if (word == "order" && !m_scope.is_implicit) {
            return order(place);
        }
        if (word == "log10") {
            const NodeId of = number(arguments(word, place, 1, 1)[0]);
            const NodeId log10_e = m_graph.constant(std::numbers::log10e);
            return number_value(m_graph.binary(Operation::multiply, log10_e, m_graph.unary(Operation::logarithm, of)), place);
        }
        if (word == "min" || word == "max") {
            const std::vector<Value> values = arguments(word, place, 2, 100);
            NodeId result = number(values[0]);
            for (std::size_t i = 1; i < values.size(); ++i) {
                result = m_graph.binary(word == "min" ? Operation::minimum : Operation::maximum, result, number(values[i]));
            }
            return number_value(result, place);
        }
        if (word == "atan2" || word == "pow") {
            const std::vector<Value> values = arguments(word, place, 2, 2);
            const Operation operation = word == "pow" ? Operation::power : Operation::arctangent2;
            return number_value(m_graph.binary(operation, number(values[0]), number(values[1])), place);
        }
        if (word == "norm") {
            const Value value = arguments(word, place, 1, 1)[0];
            return number_value(
                value.rank == 0 ? m_graph.unary(Operation::absolute, value.entries[0]) : magnitude(value.entries), place);
        }
        if (word == "dot" || word == "cross") {
            const std::vector<Value> values = arguments(word, place, 2, 2);
            return word == "dot" ? dot(values, place) : cross(values, place);
        }
        if (contains(field_functions, word) && word != "order") {
            return of_field(word, arguments(word, place, 1, 1)[0], place);
        }
        fail(place, "'" + word + "' is no function; the nearest is '" + nearest_word(word, functions()) + "'");
    }

    Value dot(const std::vector<Value>& values, std::size_t place) {
        vector(values[0], 2, 1000, "dot");
        vector(values[1], 2, 1000, "dot");
        if (values[0].entries.size() != values[1].entries.size()) {
            fail(values[1].place, "is " + named(values[1]) + ", which has no product with " + named(values[0]));
        }
        NodeId sum = m_graph.constant(0);
        for (std::size_t i = 0; i < values[0].entries.size(); ++i) {
            sum = m_graph.binary(Operation::add, sum,
                                 m_graph.binary(Operation::multiply, values[0].entries[i], values[1].entries[i]));
        }
        return number_value(sum, place);
    }

    Value cross(const std::vector<Value>& values, std::size_t place) {
        const std::vector<NodeId>& a = vector(values[0], 3, 3, "cross").entries;
        const std::vector<NodeId>& b = vector(values[1], 3, 3, "cross").entries;
        const auto entry = [&](std::size_t i, std::size_t j) {
            return m_graph.binary(Operation::subtract, m_graph.binary(Operation::multiply, a[i], b[j]),
                                  m_graph.binary(Operation::multiply, a[j], b[i]));
        };
        return vector_value({entry(1, 2), entry(2, 0), entry(0, 1)}, place);
    }

    /** d(expression, coordinate) */
    Value derivative(std::size_t place) {
        ++m_at;
        const Value value = choice();
        expect(',', place, "the first argument of 'd'");
        peek();
        const std::size_t at = m_at;
        const std::string axis = begins_name(peek()) ? name() : std::string();
        if (!contains(coordinates, axis)) {
            fail(at, "expected x, y or z: what the derivative is by");
        }
        expect(')', place, "the arguments of 'd'");
        Value result = each(value, [&](NodeId entry) { return slope(entry, static_cast<std::uint8_t>(axis[0] - 'x'), place); });
        result.place = place;
        return result;
    }

    NodeId slope(NodeId id, std::uint8_t axis, std::size_t place) {
        const std::optional<NodeId> result = m_graph.world_derivative(id, axis);
        if (!result) {
            fail(place, "this takes third derivatives, which elements do not give");
        }
        if (m_scope.dimension < 3) {
            for (const NodeId needed : m_graph.needed({*result})) {
                const Operation operation = m_graph.node(needed).operation;
                if (operation == Operation::hessian || operation == Operation::mapping_hessian) {
                    fail(place, "this takes second derivatives, which are for volumes");
                }
            }
        }
        return *result;
    }

    Value order(std::size_t place) {
        ++m_at;
        peek();
        const std::size_t at = m_at;
        const Value value = indexed();
        expect(')', place, "the argument of 'order'");
        if (!value.field) {
            fail(at, "'order' wants a field");
        }
        return number_value(m_graph.field_leaf(Operation::order, *value.field, 0), place);
    }

    /** grad, div, curl, vorticity, laplacian, q_criterion */
    Value of_field(const std::string& word, const Value& value, std::size_t place) {
        const auto by = [&](std::size_t entry, std::uint8_t axis) { return slope(value.entries[entry], axis, place); };
        const auto minus = [&](NodeId a, NodeId b) { return m_graph.binary(Operation::subtract, a, b); };
        const auto plus = [&](NodeId a, NodeId b) { return m_graph.binary(Operation::add, a, b); };
        if (word == "grad" || word == "laplacian") {
            if (value.rank == 2 || (word == "laplacian" && value.rank == 1)) {
                fail(value.place, "is " + named(value) + ", of which there is no " + word);
            }
            Value gradient{value.rank + 1, {}, place, {}, -1, false};
            for (std::size_t entry = 0; entry < value.entries.size(); ++entry) {
                for (std::uint8_t axis = 0; axis < 3; ++axis) {
                    gradient.entries.push_back(by(entry, axis));
                }
            }
            return word == "grad" ? gradient : of_field("div", gradient, place);
        }
        vector(value, 2, 3, word.c_str());
        const bool is_flat = value.entries.size() == 2;
        const NodeId zero = m_graph.constant(0);
        if (word == "div") {
            const NodeId flat = plus(by(0, 0), by(1, 1));
            return number_value(is_flat ? flat : plus(flat, by(2, 2)), place);
        }
        if (word == "q_criterion") {
            // |W|^2 - |S|^2 = -trace(A^2) with A = grad(v).
            NodeId trace = zero;
            for (std::uint8_t i = 0; i < value.entries.size(); ++i) {
                for (std::uint8_t j = 0; j < value.entries.size(); ++j) {
                    trace = plus(trace, m_graph.binary(Operation::multiply, by(i, j), by(j, i)));
                }
            }
            return number_value(m_graph.binary(Operation::multiply, m_graph.constant(-0.5), trace), place);
        }
        // curl, vorticity
        const auto third = [&](std::uint8_t axis) { return is_flat ? zero : by(2, axis); };
        return vector_value({minus(third(1), by(1, 2)), minus(by(0, 2), third(0)), minus(by(1, 0), by(0, 1))}, place);
    }

    const std::string& m_text;
    const ParserScope& m_scope;
    Graph& m_graph;
    std::size_t m_at = 0;
    int m_depth = 0;
};

} // namespace

ParsedExpression parse_expression(const std::string& text, const ParserScope& scope, Graph& graph) {
    return Parser(text, scope, graph).parse();
}

} // namespace elvis
