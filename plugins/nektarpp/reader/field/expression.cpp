#include "expression.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace nektarpp {

namespace {

struct Function {
    std::string_view name;
    double (*evaluate)(double);
};

constexpr Function functions[] = {{"abs", std::fabs},    {"sqrt", std::sqrt}, {"exp", std::exp},     {"log", std::log},
                                  {"log10", std::log10}, {"sin", std::sin},   {"cos", std::cos},     {"tan", std::tan},
                                  {"asin", std::asin},   {"acos", std::acos}, {"atan", std::atan},   {"sinh", std::sinh},
                                  {"cosh", std::cosh},   {"tanh", std::tanh}, {"floor", std::floor}, {"ceil", std::ceil}};

/** Recursive descent: sum of products of signed powers. */
class Parser {
public:
    explicit Parser(std::string_view text) : m_text(text) {}

    double parse() {
        const double value = sum();
        if (!at_end()) {
            fail("an operator or the end was expected");
        }
        if (!std::isfinite(value)) {
            throw std::invalid_argument("the value is not finite");
        }
        return value;
    }

private:
    /** Parentheses, signs and powers inside each other; far beyond any real file, far below what the stack holds. */
    static constexpr int deepest = 100;

    [[noreturn]] void fail(const std::string& what) const {
        throw std::invalid_argument("character " + std::to_string(m_at + 1) + ": " + what);
    }
    bool at_end() {
        m_at = std::min(m_text.find_first_not_of(" \t\r\n", m_at), m_text.size());
        return m_at == m_text.size();
    }
    bool take(char wanted) {
        if (at_end() || m_text[m_at] != wanted) {
            return false;
        }
        ++m_at;
        return true;
    }

    double sum() {
        double value = product();
        while (true) {
            if (take('+')) {
                value += product();
            } else if (take('-')) {
                value -= product();
            } else {
                return value;
            }
        }
    }

    double product() {
        double value = power();
        while (true) {
            if (take('*')) {
                value *= power();
            } else if (take('/')) {
                value /= power();
            } else {
                return value;
            }
        }
    }

    /** Signs bind weaker than powers: -2^2 is -4. */
    double power() {
        if (++m_depth > deepest) {
            fail("more than " + std::to_string(deepest) + " levels of nesting");
        }
        double value = 0;
        if (take('-')) {
            value = -power();
        } else if (take('+')) {
            value = power();
        } else {
            value = atom();
            if (take('^')) {
                value = std::pow(value, power());
            }
        }
        --m_depth;
        return value;
    }

    double atom() {
        if (take('(')) {
            return parenthesized();
        }
        if (at_end()) {
            fail("a number was expected");
        }
        double number = 0;
        const auto [end, error] = std::from_chars(m_text.data() + m_at, m_text.data() + m_text.size(), number);
        // from_chars also takes "inf" and "nan", which are names here.
        if (error == std::errc() && std::string_view("0123456789.").find(m_text[m_at]) != std::string_view::npos) {
            m_at = static_cast<std::size_t>(end - m_text.data());
            return number;
        }
        return named();
    }

    double parenthesized() {
        const double value = sum();
        if (!take(')')) {
            fail("')' was expected");
        }
        return value;
    }

    double named() {
        constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
        const std::size_t first = m_at;
        const std::string_view name =
            m_text.substr(first, std::min(m_text.find_first_not_of(letters, first), m_text.size()) - first);
        m_at += name.size();
        if (name == "PI") {
            return std::numbers::pi;
        }
        if (name == "E") {
            return std::numbers::e;
        }
        for (const Function& function : functions) {
            if (function.name == name && take('(')) {
                return function.evaluate(parenthesized());
            }
        }
        m_at = first;
        fail(name.empty() ? "a number was expected" : "'" + std::string(name) + "' is no constant or function known here");
    }

    std::string_view m_text;
    std::size_t m_at = 0;
    int m_depth = 0;
};

} // namespace

double evaluate_expression(const std::string& text) { return Parser(text).parse(); }

} // namespace nektarpp
