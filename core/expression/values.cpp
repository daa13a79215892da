#include <core/base/error.hpp>
#include <core/base/nearest_word.hpp>
#include <core/expression/values.hpp>

#include <algorithm>
#include <numbers>

namespace elvis {

namespace {

std::string named(const Value& value) {
    return value.rank == 0   ? "a number"
           : value.rank == 1 ? "a vector of " + std::to_string(value.entries.size())
                             : "a matrix of " + std::to_string(value.entries.size() / 3) + " x 3";
}

constexpr UnaryFunction functions_of_numbers[] = {
    {"sqrt", Operation::square_root}, {"abs", Operation::absolute},    {"sin", Operation::sine},
    {"cos", Operation::cosine},       {"tan", Operation::tangent},     {"asin", Operation::arcsine},
    {"acos", Operation::arccosine},   {"atan", Operation::arctangent}, {"exp", Operation::exponential},
    {"log", Operation::logarithm},
};

const std::vector<std::string> field_functions{"d", "grad", "div", "curl", "vorticity", "laplacian", "q_criterion", "order"};
const std::vector<std::string> other_functions{"min",   "max", "atan2", "modulus", "argument",
                                               "log10", "pow", "norm",  "dot",     "cross"};
const std::vector<std::string> coordinates{"x", "y", "z"};
const std::vector<std::string> element_names{"jacobian", "scaled_jacobian", "order", "element"};

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

std::span<const UnaryFunction> unary_functions() { return functions_of_numbers; }
bool is_field_function(const std::string& word) { return contains(field_functions, word); }
bool is_coordinate(const std::string& word) { return contains(coordinates, word); }

void ValueBuilder::fail(std::size_t place, const std::string& cause) const {
    throw Error("expression '" + m_text + "', column " + std::to_string(place + 1), cause);
}

NodeId ValueBuilder::magnitude(const std::vector<NodeId>& entries) {
    const NodeId zero = m_graph.constant(0);
    NodeId result = entries.size() == 1   ? m_graph.unary(Operation::absolute, entries[0])
                    : entries.size() == 2 ? m_graph.length(entries[0], entries[1], zero)
                                          : m_graph.length(entries[0], entries[1], entries[2]);
    for (std::size_t i = 3; i < entries.size(); i += 2) {
        result = m_graph.length(result, entries[i], i + 1 < entries.size() ? entries[i + 1] : zero);
    }
    return result;
}

NodeId ValueBuilder::number(const Value& value) {
    if (value.rank == 2) {
        fail(value.place, "is " + named(value) + ", where a number is wanted; take its norm or an entry [i][j]");
    }
    return value.rank == 0 ? value.entries[0] : magnitude(value.entries);
}

const Value& ValueBuilder::vector(const Value& value, std::size_t least, std::size_t most, const char* of) const {
    if (value.rank != 1 || value.entries.size() < least || value.entries.size() > most) {
        fail(value.place, "is " + named(value) + ", where " + of + " wants a vector" +
                              (most > 3        ? ""
                               : least == most ? " of " + std::to_string(most)
                                               : " of " + std::to_string(least) + " or " + std::to_string(most)));
    }
    return value;
}

std::optional<Value> ValueBuilder::difference_field(const Value& a, const Value& b) {
    if (!a.field || !b.field || a.component != b.component) {
        return std::nullopt;
    }
    const std::string name = m_scope.fields[*a.field].name + " - " + m_scope.fields[*b.field].name;
    if (std::ranges::none_of(m_scope.fields, [&](const FieldInfo& info) { return info.name == name; })) {
        return std::nullopt;
    }
    const Value whole = field(name, a.place);
    return a.component < 0 ? whole : component(whole, static_cast<std::uint32_t>(a.component), a.place);
}

Value ValueBuilder::combine(Operation operation, const Value& a, const Value& b) {
    if (operation == Operation::subtract) {
        if (const std::optional<Value> known = difference_field(a, b)) {
            return *known;
        }
        if (const std::optional<Value> reverse = difference_field(b, a)) {
            return each(*reverse, [&](NodeId entry) { return m_graph.unary(Operation::negate, entry); });
        }
    }
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

Value ValueBuilder::choose(const Value& condition, const Value& yes, const Value& no) {
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

Value ValueBuilder::component(const Value& value, std::uint32_t index, std::size_t place) const {
    // A field of one component may be written with it.
    const bool is_whole_field = value.field && value.component < 0;
    const std::size_t n = value.rank == 2                     ? value.entries.size() / 3
                          : value.rank == 1 || is_whole_field ? value.entries.size()
                                                              : 0;
    if (n == 0) {
        fail(place, "a number has no components");
    }
    if (index >= n) {
        fail(place,
             "there is no component " + std::to_string(index) + "; components are counted from 0 to " + std::to_string(n - 1));
    }
    if (value.rank == 2) {
        const auto row = value.entries.begin() + 3 * static_cast<std::ptrdiff_t>(index);
        return vector_value({row, row + 3}, value.place);
    }
    Value result = number_value(value.entries[index], value.place);
    result.field = is_whole_field ? value.field : std::nullopt;
    result.component = static_cast<std::int32_t>(index);
    return result;
}

NodeId ValueBuilder::truth(const Value& value) {
    const NodeId zero = m_graph.constant(0), one = m_graph.constant(1);
    return value.is_truth ? value.entries[0] : m_graph.select(m_graph.binary(Operation::equal, number(value), zero), zero, one);
}

Value ValueBuilder::field(const std::string& word, std::size_t place) {
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

std::string ValueBuilder::field_list() const {
    std::string list;
    for (const FieldInfo& info : m_scope.fields) {
        list += (list.empty() ? "; the fields are '" : "', '") + info.name;
    }
    return list.empty() ? list : list + "'";
}

Value ValueBuilder::built_in(const std::string& word, std::size_t place) {
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

NodeId ValueBuilder::jacobian(const std::string& word, std::size_t place) {
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

std::vector<std::string> ValueBuilder::functions() {
    std::vector<std::string> names(other_functions);
    for (const UnaryFunction& function : functions_of_numbers) {
        names.emplace_back(function.name);
    }
    names.insert(names.end(), field_functions.begin(), field_functions.end());
    return names;
}

Value ValueBuilder::dot(const std::vector<Value>& values, std::size_t place) {
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

Value ValueBuilder::cross(const std::vector<Value>& values, std::size_t place) {
    const std::vector<NodeId>& a = vector(values[0], 3, 3, "cross").entries;
    const std::vector<NodeId>& b = vector(values[1], 3, 3, "cross").entries;
    const auto entry = [&](std::size_t i, std::size_t j) {
        return m_graph.binary(Operation::subtract, m_graph.binary(Operation::multiply, a[i], b[j]),
                              m_graph.binary(Operation::multiply, a[j], b[i]));
    };
    return vector_value({entry(1, 2), entry(2, 0), entry(0, 1)}, place);
}

NodeId ValueBuilder::slope(NodeId id, std::uint8_t axis, std::size_t place) {
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

Value ValueBuilder::of_field(const std::string& word, const Value& value, std::size_t place) {
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
        const auto n = static_cast<std::uint8_t>(value.entries.size());
        for (std::uint8_t i = 0; i < n; ++i) {
            for (std::uint8_t j = 0; j < n; ++j) {
                trace = plus(trace, m_graph.binary(Operation::multiply, by(i, j), by(j, i)));
            }
        }
        return number_value(m_graph.binary(Operation::multiply, m_graph.constant(-0.5), trace), place);
    }
    // curl, vorticity
    const auto third = [&](std::uint8_t axis) { return is_flat ? zero : by(2, axis); };
    return vector_value({minus(third(1), by(1, 2)), minus(by(0, 2), third(0)), minus(by(1, 0), by(0, 1))}, place);
}

} // namespace elvis
