#include "data_array.hpp"

#include "encoding.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace elvis_vtk {

namespace {

/** Text of fewer digits than this is taken as exact: 0, 0.5 and 1 do not tell a precision. */
constexpr int least_digits = 6;

/** Calls visit with a value of the array's type; false if the type is none of numbers. */
template <class Visit> bool with_type(const std::string& type, Visit&& visit) {
    if (type == "Float64") {
        visit(double{});
    } else if (type == "Float32") {
        visit(float{});
    } else if (type == "Int8") {
        visit(std::int8_t{});
    } else if (type == "UInt8") {
        visit(std::uint8_t{});
    } else if (type == "Int16") {
        visit(std::int16_t{});
    } else if (type == "UInt16") {
        visit(std::uint16_t{});
    } else if (type == "Int32") {
        visit(std::int32_t{});
    } else if (type == "UInt32") {
        visit(std::uint32_t{});
    } else if (type == "Int64") {
        visit(std::int64_t{});
    } else if (type == "UInt64") {
        visit(std::uint64_t{});
    } else {
        return false;
    }
    return true;
}

std::string type_of(pugi::xml_node array) { return array.attribute("type").as_string(); }

/** Digits of a number's text that count: without leading zeros, up to the exponent. */
int significant_digits(std::string_view text) {
    int n = 0;
    for (const char c : text) {
        if (c == 'e' || c == 'E') {
            break;
        }
        n += (c >= '1' && c <= '9') || (c == '0' && n > 0);
    }
    return n;
}

/** Where an array's text ends up: value type Result. */
template <class Result> struct Parsed {
    std::vector<Result> values;
    int digits = 0;
};

template <class Result> Parsed<Result> parse_text(const XmlFile& file, pugi::xml_node array) {
    // Integers beyond 53 bits matter only as indices, which are parsed as integers.
    using Parse = std::conditional_t<std::is_integral_v<Result>, std::int64_t, double>;
    Parsed<Result> parsed;
    const std::string_view text = array.text().get();
    const auto is_space = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
    for (std::size_t at = 0; at < text.size();) {
        if (is_space(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && !is_space(text[end])) {
            ++end;
        }
        std::string_view token = text.substr(at, end - at);
        at = end;
        // std::from_chars takes no plus sign.
        if (token.size() > 1 && token.front() == '+') {
            token.remove_prefix(1);
        }
        Parse value{};
        const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
        if (error == std::errc::result_out_of_range && std::is_same_v<Parse, double>) {
            // What is too small for a double is zero; what is too large is refused.
            const std::size_t exponent = token.find_first_of("eE");
            if (exponent == std::string_view::npos || token.substr(exponent + 1, 1) != "-") {
                file.fail(array, "number " + std::string(token) + " is too large");
            }
            value = 0;
        } else if (error != std::errc{} || stop != token.data() + token.size()) {
            file.fail(array, std::string(token.substr(0, 40)) + " is not a number of type " + type_of(array));
        }
        parsed.values.push_back(static_cast<Result>(value));
        parsed.digits = std::max(parsed.digits, significant_digits(token));
    }
    return parsed;
}

/** The encoded bytes of a binary or appended array, decoded. */
std::vector<unsigned char> read_bytes(const XmlFile& file, pugi::xml_node array, const std::string& format) {
    std::string_view data;
    bool is_base64 = true;
    if (format == "binary") {
        data = array.text().get();
        data.remove_prefix(std::min(data.find_first_not_of(" \n\r\t"), data.size()));
    } else if (format == "appended") {
        const std::size_t offset = file.count(array, "offset");
        if (offset >= file.appended().size()) {
            file.fail(array, "offset " + std::to_string(offset) + " lies beyond the appended data of " +
                                 std::to_string(file.appended().size()) + " bytes");
        }
        data = file.appended().substr(offset);
        is_base64 = file.appended_is_base64();
    } else {
        file.fail(array, "format is '" + format + "', none of ascii, binary and appended");
    }
    try {
        return decode(data, is_base64, file.encoding());
    } catch (const Malformed& error) {
        file.fail(array, error.what());
    }
}

template <class Result> std::vector<Result> read_binary(const XmlFile& file, pugi::xml_node array, const std::string& format) {
    std::vector<Result> values;
    const bool is_known = with_type(type_of(array), [&]<class Stored>(Stored) {
        const std::vector<unsigned char> bytes = read_bytes(file, array, format);
        if (bytes.size() % sizeof(Stored) != 0) {
            file.fail(array, std::to_string(bytes.size()) + " bytes are no whole number of values of type " + type_of(array));
        }
        values.resize(bytes.size() / sizeof(Stored));
        for (std::size_t i = 0; i < values.size(); ++i) {
            std::array<unsigned char, sizeof(Stored)> one;
            std::memcpy(one.data(), &bytes[i * sizeof(Stored)], sizeof(Stored));
            if (file.encoding().swap_bytes) {
                std::reverse(one.begin(), one.end());
            }
            Stored value;
            std::memcpy(&value, one.data(), sizeof(Stored));
            values[i] = static_cast<Result>(value);
        }
    });
    if (!is_known) {
        file.fail(array, "type '" + type_of(array) + "' is not a type of numbers");
    }
    return values;
}

std::string format_of(pugi::xml_node array) { return array.attribute("format").as_string("ascii"); }

} // namespace

std::uint32_t n_components(const XmlFile& file, pugi::xml_node array) {
    if (!array.attribute("NumberOfComponents")) {
        return 1;
    }
    const std::size_t count = file.count(array, "NumberOfComponents");
    if (count < 1 || count > 1024) {
        file.fail(array, std::to_string(count) + " components (1 to 1024 are possible)");
    }
    return static_cast<std::uint32_t>(count);
}

bool is_numeric(pugi::xml_node array) {
    return with_type(type_of(array), [](auto) {});
}

bool is_text(pugi::xml_node array) { return format_of(array) == "ascii"; }

std::uint32_t mantissa_bits_of_type(pugi::xml_node array) { return type_of(array) == "Float32" ? 24 : 53; }

Numbers read_numbers(const XmlFile& file, pugi::xml_node array, std::size_t size) {
    const std::string type = type_of(array);
    const std::string format = format_of(array);
    Numbers numbers;
    numbers.mantissa_bits = mantissa_bits_of_type(array);
    if (!is_numeric(array)) {
        file.fail(array, "type '" + type + "' is not a type of numbers");
    }
    if (is_text(array)) {
        Parsed<double> parsed = parse_text<double>(file, array);
        numbers.values = std::move(parsed.values);
        if (type.starts_with("Float") && parsed.digits >= least_digits) {
            const auto bits = static_cast<std::uint32_t>(std::lround(parsed.digits * std::log2(10.0)));
            numbers.mantissa_bits = std::min(numbers.mantissa_bits, bits);
        }
    } else {
        numbers.values = read_binary<double>(file, array, format);
    }
    if (numbers.values.size() != size) {
        file.fail(array, "holds " + std::to_string(numbers.values.size()) + " numbers where " + std::to_string(size) +
                             " are expected");
    }
    return numbers;
}

std::vector<std::int64_t> read_integers(const XmlFile& file, pugi::xml_node array) {
    if (type_of(array).find("Int") == std::string::npos) {
        file.fail(array, "type '" + type_of(array) + "' is not a type of integers");
    }
    const std::string format = format_of(array);
    return format == "ascii" ? parse_text<std::int64_t>(file, array).values : read_binary<std::int64_t>(file, array, format);
}

} // namespace elvis_vtk
