/**
 * @file values.hpp
 * What the words and operators of an expression's text mean: nodes of its graph.
 */
#pragma once

#include <core/expression/graph.hpp>
#include <core/expression/parser.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace elvis {

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

/** Functions of a number. */
struct UnaryFunction {
    const char* name;
    Operation operation;
};
std::span<const UnaryFunction> unary_functions();
/** Whether it is a function of fields: d, grad, div and so on. */
bool is_field_function(const std::string& word);
bool is_coordinate(const std::string& word);

/** Makes values of values; `place` is where in the text the result stands, for messages. All are kept by reference. */
class ValueBuilder {
public:
    ValueBuilder(const std::string& text, const ParserScope& scope, Graph& graph)
        : m_text(text), m_scope(scope), m_graph(graph) {}

    /** Throws an Error that names text and column. */
    [[noreturn]] void fail(std::size_t place, const std::string& cause) const;

    static Value number_value(NodeId id, std::size_t place) { return {0, {id}, place, {}, -1, false}; }
    static Value vector_value(std::vector<NodeId> entries, std::size_t place) {
        return {1, std::move(entries), place, {}, -1, false};
    }
    static Value truth_value(NodeId id, std::size_t place) { return {0, {id}, place, {}, -1, true}; }
    /** Of the same rank, `function` applied to every entry. */
    static Value each(const Value& value, const auto& function) {
        Value result{value.rank, {}, value.place, {}, -1, false};
        for (const NodeId entry : value.entries) {
            result.entries.push_back(function(entry));
        }
        return result;
    }

    /** A vector alone means its magnitude. */
    NodeId number(const Value& value);
    NodeId magnitude(const std::vector<NodeId>& entries);
    /** 1 where a number is not 0, else 0. */
    NodeId truth(const Value& value);
    /** Sum, difference, product, quotient and others of two values. */
    Value combine(Operation operation, const Value& a, const Value& b);
    /** Of two fields or components, if the volume has the field "A - B": fields that are joined
     * (elvis/native/joined_volume.hpp). */
    std::optional<Value> difference_field(const Value& a, const Value& b);
    /** Entry by entry, where both have the same; else of their numbers. */
    Value choose(const Value& condition, const Value& yes, const Value& no);
    /** What an index, which stands at `place`, takes of a value. */
    Value component(const Value& value, std::uint32_t index, std::size_t place) const;

    Value field(const std::string& word, std::size_t place);
    /** Coordinates, what elements have, constants. */
    Value built_in(const std::string& word, std::size_t place);

    /** Names of all functions. */
    static std::vector<std::string> functions();
    Value dot(const std::vector<Value>& values, std::size_t place);
    Value cross(const std::vector<Value>& values, std::size_t place);
    /** World derivative by axis 0, 1 or 2. */
    NodeId slope(NodeId id, std::uint8_t axis, std::size_t place);
    /** grad, div, curl, vorticity, laplacian, q_criterion */
    Value of_field(const std::string& word, const Value& value, std::size_t place);

private:
    /** The value itself, if it is a vector of `least` to `most` entries. */
    const Value& vector(const Value& value, std::size_t least, std::size_t most, const char* of) const;
    NodeId jacobian(const std::string& word, std::size_t place);
    /** For messages. */
    std::string field_list() const;

    const std::string& m_text;
    const ParserScope& m_scope;
    Graph& m_graph;
};

} // namespace elvis
