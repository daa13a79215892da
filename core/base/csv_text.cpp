#include <core/base/csv_text.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace elvis {

std::string csv_name(const std::string& name) {
    if (name.find_first_of(",\"\n") == std::string::npos) {
        return name;
    }
    std::string text(1, '"');
    for (const char letter : name) {
        text.append(letter == '"' ? 2 : 1, letter);
    }
    text += '"';
    return text;
}

void append_csv_number(std::string& row, double number) {
    row += ',';
    if (std::isfinite(number)) {
        std::array<char, 32> text{};
        row.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr);
    }
}

} // namespace elvis
