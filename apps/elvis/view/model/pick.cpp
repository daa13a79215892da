#include "pick.hpp"

#include <cstdio>

namespace elvis::view {

namespace {

/** Null is no number. */
std::string number(const nlohmann::json& value) {
    char text[40] = "nan";
    if (value.is_number()) {
        std::snprintf(text, sizeof text, "%.9g", value.get<double>());
    }
    return text;
}

/** Three numbers, from one of them on. */
std::string triple(const nlohmann::json& values, std::size_t first = 0) {
    return std::string("(") + number(values[first]) + ", " + number(values[first + 1]) + ", " + number(values[first + 2]) + ")";
}

std::string text_of_element(const nlohmann::json& answer) {
    std::string text = std::string("element ") + std::to_string(answer["element"].get<std::int64_t>());
    for (const nlohmann::json& other : answer["also"]) {
        text += std::string(", also ") + std::to_string(other.get<std::int64_t>());
    }
    text += std::string("\nxi = ") + triple(answer["xi"]) + "\n";
    if (answer["order"].is_number()) {
        text += std::string("order ") + number(answer["order"]) + "\n";
    }
    if (answer["jacobian"].is_number()) {
        text += std::string("Jacobian ") + number(answer["jacobian"]);
        if (answer["scaled_jacobian"].is_number()) {
            text += std::string(", scaled ") + number(answer["scaled_jacobian"]);
        }
        text += '\n';
    }
    return text;
}

std::string text_of_field(const nlohmann::json& field) {
    const auto name = field["name"].get<std::string>(), unit = field["unit"].get<std::string>();
    const std::size_t n_components = field["values"].size();
    std::string text;
    for (std::size_t c = 0; c < n_components; ++c) {
        text += name;
        if (n_components > 1) {
            text += std::string("[") + std::to_string(c) + "]";
        }
        text += std::string(" = ") + number(field["values"][c]);
        text += unit.empty() ? std::string() : std::string(" ") + unit;
        text += std::string(", gradient ") + triple(field["gradients"], 3 * c);
        text += field["gradient_is_estimated"] ? " (estimated)\n" : "\n";
    }
    return text;
}

} // namespace

Picked picked_of(const nlohmann::json& answer) {
    if (!answer["hit"]) {
        return {false, {}, "nothing is hit\n"};
    }
    Picked picked{true, answer["position"], std::string("x = ") + triple(answer["position"]) + "\n"};
    picked.text += std::string("value drawn there = ") + number(answer["value"]) + "\n";
    if (answer["element"].is_number()) {
        picked.text += text_of_element(answer);
    }
    for (const nlohmann::json& field : answer["fields"]) {
        picked.text += text_of_field(field);
    }
    if (const auto remark = answer["remark"].get<std::string>(); !remark.empty()) {
        picked.text += remark + "\n";
    }
    return picked;
}

} // namespace elvis::view
