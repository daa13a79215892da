#include "subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::native {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
/**
 * Halvings along a direction: witnesses stay exact in double precision, since xi of eta with 16 bits each is a product of at
 * most three such numbers.
 */
constexpr std::uint32_t max_depth = 16;
/** Numbers that an element's parts may take: 256 MB. */
constexpr std::size_t max_numbers = std::size_t{1} << 25;

} // namespace

Subdivision::Subdivision(Shape shape, const Sizes& sizes, const JacobianOptions& options)
    : m_shape(shape), m_sizes(sizes), m_places(storage_places(shape)), m_size(product(sizes)), m_tolerance(options.tolerance),
      m_max_parts(std::min(options.max_parts, max_numbers / product(sizes) + 1)) {}

std::span<double> Subdivision::numbers(const Part& part) { return std::span(m_numbers).subspan(part.place * m_size, m_size); }

bool Subdivision::look(Part& part) {
    const std::span<const double> b = numbers(part);
    part.least = *std::min_element(b.begin(), b.end());
    const Sizes last{m_sizes[0] - 1, m_sizes[1] - 1, m_sizes[2] - 1};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        std::size_t at = 0;
        for (std::size_t place = 0; place < 3; ++place)
            at = at * m_sizes[place] + ((corner >> place) % 2 != 0 ? last[place] : 0);
        if (!(b[at] < m_witness_value))
            continue;
        Point eta{};
        for (std::size_t direction = 0; direction < 3; ++direction) {
            const std::uint32_t step = (corner >> m_places[direction]) % 2 != 0 ? 1 : 0;
            eta[direction] = std::ldexp(part.index[direction] + step, 1 - static_cast<int>(part.depth[direction])) - 1;
        }
        // xi cannot tell the directions at the apex of a pyramid apart.
        if (m_shape == Shape::pyramid && eta[2] == 1)
            continue;
        m_witness_value = b[at];
        m_witness = expand(m_shape, eta);
        if (m_witness_value < -part.error)
            return true;
    }
    return false;
}

std::size_t Subdivision::direction_to_halve(const Part& part) {
    const std::span<const double> b = numbers(part);
    std::size_t best = 3;
    double most = -1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const std::size_t place = m_places[direction];
        if (part.depth[direction] == max_depth || m_sizes[place] == 1)
            continue;
        std::size_t stride = 1;
        for (std::size_t faster = place + 1; faster < 3; ++faster)
            stride *= m_sizes[faster];
        double variation = 0;
        for (std::size_t block = 0; block < m_size; block += stride * m_sizes[place])
            for (std::size_t k = block; k + stride < block + stride * m_sizes[place]; ++k)
                variation = std::max(variation, std::abs(b[k + stride] - b[k]));
        if (variation > most) {
            most = variation;
            best = direction;
        }
    }
    return best;
}

void Subdivision::halve(const Part& part, std::size_t direction, Part& low, Part& high) {
    const std::size_t place = m_places[direction];
    std::size_t stride = 1;
    for (std::size_t faster = place + 1; faster < 3; ++faster)
        stride *= m_sizes[faster];
    const std::size_t n = m_sizes[place];
    low = high = part;
    low.place = m_numbers.size() / m_size;
    m_numbers.resize(m_numbers.size() + m_size);
    low.index[direction] = 2 * part.index[direction];
    high.index[direction] = low.index[direction] + 1;
    low.depth[direction] = high.depth[direction] = part.depth[direction] + 1;
    // Every level of means rounds once.
    low.error = high.error = part.error + static_cast<double>(n) * unit * m_scale;
    double* const b = numbers(high).data();
    double* const left = numbers(low).data();
    for (std::size_t block = 0; block < m_size; block += stride * n)
        for (std::size_t level = 0; level < n; ++level) {
            std::copy_n(b + block, stride, left + block + level * stride);
            const std::size_t end = block + (n - 1 - level) * stride;
            for (std::size_t k = block; k < end; ++k)
                b[k] = 0.5 * (b[k] + b[k + stride]);
        }
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
