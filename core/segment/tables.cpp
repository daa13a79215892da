#include <core/segment/tables.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

namespace elvis::segment {

namespace {

/** Long double: the tables are exact to the last place of double. */
using Number = long double;

std::size_t at(int row, int n_columns, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_columns) + static_cast<std::size_t>(column);
}

/** An angle of pi numerator / denominator; the parameter is (1 - cos angle) / 2. */
struct Angle {
    int numerator = 0, denominator = 1;

    bool operator==(const Angle& other) const { return numerator * other.denominator == other.numerator * denominator; }
    /** cos(k (pi - angle)), which is T_k(2 t - 1). */
    Number chebyshev(int k) const {
        const int turned = k * (denominator - numerator) % (2 * denominator);
        return std::cos(std::numbers::pi_v<Number> * static_cast<Number>(turned) / static_cast<Number>(denominator));
    }
    Number parameter() const {
        const Number half_sine =
            std::sin(std::numbers::pi_v<Number> * static_cast<Number>(numerator) / static_cast<Number>(2 * denominator));
        return half_sine * half_sine;
    }
};

/** Ends first, then the middle if it is a node. */
std::vector<Angle> nodes(int degree) {
    std::vector<Angle> result{{0, degree}, {degree, degree}};
    if (degree % 2 == 0) {
        result.push_back({degree / 2, degree});
    }
    for (int j = 1; j < degree; ++j) {
        if (2 * j != degree) {
            result.push_back({j, degree});
        }
    }
    return result;
}

/** One near the middle, where the first neglected term is largest, and one towards the other end, where others may be. */
std::array<Angle, n_checks> checks(int degree) {
    return {Angle{2 * ((degree - 1) / 2) + 1, 2 * degree}, Angle{2 * (3 * degree / 4) + 1, 2 * degree}};
}

/** Largest value on the segment of the polynomial that is 1 at one check point and 0 at the other and at all nodes. */
double largest_correction(const std::vector<Angle>& nodes, const Angle& one, const Angle& other) {
    const auto zeros = [&](Number t) {
        Number product = t - other.parameter();
        for (const Angle& node : nodes) {
            product *= t - node.parameter();
        }
        return product;
    };
    // Dense enough for the last digits not to matter: the gain is multiplied with an estimate.
    constexpr int n_points = 4096;
    Number largest = 0;
    for (int i = 0; i <= n_points; ++i) {
        largest = std::max(largest, std::abs(zeros(static_cast<Number>(i) / n_points)));
    }
    return static_cast<double>(largest / std::abs(zeros(one.parameter())));
}

Level make_level(int degree, const std::vector<Angle>& samples) {
    Level level;
    level.degree = degree;
    const std::vector<Angle> own(samples.begin(), samples.begin() + degree + 1);
    for (int k = 0; k <= degree; ++k) {
        const Number scale = static_cast<Number>(2 - (k == 0 ? 1 : 0) - (k == degree ? 1 : 0)) / static_cast<Number>(degree);
        for (std::size_t i = 0; i < own.size(); ++i) {
            const bool is_end = i < 2;
            level.fit.push_back(static_cast<double>((is_end ? scale / 2 : scale) * own[i].chebyshev(k)));
        }
    }
    const std::array<Angle, n_checks> points = checks(degree);
    for (const Angle& point : points) {
        for (int k = 0; k <= degree; ++k) {
            level.check.push_back(static_cast<double>(point.chebyshev(k)));
        }
    }
    level.gain = {largest_correction(own, points[0], points[1]), largest_correction(own, points[1], points[0])};
    return level;
}

SamplePlan make_plan(const std::vector<int>& degrees) {
    SamplePlan plan;
    plan.degree = degrees.back();
    std::vector<Angle> samples;
    const auto add = [&](const auto& angles) {
        for (const Angle& angle : angles) {
            if (std::find(samples.begin(), samples.end(), angle) == samples.end()) {
                samples.push_back(angle);
            }
        }
    };
    for (const int degree : degrees) {
        add(nodes(degree));
        assert(samples.size() == static_cast<std::size_t>(degree + 1));
        plan.levels.push_back(make_level(degree, samples));
        add(checks(degree));
    }
    for (const Angle& angle : samples) {
        plan.parameters.push_back(static_cast<double>(angle.parameter()));
    }
    return plan;
}

/** An array of arrays, whose sizes are given from the outermost to the innermost; the numbers of the innermost stand together. */
std::string array(const std::string& name, const std::vector<int>& sizes, const std::vector<double>& numbers) {
    std::string type = "elvis_real";
    for (const int size : sizes) {
        type.append("[").append(std::to_string(size)).append("]");
    }
    const std::function<std::string(std::size_t, std::size_t, std::size_t)> list = [&](std::size_t dimension, std::size_t first,
                                                                                       std::size_t count) {
        if (dimension == sizes.size()) {
            char number[48];
            std::snprintf(number, sizeof(number), "elvis_real(%.17eLF)", numbers[first]);
            return std::string(number);
        }
        const auto size = static_cast<std::size_t>(sizes[dimension]);
        std::string text = "{";
        for (std::size_t i = 0; i < size; ++i) {
            text.append(i == 0 ? "" : ", ").append(list(dimension + 1, first + i * (count / size), count / size));
        }
        return text.append("}");
    };
    std::string text = "const ";
    return text.append(type).append(" ").append(name).append(" = ").append(list(0, 0, numbers.size())).append(";\n");
}

} // namespace

SamplePlan nested_plan(int degree) {
    assert(degree == 2 || degree == 4 || degree == 8);
    std::vector<int> degrees;
    for (int n = 2; n <= degree; n *= 2) {
        degrees.push_back(n);
    }
    return make_plan(degrees);
}

SamplePlan fixed_plan(int degree) {
    assert(degree >= 2 && degree <= max_degree);
    return make_plan({degree});
}

std::vector<double> binomials(int n) {
    std::vector<double> row{1};
    for (int i = 1; i <= n; ++i) {
        row.push_back(row.back() * static_cast<double>(n - i + 1) / static_cast<double>(i));
    }
    return row;
}

std::vector<double> bernstein_of_chebyshev(int n) {
    std::vector<double> matrix(at(n + 1, n + 1, 0));
    const std::vector<double> row = binomials(n);
    for (int k = 0; k <= n; ++k) {
        const std::vector<double> doubled = binomials(2 * k), rest = binomials(n - k);
        for (int j = 0; j <= n; ++j) {
            // Whole numbers below 2^53: exact.
            double sum = 0;
            for (int i = std::max(0, j + k - n); i <= std::min(j, k); ++i) {
                sum += ((k - i) % 2 == 0 ? 1 : -1) * doubled[static_cast<std::size_t>(2 * i)] * rest[static_cast<std::size_t>(j - i)];
            }
            matrix[at(j, n + 1, k)] = sum / row[static_cast<std::size_t>(j)];
        }
    }
    return matrix;
}

std::vector<double> bernstein_growth(int n) {
    const std::vector<double> matrix = bernstein_of_chebyshev(n);
    std::vector<double> growth(static_cast<std::size_t>(n + 1), 0.0);
    for (int j = 0; j <= n; ++j) {
        for (int k = 0; k <= n; ++k) {
            double& largest = growth[static_cast<std::size_t>(k)];
            largest = std::max(largest, std::abs(matrix[at(j, n + 1, k)]));
        }
    }
    return growth;
}

std::string segment_glsl(const SamplePlan& plan) {
    // Rows of lower degrees are filled with zeros, so that one loop serves all.
    const int size = plan.degree + 1;
    const int n_levels = static_cast<int>(plan.levels.size());
    std::vector<double> fit(at(n_levels, size * size, 0), 0.0), check(at(n_levels, n_checks * size, 0), 0.0), gain;
    std::string degrees;
    for (int l = 0; l < n_levels; ++l) {
        const Level& level = plan.levels[static_cast<std::size_t>(l)];
        const int own = level.degree + 1;
        for (int row = 0; row < own; ++row) {
            std::copy_n(&level.fit[at(row, own, 0)], own, &fit[at(l * size + row, size, 0)]);
        }
        for (int row = 0; row < n_checks; ++row) {
            std::copy_n(&level.check[at(row, own, 0)], own, &check[at(l * n_checks + row, size, 0)]);
        }
        gain.insert(gain.end(), level.gain.begin(), level.gain.end());
        degrees += (l == 0 ? "" : ", ") + std::to_string(level.degree) + "u";
    }
    const std::string levels = std::to_string(n_levels);
    return "#define CORE_SEGMENT_DEGREE " + std::to_string(plan.degree) + "\n#define CORE_SEGMENT_LEVELS " + levels +
           "\nconst uint core_segment_degrees[" + levels + "] = uint[" + levels + "](" + degrees + ");\n" +
           array("core_segment_parameters", {size + n_checks}, plan.parameters) +
           array("core_segment_fits", {n_levels, size, size}, fit) +
           array("core_segment_checks", {n_levels, n_checks, size}, check) +
           array("core_segment_gains", {n_levels, n_checks}, gain) +
           array("core_segment_bernstein", {size, size}, bernstein_of_chebyshev(plan.degree)) +
           array("core_segment_growth", {size}, bernstein_growth(plan.degree)) +
           array("core_segment_binomials", {size}, binomials(plan.degree));
}

} // namespace elvis::segment
