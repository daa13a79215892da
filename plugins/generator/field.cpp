#include "field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace generator {
namespace {

double power(double x, std::uint32_t n) {
    double result = 1;
    for (; n > 0; --n)
        result *= x;
    return result;
}

double polynomial(const std::vector<Term>& terms, const Vec3& x) {
    double sum = 0;
    for (const Term& term : terms)
        sum +=
            term.coefficient * power(x[0], term.exponents[0]) * power(x[1], term.exponents[1]) * power(x[2], term.exponents[2]);
    return sum;
}

// A number in [0, 1) for each element that differs much between neighbours: Knuth's multiplicative hash.
double offset(std::uint64_t element) { return static_cast<double>(element * 2654435761u % 4294967296u) / 4294967296.0; }

double sinc(double t) { return std::abs(t) < 1e-4 ? 1 - t * t / 6 : std::sin(t) / t; }

double norm(const Vec3& x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

// Taylor and Green's vortex: viscosity in F = exp(-2 nu t).
constexpr double viscosity = 0.05;

double waves(const Vec3& x) {
    const auto s = [&](std::size_t d) { return std::sin(3.5 * x[d]); };
    const auto c = [&](std::size_t d) { return std::cos(3.5 * x[d]); };
    return s(0) * c(1) + s(1) * c(2) + s(2) * c(0);
}

Field::Function function_of(FieldKind kind) {
    switch (kind) {
    case FieldKind::jump:
        return Field::Function::jump;
    case FieldKind::sinc:
        return Field::Function::sinc;
    case FieldKind::taylor_green:
        return Field::Function::velocity;
    case FieldKind::waves:
        return Field::Function::waves;
    case FieldKind::element:
        return Field::Function::element;
    case FieldKind::distance:
        return Field::Function::distance;
    default:
        return Field::Function::polynomial;
    }
}

} // namespace

std::optional<std::uint32_t> Field::degree() const {
    if (function == Function::element)
        return 0;
    if (function != Function::polynomial && function != Function::jump)
        return std::nullopt;
    std::uint32_t result = 0;
    for (const Term& term : terms)
        result = std::max(result, term.exponents[0] + term.exponents[1] + term.exponents[2]);
    return result;
}

std::array<std::uint32_t, 3> Field::degrees() const {
    std::array<std::uint32_t, 3> result{};
    for (const Term& term : terms)
        for (std::size_t d = 0; d < 3; ++d)
            result[d] = std::max(result[d], term.exponents[d]);
    return result;
}

void Field::evaluate(const Vec3& x, double time, std::uint64_t element, double* values) const {
    switch (function) {
    case Function::polynomial:
        values[0] = (1 + time) * polynomial(terms, x);
        return;
    case Function::jump:
        values[0] = (1 + time) * (polynomial(terms, x) + offset(element));
        return;
    case Function::sinc:
        values[0] = (1 + time) * sinc(2 * std::numbers::pi * norm(x));
        return;
    case Function::velocity: {
        const double f = std::exp(-2 * viscosity * time);
        values[0] = f * std::sin(x[0]) * std::cos(x[1]) * std::cos(x[2]);
        values[1] = -f * std::cos(x[0]) * std::sin(x[1]) * std::cos(x[2]);
        values[2] = 0;
        return;
    }
    case Function::pressure: {
        const double f = std::exp(-2 * viscosity * time);
        values[0] = f * f / 16 * (std::cos(2 * x[0]) + std::cos(2 * x[1])) * (std::cos(2 * x[2]) + 2);
        return;
    }
    case Function::waves:
        values[0] = (1 + time) * waves(x);
        return;
    case Function::element:
        values[0] = (1 + time) * static_cast<double>(element);
        return;
    case Function::distance:
        values[0] = (1 + time) * norm(x);
        return;
    }
}

std::vector<Field> make_fields(const std::vector<FieldParameters>& parameters) {
    const std::vector<Term> square{{{2, 0, 0}, 1}, {{0, 2, 0}, 1}, {{0, 0, 2}, 1}};
    std::vector<Field> fields;
    for (const FieldParameters& p : parameters) {
        Field field;
        field.name = p.name;
        field.function = function_of(p.kind);
        field.order = p.order;
        field.terms = p.kind == FieldKind::sphere || p.kind == FieldKind::jump ? square : p.terms;
        const bool jumps = p.kind == FieldKind::jump || p.kind == FieldKind::element;
        field.continuity = p.continuity.value_or(jumps ? ELVIS_CONTINUITY_DISCONTINUOUS : ELVIS_CONTINUITY_CONTINUOUS);
        if (p.kind == FieldKind::taylor_green) {
            const std::string prefix = p.name == "taylor-green" ? "" : p.name + "_";
            field.n_components = 3;
            field.name = prefix + "velocity";
            fields.push_back(field);
            field.n_components = 1;
            field.name = prefix + "pressure";
            field.function = Field::Function::pressure;
        }
        fields.push_back(field);
    }
    return fields;
}

} // namespace generator
