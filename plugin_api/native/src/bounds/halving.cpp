#include "halving.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::native {

Point CubePart::corner(unsigned corner) const {
    Point eta{};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const std::uint32_t step = (corner >> direction) & 1u;
        eta[direction] = std::ldexp(index[direction] + step, 1 - static_cast<int>(depth[direction])) - 1;
    }
    return eta;
}

CubePart CubePart::half(std::size_t direction, bool is_upper) const {
    CubePart result = *this;
    result.index[direction] = 2 * index[direction] + (is_upper ? 1 : 0);
    ++result.depth[direction];
    return result;
}

FormLayout::FormLayout(Shape shape, const Sizes& sizes) : m_sizes(sizes), m_places(storage_places(shape)) {
    for (unsigned corner = 0; corner < 8; ++corner)
        for (std::size_t direction = 0; direction < 3; ++direction)
            if ((corner >> direction) & 1u)
                m_corners[corner] += (n_along(direction) - 1) * stride(direction);
}

std::size_t FormLayout::stride(std::size_t direction) const {
    std::size_t stride = 1;
    for (std::size_t faster = m_places[direction] + 1; faster < 3; ++faster)
        stride *= m_sizes[faster];
    return stride;
}

double FormLayout::variation(std::span<const double> form, std::size_t direction) const {
    const std::size_t step = stride(direction), block = step * n_along(direction);
    double most = 0;
    for (std::size_t first = 0; first < form.size(); first += block)
        for (std::size_t k = first; k + step < first + block; ++k)
            most = std::max(most, std::abs(form[k + step] - form[k]));
    return most;
}

void FormLayout::halve(std::span<double> form, std::span<double> lower, std::size_t direction) const {
    const std::size_t step = stride(direction), n = n_along(direction);
    double* const b = form.data();
    for (std::size_t first = 0; first < form.size(); first += step * n)
        for (std::size_t level = 0; level < n; ++level) {
            std::copy_n(b + first, step, lower.data() + first + level * step);
            const std::size_t end = first + (n - 1 - level) * step;
            for (std::size_t k = first; k < end; ++k)
                b[k] = 0.5 * (b[k] + b[k + step]);
        }
}

} // namespace elvis::native
