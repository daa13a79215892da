#include <core/base/plot_ticks.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

std::vector<double> plot_ticks(double lower, double upper, bool is_logarithmic) {
    std::vector<double> ticks;
    if (is_logarithmic) {
        const int first = static_cast<int>(std::floor(std::log10(lower)));
        const int last = static_cast<int>(std::ceil(std::log10(upper)));
        // 2 and 5 in between where decades are few; no more than about ten labels.
        const int step = std::max(1, (last - first + 9) / 10);
        for (int power = first; power <= last; power += step) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double tick = digit * std::pow(10.0, power);
                if ((digit == 1 || last - first <= 4) && tick >= lower * (1 - 1e-9) && tick <= upper * (1 + 1e-9)) {
                    ticks.push_back(tick);
                }
            }
        }
        return ticks;
    }
    const double rough = (upper - lower) / 6;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double step = power * (rough < 1.5 * power ? 1 : rough < 3 * power ? 2 : rough < 7 * power ? 5 : 10);
    for (double index = std::ceil(lower / step - 1e-9); index * step <= upper * (1 + 1e-12); ++index) {
        ticks.push_back(index * step + 0.0); // no negative zero
    }
    return ticks;
}

} // namespace elvis
