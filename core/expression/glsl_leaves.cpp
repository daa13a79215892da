#include <core/expression/glsl_leaves.hpp>

#include <core/expression/glsl_text.hpp>

#include <algorithm>
#include <cassert>

namespace elvis::expression_glsl {

LeafWriter::LeafWriter(const Expression& expression, const ExpressionClass& element_class, const std::vector<NodeId>& needed)
    : m_expression(expression), m_class(element_class) {
    for (const NodeId id : needed) {
        note(expression.graph().node(id));
    }
}

std::string LeafWriter::declarations() const {
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

std::string LeafWriter::leaf(const Node& node) const {
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

double LeafWriter::offset(const Node& node) const {
    return node.operation == Operation::field && !m_class.offsets.empty() ? m_class.offsets[slot(node.field)][node.component]
                                                                          : 0.0;
}

bool LeafWriter::is_of_field(Operation operation) {
    return operation == Operation::field || operation == Operation::slope || operation == Operation::gradient ||
           operation == Operation::bend || operation == Operation::hessian;
}

std::size_t LeafWriter::slot(std::uint32_t field) const {
    const auto& fields = m_expression.fields();
    return static_cast<std::size_t>(std::find(fields.begin(), fields.end(), field) - fields.begin());
}

void LeafWriter::raise_fields(int level) {
    for (auto& [key, of_field] : m_fields) {
        of_field = std::max(of_field, level);
    }
}

void LeafWriter::note(const Node& node) {
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

std::string LeafWriter::field(std::size_t slot, std::uint32_t component, int level) const {
    const std::string at = field_suffix(slot, component), instance = instance_suffix(slot);
    const std::string number = std::to_string(component) + "u";
    if (level == 0) {
        return "    const elvis_real core_f" + at + " = elvis_field_value" + instance + "(element, xi, " + number + ");\n";
    }
    std::string text = "    elvis_real core_f" + at + ";\n    elvis_vec3 core_s" + at + ";\n";
    if (level < 3) {
        text += "    elvis_field_gradient" + instance + "(element, xi, " + number + ", core_f" + at + ", core_s" + at + ");\n";
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

double LeafWriter::order(std::uint32_t field) const {
    if (field != any_field) {
        return m_class.orders[field];
    }
    return m_class.orders.empty() ? 0 : *std::max_element(m_class.orders.begin(), m_class.orders.end());
}

} // namespace elvis::expression_glsl
