#include "lattice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace elvis::lattice {

namespace {

/** Of sums of some thirty products: far more than they are off. */
constexpr double rounding = 1e-13;

/** From values at -1, 0, 1 to coefficients of 1, t, t^2; `stride` numbers apart. */
void to_coefficients(double* values, std::size_t stride) {
    const double low = values[0], middle = values[stride], high = values[2 * stride];
    values[0] = middle;
    values[stride] = 0.5 * (high - low);
    values[2 * stride] = 0.5 * (high + low) - middle;
}

} // namespace

QuadraticBounds bounds_of(const Quadratic& f) {
    double reach = 0, slope = 0, bend = 0;
    for (std::size_t index = 1; index < f.size(); ++index) {
        const auto a = static_cast<double>(index % 3), b = static_cast<double>(index / 3 % 3),
                   c = static_cast<double>(index / 9);
        const double size = std::abs(f[index]), degree = a + b + c;
        reach += size;
        slope += degree * size;
        // a (a - 1) + b (b - 1) + c (c - 1) + 2 (a b + b c + c a)
        bend += degree * (degree - 1) * size;
    }
    const double margin = rounding * (std::abs(f[0]) + reach);
    // Coefficients that are rounded to single precision, too.
    constexpr double rounded = 1 + 1e-6;
    return {f[0] - reach - margin, f[0] + reach + margin, rounded * slope, rounded * bend};
}

Lattice::Lattice(const Description& description)
    : m_counts(description.counts), m_lower(description.lower), m_moved(description.moved) {
    using std::numbers::pi;
    for (std::size_t d = 0; d < 3; ++d) {
        const auto n = static_cast<double>(m_counts[d]);
        m_sides[d] = (description.upper[d] - description.lower[d]) / n;
        for (std::uint64_t i = 0; i <= m_counts[d]; ++i) {
            m_shifts[d].push_back(std::sin(4 * pi * static_cast<double>(i) / n));
        }
    }
    for (const Wave& wave : description.fields) {
        Table& table = m_fields.emplace_back();
        table.amplitude = wave.amplitude;
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::uint64_t i = 0; i <= 2 * m_counts[d]; ++i) {
                const double phase = pi * wave.periods[d] * static_cast<double>(i) / static_cast<double>(m_counts[d]);
                table.sines[d].push_back(std::sin(phase));
                table.cosines[d].push_back(std::cos(phase));
            }
        }
    }
}

std::array<std::uint64_t, 3> Lattice::place(std::uint64_t element) const {
    const std::uint64_t row = element / m_counts[0];
    return {element % m_counts[0], row % m_counts[1], row / m_counts[1]};
}

Point Lattice::vertex(const std::array<std::uint64_t, 3>& index) const {
    const Point s{m_shifts[0][index[0]], m_shifts[1][index[1]], m_shifts[2][index[2]]};
    Point x{};
    for (std::size_t d = 0; d < 3; ++d) {
        const double moved = m_moved * s[(d + 1) % 3] * s[(d + 2) % 3];
        x[d] = m_lower[d] + m_sides[d] * (static_cast<double>(index[d]) + moved);
    }
    return x;
}

Mapping Lattice::mapping(std::uint64_t element) const {
    const auto first = place(element);
    Mapping mapping{};
    for (std::uint64_t corner = 0; corner < 8; ++corner) {
        const Point x = vertex({first[0] + (corner & 1u), first[1] + (corner >> 1u & 1u), first[2] + (corner >> 2u)});
        for (std::size_t d = 0; d < 3; ++d) {
            for (std::size_t product = 0; product < 8; ++product) {
                // (1 +- xi) / 2 in each direction: minus where a power is 1 and the corner at -1.
                const bool is_negative = (__builtin_popcountll(product & ~corner) & 1) != 0;
                mapping[d][product] += (is_negative ? -0.125 : 0.125) * x[d];
            }
        }
    }
    return mapping;
}

Box Lattice::bounds(std::uint64_t element) const {
    const auto first = place(element);
    Box box{};
    for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t e = (d + 1) % 3, f = (d + 2) % 3;
        double least = 0, most = 0;
        for (unsigned corner = 0; corner < 4; ++corner) {
            const double moved = m_shifts[e][first[e] + (corner & 1u)] * m_shifts[f][first[f] + (corner >> 1u)];
            least = corner == 0 ? moved : std::min(least, moved);
            most = corner == 0 ? moved : std::max(most, moved);
        }
        // A trilinear image lies in the hull of its corners.
        const auto index = static_cast<double>(first[d]);
        const double lower = m_lower[d] + m_sides[d] * (index + m_moved * least);
        const double upper = m_lower[d] + m_sides[d] * (index + 1 + m_moved * most);
        const double margin = rounding * (std::abs(m_lower[d]) + std::abs(lower) + std::abs(upper));
        box[d] = lower - margin;
        box[d + 3] = upper + margin;
    }
    return box;
}

Quadratic Lattice::field(std::size_t field, std::uint64_t element) const {
    const Table& table = m_fields[field];
    const auto first = place(element);
    Quadratic f{};
    for (std::size_t node = 0; node < f.size(); ++node) {
        const std::array<std::uint64_t, 3> at{2 * first[0] + node % 3, 2 * first[1] + node / 3 % 3, 2 * first[2] + node / 9};
        for (std::size_t d = 0; d < 3; ++d) {
            const std::size_t e = (d + 1) % 3;
            f[node] += table.amplitude * table.sines[d][at[d]] * table.cosines[e][at[e]];
        }
    }
    for (std::size_t line = 0; line < 9; ++line) {
        to_coefficients(&f[3 * line], 1);
    }
    for (std::size_t line = 0; line < 9; ++line) {
        to_coefficients(&f[line % 3 + line / 3 * 9], 3);
    }
    for (std::size_t line = 0; line < 9; ++line) {
        to_coefficients(&f[line], 9);
    }
    return f;
}

} // namespace elvis::lattice
