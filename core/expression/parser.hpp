/**
 * @file parser.hpp
 * From the text of an expression to its graph. See core/expression/expression.hpp for the language.
 */
#pragma once

#include <core/expression/graph.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <optional>
#include <span>
#include <string>

namespace elvis {

/** What names may stand for. */
struct ParserScope {
    std::span<const FieldInfo> fields;
    std::uint32_t dimension = 3;
    /** There is no element: x, y and z alone. */
    bool is_implicit = false;
};

struct ParsedExpression {
    NodeId value = 0;
    /** Set if the text is a field, or a component of one (-1: all of a vector), and nothing else. */
    std::optional<std::uint32_t> plain_field;
    std::int32_t plain_component = 0;
};

/** Throws an Error that names text, column and cause. */
ParsedExpression parse_expression(const std::string& text, const ParserScope& scope, Graph& graph);

} // namespace elvis
