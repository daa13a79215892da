#include "collection.hpp"

#include "text.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace elvis_mfem {

namespace {

bool take(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) {
        return false;
    }
    text.remove_prefix(prefix.size());
    return true;
}

std::optional<int> take_number(std::string_view& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value < 0) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

/** MFEM's letter for a basis in names with '@'. */
std::optional<Basis> take_basis(std::string_view& text) {
    constexpr std::string_view letters = "gGPuUo";
    const std::size_t index = text.empty() ? std::string_view::npos : letters.find(text.front());
    if (index == std::string_view::npos) {
        return std::nullopt;
    }
    text.remove_prefix(1);
    return static_cast<Basis>(index);
}

bool is_closed(Basis basis) {
    return basis == Basis::gauss_lobatto || basis == Basis::closed_uniform || basis == Basis::positive;
}

/** The part of a name before "_2D_P" or "_3D_P". */
std::optional<Collection> parse_prefix(std::string_view text) {
    Collection result;
    if (text == "H1Pos") {
        result.basis = Basis::positive;
        return result;
    }
    if (take(text, "H1")) {
        if (take(text, "@")) {
            const auto basis = take_basis(text);
            if (!basis || !is_closed(*basis)) {
                return std::nullopt;
            }
            result.basis = *basis;
        }
        return text.empty() ? std::optional(result) : std::nullopt;
    }
    if (take(text, "L2")) {
        result.family = Family::l2;
        result.basis = Basis::gauss_legendre;
        if (take(text, "_T")) {
            const auto number = take_number(text);
            if (!number || *number > static_cast<int>(Basis::open_half_uniform)) {
                return std::nullopt;
            }
            result.basis = static_cast<Basis>(*number);
        }
        return text.empty() ? std::optional(result) : std::nullopt;
    }
    const bool is_nd = take(text, "ND");
    if (!is_nd && !take(text, "RT")) {
        return std::nullopt;
    }
    result.family = is_nd ? Family::nd : Family::rt;
    if (take(text, "@")) {
        const auto closed = take_basis(text);
        const auto open = take_basis(text);
        const auto is_nodal = [](std::optional<Basis> basis) { return basis && *basis != Basis::positive; };
        if (!is_nodal(closed) || !is_nodal(open) || !is_closed(*closed) || is_closed(*open)) {
            return std::nullopt;
        }
        result.basis = *closed;
        result.open_basis = *open;
    }
    return text.empty() ? std::optional(result) : std::nullopt;
}

} // namespace

Collection parse_collection(std::string_view name) {
    const std::string shown = "finite element collection " + elvis_mfem::shown(name);
    if (name.starts_with("L2Int")) {
        throw std::invalid_argument(shown + ": densities (values divided by det J) are not supported");
    }
    // Names of the first versions of MFEM that are still common for curved meshes; evenly spaced nodes.
    constexpr std::array<std::string_view, 3> first_names{"Linear", "Quadratic", "Cubic"};
    const auto first_name = std::ranges::find(first_names, name);
    if (first_name != first_names.end()) {
        return Collection{.order = 1 + static_cast<int>(first_name - first_names.begin()),
                          .basis = Basis::closed_uniform,
                          .is_first_cubic = name == "Cubic"};
    }
    const std::size_t place = std::min({name.find("_1D_P"), name.find("_2D_P"), name.find("_3D_P")});
    const auto prefix = parse_prefix(name.substr(0, place));
    if (place == std::string_view::npos || !prefix) {
        throw std::invalid_argument(shown +
                                    " is not supported; H1, H1Pos, L2, ND and RT in two and three dimensions are, with the "
                                    "points of Gauss-Lobatto, Gauss-Legendre or uniform ones");
    }
    Collection result = *prefix;
    result.dimension = name[place + 1] - '0';
    std::string_view digits = name.substr(place + 5);
    const auto order = take_number(digits);
    const int least = result.family == Family::h1 || result.family == Family::nd ? 1 : 0;
    if (!order || !digits.empty() || *order < least || *order > max_order) {
        throw std::invalid_argument(shown + ": the order is not in " + std::to_string(least) + ".." +
                                    std::to_string(max_order));
    }
    result.order = *order;
    if (result.polynomial_order() > max_order) {
        throw std::invalid_argument(shown + ": polynomials of more than order " + std::to_string(max_order));
    }
    return result;
}

int parse_nurbs_order(std::string_view name) {
    std::string_view digits = name;
    const auto order = take(digits, "NURBS") ? take_number(digits) : std::nullopt;
    if (!order || !digits.empty() || *order < 1) {
        throw std::invalid_argument("finite element collection " + shown(name) +
                                    ": only NURBS of one order are supported, as NURBS2");
    }
    return *order;
}

std::vector<double> points(Basis basis, int n) {
    const auto size = static_cast<std::size_t>(n);
    std::vector<double> result(size);
    if (size == 1) {
        return {0.5};
    }
    std::vector<double> weights(size);
    switch (basis) {
    case Basis::gauss_legendre:
        elvis::native::gauss_legendre(result, weights);
        break;
    case Basis::gauss_lobatto:
        elvis::native::gauss_lobatto_legendre(result);
        break;
    default:
        break;
    }
    for (std::size_t i = 0; i < size; ++i) {
        const auto place = static_cast<double>(i);
        switch (basis) {
        case Basis::gauss_legendre:
        case Basis::gauss_lobatto:
            result[i] = 0.5 * (1 + result[i]);
            break;
        case Basis::open_uniform:
            result[i] = (place + 1) / (n + 1);
            break;
        case Basis::open_half_uniform:
            result[i] = (place + 0.5) / n;
            break;
        default:
            result[i] = place / (n - 1);
            break;
        }
    }
    return result;
}

} // namespace elvis_mfem
