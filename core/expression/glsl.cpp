#include <core/expression/glsl.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace elvis {

namespace {

/** A number as GLSL writes it in the precision in use. */
std::string literal(double number) {
    if (!std::isfinite(number)) {
        return std::isnan(number) ? "core_nan()" : number > 0 ? "core_infinity()" : "(-core_infinity())";
    }
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    std::string text(digits, end);
    if (text.find_first_of(".e") == std::string::npos) {
        text += ".0";
    }
    return "elvis_real(" + text + "LF)";
}

std::string name(NodeId id) { return "core_n" + std::to_string(id); }

std::string call(const std::string& function, std::initializer_list<std::string> arguments) {
    std::string text = function + "(";
    for (const std::string& argument : arguments) {
        text += (text.back() == '(' ? "" : ", ") + argument;
    }
    return text + ")";
}

/** What an element gives, read once for one function. */
class LeafWriter {
public:
    LeafWriter(const Expression& expression, const ExpressionClass& element_class, const std::vector<NodeId>& needed)
        : m_expression(expression), m_class(element_class) {
        for (const NodeId id : needed) {
            note(expression.graph().node(id));
        }
    }

    /** Declarations of all that the leaves stand on. */
    std::string declarations() const {
        std::string text;
        const bool has_inverse = m_needs_inverse;
        if (m_geometry == 1) {
            text += "    elvis_vec3 core_x = elvis_mapping(element, xi);\n";
        } else if (m_geometry >= 2) {
            text += "    elvis_vec3 core_x;\n    elvis_mat3 core_j;\n";
        }
        if (m_geometry == 2) {
            text += "    elvis_mapping_jacobian(element, xi, core_x, core_j);\n";
        } else if (m_geometry == 3) {
            text += "    elvis_mat3 core_m0, core_m1, core_m2;\n"
                    "    elvis_mapping_hessian(element, xi, core_x, core_j, core_m0, core_m1, core_m2);\n";
        }
        if (m_needs_position) {
            text += "    core_x += elvis_origin(element);\n";
        }
        if (has_inverse && m_class.dimension == 2) {
            // Completed by a normal of about the length of the other columns: gradients are then tangential.
            text += "    core_j[2] = cross(core_j[0], core_j[1]);\n    core_j[2] /= sqrt(length(core_j[2]));\n";
        }
        if (has_inverse) {
            text += "    const elvis_mat3 core_k = inverse(core_j);\n";
        }
        for (const auto& [key, level] : m_fields) {
            text += field(key.first, key.second, level);
        }
        return text;
    }

    std::string leaf(const Node& node) const {
        const auto [i, j, k] = node.index;
        const auto entry = [](const std::string& matrix, int row, int column) {
            return matrix + "[" + std::to_string(column) + "][" + std::to_string(row) + "]";
        };
        const std::string of_field = is_of_field(node.operation) ? field_suffix(slot(node.field), node.component) : "";
        switch (node.operation) {
        case Operation::constant:
            return literal(node.number);
        case Operation::position:
            return "core_x[" + std::to_string(i) + "]";
        case Operation::field:
            return "core_f" + of_field;
        case Operation::slope:
            return "core_s" + of_field + "[" + std::to_string(i) + "]";
        case Operation::gradient:
            return "core_g" + of_field + "[" + std::to_string(i) + "]";
        case Operation::bend:
            return entry("core_c" + of_field, i, j);
        case Operation::hessian:
            return entry("core_w" + of_field, i, j);
        case Operation::jacobian:
            return entry("core_j", i, j);
        case Operation::inverse_jacobian:
            return entry("core_k", i, j);
        case Operation::mapping_hessian:
            return entry("core_m" + std::to_string(i), j, k);
        case Operation::order:
            return literal(order(node.field));
        case Operation::element:
            return "elvis_real(elvis_fetch_core_elements(element, 0u))";
        default:
            assert(false && "not a leaf");
            return {};
        }
    }

    /** What the device's value of a field lacks. */
    double offset(const Node& node) const {
        return node.operation == Operation::field && !m_class.offsets.empty()
                   ? m_class.offsets[slot(node.field)][node.component]
                   : 0.0;
    }

    static bool is_of_field(Operation operation) {
        return operation == Operation::field || operation == Operation::slope || operation == Operation::gradient ||
               operation == Operation::bend || operation == Operation::hessian;
    }
    std::size_t slot(std::uint32_t field) const {
        const auto& fields = m_expression.fields();
        return static_cast<std::size_t>(std::find(fields.begin(), fields.end(), field) - fields.begin());
    }
    static std::string field_suffix(std::size_t slot, std::uint32_t component) {
        return std::to_string(slot) + "_" + std::to_string(component);
    }
    static std::string instance_suffix(std::size_t slot) {
        return slot == 0 ? std::string() : std::string("_").append(std::to_string(slot));
    }

    /** Values alone, values with gradients in xi whatever the leaves say. */
    void raise_fields(int level) {
        for (auto& [key, of_field] : m_fields) {
            of_field = std::max(of_field, level);
        }
    }
    void raise_geometry(int level) { m_geometry = std::max(m_geometry, level); }
    bool needs_position() const { return m_needs_position; }

private:
    /** Levels of a field: 0 value, 1 gradient in xi, 2 world gradient, 3 bend, 4 world hessian; of geometry: 1 position, 2
     * Jacobian, 3 second derivatives. */
    void note(const Node& node) {
        const auto at_least = [this, &node](int level) {
            const auto [found, is_new] = m_fields.try_emplace({slot(node.field), node.component}, level);
            found->second = std::max(found->second, level);
            m_needs_inverse = m_needs_inverse || level >= 2;
            raise_geometry(level >= 3 ? 3 : level >= 2 ? 2 : 0);
        };
        switch (node.operation) {
        case Operation::field:
            return at_least(0);
        case Operation::slope:
            return at_least(1);
        case Operation::gradient:
            return at_least(2);
        case Operation::bend:
            return at_least(3);
        case Operation::hessian:
            return at_least(4);
        case Operation::position:
            m_needs_position = true;
            return raise_geometry(1);
        case Operation::jacobian:
            return raise_geometry(2);
        case Operation::inverse_jacobian:
            m_needs_inverse = true;
            return raise_geometry(2);
        case Operation::mapping_hessian:
            return raise_geometry(3);
        default:
            return;
        }
    }

    std::string field(std::size_t slot, std::uint32_t component, int level) const {
        const std::string at = field_suffix(slot, component), instance = instance_suffix(slot);
        const std::string number = std::to_string(component) + "u";
        if (level == 0) {
            return "    const elvis_real core_f" + at + " = elvis_field_value" + instance + "(element, xi, " + number + ");\n";
        }
        std::string text = "    elvis_real core_f" + at + ";\n    elvis_vec3 core_s" + at + ";\n";
        if (level < 3) {
            text +=
                "    elvis_field_gradient" + instance + "(element, xi, " + number + ", core_f" + at + ", core_s" + at + ");\n";
        } else {
            text += "    elvis_mat3 core_h" + at + ";\n    elvis_field_hessian" + instance + "(element, xi, " + number +
                    ", core_f" + at + ", core_s" + at + ", core_h" + at + ");\n";
        }
        if (level >= 2) {
            // Row times matrix: G_i = sum_j s_j K_ji.
            text += "    const elvis_vec3 core_g" + at + " = core_s" + at + " * core_k;\n";
        }
        if (level >= 3) {
            text += "    const elvis_mat3 core_c" + at + " = core_h" + at + " - core_g" + at + ".x * core_m0 - core_g" + at +
                    ".y * core_m1 - core_g" + at + ".z * core_m2;\n";
        }
        if (level >= 4) {
            text += "    const elvis_mat3 core_w" + at + " = transpose(core_k) * core_c" + at + " * core_k;\n";
        }
        return text;
    }

    double order(std::uint32_t field) const {
        if (field != any_field) {
            return m_class.orders[field];
        }
        return m_class.orders.empty() ? 0 : *std::max_element(m_class.orders.begin(), m_class.orders.end());
    }

    const Expression& m_expression;
    const ExpressionClass& m_class;
    /** By slot and component. */
    std::map<std::pair<std::size_t, std::uint32_t>, int> m_fields;
    int m_geometry = 0;
    bool m_needs_position = false;
    bool m_needs_inverse = false;
};

/** Names of the operands of a node. */
using Operands = std::array<std::string, 3>;

std::string real_operation(const Node& node, const Operands& operands) {
    const auto& [a, b, c] = operands;
    const auto truth = [](const std::string& condition) { return condition + " ? elvis_real(1) : elvis_real(0)"; };
    switch (node.operation) {
    case Operation::negate:
        return "-" + a;
    case Operation::whole_power:
        return node.number == 2   ? a + " * " + a
               : node.number == 3 ? a + " * " + a + " * " + a
                                  : call("core_whole_power", {a, std::to_string(static_cast<int>(node.number)) + "u"});
    case Operation::power_to:
        return call("elvis_pow", {a, literal(node.number)});
    case Operation::square_root:
        return call("sqrt", {a});
    case Operation::absolute:
        return call("abs", {a});
    case Operation::sign:
        return call("sign", {a});
    case Operation::sine:
        return call("elvis_sin", {a});
    case Operation::cosine:
        return call("elvis_cos", {a});
    case Operation::tangent:
        return call("elvis_sin", {a}) + " / " + call("elvis_cos", {a});
    case Operation::arcsine:
        return call("elvis_asin", {a});
    case Operation::arccosine:
        return call("elvis_acos", {a});
    case Operation::arctangent:
        return call("elvis_atan", {a});
    case Operation::exponential:
        return call("elvis_exp", {a});
    case Operation::logarithm:
        return call("elvis_log", {a});
    case Operation::add:
        return a + " + " + b;
    case Operation::subtract:
        return a + " - " + b;
    case Operation::multiply:
        return a + " * " + b;
    case Operation::divide:
        return a + " / " + b;
    case Operation::power:
        return call("elvis_pow", {a, b});
    case Operation::minimum:
        return call("min", {a, b});
    case Operation::maximum:
        return call("max", {a, b});
    case Operation::arctangent2:
        return call("elvis_atan", {a, b});
    case Operation::over_length:
        return call("core_over_length", {a, b});
    case Operation::less:
        return truth(a + " < " + b);
    case Operation::less_equal:
        return truth(a + " <= " + b);
    case Operation::equal:
        return truth(a + " == " + b);
    case Operation::length:
        return "sqrt(" + a + " * " + a + " + " + b + " * " + b + " + " + c + " * " + c + ")";
    case Operation::select:
        return a + " != elvis_real(0) ? " + b + " : " + c;
    default:
        assert(false && "a leaf is no operation");
        return {};
    }
}

/** The same for types whose functions are PREFIX_add(a, b) and so on; `last` ends every list of arguments. */
std::string enclosure_operation(const Node& node, const Operands& operands, const std::string& prefix,
                                const std::string& last) {
    const auto operand = [&](std::size_t i) { return operands[i]; };
    const auto of = [&](const char* function, std::initializer_list<std::string> more) {
        std::string text = prefix + function + "(" + operand(0);
        for (const std::string& one : more) {
            text += ", " + one;
        }
        return text + last + ")";
    };
    const std::string b = operand(1), c = operand(2);
    switch (node.operation) {
    case Operation::negate:
        return prefix + "negate(" + operand(0) + ")";
    case Operation::whole_power:
        return node.number == 2 ? of("square", {}) : of("whole_power", {std::to_string(static_cast<int>(node.number)) + "u"});
    case Operation::power_to:
        return of("power_to", {literal(node.number)});
    case Operation::square_root:
        return of("sqrt", {});
    case Operation::absolute:
        return of("abs", {});
    case Operation::sign:
        return of("sign", {});
    case Operation::sine:
        return of("sin", {});
    case Operation::cosine:
        return of("cos", {});
    case Operation::tangent:
        return of("tan", {});
    case Operation::arcsine:
        return of("asin", {});
    case Operation::arccosine:
        return of("acos", {});
    case Operation::arctangent:
        return of("atan", {});
    case Operation::exponential:
        return of("exp", {});
    case Operation::logarithm:
        return of("log", {});
    case Operation::add:
        return of("add", {b});
    case Operation::subtract:
        return of("subtract", {b});
    case Operation::multiply:
        return of("multiply", {b});
    case Operation::divide:
        return of("divide", {b});
    case Operation::power:
        return of("power", {b});
    case Operation::minimum:
        return of("min", {b});
    case Operation::maximum:
        return of("max", {b});
    case Operation::arctangent2:
        return of("atan", {b});
    case Operation::over_length:
        return of("over_length", {b});
    case Operation::less:
        return of("less", {b});
    case Operation::less_equal:
        return of("less_equal", {b});
    case Operation::equal:
        return of("equal", {b});
    case Operation::length:
        return of("length", {b, c});
    case Operation::select:
        return of("select", {b, c});
    default:
        assert(false && "a leaf is no operation");
        return {};
    }
}

std::string commented(const Expression& expression) {
    std::string text = expression.text();
    // One line, and no backslash that would continue the comment.
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\\' || (c & 0x80) != 0; }, ' ');
    return "// " + text + "\n";
}

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

    NodeWriter(const Graph& graph, const std::vector<NodeId>& needed, Dialect dialect)
        : m_graph(graph), m_dialect(std::move(dialect)) {
        for (const NodeId id : needed) {
            write(id);
        }
    }

    const std::string& text() const { return m_text; }

    /** Name of a variable with the whole value of a node. */
    std::string whole(NodeId id) {
        if (m_lacking[id] == 0) {
            return base(id);
        }
        const std::string variable = m_dialect.prefix + "core_whole" + std::to_string(id);
        if (m_shifted.insert(id).second) {
            declare(variable, m_dialect.shifted(base(id), m_lacking[id]));
        }
        return variable;
    }

private:
    std::string base(NodeId id) const { return m_dialect.prefix + name(id); }
    void declare(const std::string& variable, const std::string& value) {
        m_text += "    const " + m_dialect.type + " " + variable + " = " + value + ";\n";
    }
    const Node& node(NodeId id) const { return m_graph.node(id); }
    bool is_constant(NodeId id) const { return node(id).operation == Operation::constant; }

    void write(NodeId id) {
        const Node& of = node(id);
        const auto [a, b, c] = of.operands;
        double lacking = 0;
        const bool is_sum = of.operation == Operation::add || of.operation == Operation::subtract;
        const double sign = of.operation == Operation::subtract ? -1 : 1;
        if (n_operands(of.operation) == 0) {
            lacking = m_dialect.offset(of);
            declare(base(id), m_dialect.leaf(of));
        } else if (is_sum && is_constant(b) && std::isfinite(node(b).number)) {
            lacking = m_lacking[a] + sign * node(b).number;
            declare(base(id), base(a));
        } else if (is_sum && is_constant(a) && std::isfinite(node(a).number)) {
            Node negation = of;
            negation.operation = Operation::negate;
            lacking = node(a).number + sign * m_lacking[b];
            declare(base(id), sign > 0 ? base(b) : m_dialect.operation(negation, {base(b), {}, {}}));
        } else if (is_sum) {
            lacking = m_lacking[a] + sign * m_lacking[b];
            declare(base(id), m_dialect.operation(of, {base(a), base(b), {}}));
        } else if (of.operation == Operation::negate) {
            lacking = -m_lacking[a];
            declare(base(id), m_dialect.operation(of, {base(a), {}, {}}));
        } else if (of.operation == Operation::multiply && (is_constant(a) || is_constant(b))) {
            lacking = is_constant(a) ? node(a).number * m_lacking[b] : node(b).number * m_lacking[a];
            declare(base(id), m_dialect.operation(of, {base(a), base(b), {}}));
        } else if (of.operation == Operation::divide && is_constant(b)) {
            lacking = m_lacking[a] / node(b).number;
            declare(base(id), m_dialect.operation(of, {base(a), base(b), {}}));
        } else {
            const std::size_t n = n_operands(of.operation);
            const Operands operands{whole(a), n > 1 ? whole(b) : std::string(), n > 2 ? whole(c) : std::string()};
            declare(base(id), m_dialect.operation(of, operands));
        }
        m_lacking[id] = lacking;
    }

    const Graph& m_graph;
    Dialect m_dialect;
    std::string m_text;
    /** By node: what its variable lacks. */
    std::map<NodeId, double> m_lacking;
    std::set<NodeId> m_shifted;
};

NodeWriter::Dialect real_dialect(const std::function<std::string(const Node&)>& leaf,
                                 const std::function<double(const Node&)>& offset) {
    return {"elvis_real",
            "",
            leaf,
            real_operation,
            [](const std::string& variable, double constant) { return variable + " + " + literal(constant); },
            offset};
}

const char* const real_includes = "#include \"library/expression.glsl\"\n";

std::vector<NodeId> roots_with_gradient(const Expression& expression) {
    const auto& [d0, d1, d2] = expression.gradient().value();
    return {expression.value(), d0, d1, d2};
}

/** Nodes and results of a function that gives value and gradient. */
std::string gradient_body(const Expression& expression, const NodeWriter::Dialect& dialect) {
    const auto& [d0, d1, d2] = expression.gradient().value();
    NodeWriter nodes(expression.graph(), expression.graph().needed(roots_with_gradient(expression)), dialect);
    const Operands whole{nodes.whole(d0), nodes.whole(d1), nodes.whole(d2)};
    const std::string value = nodes.whole(expression.value());
    return nodes.text() + "    value = " + value + ";\n    gradient = elvis_vec3(" + whole[0] + ", " + whole[1] + ", " +
           whole[2] + ");\n}\n";
}

/** Nodes and result of a function that gives the value. */
std::string value_body(const Expression& expression, const NodeWriter::Dialect& dialect) {
    NodeWriter nodes(expression.graph(), expression.graph().needed({expression.value()}), dialect);
    const std::string value = nodes.whole(expression.value());
    return nodes.text() + "    return " + value + ";\n}\n";
}

} // namespace

ExpressionClass expression_class(const RuntimeVolume& volume, std::uint32_t element_class) {
    ExpressionClass result;
    result.dimension = volume.dimension();
    result.is_affine = volume.classes()[element_class].is_affine;
    result.capabilities = volume.snippet(element_class).capabilities;
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        const ClassFieldInfo info = volume.class_field(element_class, field);
        result.orders.push_back(*std::max_element(std::begin(info.order), std::end(info.order)));
    }
    return result;
}

namespace {

NodeWriter::Dialect dialect_of(const LeafWriter& leaves) {
    return real_dialect([&leaves](const Node& node) { return leaves.leaf(node); },
                        [&leaves](const Node& node) { return leaves.offset(node); });
}

} // namespace

std::string value_glsl(const Expression& expression, const ExpressionClass& element_class) {
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    const LeafWriter leaves(expression, element_class, needed);
    return std::string("#define CORE_SHOWN_BY_EXPRESSION 1\n#define CORE_VALUE_FLAGS ") +
           (value_is_estimated(expression, element_class) ? "CORE_FLAG_ESTIMATED\n" : "0u\n") + real_includes +
           commented(expression) + "elvis_real core_shown_value(uint element, elvis_vec3 xi) {\n" + leaves.declarations() +
           value_body(expression, dialect_of(leaves));
}

std::string gradient_glsl(const Expression& expression, const ExpressionClass& element_class) {
    if (!expression.gradient()) {
        return "#include \"library/shown_gradient_default.glsl\"\n";
    }
    const std::vector<NodeId> needed = expression.graph().needed(roots_with_gradient(expression));
    const LeafWriter leaves(expression, element_class, needed);
    return real_includes + commented(expression) +
           "void core_shown_gradient(uint element, elvis_vec3 xi, out elvis_real value, out elvis_vec3 gradient) {\n" +
           leaves.declarations() + gradient_body(expression, dialect_of(leaves));
}

namespace {

/** Whether bounds of everything in it are known: fields, constants, coordinates of affine mappings. */
bool has_certified_model(const Expression& expression, const ExpressionClass& element_class) {
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    return std::all_of(needed.begin(), needed.end(), [&](NodeId id) {
        const Operation operation = expression.graph().node(id).operation;
        return n_operands(operation) > 0 || operation == Operation::constant || operation == Operation::field ||
               operation == Operation::order || operation == Operation::element ||
               (operation == Operation::position && element_class.is_affine);
    });
}

} // namespace

std::string model_glsl(const Expression& expression, const ExpressionClass& element_class) {
    if (!has_certified_model(expression, element_class)) {
        return "#include \"library/model.glsl\"\n" + gradient_glsl(expression, element_class) +
               "#include \"library/estimated_model.glsl\"\n";
    }
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    LeafWriter leaves(expression, element_class, needed);
    leaves.raise_fields(1);
    if (leaves.needs_position()) {
        leaves.raise_geometry(2);
    }
    const auto row = [&](const Node& node) {
        return "elvis_fetch4_core_bounds" + LeafWriter::instance_suffix(leaves.slot(node.field)) + "(element, " +
               std::to_string(node.component) + "u)";
    };
    const auto leaf = [&](const Node& node) -> std::string {
        if (node.operation == Operation::field) {
            const std::string at = LeafWriter::field_suffix(leaves.slot(node.field), node.component);
            return call("core_model_leaf", {"core_f" + at, "core_s" + at, call("core_leaf_bounds", {row(node)}), "cell"});
        }
        if (node.operation == Operation::position) {
            const std::string i = std::to_string(node.index[0]);
            const std::string slope =
                call("elvis_vec3", {"core_j[0][" + i + "]", "core_j[1][" + i + "]", "core_j[2][" + i + "]"});
            return call("core_model_coordinate", {"core_x[" + i + "]", slope, "cell"});
        }
        return call("core_model_constant", {leaves.leaf(node)});
    };
    std::string text = "#include \"library/model.glsl\"\n#include \"library/model_choice.glsl\"\n#include "
                       "\"library/leaf_bounds.glsl\"\n" +
                       commented(expression) +
                       "core_model core_shown_model(uint element, elvis_vec3 xi, core_patch cell, out elvis_real value) {\n" +
                       leaves.declarations();
    std::string is_estimated = "false";
    for (const NodeId id : needed) {
        if (expression.graph().node(id).operation == Operation::field) {
            is_estimated += " || " + row(expression.graph().node(id)) + ".w > elvis_real(0)";
        }
    }
    NodeWriter models(expression.graph(), needed,
                      {"core_model", "core_model_", leaf,
                       [](const Node& node, const Operands& operands) {
                           return enclosure_operation(node, operands, "core_model_", ", cell");
                       },
                       [](const std::string& variable, double constant) {
                           return call("core_model_add", {variable, call("core_model_constant", {literal(constant)}), "cell"});
                       },
                       [&](const Node& node) { return leaves.offset(node); }});
    // What is drawn is the value itself, not the model's, which is 0 where nothing is known.
    NodeWriter values(expression.graph(), needed, dialect_of(leaves));
    const std::string model = models.whole(expression.value()), value = values.whole(expression.value());
    text += models.text() + values.text() + "    value = " + value + ";\n    return " + model + ";\n}\n";
    return text + "bool core_is_model_estimated(uint element) { return " + is_estimated + "; }\n";
}

namespace {

/**
 * A condition in GLSL, of the nodes' intervals: that all is continuous there where it has a value, so that derivatives tell how
 * the value can change.
 */
std::string continuity(const Graph& graph, const std::vector<NodeId>& needed) {
    const auto of = [](NodeId id, const char* end) { return "core_interval_" + name(id) + end; };
    std::string text = "true";
    for (const NodeId id : needed) {
        const Node& node = graph.node(id);
        const auto [a, b, c] = node.operands;
        switch (node.operation) {
        case Operation::sign:
        case Operation::less:
        case Operation::less_equal:
        case Operation::equal:
            text += " && " + of(id, ".lower == ") + of(id, ".upper");
            break;
        case Operation::arctangent2:
            text += " && (" + of(a, ".lower > elvis_real(0) || ") + of(a, ".upper < elvis_real(0) || ") +
                    of(b, ".lower > elvis_real(0))");
            break;
        case Operation::over_length:
            text += " && " + of(b, ".lower > elvis_real(0)");
            break;
        default:
            break;
        }
    }
    return text;
}

} // namespace

namespace {

/** First-order error of an operation from those of its operands, beyond its own rounding: sum of |derivative| times error. */
std::string error_operation(const Node& node, const std::string& v, const Operands& operands, const Operands& errors) {
    const auto& [a, b, c] = operands;
    const auto& [ea, eb, ec] = errors;
    switch (node.operation) {
    case Operation::negate:
    case Operation::absolute:
    case Operation::sine:
    case Operation::cosine:
        return ea;
    case Operation::whole_power:
    case Operation::power_to:
        return "abs(" + literal(node.number) + " * " + v + " / " + a + ") * " + ea;
    case Operation::square_root:
        return ea + " / (elvis_real(2) * " + v + ")";
    case Operation::tangent:
        return "(elvis_real(1) + " + v + " * " + v + ") * " + ea;
    case Operation::arcsine:
    case Operation::arccosine:
        return ea + " / sqrt(elvis_real(1) - " + a + " * " + a + ")";
    case Operation::arctangent:
        return ea + " / (elvis_real(1) + " + a + " * " + a + ")";
    case Operation::exponential:
        return v + " * " + ea;
    case Operation::logarithm:
        return ea + " / abs(" + a + ")";
    case Operation::add:
    case Operation::subtract:
        return ea + " + " + eb;
    case Operation::multiply:
        return "abs(" + a + ") * " + eb + " + abs(" + b + ") * " + ea;
    case Operation::divide:
        return "(" + ea + " + abs(" + v + ") * " + eb + ") / abs(" + b + ")";
    case Operation::power:
        return "abs(" + b + " * " + v + " / " + a + ") * " + ea + " + abs(" + v + " * elvis_log(abs(" + a + "))) * " + eb;
    case Operation::minimum:
    case Operation::maximum:
        return "max(" + ea + ", " + eb + ")";
    case Operation::arctangent2:
        return "(abs(" + b + ") * " + ea + " + abs(" + a + ") * " + eb + ") / (" + a + " * " + a + " + " + b + " * " + b + ")";
    case Operation::over_length:
        return "(" + ea + " + " + eb + ") / abs(" + b + ")";
    case Operation::length:
        return "sqrt(" + ea + " * " + ea + " + " + eb + " * " + eb + " + " + ec + " * " + ec + ")";
    case Operation::select:
        return a + " != elvis_real(0) ? " + eb + " : " + ec;
    default:
        // Signs and comparisons: constant but for jumps.
        return "elvis_real(0)";
    }
}

} // namespace

std::string error_glsl(const Expression& expression, const ExpressionClass& element_class) {
    const Graph& graph = expression.graph();
    const std::vector<NodeId> needed = graph.needed({expression.value()});
    const LeafWriter leaves(expression, element_class, needed);
    std::string text = std::string(real_includes) + "#include \"library/precision.glsl\"\n" + commented(expression) +
                       "elvis_real core_shown_error(uint element, elvis_vec3 xi) {\n" + leaves.declarations();
    NodeWriter nodes(graph, needed, dialect_of(leaves));
    std::string errors;
    for (const NodeId id : needed) {
        const Node& node = graph.node(id);
        // In units of roundoff: what evaluations of fields and their derivatives show, doubled; what operations lose.
        const bool is_derivative = node.operation == Operation::gradient || node.operation == Operation::hessian;
        const std::string own = node.operation == Operation::constant ? "1"
                                : is_derivative                       ? "64"
                                : n_operands(node.operation) == 0     ? "16"
                                                                      : "2";
        // Of what is computed: constants that were left out lose nothing.
        errors += "    const elvis_real core_error_" + name(id) + " = elvis_real(" + own + ") * CORE_ROUNDOFF * abs(" +
                  name(id) + ")";
        const bool is_sum = node.operation == Operation::add || node.operation == Operation::subtract;
        Operands operands, operand_errors;
        for (std::size_t i = 0; i < n_operands(node.operation); ++i) {
            const NodeId operand = node.operands[i];
            const bool is_left_out = is_sum && graph.node(operand).operation == Operation::constant;
            operands[i] = nodes.whole(operand);
            operand_errors[i] = is_left_out ? "elvis_real(0)" : "core_error_" + name(operand);
            // A constant that is put in rounds.
            if (!is_sum && operands[i] != name(operand)) {
                operand_errors[i] = "(" + operand_errors[i] + " + CORE_ROUNDOFF * abs(" + operands[i] + "))";
            }
        }
        errors += n_operands(node.operation) == 0
                      ? ";\n"
                      : " + (" + error_operation(node, nodes.whole(id), operands, operand_errors) + ");\n";
    }
    const std::string value = nodes.whole(expression.value());
    text += nodes.text() + errors;
    return text + "    return core_error_" + name(expression.value()) + " + CORE_ROUNDOFF * abs(" + value + ");\n}\n";
}

std::string implicit_glsl(const Expression& expression) {
    assert(expression.is_implicit());
    const Graph& graph = expression.graph();
    const auto leaf = [](const Node& node) {
        return node.operation == Operation::constant ? literal(node.number) : "x[" + std::to_string(node.index[0]) + "]";
    };
    const auto interval_leaf = [](const Node& node) -> std::string {
        constexpr const char* axes[] = {"x", "y", "z"};
        // Integers of moderate size are exact in both precisions.
        const bool is_exact = node.number == std::floor(node.number) && std::abs(node.number) < 1e6;
        return node.operation != Operation::constant
                   ? axes[node.index[0]]
                   : call(is_exact ? "core_interval_number" : "core_interval_near", {literal(node.number)});
    };
    const std::vector<NodeId> of_value = graph.needed({expression.value()});
    std::string text = std::string(real_includes) +
                       "#include \"library/interval.glsl\"\n#include \"library/interval_choice.glsl\"\n" +
                       commented(expression);
    const NodeWriter::Dialect reals = real_dialect(leaf, [](const Node&) { return 0.0; });
    text += "elvis_real core_implicit_value(elvis_vec3 x) {\n" + value_body(expression, reals);
    text += "void core_implicit(elvis_vec3 x, out elvis_real value, out elvis_vec3 gradient) {\n" +
            gradient_body(expression, reals);
    const auto intervals = [&](const std::vector<NodeId>& needed) {
        std::string lines;
        for (const NodeId id : needed) {
            const Node& node = graph.node(id);
            lines += "    const core_interval core_interval_" + name(id) + " = ";
            Operands operands;
            for (std::size_t i = 0; i < n_operands(node.operation); ++i) {
                operands[i] = "core_interval_" + name(node.operands[i]);
            }
            lines += n_operands(node.operation) == 0 ? interval_leaf(node)
                                                     : enclosure_operation(node, operands, "core_interval_", "");
            lines += ";\n";
        }
        return lines;
    };
    text += "core_interval core_implicit_range(core_interval x, core_interval y, core_interval z) {\n" + intervals(of_value) +
            "    return core_interval_" + name(expression.value()) + ";\n}\n";
    text += "core_interval core_implicit_slopes(core_interval x, core_interval y, core_interval z, out core_interval dx, "
            "out core_interval dy, out core_interval dz) {\n";
    const auto& [d0, d1, d2] = expression.gradient().value();
    text += intervals(graph.needed(roots_with_gradient(expression))) + "    dx = core_interval_" + name(d0) +
            ";\n    dy = core_interval_" + name(d1) + ";\n    dz = core_interval_" + name(d2) + ";\n    if (!(" +
            continuity(graph, of_value) + ")) {\n        dx = dy = dz = core_interval_whole();\n    }\n";
    return text + "    return core_interval_" + name(expression.value()) + ";\n}\n";
}

bool value_is_estimated(const Expression& expression, const ExpressionClass& element_class) {
    const auto lacks = [&](std::uint32_t capability) { return (element_class.capabilities & capability) == 0; };
    return (expression.needs_gradients() && lacks(ELVIS_SNIPPET_FIELD_GRADIENT)) ||
           (expression.needs_second_derivatives() &&
            (lacks(ELVIS_SNIPPET_FIELD_HESSIAN) || lacks(ELVIS_SNIPPET_MAPPING_HESSIAN)));
}

bool gradient_is_estimated(const Expression& expression, const ExpressionClass& element_class) {
    const auto lacks = [&](std::uint32_t capability) { return (element_class.capabilities & capability) == 0; };
    return !expression.gradient() || lacks(ELVIS_SNIPPET_FIELD_GRADIENT) ||
           (expression.gradient_needs_second_derivatives() &&
            (lacks(ELVIS_SNIPPET_FIELD_HESSIAN) || lacks(ELVIS_SNIPPET_MAPPING_HESSIAN)));
}

} // namespace elvis
