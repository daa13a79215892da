#include <core/annotation/ticks.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace elvis;

namespace {

/** A label as people read it. */
long double read(const std::string& label) {
    std::string text = label;
    const std::string minus = "−";
    if (text.compare(0, minus.size(), minus) == 0) {
        text.replace(0, minus.size(), "-");
    }
    return std::stold(text);
}

/** The step's first digit, or 0 where it is not one digit and zeros. */
int first_digit(long double step) {
    const long double power = std::pow(10.0L, std::floor(std::log10(step * (1 + 1e-9L))));
    const long double digit = step / power;
    // Ticks are doubles: a step of numbers 1e5 times as large is known to about 1e-10.
    return std::abs(digit - std::round(digit)) < 1e-6L ? static_cast<int>(std::lround(digit)) : 0;
}

} // namespace

TEST_CASE("ticks are round, inside the range, and labels say their values") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> mantissa(-1, 1), magnitude(-12, 12), tightness(0, 5);
    std::uniform_int_distribution<int> count(2, 12);
    int without_choice = 0;
    for (int repetition = 0; repetition < 20000; ++repetition) {
        const double middle = mantissa(random) * std::pow(10.0, magnitude(random));
        const double half = std::abs(middle) * std::pow(10.0, 1 - tightness(random)) + 1e-300;
        const double low = middle - half, high = middle + half;
        const int most = count(random);
        const Ticks axis = round_ticks(low, high, most);
        INFO(low << " to " << high << ", at most " << most);
        REQUIRE(!axis.ticks.empty());
        REQUIRE(static_cast<int>(axis.ticks.size()) <= most);
        without_choice += axis.ticks.size() < 2 ? 1 : 0;
        for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
            const Tick& tick = axis.ticks[i];
            REQUIRE(tick.value >= low);
            REQUIRE(tick.value <= high);
            if (axis.ticks.size() > 1) {
                const long double said = read(tick.label) * std::pow(10.0L, axis.exponent) + axis.offset;
                // What is left is the rounding of the tick and of the offset, to doubles.
                REQUIRE(std::abs(said - tick.value) <= 3e-16L * (std::abs(tick.value) + std::abs(axis.offset)));
            }
            if (i > 0) {
                const long double step = static_cast<long double>(tick.value) - axis.ticks[i - 1].value;
                REQUIRE(step > 0);
                const int digit = first_digit(step);
                REQUIRE((digit == 1 || digit == 2 || digit == 5));
                // A tick is an integer times the step.
                REQUIRE(std::abs(tick.value / step - std::round(tick.value / step)) < 1e-4L);
            }
            // A minus sign takes three bytes.
            REQUIRE((axis.ticks.size() == 1 || tick.label.size() <= 11));
        }
    }
    // Of two ticks at most, or three, there may be only one; from four on always two.
    CHECK(without_choice < 20000 / 10);
}

TEST_CASE("four ticks and more leave at least two") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1, 1);
    for (int repetition = 0; repetition < 5000; ++repetition) {
        const double low = place(random), high = low + std::abs(place(random)) + 1e-3;
        REQUIRE(round_ticks(low, high, 5).ticks.size() >= 2);
    }
}

TEST_CASE("a tight range is written as differences from a round number") {
    const Ticks axis = round_ticks(101324, 101326, 6);
    CHECK(axis.offset == 101325);
    CHECK(axis.exponent == 0);
    CHECK(axis.scale == "+ 101325");
    REQUIRE(axis.ticks.size() == 5);
    CHECK(axis.ticks[0].label == "−1.0");
    CHECK(axis.ticks[2].label == "0.0");
    CHECK(axis.ticks[4].label == "+1.0");
    const Ticks tighter = round_ticks(-101325.00001, -101324.99999, 6);
    CHECK(tighter.scale == "×10⁻⁵ − 101325");
    CHECK(tighter.ticks.back().label == "+1.0");
}

TEST_CASE("labels have as many digits as they need, and powers of ten where plain numbers are long") {
    const auto labels = [](double low, double high, int most) {
        std::string all;
        const Ticks axis = round_ticks(low, high, most);
        for (const Tick& tick : axis.ticks) {
            all += tick.label + " ";
        }
        return all + axis.scale;
    };
    CHECK(labels(0, 1, 6) == "0.0 0.2 0.4 0.6 0.8 1.0 ");
    CHECK(labels(0, 10, 6) == "0 2 4 6 8 10 ");
    CHECK(labels(300, 301, 6) == "300.0 300.2 300.4 300.6 300.8 301.0 ");
    CHECK(labels(0, 2e6, 5) == "0.0 0.5 1.0 1.5 2.0 ×10⁶");
    CHECK(labels(-2e-5, 1e-5, 4) == "−2 −1 0 1 ×10⁻⁵");
    CHECK(labels(0, 40000, 5) == "0 10000 20000 30000 40000 ");
    CHECK(labels(0.001, 0.005, 5) == "0.001 0.002 0.003 0.004 0.005 ");
}

TEST_CASE("ranges at the limits of double precision do no harm") {
    constexpr double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [low, high] : std::vector<std::pair<double, double>>{{-huge, huge},
                                                                          {0, huge},
                                                                          {0, tiny},
                                                                          {-tiny, tiny},
                                                                          {1, std::nextafter(1.0, 2.0)},
                                                                          {1e300, std::nextafter(1e300, infinity)},
                                                                          {2.5, 2.5},
                                                                          {0, 0},
                                                                          {3, 2},
                                                                          {-infinity, 1},
                                                                          {std::nan(""), 1}}) {
        const Ticks axis = round_ticks(low, high, 8);
        CHECK(axis.ticks.size() <= 8);
        for (const Tick& tick : axis.ticks) {
            CHECK((tick.value >= low && tick.value <= high));
            CHECK(!tick.label.empty());
        }
    }
    CHECK(round_ticks(2.5, 2.5, 8).ticks.at(0).label == "2.5");
    CHECK(round_ticks(0, 0, 8).ticks.at(0).label == "0");
    CHECK(round_ticks(-1.5e12, -1.5e12, 8).ticks.at(0).label == "−1.5×10¹²");
}

TEST_CASE("a logarithmic scale has powers of ten, and what is between them where there is room") {
    const Ticks two = logarithmic_ticks(0.5, 300, 8);
    std::string labels;
    std::vector<double> values;
    for (const Tick& tick : two.ticks) {
        labels += tick.label.empty() ? "" : tick.label + " ";
        values.push_back(tick.value);
    }
    CHECK(labels == "10⁰ 10¹ 10² ");
    CHECK(values == std::vector<double>{0.5, 0.6, 0.7, 0.8, 0.9, 1,  2,  3,  4,  5,  6,   7,   8,
                                        9,   10,  20,  30,  40,  50, 60, 70, 80, 90, 100, 200, 300});
    const Ticks many = logarithmic_ticks(1e-12, 1e9, 6);
    int n_labels = 0;
    for (const Tick& tick : many.ticks) {
        n_labels += tick.label.empty() ? 0 : 1;
    }
    CHECK((n_labels >= 4 && n_labels <= 6));
    CHECK(many.ticks.size() == 22);
    // Not enough powers: numbers that are round in another way, all with labels.
    const Ticks one = logarithmic_ticks(0.15, 0.9, 8);
    REQUIRE(one.ticks.size() == 2);
    CHECK((one.ticks[0].label == "0.2" && one.ticks[1].label == "0.5"));
    const Ticks none = logarithmic_ticks(101, 104, 8);
    CHECK(none.ticks.size() >= 2);
    for (const Tick& tick : none.ticks) {
        CHECK_FALSE(tick.label.empty());
    }
    CHECK_FALSE(logarithmic_ticks(1e-320, 1e308, 8).ticks.empty());
    CHECK_FALSE(logarithmic_ticks(-1, 1, 8).ticks.empty());
}
