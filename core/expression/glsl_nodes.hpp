/**
 * @file glsl_nodes.hpp
 * The nodes of an expression's graph as variables of GLSL.
 */
#pragma once

#include <core/expression/glsl_operations.hpp>
#include <core/expression/glsl_text.hpp>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace elvis::expression_glsl {

/**
 * Writes the nodes of a graph as numbers, models or intervals, one variable each.
 *
 * Fields may lack an offset on the device, so that small variations of large values keep their digits. It stays out of sums,
 * differences and multiples, and so do constants that are added: p - 101325 is what the device holds of p, plus what is left of
 * both constants in double precision. Where an operation needs the whole of an operand, the constant is put in.
 */
class NodeWriter {
public:
    struct Dialect {
        std::string type, prefix;
        std::function<std::string(const Node&)> leaf;
        std::function<std::string(const Node&, const Operands&)> operation;
        /** A variable plus a constant. */
        std::function<std::string(const std::string&, double)> shifted;
        /** What a leaf lacks. */
        std::function<double(const Node&)> offset;
    };

    NodeWriter(const Graph& graph, const std::vector<NodeId>& needed, Dialect dialect);

    const std::string& text() const { return m_text; }

    /** Name of a variable with the whole value of a node. */
    std::string whole(NodeId id);

private:
    std::string base(NodeId id) const { return m_dialect.prefix + name(id); }
    void declare(const std::string& variable, const std::string& value);
    const Node& node(NodeId id) const { return m_graph.node(id); }
    bool is_constant(NodeId id) const { return node(id).operation == Operation::constant; }

    void write(NodeId id);

    const Graph& m_graph;
    Dialect m_dialect;
    std::string m_text;
    /** By node: what its variable lacks. Long, because large constants may cancel. */
    std::map<NodeId, long double> m_lacking;
    std::set<NodeId> m_shifted;
};

/** Numbers of the precision in use. */
NodeWriter::Dialect real_dialect(const std::function<std::string(const Node&)>& leaf,
                                 const std::function<double(const Node&)>& offset);

/** What functions with numbers include. */
inline constexpr const char* real_includes = "#include \"field/expression.glsl\"\n";

/** The nodes of the value and its three derivatives. */
std::vector<NodeId> roots_with_gradient(const Expression& expression);
/** Nodes and results of a function that gives value and gradient. */
std::string gradient_body(const Expression& expression, const NodeWriter::Dialect& dialect);
/** Nodes and result of a function that gives the value. */
std::string value_body(const Expression& expression, const NodeWriter::Dialect& dialect);

} // namespace elvis::expression_glsl
