#include "pick.hpp"

#include <cstdio>

namespace elvis::view {

namespace {

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

std::string list(const double* values, std::size_t count) {
    std::string text = "(";
    for (std::size_t i = 0; i < count; ++i) {
        text += (i == 0 ? "" : ", ") + number(values[i]);
    }
    return text + ")";
}

} // namespace

std::string text_of(const Picked& picked) {
    if (!picked.is_hit) {
        return "nothing is hit\n";
    }
    std::string text = "x = ";
    text += list(picked.position.data(), 3);
    text += '\n';
    text += "value drawn there = ";
    text += number(picked.shown_value);
    text += '\n';
    if (picked.element) {
        text += std::string("element ") + std::to_string(*picked.element);
        for (const std::int64_t other : picked.also) {
            text += std::string(", also ") + std::to_string(other);
        }
        text += std::string("\nxi = ") + list(picked.xi.data(), 3) + "\n";
        if (picked.order) {
            text += std::string("order ") + number(*picked.order) + "\n";
        }
        if (picked.jacobian) {
            text += std::string("Jacobian ") + number(*picked.jacobian);
            text +=
                picked.scaled_jacobian ? std::string(", scaled ") + number(*picked.scaled_jacobian) + "\n" : std::string("\n");
        }
    }
    for (const Picked::Field& field : picked.fields) {
        for (std::size_t c = 0; c < field.values.size(); ++c) {
            text += field.name + (field.values.size() > 1 ? std::string("[") + std::to_string(c) + "]" : std::string());
            text += std::string(" = ") + number(field.values[c]) +
                    (field.unit.empty() ? std::string() : std::string(" ") + field.unit);
            text += std::string(", gradient ") + list(field.gradients.data() + 3 * c, 3);
            text += field.gradient_is_estimated ? " (estimated)\n" : "\n";
        }
    }
    if (!picked.remark.empty()) {
        text += picked.remark + "\n";
    }
    return text;
}

} // namespace elvis::view
