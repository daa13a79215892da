#include "cube_maximum.hpp"

#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::native {
namespace {

/** Some hundreds suffice unless nearly the largest value is taken along a whole line or surface inside the element. */
constexpr std::size_t max_parts = 8192;

bool is_negative(Objective objective) { return objective == Objective::negative || objective == Objective::negative_magnitude; }
bool is_magnitude(Objective objective) {
    return objective == Objective::magnitude || objective == Objective::negative_magnitude;
}

} // namespace

CubeMaximum::CubeMaximum(Shape shape, const Sizes& sizes, std::size_t n_forms, Objective objective)
    : m_shape(shape), m_layout(shape, sizes), m_n_forms(n_forms), m_objective(objective) {}

double CubeMaximum::at(std::span<const double> forms, std::size_t k) const {
    double value = forms[k];
    if (is_magnitude(m_objective)) {
        double sum = 0;
        for (std::size_t form = 0; form < m_n_forms; ++form)
            sum += forms[form * m_layout.size() + k] * forms[form * m_layout.size() + k];
        value = std::sqrt(sum);
    }
    return is_negative(m_objective) ? -value : value;
}

double CubeMaximum::bound(std::span<const double> forms, double error) const {
    const std::size_t size = m_layout.size();
    double largest = -std::numeric_limits<double>::infinity();
    if (m_objective != Objective::negative_magnitude) {
        for (std::size_t k = 0; k < size; ++k)
            largest = std::max(largest, at(forms, k));
        // Each form may be off by `error`; a square root and a few products round besides.
        return m_objective == Objective::magnitude
                   ? (largest + std::sqrt(static_cast<double>(m_n_forms)) * error) * (1 + 16 * unit)
                   : largest + error;
    }
    std::vector<double> direction(m_n_forms);
    double length = 0;
    for (std::size_t form = 0; form < m_n_forms; ++form) {
        for (const double b : forms.subspan(form * size, size))
            direction[form] += b;
        length = std::hypot(length, direction[form]);
    }
    if (!(length > 0))
        return 0;
    for (std::size_t k = 0; k < size; ++k) {
        double along = 0;
        for (std::size_t form = 0; form < m_n_forms; ++form)
            along += direction[form] / length * forms[form * size + k];
        largest = std::max(largest, -along);
    }
    const double rounding = 16 * unit * static_cast<double>(m_n_forms) * std::abs(largest);
    return std::min(0.0, largest + std::sqrt(static_cast<double>(m_n_forms)) * error + rounding);
}

void CubeMaximum::raise(std::span<const double> forms, const CubePart& region, Peak& best) const {
    for (unsigned corner = 0; corner < 8; ++corner) {
        const double value = at(forms, m_layout.at_corner(corner));
        if (!(value > best.value))
            continue;
        const Point eta = region.corner(corner);
        // One value belongs to the apex of a pyramid, whatever the other collapsed coordinates: that of evaluate().
        if (m_shape == Shape::pyramid && eta[2] == 1 && (eta[0] != -1 || eta[1] != -1))
            continue;
        best = {value, expand(m_shape, eta)};
    }
}

Peak CubeMaximum::largest_corner(std::span<const double> forms) const {
    Peak best{-std::numeric_limits<double>::infinity(), {}};
    raise(forms, {}, best);
    return best;
}

std::span<double> CubeMaximum::numbers(std::size_t place) {
    const std::size_t size = m_n_forms * m_layout.size();
    return std::span(m_numbers).subspan(place * size, size);
}

std::size_t CubeMaximum::new_place() {
    if (!m_free.empty()) {
        const std::size_t place = m_free.back();
        m_free.pop_back();
        return place;
    }
    const std::size_t size = m_n_forms * m_layout.size();
    m_numbers.resize(m_numbers.size() + size);
    return m_numbers.size() / size - 1;
}

std::size_t CubeMaximum::direction_to_halve(const Part& part) {
    std::size_t best = 3;
    double most = -1;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        if (part.region.depth[direction] == max_depth || m_layout.n_along(direction) == 1)
            continue;
        double variation = 0;
        for (std::size_t form = 0; form < m_n_forms; ++form)
            variation += m_layout.variation(numbers(part.place).subspan(form * m_layout.size(), m_layout.size()), direction);
        if (variation > most) {
            most = variation;
            best = direction;
        }
    }
    return best;
}

void CubeMaximum::halve(const Part& part, std::size_t direction, double scale, Part& lower, Part& upper) {
    lower.place = new_place();
    upper.place = part.place;
    lower.region = part.region.half(direction, false);
    upper.region = part.region.half(direction, true);
    lower.error = upper.error = part.error + static_cast<double>(m_layout.n_along(direction)) * unit * scale;
    const std::size_t size = m_layout.size();
    for (std::size_t form = 0; form < m_n_forms; ++form)
        m_layout.halve(numbers(upper.place).subspan(form * size, size), numbers(lower.place).subspan(form * size, size),
                       direction);
    for (Part* half : {&lower, &upper})
        half->bound = std::min(part.bound, bound(numbers(half->place), half->error));
}

double CubeMaximum::search(std::span<const double> forms, double error, double tolerance, Peak& best) {
    m_numbers.assign(forms.begin(), forms.end());
    m_free.clear();
    m_queue.clear();
    double scale = 0;
    for (const double b : forms)
        scale = std::max(scale, std::abs(b));
    raise(forms, {}, best);
    // Of parts that are left as they are, because no value in them exceeds `best` by more than the tolerance.
    double left = best.value;
    const auto has_lower_bound = [](const Part& a, const Part& b) { return a.bound < b.bound; };
    const auto consider = [&](const Part& part) {
        if (part.bound <= best.value + tolerance) {
            left = std::max(left, part.bound);
            m_free.push_back(part.place);
        } else {
            m_queue.push_back(part);
            std::push_heap(m_queue.begin(), m_queue.end(), has_lower_bound);
        }
    };
    consider({{}, bound(forms, error), error, 0});
    for (std::size_t n_parts = 1; !m_queue.empty(); n_parts += 2) {
        const Part part = m_queue.front();
        // What rounding leaves open is not to be had by halving.
        const double enough = std::max(tolerance, 4 * part.error);
        const std::size_t direction = part.bound <= best.value + enough || n_parts >= max_parts ? 3 : direction_to_halve(part);
        if (direction == 3)
            return std::max({part.bound, left, best.value});
        std::pop_heap(m_queue.begin(), m_queue.end(), has_lower_bound);
        m_queue.pop_back();
        Part lower, upper;
        halve(part, direction, scale, lower, upper);
        raise(numbers(lower.place), lower.region, best);
        raise(numbers(upper.place), upper.region, best);
        consider(lower);
        consider(upper);
    }
    return std::max(left, best.value);
}

} // namespace elvis::native
