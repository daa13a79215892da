#include <core/annotation/ticks.hpp>
#include <core/base/infinity.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <system_error>

namespace elvis {

namespace {

/** A number n 10^power, exactly. */
struct Decimal {
    std::int64_t n = 0;
    int power = 0;
};

/** More than 53 bits need: an integer beyond this is no multiple that a double can tell from its neighbours. */
constexpr double most_multiples = 9e15;

double value_of(const Decimal& decimal) {
    // The conversion of decimal text rounds correctly, which a product with a power of ten does not.
    const std::string text = std::to_string(decimal.n) + "e" + std::to_string(decimal.power);
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec == std::errc::result_out_of_range) {
        return decimal.power < 0 ? 0 : decimal.n < 0 ? -infinity : infinity;
    }
    return value;
}

int n_digits(std::int64_t n) { return static_cast<int>(std::to_string(std::abs(n)).size()); }

/** As fixed-point text with that many decimals, which must suffice. */
std::string fixed_text(const Decimal& decimal, int decimals, bool with_plus) {
    std::string digits = std::to_string(std::abs(decimal.n));
    if (decimal.n != 0) {
        digits.append(static_cast<std::size_t>(std::max(0, decimal.power + decimals)), '0');
    }
    // Before the point at least one digit.
    const std::size_t n_decimals = static_cast<std::size_t>(decimals);
    const std::size_t n_zeros = digits.size() <= n_decimals ? n_decimals + 1 - digits.size() : 0;
    digits = std::string(n_zeros, '0').append(digits);
    std::string text = decimal.n < 0 ? "−" : with_plus && decimal.n > 0 ? "+" : "";
    text.append(digits, 0, digits.size() - n_decimals);
    if (decimals > 0) {
        text.append(1, '.').append(digits, digits.size() - n_decimals, n_decimals);
    }
    return text;
}

std::string superscript(int number) {
    static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = number < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(number))) {
        text += digits[digit - '0'];
    }
    return text;
}

std::string power_text(int exponent) { return "×10" + superscript(exponent); }

/** Without digits that say nothing; large and small numbers with a power of ten. */
std::string plain_text(Decimal decimal) {
    while (decimal.n != 0 && decimal.n % 10 == 0) {
        decimal.n /= 10;
        ++decimal.power;
    }
    if (decimal.n == 0) {
        return "0";
    }
    const int leading = n_digits(decimal.n) - 1 + decimal.power;
    if (leading >= -4 && leading < 9) {
        return fixed_text(decimal, std::max(0, -decimal.power), false);
    }
    const int decimals = n_digits(decimal.n) - 1;
    // "10⁶", not "1×10⁶".
    const std::string power = power_text(leading);
    return decimal.n == 1 ? power.substr(std::string("×").size()) : fixed_text({decimal.n, -decimals}, decimals, false) + power;
}

/** The multiple in [low, high] of the largest power of ten, or five times one, that has any; the one nearest to the middle. */
std::int64_t roundest(std::int64_t low, std::int64_t high) {
    for (std::int64_t power = 1'000'000'000'000'000; power > 0; power /= 10) {
        for (const std::int64_t unit : {5 * power, power}) {
            const std::int64_t middle = low + (high - low) / 2;
            const auto nearest =
                static_cast<std::int64_t>(std::llround(static_cast<long double>(middle) / static_cast<long double>(unit))) *
                unit;
            for (const std::int64_t candidate : {nearest, nearest - unit, nearest + unit}) {
                if (candidate >= low && candidate <= high) {
                    return candidate;
                }
            }
        }
    }
    return low;
}

/** A single value: six digits, as few as tell it. */
Ticks single(double value) {
    Ticks result;
    if (!std::isfinite(value)) {
        return result;
    }
    char text[40];
    std::snprintf(text, sizeof text, "%.5e", value);
    const std::string mantissa(text);
    const std::size_t at = mantissa.find('e');
    std::string digits = mantissa.substr(0, at);
    digits.erase(std::remove_if(digits.begin(), digits.end(), [](char c) { return c < '0' || c > '9'; }), digits.end());
    const std::int64_t n = std::stoll(digits) * (value < 0 ? -1 : 1);
    result.ticks.push_back({value, plain_text({n, std::atoi(text + at + 1) - 5})});
    return result;
}

/** All multiples of step from low to high; one more than `most` where there are too many. */
std::vector<std::int64_t> multiples(double low, double high, const Decimal& step, int most) {
    const double unit = value_of(step);
    if (!(unit > 0) || std::max(std::abs(low), std::abs(high)) / unit > most_multiples) {
        return {};
    }
    // Decided with the rounded decimal itself: the quotient may be off by one.
    const auto value = [&](std::int64_t n) { return value_of({n * step.n, step.power}); };
    auto n = static_cast<std::int64_t>(std::ceil(low / unit)) - 1;
    while (value(n) < low) {
        ++n;
    }
    std::vector<std::int64_t> result;
    double last = -std::numeric_limits<double>::infinity();
    for (; value(n) <= high && static_cast<int>(result.size()) <= most; ++n) {
        if (value(n) > last) {
            result.push_back(n * step.n);
        }
        last = value(n);
    }
    return result;
}

} // namespace

Ticks round_ticks(double low, double high, int most) {
    if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
        return single(low == high ? low : std::numeric_limits<double>::quiet_NaN());
    }
    // The difference of the largest numbers overflows, that of their quotients does not.
    const double least_step = high / most - low / most;
    Decimal step{1, static_cast<int>(std::floor(std::log10(std::max(least_step, std::numeric_limits<double>::min()))))};
    std::vector<std::int64_t> numbers = multiples(low, high, step, most);
    while (static_cast<int>(numbers.size()) > most || (numbers.empty() && value_of(step) < high - low)) {
        step = step.n == 1 ? Decimal{2, step.power} : step.n == 2 ? Decimal{5, step.power} : Decimal{1, step.power + 1};
        numbers = multiples(low, high, step, most);
    }
    if (numbers.size() < 2) {
        return single(numbers.empty() ? 0.5 * low + 0.5 * high : value_of({numbers[0], step.power}));
    }

    Ticks result;
    // An offset where labels would need more digits than people read at a glance.
    constexpr int readable_digits = 5;
    const int needed = std::max(n_digits(numbers.front()), n_digits(numbers.back()));
    const bool has_offset = needed > readable_digits;
    const std::int64_t offset = has_offset ? roundest(numbers.front(), numbers.back()) : 0;
    const std::int64_t largest = std::max(std::abs(numbers.front() - offset), std::abs(numbers.back() - offset));
    const int leading = n_digits(largest) - 1 + step.power;
    const bool is_plain = leading >= -3 && leading < readable_digits && -step.power <= readable_digits;
    result.exponent = is_plain ? 0 : leading;
    result.offset = value_of({offset, step.power});
    const int decimals = std::max(0, result.exponent - step.power);
    for (const std::int64_t n : numbers) {
        result.ticks.push_back(
            {value_of({n, step.power}), fixed_text({n - offset, step.power - result.exponent}, decimals, has_offset)});
    }
    if (result.exponent != 0) {
        result.scale = power_text(result.exponent);
    }
    if (has_offset) {
        result.scale.append(result.scale.empty() ? "" : " ").append(offset < 0 ? "− " : "+ ");
        result.scale.append(plain_text({std::abs(offset), step.power}));
    }
    return result;
}

Ticks logarithmic_ticks(double low, double high, int most) {
    if (!(0 < low && low < high) || !std::isfinite(high)) {
        return round_ticks(low, high, most);
    }
    const auto inside = [&](std::int64_t n, int power) { return low <= value_of({n, power}) && value_of({n, power}) <= high; };
    const int first = static_cast<int>(std::floor(std::log10(low))) - 1,
              last = static_cast<int>(std::ceil(std::log10(high))) + 1;
    std::vector<int> powers;
    for (int power = first; power <= last; ++power) {
        if (inside(1, power)) {
            powers.push_back(power);
        }
    }
    Ticks result;
    if (powers.size() >= 2) {
        const int stride = (static_cast<int>(powers.size()) + most - 1) / most;
        for (int power = first; power <= last; ++power) {
            if (inside(1, power)) {
                // Multiples of the stride: the same labels for ranges that differ a little.
                const bool has_label = ((power % stride) + stride) % stride == 0;
                result.ticks.push_back({value_of({1, power}), has_label ? "10" + superscript(power) : std::string()});
            }
            for (std::int64_t n = 2; stride == 1 && n < 10; ++n) {
                if (inside(n, power)) {
                    result.ticks.push_back({value_of({n, power}), {}});
                }
            }
        }
        return result;
    }
    for (int power = first; power <= last; ++power) {
        for (const std::int64_t n : {1, 2, 5}) {
            if (inside(n, power)) {
                result.ticks.push_back({value_of({n, power}), plain_text({n, power})});
            }
        }
    }
    return result.ticks.size() >= 2 ? result : round_ticks(low, high, most);
}

} // namespace elvis
