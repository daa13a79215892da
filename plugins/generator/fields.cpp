#include "fields.hpp"

#include <cassert>
#include <cmath>

namespace generator {

namespace {

using Position = std::array<double, 3>;

double radius(const Position& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

/** x^2 + y^2 + z^2 */
class Sphere : public AnalyticField {
public:
    std::string name() const override { return "sphere"; }
    std::optional<std::uint32_t> degree() const override { return 2; }
    void evaluate(const Position& x, std::uint64_t, double* f) const override {
        f[0] = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    }
};

/** Sum over i + j + k <= degree of (-1)^(i+j+k) x^i y^j z^k / (1 + i + 2 j + 3 k). */
class Polynomial : public AnalyticField {
public:
    explicit Polynomial(std::uint32_t degree) : m_degree(degree) {}
    std::string name() const override { return "polynomial"; }
    std::optional<std::uint32_t> degree() const override { return m_degree; }
    void evaluate(const Position& x, std::uint64_t, double* f) const override {
        double sum = 0;
        double power_x = 1;
        for (std::uint32_t i = 0; i <= m_degree; ++i, power_x *= -x[0]) {
            double power_y = 1;
            for (std::uint32_t j = 0; i + j <= m_degree; ++j, power_y *= -x[1]) {
                double power_z = 1;
                for (std::uint32_t k = 0; i + j + k <= m_degree; ++k, power_z *= -x[2]) {
                    sum += power_x * power_y * power_z / (1.0 + i + 2.0 * j + 3.0 * k);
                }
            }
        }
        f[0] = sum;
    }

private:
    std::uint32_t m_degree;
};

/** sin(6 r) / (6 r) */
class Sinc : public AnalyticField {
public:
    std::string name() const override { return "sinc"; }
    void evaluate(const Position& x, std::uint64_t, double* f) const override {
        const double s = 6 * radius(x);
        f[0] = s == 0 ? 1 : std::sin(s) / s;
    }
};

/** Velocity of the Taylor-Green vortex at time 0. */
class TaylorGreen : public AnalyticField {
public:
    std::string name() const override { return "taylor-green"; }
    std::uint32_t n_components() const override { return 3; }
    void evaluate(const Position& x, std::uint64_t, double* f) const override {
        f[0] = std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]);
        f[1] = -std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]);
        f[2] = 0;
    }
};

/** sin 3.5x cos 3.5y + sin 3.5y cos 3.5z + sin 3.5z cos 3.5x */
class Waves : public AnalyticField {
public:
    std::string name() const override { return "waves"; }
    void evaluate(const Position& x, std::uint64_t, double* f) const override {
        f[0] = std::sin(3.5 * x[0]) * std::cos(3.5 * x[1]) + std::sin(3.5 * x[1]) * std::cos(3.5 * x[2]) +
               std::sin(3.5 * x[2]) * std::cos(3.5 * x[0]);
    }
};

/** x + 0.3 (element mod 5): a slope with a jump at every face. */
class Jump : public AnalyticField {
public:
    std::string name() const override { return "jump"; }
    std::optional<std::uint32_t> degree() const override { return 1; }
    bool is_continuous() const override { return false; }
    void evaluate(const Position& x, std::uint64_t element, double* f) const override {
        f[0] = x[0] + 0.3 * static_cast<double>(element % 5);
    }
};

/** The element's number. */
class ElementNumber : public AnalyticField {
public:
    std::string name() const override { return "element"; }
    std::optional<std::uint32_t> degree() const override { return 0; }
    bool is_continuous() const override { return false; }
    void evaluate(const Position&, std::uint64_t element, double* f) const override { f[0] = static_cast<double>(element); }
};

/** |x| - 1: distance to the unit sphere, with a kink at the origin. */
class Distance : public AnalyticField {
public:
    std::string name() const override { return "distance"; }
    void evaluate(const Position& x, std::uint64_t, double* f) const override { f[0] = radius(x) - 1; }
};

} // namespace

const std::vector<std::string>& field_names() {
    static const std::vector<std::string> names = {"sphere", "polynomial", "sinc",    "taylor-green",
                                                   "waves",  "jump",       "element", "distance"};
    return names;
}

std::unique_ptr<const AnalyticField> make_field(const std::string& name, std::uint32_t degree) {
    if (name == "sphere") {
        return std::make_unique<Sphere>();
    }
    if (name == "polynomial") {
        return std::make_unique<Polynomial>(degree);
    }
    if (name == "sinc") {
        return std::make_unique<Sinc>();
    }
    if (name == "taylor-green") {
        return std::make_unique<TaylorGreen>();
    }
    if (name == "waves") {
        return std::make_unique<Waves>();
    }
    if (name == "jump") {
        return std::make_unique<Jump>();
    }
    if (name == "element") {
        return std::make_unique<ElementNumber>();
    }
    assert(name == "distance");
    return std::make_unique<Distance>();
}

} // namespace generator
