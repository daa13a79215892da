#include "nodes_text.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace nektarpp {

namespace {

namespace native = elvis::native;

std::vector<double> nodes_of(bool is_gauss, std::uint32_t order) {
    std::vector<double> nodes(order + 1), weights(order + 1);
    if (is_gauss) {
        native::gauss_legendre(nodes, weights);
    } else {
        native::gauss_lobatto_legendre(nodes);
    }
    return nodes;
}

std::string literal(double number) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == std::string::npos) {
        text += ".0";
    }
    return "elvis_real(" + text + "LF)";
}

std::string declaration(const char* name, char direction, const std::vector<double>& numbers) {
    const std::string size = std::to_string(numbers.size());
    std::string text = "const elvis_real nektar_";
    text.append(name).append({'_', direction, '['}).append(size).append("] = elvis_real[").append(size).append("](");
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += (i == 0 ? "" : ", ") + literal(numbers[i]);
    }
    return text + ");\n";
}

} // namespace

std::string write_nodes(std::span<const native::Space> fields) {
    std::set<std::pair<bool, std::uint32_t>> wanted;
    for (const native::Space& space : fields) {
        if (space.basis == native::Basis::gll_lagrange || space.basis == native::Basis::gauss_lagrange) {
            for (const std::uint32_t order : space.order) {
                // The third of two dimensions is not used.
                if (order > 0 || space.basis == native::Basis::gauss_lagrange) {
                    wanted.emplace(space.basis == native::Basis::gauss_lagrange, order);
                }
            }
        }
    }
    std::string text;
    for (const auto& [is_gauss, order] : wanted) {
        const std::vector<double> nodes = nodes_of(is_gauss, order);
        std::vector<double> scales(nodes.size(), 1);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                scales[i] /= i == j ? 1 : nodes[i] - nodes[j];
            }
        }
        for (const char direction : {'p', 'q', 'r'}) {
            text += std::string("#if NEKTAR_FIELD_NODES == ") + (is_gauss ? "1" : "0") + " && NEKTAR_FIELD_" +
                    static_cast<char>(direction - 'a' + 'A') + " == " + std::to_string(order) + "\n";
            text += declaration("nodes", direction, nodes);
            text += declaration("scales", direction, scales);
            text += "#endif\n";
        }
    }
    return text;
}

} // namespace nektarpp
