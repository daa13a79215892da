#include "number_list.hpp"

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::commands {

std::vector<double> numbers(const char* option, const std::string& text, std::size_t least, std::size_t most) {
    std::vector<double> list;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        std::size_t used = 0;
        double value = std::nan("");
        try {
            value = std::stod(part, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used == 0 || used != part.size() || !std::isfinite(value)) {
            throw UsageError(option, "'" + text + "' is no list of numbers separated by commas");
        }
        list.push_back(value);
        begin = end + 1;
    }
    if (list.size() < least || list.size() > most) {
        throw UsageError(option, "'" + text + "' has " + std::to_string(list.size()) + " numbers where " +
                                     std::to_string(least) + (most > least ? " or " + std::to_string(most) : "") +
                                     " are expected");
    }
    return list;
}

std::array<double, 3> point(const char* option, const std::string& text) {
    const std::vector<double> list = numbers(option, text, 3, 3);
    return {list[0], list[1], list[2]};
}

} // namespace elvis::commands
