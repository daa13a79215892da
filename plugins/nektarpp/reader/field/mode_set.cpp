#include "mode_set.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace nektarpp {

namespace {

bool is_tensor(Shape shape) { return shape == Shape::hexahedron || shape == Shape::quadrilateral; }
bool is_lagrange(Basis basis) { return basis == Basis::gll_lagrange || basis == Basis::gauss_lagrange; }

/** Number of modes in the third direction for given first two indices, 0 or negative if there are none. */
int n_third(const ModeSet& set, std::uint32_t p, std::uint32_t q) {
    const auto n = static_cast<int>(set.n_modes[2]);
    switch (set.shape) {
    case Shape::prism:
        return n - static_cast<int>(p);
    case Shape::pyramid:
        return n - static_cast<int>(std::max(p, q));
    case Shape::tetrahedron:
        return n - static_cast<int>(p + q);
    default:
        return n;
    }
}

std::uint32_t n_second(const ModeSet& set, std::uint32_t p) {
    const bool is_collapsed = set.shape == Shape::tetrahedron || set.shape == Shape::triangle;
    return is_collapsed ? set.n_modes[1] - p : set.n_modes[1];
}

} // namespace

void check(const ModeSet& set) {
    const std::uint32_t a = set.n_modes[0], b = set.n_modes[1], c = set.n_modes[2];
    const auto dimension = static_cast<std::size_t>(elvis::native::dimension(set.shape));
    const auto refuse = [&](const std::string& why) {
        std::ostringstream text;
        text << a << ',' << b;
        if (dimension == 3) {
            text << ',' << c;
        }
        text << " modes in a " << elvis::native::name(set.shape) << ": " << why;
        throw std::invalid_argument(text.str());
    };
    const std::span<const std::uint32_t> used(set.n_modes.data(), dimension);
    const auto [least, most] = std::ranges::minmax(used);
    if (least < 1 || most > elvis::native::max_order + 1) {
        refuse("from 1 to " + std::to_string(elvis::native::max_order + 1) + " can be read");
    }
    if (least < 2 && set.basis != Basis::orthogonal && !(set.basis == Basis::gauss_lagrange && most == 1)) {
        refuse("this basis needs at least 2");
    }
    if (is_lagrange(set.basis) && !is_tensor(set.shape)) {
        refuse("Lagrange bases are known for hexahedra and quadrilaterals only");
    }
    const bool has_enough = set.shape == Shape::prism         ? a <= c
                            : set.shape == Shape::triangle    ? a <= b
                            : set.shape == Shape::tetrahedron ? a <= b && b <= c
                                                              : true;
    if (!has_enough) {
        refuse("collapsed directions need at least as many modes as those collapsed into them");
    }
    if (set.shape == Shape::pyramid && !(a == b && b == c)) {
        refuse("pyramids need equal numbers, Nektar++ itself evaluates others wrongly");
    }
}

void for_each_mode(const ModeSet& set, const std::function<void(const ModeIndex&)>& visit) {
    const auto [a, b, c] = set.n_modes;
    if (is_tensor(set.shape)) {
        for (std::uint32_t r = 0; r < c; ++r) {
            for (std::uint32_t q = 0; q < b; ++q) {
                for (std::uint32_t p = 0; p < a; ++p) {
                    visit({p, q, r});
                }
            }
        }
        return;
    }
    for (std::uint32_t p = 0; p < a; ++p) {
        for (std::uint32_t q = 0; q < n_second(set, p); ++q) {
            for (std::uint32_t r = 0; static_cast<int>(r) < n_third(set, p, q); ++r) {
                visit({p, q, r});
            }
        }
    }
}

std::size_t n_modes(const ModeSet& set) {
    std::size_t n = 0;
    for_each_mode(set, [&](const ModeIndex&) { ++n; });
    return n;
}

elvis::native::Space native_space(const ModeSet& set) {
    elvis::native::Space space;
    space.shape = set.shape;
    space.basis = set.basis;
    // The native volume knows constants by another normalisation, and none in one direction alone.
    const std::uint32_t least = set.basis == Basis::orthogonal ? 1 : 0;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        space.order[direction] = std::max(least, set.n_modes[direction] - 1);
    }
    if (elvis::native::dimension(set.shape) == 2) {
        space.order[2] = 0;
    }
    return space;
}

std::vector<std::size_t> native_modes(const ModeSet& set) { return native_modes(set, native_space(set)); }

std::vector<std::size_t> native_modes(const ModeSet& set, const elvis::native::Space& space) {
    ModeSet whole = set;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        whole.n_modes[direction] = space.order[direction] + 1;
    }
    const std::array<std::uint32_t, 3>& n_along = whole.n_modes;
    std::vector<std::size_t> position(static_cast<std::size_t>(n_along[0]) * n_along[1] * n_along[2]);
    const auto at = [&](const ModeIndex& index) -> std::size_t& {
        return position[(static_cast<std::size_t>(index[0]) * n_along[1] + index[1]) * n_along[2] + index[2]];
    };
    std::size_t n = 0;
    for_each_mode(whole, [&](const ModeIndex& index) { at(index) = n++; });
    std::vector<std::size_t> modes;
    for_each_mode(set, [&](const ModeIndex& index) { modes.push_back(at(index)); });
    return modes;
}

std::array<std::uint32_t, 3> target_order(const ModeSet& set) {
    std::array<std::uint32_t, 3> order{};
    const std::uint32_t most = std::ranges::max(set.n_modes);
    for (std::size_t direction = 0; direction < 3; ++direction) {
        order[direction] = most == 1 ? 0 : std::max(1u, set.n_modes[direction] - 1);
    }
    if (elvis::native::dimension(set.shape) == 2) {
        order[2] = 0;
    }
    // A pyramid of order 1 in the modified basis is one of the native volume's own.
    if (set.shape == Shape::pyramid && (most > 2 || set.basis != Basis::modified) && most > 1) {
        order = elvis::native::collapsed_order(native_space(set));
    }
    return order;
}

ModeSet modified_modes(Shape shape, std::uint32_t n) {
    return {shape, Basis::modified, {n, n, elvis::native::dimension(shape) == 2 ? 1 : n}};
}

} // namespace nektarpp
