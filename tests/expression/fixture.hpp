/**
 * @file fixture.hpp
 * An element in closed form, curved, with fields p (scalar), u (vector) and others, for tests of expressions.
 */
#pragma once

#include <core/expression/evaluate.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace elvis::test {

inline FieldInfo field_info(const char* name, std::uint32_t n_components) {
    FieldInfo info;
    info.name = name;
    info.n_components = n_components;
    return info;
}

inline const std::vector<FieldInfo>& test_fields() {
    static const std::vector<FieldInfo> fields{field_info("p", 1), field_info("u", 3), field_info("heat flux", 1),
                                               field_info("jacobian", 1), field_info("v", 2)};
    return fields;
}

/** x_i = 1.2 xi_i + 0.1 sin(xi_{i+1} + 0.3 i) + 0.05 xi_{i+1} xi_{i+2}; fields sums of sines and products of xi, all positive.
 */
class CurvedPoint : public ExpressionPoint {
public:
    explicit CurvedPoint(const std::array<double, 3>& xi) : m_xi(xi) {}

    std::array<double, 3> position() override {
        std::array<double, 3> x{};
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] = 1.2 * m_xi[i] + 0.1 * std::sin(at(i + 1) + phase(i)) + 0.05 * at(i + 1) * at(i + 2);
        }
        return x;
    }
    std::array<double, 9> jacobian() override {
        std::array<double, 9> j{};
        for (std::size_t i = 0; i < 3; ++i) {
            j[3 * i + i] = 1.2;
            j[3 * i + (i + 1) % 3] = 0.1 * std::cos(at(i + 1) + phase(i)) + 0.05 * at(i + 2);
            j[3 * i + (i + 2) % 3] = 0.05 * at(i + 1);
        }
        return j;
    }
    std::array<double, 27> mapping_hessian() override {
        std::array<double, 27> m{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
            m[9 * i + 3 * a + a] = -0.1 * std::sin(at(i + 1) + phase(i));
            m[9 * i + 3 * a + b] = m[9 * i + 3 * b + a] = 0.05;
        }
        return m;
    }
    double value(std::uint32_t field, std::uint32_t component) override {
        const auto [a, b, c] = weights(field, component);
        return 3 + 0.3 * std::sin(a * m_xi[0]) * m_xi[1] + 0.2 * b * m_xi[1] * m_xi[2] + 0.3 * std::cos(c * m_xi[2] + m_xi[0]);
    }
    std::array<double, 3> gradient(std::uint32_t field, std::uint32_t component) override {
        const auto [a, b, c] = weights(field, component);
        const double s = -0.3 * std::sin(c * m_xi[2] + m_xi[0]);
        return {0.3 * a * std::cos(a * m_xi[0]) * m_xi[1] + s, 0.3 * std::sin(a * m_xi[0]) + 0.2 * b * m_xi[2],
                0.2 * b * m_xi[1] + c * s};
    }
    std::array<double, 9> hessian(std::uint32_t field, std::uint32_t component) override {
        const auto [a, b, c] = weights(field, component);
        const double s = -0.3 * std::cos(c * m_xi[2] + m_xi[0]), mixed = 0.3 * a * std::cos(a * m_xi[0]);
        return {-0.3 * a * a * std::sin(a * m_xi[0]) * m_xi[1] + s, mixed, c * s, mixed, 0, 0.2 * b, c * s, 0.2 * b, c * c * s};
    }
    double order(std::uint32_t field) override { return field == any_field ? 7 : field; }
    double element_number() override { return 42; }

private:
    double at(std::size_t i) const { return m_xi[i % 3]; }
    static double phase(std::size_t i) { return 0.3 * static_cast<double>(i); }
    static std::array<double, 3> weights(std::uint32_t field, std::uint32_t component) {
        const double k = field + 0.7 * component;
        return {1 + 0.3 * k, 1 - 0.2 * k, 0.5 + 0.25 * k};
    }
    std::array<double, 3> m_xi;
};

} // namespace elvis::test
