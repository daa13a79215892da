#include "subdivision.hpp"

#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::native {
namespace {

/** Numbers that an element's parts may take: 256 MB. */
constexpr std::size_t max_numbers = std::size_t{1} << 25;

} // namespace

Subdivision::Subdivision(Shape shape, const Sizes& sizes, const JacobianOptions& options)
    : m_shape(shape), m_layout(shape, sizes), m_size(product(sizes)), m_tolerance(options.tolerance),
      m_max_parts(std::min(options.max_parts, max_numbers / product(sizes) + 1)) {}

std::span<double> Subdivision::numbers(const Part& part) { return std::span(m_numbers).subspan(part.place * m_size, m_size); }

bool Subdivision::look(Part& part) {
    const std::span<const double> b = numbers(part);
    part.least = *std::min_element(b.begin(), b.end());
    for (unsigned corner = 0; corner < 8; ++corner) {
        const double value = b[m_layout.at_corner(corner)];
        if (!(value < m_witness_value))
            continue;
        const Point eta = part.region.corner(corner);
        // xi cannot tell the directions at the apex of a pyramid apart.
        if (m_shape == Shape::pyramid && eta[2] == 1)
            continue;
        m_witness_value = value;
        m_witness = expand(m_shape, eta);
        if (m_witness_value < -part.error)
            return true;
    }
    return false;
}

std::size_t Subdivision::direction_to_halve(const Part& part) {
    std::size_t best = 3;
    double most = -1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        if (part.region.depth[direction] == max_depth || m_layout.n_along(direction) == 1)
            continue;
        const double variation = m_layout.variation(numbers(part), direction);
        if (variation > most) {
            most = variation;
            best = direction;
        }
    }
    return best;
}

void Subdivision::halve(const Part& part, std::size_t direction, Part& low, Part& high) {
    low = high = part;
    low.place = m_numbers.size() / m_size;
    m_numbers.resize(m_numbers.size() + m_size);
    low.region = part.region.half(direction, false);
    high.region = part.region.half(direction, true);
    // Every level of means rounds once.
    low.error = high.error = part.error + static_cast<double>(m_layout.n_along(direction)) * unit * m_scale;
    m_layout.halve(numbers(high), numbers(low), direction);
}

JacobianCheck Subdivision::decide(std::span<const double> coefficients, double error) {
    m_numbers.assign(coefficients.begin(), coefficients.end());
    m_scale = 0;
    for (const double value : coefficients)
        m_scale = std::max(m_scale, std::abs(value));
    m_queue.clear();
    m_witness_value = std::numeric_limits<double>::infinity();
    m_witness = expand(m_shape, {0, 0, 0});
    const double nan = std::numeric_limits<double>::quiet_NaN();

    Part root;
    root.error = error;
    if (look(root))
        return {JacobianSign::negative, nan, m_witness, m_witness_value};
    m_queue.push_back(root);
    const auto later = [](const Part& a, const Part& b) { return a.least - a.error > b.least - b.error; };
    while (true) {
        const Part part = m_queue.front();
        const double lower = part.least - part.error;
        if (lower > 0)
            return {JacobianSign::positive, lower, {nan, nan, nan}, nan};
        // The smallest determinant lies between `lower` and the witness's.
        const double enough = std::max(m_tolerance * m_scale, 4 * part.error);
        const bool is_close = lower >= -enough && m_witness_value <= enough;
        const std::size_t direction = is_close || m_queue.size() >= m_max_parts ? 3 : direction_to_halve(part);
        if (direction == 3)
            return {JacobianSign::undecided, lower, m_witness, m_witness_value};
        std::pop_heap(m_queue.begin(), m_queue.end(), later);
        m_queue.pop_back();
        Part low, high;
        halve(part, direction, low, high);
        if (look(low) || look(high))
            return {JacobianSign::negative, nan, m_witness, m_witness_value};
        for (const Part& half : {low, high}) {
            m_queue.push_back(half);
            std::push_heap(m_queue.begin(), m_queue.end(), later);
        }
    }
}

} // namespace elvis::native
