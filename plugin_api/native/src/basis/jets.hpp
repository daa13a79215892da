/**
 * @file jets.hpp
 * The one-dimensional polynomials behind the device spaces, for numbers and for functions of one variable with two derivatives.
 */
#pragma once

namespace elvis::native::device {

/** A function's value and first two derivatives at one point. */
struct Jet {
    double value = 0, first = 0, second = 0;
};

inline Jet operator+(const Jet& a, const Jet& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
inline Jet operator-(const Jet& a, const Jet& b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }
inline Jet operator+(double a, const Jet& b) { return {a + b.value, b.first, b.second}; }
inline Jet operator-(double a, const Jet& b) { return {a - b.value, -b.first, -b.second}; }
inline Jet operator*(double a, const Jet& b) { return {a * b.value, a * b.first, a * b.second}; }
inline Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value, a.first * b.value + a.value * b.first,
            a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}

template <class Number> Number constant(double value) {
    Number number{};
    return value + number;
}

/** P_n^{a,0}(z), Abramowitz & Stegun 22.7.1. */
template <class Number> Number jacobi(int a, int n, const Number& z) {
    Number before = constant<Number>(0);
    Number now = constant<Number>(1);
    for (int i = 0; i < n; ++i) {
        const double s = 2 * i + a;
        const double divisor = 2 * (i + 1.0) * (i + a + 1.0) * s;
        // a = 0, i = 0 would divide 0 by 0: P_1 = z.
        const Number next = s == 0 ? z
                                   : ((s + 1) / divisor) * ((double(a) * a + s * (s + 2) * z) * now) -
                                         (2.0 * (i + a) * i * (s + 2) / divisor) * before;
        before = now;
        now = next;
    }
    return now;
}

/** P_n^{1,1}(z), Abramowitz & Stegun 22.7.1. */
template <class Number> Number jacobi_11(int n, const Number& z) {
    Number before = constant<Number>(0);
    Number now = constant<Number>(1);
    for (int i = 0; i < n; ++i) {
        const Number next = ((i + 2) / ((i + 1.0) * (i + 3.0))) * (((2 * i + 3) * z) * now - double(i + 1) * before);
        before = now;
        now = next;
    }
    return now;
}

/** z^n. */
template <class Number> Number power(const Number& z, int n) {
    Number result = constant<Number>(1);
    for (int i = 0; i < n; ++i)
        result = result * z;
    return result;
}

} // namespace elvis::native::device
