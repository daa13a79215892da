#include "roots.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

class Search {
public:
    Search(const RealFunction& function, double level) : m_function(function), m_level(level) {}

    // Of a change of sign between two points.
    double bisect(double low, double high, bool is_low_positive) const {
        for (int i = 0; i < 60 && low < high; ++i) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high)
                break;
            ((value(middle) > 0) == is_low_positive ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    // Golden-section search for the least of sign * function, until it is negative or the width is rounding.
    Roots::NearMiss least(double low, double high, double sign) const {
        constexpr double golden = 0.6180339887498949;
        // Around an extreme values differ by the square of the width.
        const double width = 1e-9 * (1 + std::abs(low));
        double a = high - golden * (high - low), b = low + golden * (high - low);
        double at_a = sign * value(a), at_b = sign * value(b);
        while (high - low > width && at_a > 0 && at_b > 0) {
            if (at_a < at_b) {
                high = b;
                b = a;
                at_b = at_a;
                a = high - golden * (high - low);
                at_a = sign * value(a);
            } else {
                low = a;
                a = b;
                at_a = at_b;
                b = low + golden * (high - low);
                at_b = sign * value(b);
            }
        }
        return at_a < at_b ? Roots::NearMiss{a, sign * at_a} : Roots::NearMiss{b, sign * at_b};
    }

private:
    double value(double s) const { return m_function(s) - m_level; }

    const RealFunction& m_function;
    double m_level;
};

} // namespace

Roots find_roots(const RealFunction& function, double level, std::span<const double> points, std::span<const double> values) {
    const Search search(function, level);
    const std::size_t last = points.size() - 1;
    Roots roots;
    for (std::size_t i = 0; i <= last; ++i) {
        const bool is_positive = values[i] > 0;
        const auto differs = [&](std::size_t other) { return (values[other] > 0) != is_positive; };
        if (i < last && differs(i + 1)) {
            roots.at.push_back(search.bisect(points[i], points[i + 1], is_positive));
            continue;
        }
        if (i > 0 && differs(i - 1))
            continue;
        // An extreme towards zero, at an end of the points perhaps.
        const double size = std::abs(values[i]);
        const double before = i > 0 ? std::abs(values[i - 1]) : std::numeric_limits<double>::infinity();
        const double after = i < last ? std::abs(values[i + 1]) : std::numeric_limits<double>::infinity();
        if (size > before || size > after)
            continue;
        const double bend = std::max(i > 0 ? before - size : 0, i < last ? after - size : 0);
        if (size > 4 * bend) {
            roots.near_misses.push_back({points[i], values[i]});
            continue;
        }
        const double low = points[i > 0 ? i - 1 : i], high = points[i < last ? i + 1 : i];
        const Roots::NearMiss extreme = search.least(low, high, is_positive ? 1 : -1);
        if ((extreme.value > 0) == is_positive && extreme.value != 0) {
            roots.near_misses.push_back(extreme);
        } else {
            roots.at.push_back(search.bisect(low, extreme.at, is_positive));
            roots.at.push_back(search.bisect(extreme.at, high, !is_positive));
        }
    }
    std::sort(roots.at.begin(), roots.at.end());
    return roots;
}

Roots find_close_roots(const RealFunction& function, double level, std::span<const double> points,
                       std::span<const double> values) {
    Roots roots = find_roots(function, level, points, values);
    const Search search(function, level);
    const auto changes = [&](std::size_t i) { return (values[i] > 0) != (values[i + 1] > 0); };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const bool is_beside = (i > 0 && changes(i - 1)) || (i + 2 < points.size() && changes(i + 1));
        if (changes(i) || !is_beside)
            continue;
        const bool is_positive = values[i] > 0;
        const Roots::NearMiss extreme = search.least(points[i], points[i + 1], is_positive ? 1 : -1);
        if ((extreme.value > 0) != is_positive) {
            roots.at.push_back(search.bisect(points[i], extreme.at, is_positive));
            roots.at.push_back(search.bisect(extreme.at, points[i + 1], !is_positive));
        }
    }
    std::sort(roots.at.begin(), roots.at.end());
    // Pairs that were found already.
    const double same = 1e-12 * (points.back() - points.front());
    const auto repeats =
        std::unique(roots.at.begin(), roots.at.end(), [same](double one, double other) { return other - one <= same; });
    roots.at.erase(repeats, roots.at.end());
    return roots;
}

} // namespace elvis::oracle
