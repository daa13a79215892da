#include <core/base/memory_budget.hpp>

#include <charconv>
#include <cmath>

namespace elvis {

namespace {

const std::string size_units = "KMGT";

} // namespace

std::optional<std::uint64_t> bytes_of_size(const std::string& text) {
    double number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string unit(end, text.data() + text.size());
    const std::size_t power = unit.size() == 1 ? size_units.find(unit) : std::string::npos;
    if (failure != std::errc() || !(unit.empty() || power != std::string::npos)) {
        return {};
    }
    const double bytes = std::ldexp(number, unit.empty() ? 0 : 10 * static_cast<int>(power + 1));
    return bytes >= 1 && bytes < 0x1p63 ? std::optional(static_cast<std::uint64_t>(bytes)) : std::nullopt;
}

std::string no_size_text(const std::string& text) {
    return "'" + text + "' is no size; sizes are bytes, or numbers with K, M, G or T, such as 2G";
}

std::string size_text(std::uint64_t bytes) {
    std::size_t power = 0;
    while (power < size_units.size() && bytes > 0 && bytes % 1024 == 0) {
        bytes /= 1024;
        ++power;
    }
    return std::to_string(bytes) + (power > 0 ? size_units.substr(power - 1, 1) : std::string());
}

} // namespace elvis
