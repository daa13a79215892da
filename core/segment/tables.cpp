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

/**
 * Halfway between nodes, on both sides of the middle, close to 5/16 and 11/16 of the half circle: of all pairs those whose
 * misfit tells most surely how large the error is elsewhere, be it in the middle or towards an end
 * (tests/segment/fit_test.cpp).
 */
std::array<Angle, n_checks> checks(int degree) {
    const int gap = std::min((10 * degree + 8) / 32, (degree - 2) / 2);
    return {Angle{2 * gap + 1, 2 * degree}, Angle{2 * (degree - gap) - 1, 2 * degree}};
}

/** Largest value on the segment of the polynomial that is 1 at one check point and 0 at the other and at all nodes. */
Number largest_correction(const std::vector<Angle>& nodes, const Angle& one, const Angle& other) {
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
    return largest / std::abs(zeros(one.parameter()));
}

Level make_level(int degree, const std::vector<Angle>& samples, const std::array<Angle, n_checks>& points) {
    const std::vector<Angle> own = nodes(degree);
    const auto column = [&](const Angle& angle) {
        return static_cast<std::size_t>(std::find(samples.begin(), samples.end(), angle) - samples.begin());
    };
    Level level;
    level.degree = degree;
    for (int k = 0; k <= degree; ++k) {
        const Number scale = static_cast<Number>(2 - (k == 0 ? 1 : 0) - (k == degree ? 1 : 0)) / static_cast<Number>(degree);
        level.fit.emplace_back(samples.size(), 0.0);
        for (std::size_t i = 0; i < own.size(); ++i) {
            const bool is_end = i < 2;
            level.fit.back()[column(own[i])] = static_cast<double>((is_end ? scale / 2 : scale) * own[i].chebyshev(k));
            level.n_samples = std::max(level.n_samples, static_cast<int>(column(own[i])) + 1);
        }
    }
    for (std::size_t i = 0; i < n_checks; ++i) {
        const Number gain = largest_correction(own, points[i], points[n_checks - 1 - i]);
        std::vector<double>& row = level.misfit[i];
        row.resize(samples.size());
        for (std::size_t sample = 0; sample < samples.size(); ++sample) {
            Number value = 0;
            for (int k = 0; k <= degree; ++k) {
                value += level.fit[static_cast<std::size_t>(k)][sample] * points[i].chebyshev(k);
            }
            row[sample] = static_cast<double>(-gain * value);
        }
        row[column(points[i])] = static_cast<double>(gain);
        level.n_samples = std::max(level.n_samples, static_cast<int>(column(points[i])) + 1);
    }
    return level;
}

SamplePlan make_plan(const std::vector<std::pair<int, std::array<Angle, n_checks>>>& degrees) {
    SamplePlan plan;
    plan.degree = degrees.back().first;
    std::vector<Angle> samples;
    const auto add = [&](const auto& angles) {
        for (const Angle& angle : angles) {
            if (std::find(samples.begin(), samples.end(), angle) == samples.end()) {
                samples.push_back(angle);
            }
        }
    };
    for (const auto& [degree, points] : degrees) {
        add(nodes(degree));
        add(points);
    }
    for (const auto& [degree, points] : degrees) {
        plan.levels.push_back(make_level(degree, samples, points));
    }
    for (const Angle& angle : samples) {
        plan.parameters.push_back(static_cast<double>(angle.parameter()));
    }
    return plan;
}

/** An array of arrays, whose sizes are given from the outermost to the innermost; the numbers of the innermost stand together.
 */
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

SamplePlan nested_plan() {
    // Those of degree 8 serve all: no node of any, and never more than a third of a gap from where the first neglected term is
    // largest.
    return make_plan({{2, checks(8)}, {4, checks(8)}, {8, checks(8)}});
}

SamplePlan fixed_plan(int degree) {
    assert(degree >= 2 && degree <= max_degree);
    return make_plan({{degree, checks(degree)}});
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
                sum += ((k - i) % 2 == 0 ? 1 : -1) * doubled[static_cast<std::size_t>(2 * i)] *
                       rest[static_cast<std::size_t>(j - i)];
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
    const int size = plan.degree + 1, n_levels = static_cast<int>(plan.levels.size());
    const int n_samples = static_cast<int>(plan.parameters.size());
    std::vector<double> fits, misfits;
    std::string degrees, counts;
    for (const Level& level : plan.levels) {
        for (const std::vector<double>& row : level.fit) {
            fits.insert(fits.end(), row.begin(), row.end());
        }
        // Lower degrees are filled with zeros, so that one loop serves all.
        fits.resize(fits.size() + static_cast<std::size_t>((plan.degree - level.degree) * n_samples), 0.0);
        for (const std::vector<double>& row : level.misfit) {
            misfits.insert(misfits.end(), row.begin(), row.end());
        }
        const char* const separator = degrees.empty() ? "" : ", ";
        degrees.append(separator).append(std::to_string(level.degree)).append("u");
        counts.append(separator).append(std::to_string(level.n_samples)).append("u");
    }
    const std::string levels = std::to_string(n_levels);
    return "#define CORE_FIT_DEGREE " + std::to_string(plan.degree) + "\n#define CORE_FIT_LEVELS " + levels +
           "\n#define CORE_FIT_CHECKS " + std::to_string(n_checks) + "\n#define CORE_FIT_SAMPLES " + std::to_string(n_samples) +
           "\nconst uint core_fit_degrees[" + levels + "] = {" + degrees + "};\nconst uint core_fit_counts[" + levels +
           "] = {" + counts + "};\n" + array("core_fit_parameters", {n_samples}, plan.parameters) +
           array("core_fit_fits", {n_levels, size, n_samples}, fits) +
           array("core_fit_misfits", {n_levels, n_checks, n_samples}, misfits) +
           array("core_fit_bernstein", {size, size}, bernstein_of_chebyshev(plan.degree)) +
           array("core_fit_growth", {size}, bernstein_growth(plan.degree)) +
           array("core_fit_binomials", {size}, binomials(plan.degree));
}

} // namespace elvis::segment
