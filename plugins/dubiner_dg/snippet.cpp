#include "snippet.hpp"

#include "basis.hpp"

#include <array>
#include <charconv>
#include <functional>

namespace elvis::dubiner {

namespace {

std::string literal(double number) {
    std::array<char, 40> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == std::string::npos) {
        text += ".0";
    }
    return "elvis_real(" + text + "LF)";
}

std::string mode_name(std::size_t p, std::size_t q, std::size_t r) {
    return std::string("m") + std::to_string(p) + "_" + std::to_string(q) + "_" + std::to_string(r);
}

/** A line that declares the mode after `in`: combination(1, product(factor, in), -c, before), without what is zero. */
std::string next_mode(const std::string& name, const std::string& factor, const std::string& in, double c,
                      const std::string& before) {
    const std::string product = std::string("dubiner_product(") + factor + ", " + in + ")";
    return "    dubiner_jet " + name + " = " +
           (c == 0 ? product : "dubiner_combination(elvis_real(1), " + product + ", " + literal(-c) + ", " + before + ")") +
           ";\n";
}

/** Declares all modes, those that others stand on first, each followed by what `use` writes of it. */
std::string all_modes(std::size_t order, const std::function<std::string(std::size_t mode, const std::string& name)>& use) {
    std::string text =
        "    dubiner_factors f = dubiner_factors_at(xi);\n    dubiner_jet m0_0_0 = dubiner_constant(elvis_real(1));\n";
    std::size_t mode = 0;
    for (std::size_t p = 0; p <= order; ++p) {
        if (p > 0) {
            const double n = static_cast<double>(p - 1);
            text += next_mode(mode_name(p, 0, 0), "dubiner_scaled(" + literal((2 * n + 1) / (n + 1)) + ", f.f1)",
                              mode_name(p - 1, 0, 0), n / (n + 1),
                              p > 1 ? "dubiner_product(f.f2, " + mode_name(p - 2, 0, 0) + ")" : "");
        }
        for (std::size_t q = 0; p + q <= order; ++q) {
            if (q > 0) {
                const Recurrence step(q - 1, 2 * p + 1);
                text += next_mode(
                    mode_name(p, q, 0), "dubiner_combination(" + literal(step.a) + ", f.f3, " + literal(step.b) + ", f.f4)",
                    mode_name(p, q - 1, 0), step.c, q > 1 ? "dubiner_product(f.f5, " + mode_name(p, q - 2, 0) + ")" : "");
            }
            for (std::size_t r = 0; p + q + r <= order; ++r, ++mode) {
                if (r > 0) {
                    const Recurrence step(r - 1, 2 * (p + q) + 2);
                    text += next_mode(mode_name(p, q, r),
                                      "dubiner_linear_in_z(" + literal(step.b) + ", " + literal(step.a) + ", xi)",
                                      mode_name(p, q, r - 1), step.c, r > 1 ? mode_name(p, q, r - 2) : "");
                }
                text += use(mode, mode_name(p, q, r));
            }
        }
    }
    return text;
}

} // namespace

std::string write_modes(std::size_t field_order, std::size_t geometry_order) {
    std::string text = "dubiner_map dubiner_mapping(uint element, elvis_vec3 xi) {\n"
                       "    dubiner_map map = dubiner_map(dubiner_zero(), dubiner_zero(), dubiner_zero());\n"
                       "    elvis_vec4 c;\n";
    text += all_modes(geometry_order, [](std::size_t mode, const std::string& name) {
        std::string lines = "    c = elvis_fetch4_geometry(element, " + std::to_string(mode) + "u);\n";
        for (const char* axis : {"x", "y", "z"}) {
            lines += std::string("    map.") + axis + " = dubiner_combination(elvis_real(1), map." + axis + ", c." + axis +
                     ", " + name + ");\n";
        }
        return lines;
    });
    text += "    return map;\n}\n\n"
            "dubiner_jet dubiner_field(uint element, uint component, elvis_vec3 xi) {\n"
            "    dubiner_jet sum = dubiner_zero();\n    uint first = component * uint(DUBINER_N_ROWS);\n    elvis_vec4 c;\n";
    text += all_modes(field_order, [](std::size_t mode, const std::string& name) {
        const std::string row =
            mode % 4 == 0 ? "    c = elvis_fetch4_modes(element, first + " + std::to_string(mode / 4) + "u);\n" : "";
        return row + "    sum = dubiner_combination(elvis_real(1), sum, c[" + std::to_string(mode % 4) + "], " + name + ");\n";
    });
    return text + "    return sum;\n}\n";
}

} // namespace elvis::dubiner
