#include "formula.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>

namespace elvis::oracle {
namespace {

/** Each rule returns nothing where the text does not follow it. */
class Parser {
public:
    explicit Parser(std::string_view text) : m_text(text) {}

    std::optional<Formula> all() {
        std::optional<Formula> formula = sum();
        return next() == '\0' ? formula : std::nullopt;
    }

private:
    char next() {
        while (m_at < m_text.size() && std::isspace(static_cast<unsigned char>(m_text[m_at])) != 0)
            ++m_at;
        return m_at < m_text.size() ? m_text[m_at] : '\0';
    }
    bool take(char wanted) {
        const bool is_there = next() == wanted;
        m_at += is_there ? 1 : 0;
        return is_there;
    }

    std::optional<Formula> sum() {
        std::optional<Formula> left = product();
        while (left && (next() == '+' || next() == '-')) {
            const double sign = m_text[m_at++] == '+' ? 1 : -1;
            const std::optional<Formula> right = product();
            if (!right)
                return {};
            left = [a = *left, b = *right, sign](const Vector& x) {
                const Slope u = a(x), v = b(x);
                return Slope{u.value + sign * v.value, u.gradient + sign * v.gradient};
            };
        }
        return left;
    }

    std::optional<Formula> product() {
        std::optional<Formula> left = signed_power();
        while (left && take('*')) {
            const std::optional<Formula> right = signed_power();
            if (!right)
                return {};
            left = [a = *left, b = *right](const Vector& x) {
                const Slope u = a(x), v = b(x);
                return Slope{u.value * v.value, u.value * v.gradient + v.value * u.gradient};
            };
        }
        return left;
    }

    /** -x^2 is -(x^2). */
    std::optional<Formula> signed_power() {
        if (!take('-'))
            return power();
        const std::optional<Formula> inner = signed_power();
        if (!inner)
            return {};
        return [a = *inner](const Vector& x) {
            const Slope u = a(x);
            return Slope{-u.value, -u.gradient};
        };
    }

    std::optional<Formula> power() {
        std::optional<Formula> base = atom();
        if (!base || !take('^'))
            return base;
        const std::optional<double> exponent = number();
        if (!exponent || *exponent < 1 || *exponent != std::floor(*exponent) || next() == '^')
            return {};
        return [a = *base, n = *exponent](const Vector& x) {
            const Slope u = a(x);
            return Slope{std::pow(u.value, n), n * std::pow(u.value, n - 1) * u.gradient};
        };
    }

    std::optional<Formula> atom() {
        if (take('(')) {
            std::optional<Formula> inner = sum();
            return take(')') ? inner : std::nullopt;
        }
        if (std::isalpha(static_cast<unsigned char>(next())) != 0)
            return named();
        const std::optional<double> constant = number();
        if (!constant)
            return {};
        return [c = *constant](const Vector&) { return Slope{c, Vector::Zero()}; };
    }

    std::optional<double> number() {
        if (std::isdigit(static_cast<unsigned char>(next())) == 0)
            return {};
        const std::string rest(m_text.substr(m_at));
        char* end = nullptr;
        const double value = std::strtod(rest.c_str(), &end);
        m_at += static_cast<std::size_t>(end - rest.c_str());
        return value;
    }

    std::optional<Formula> named() {
        std::string name;
        while (m_at < m_text.size() && std::isalnum(static_cast<unsigned char>(m_text[m_at])) != 0)
            name += m_text[m_at++];
        if (name == "x" || name == "y" || name == "z")
            return [d = name[0] - 'x'](const Vector& x) { return Slope{x[d], Vector::Unit(d)}; };
        if (!take('('))
            return {};
        const std::optional<Formula> inner = sum();
        if (!inner || !take(')'))
            return {};
        if (name == "sin")
            return [a = *inner](const Vector& x) {
                const Slope u = a(x);
                return Slope{std::sin(u.value), std::cos(u.value) * u.gradient};
            };
        if (name == "cos")
            return [a = *inner](const Vector& x) {
                const Slope u = a(x);
                return Slope{std::cos(u.value), -std::sin(u.value) * u.gradient};
            };
        if (name == "exp")
            return [a = *inner](const Vector& x) {
                const Slope u = a(x);
                return Slope{std::exp(u.value), std::exp(u.value) * u.gradient};
            };
        return {};
    }

    std::string_view m_text;
    std::size_t m_at = 0;
};

} // namespace

std::optional<Formula> parse_formula(std::string_view text) { return Parser(text).all(); }

} // namespace elvis::oracle
