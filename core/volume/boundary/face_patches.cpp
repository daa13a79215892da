#include <core/base/vector3.hpp>
#include <core/volume/boundary/face_patches.hpp>
#include <core/volume/element/chebyshev.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <tuple>

namespace elvis {

namespace {

/** By how much the square is enlarged for what holds near the patch: shaders/boundary/face_patch.glsl. */
constexpr double patch_reach = 1.2;
/**
 * The sum of the normal's turn and the share of the tangents that changes, at which a patch is divided: smaller patches leave
 * fewer pixels to the careful kernel, which takes rays for which it is above 0.5 as they see the patch; larger ones make
 * shorter lists. At 0.4 pictures of balls, tori and strongly bent hexahedra take least time, or nearly so.
 */
constexpr double largest_turn = 0.4;

struct Square {
    int level = 0;
    std::uint32_t i = 0, j = 0;
    /** Of a triangle's hypotenuse: only its lower half counts. */
    bool is_diagonal = false;

    double half() const { return std::ldexp(1.0, -level); }
    double middle(std::uint32_t index) const { return (2.0 * index + 1.0) * half() - 1.0; }
    std::uint32_t word() const {
        return static_cast<std::uint32_t>(level) | (i << 4) | (j << 16) | (is_diagonal ? 1u << 31 : 0u);
    }
};

/** Coefficients of the face's polynomial on the square, `factor` times enlarged. */
std::vector<Vector3> on_square(const FaceShape& shape, const Square& square, double factor) {
    const auto size = static_cast<std::size_t>(shape.order + 1);
    const double half = factor * square.half();
    const std::vector<double> along_u = chebyshev_on_interval(shape.order, square.middle(square.i), half);
    const std::vector<double> along_v = chebyshev_on_interval(shape.order, square.middle(square.j), half);
    std::vector<Vector3> between(size * size, Vector3{}), result(size * size, Vector3{});
    for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t m = 0; m <= i; ++m) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    between[j * size + m][axis] += along_u[i * size + m] * shape.coefficients[3 * (j * size + i) + axis];
                }
            }
        }
    }
    for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t m = 0; m <= j; ++m) {
            for (std::size_t i = 0; i < size; ++i) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    result[m * size + i][axis] += along_v[j * size + m] * between[j * size + i][axis];
                }
            }
        }
    }
    return result;
}

/** Bounds of |T_n'| and |T_n''| on [-1, 1]. */
double first_bound(std::size_t n) { return static_cast<double>(n * n); }
double second_bound(std::size_t n) {
    const double square = static_cast<double>(n * n);
    return square * (square - 1) / 3;
}

struct Model {
    Vector3 x0{}, a{}, b{};
    Vector3 to_u{}, to_v{}, to_s{};
    double flat = 0, high = 0;
    double slope_flat = 0, slope_high = 0;
    double bend_flat = 0, bend_high = 0;
    /** Bound of half the second derivative, and of the remainder, of each coordinate. */
    Vector3 quadratic{}, remainder{};

    double turn() const { return slope_flat + slope_high / std::max(1e-300, std::min(length(a), length(b))); }
};

Model model_of(const FaceShape& shape, const Square& square) {
    const auto size = static_cast<std::size_t>(shape.order + 1);
    const std::vector<Vector3> here = on_square(shape, square, 1.0), near = on_square(shape, square, patch_reach);
    Model model;
    model.x0 = here[0];
    model.a = here[1];
    model.b = here[size];
    const Vector3 normal = cross(model.a, model.b);
    const double area = length(normal);
    // Where the tangents are parallel, as at a collapsed edge, nothing is known but the bounds of coordinates.
    const bool is_regular = area > 1e-6 * length(model.a) * length(model.b) && area > 1e-300;
    if (is_regular) {
        model.to_s = scaled(normal, 1 / area);
        model.to_u = scaled(cross(model.b, model.to_s), 1 / area);
        model.to_v = scaled(cross(model.to_s, model.a), 1 / area);
    }
    const double infinite = 1e30;
    model.flat = is_regular ? shape.misfit * (length(model.to_u) + length(model.to_v)) : infinite;
    model.high = shape.misfit;
    model.slope_flat = is_regular ? 0 : infinite;
    for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t i = 0; i < size; ++i) {
            const bool is_linear = i + j <= 1;
            const Vector3& c = here[j * size + i];
            for (std::size_t axis = 0; axis < 3 && !is_linear; ++axis) {
                model.remainder[axis] += std::abs(c[axis]);
            }
            if (!is_linear) {
                model.flat += std::max(std::abs(dot(model.to_u, c)), std::abs(dot(model.to_v, c)));
                model.high += std::abs(dot(model.to_s, c));
            }
            // In the coordinates of the enlarged square the model's slopes are `patch_reach` times as large.
            Vector3 d = near[j * size + i];
            for (std::size_t axis = 0; axis < 3 && is_linear && i + j == 1; ++axis) {
                d[axis] -= patch_reach * (i == 1 ? model.a : model.b)[axis];
            }
            const double first = (first_bound(i) + first_bound(j)) / patch_reach;
            const double second =
                0.5 * (second_bound(i) + 2 * first_bound(i) * first_bound(j) + second_bound(j)) / (patch_reach * patch_reach);
            const double in_plane = std::max(std::abs(dot(model.to_u, d)), std::abs(dot(model.to_v, d)));
            const double across = std::abs(dot(model.to_s, d));
            model.slope_flat += first * in_plane;
            model.slope_high += first * across;
            model.bend_flat += second * in_plane;
            model.bend_high += second * across;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                model.quadratic[axis] += second * std::abs(d[axis]);
            }
        }
    }
    return model;
}

std::uint32_t bits(double number) { return std::bit_cast<std::uint32_t>(static_cast<float>(number)); }
/** A bound, with room for rounding. */
std::uint32_t bound_bits(double number) { return bits(number * (1 + 1e-5)); }

void append(const Square& square, const FaceShape& shape, std::uint32_t face, int max_level, const Vector3& centre,
            FacePatches& patches) {
    const Model model = model_of(shape, square);
    if (model.turn() > largest_turn && square.level < max_level) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const Square quarter{square.level + 1, 2 * square.i + (k & 1u), 2 * square.j + (k >> 1u),
                                 square.is_diagonal && (k == 1 || k == 2)};
            if (!(square.is_diagonal && k == 3)) {
                append(quarter, shape, face, max_level, centre, patches);
            }
        }
        return;
    }
    const auto row = [&](const Vector3& to) {
        const Vector3 from = {model.x0[0] - centre[0], model.x0[1] - centre[1], model.x0[2] - centre[2]};
        return std::array<std::uint32_t, 4>{bits(to[0]), bits(to[1]), bits(to[2]), bits(-dot(to, from))};
    };
    for (const Vector3* to : {&model.to_u, &model.to_v, &model.to_s}) {
        const auto words = row(*to);
        patches.records.insert(patches.records.end(), words.begin(), words.end());
    }
    patches.records.insert(patches.records.end(), {bound_bits(model.flat), bound_bits(model.high), bound_bits(model.slope_flat),
                                                   bound_bits(model.slope_high)});
    patches.records.insert(patches.records.end(),
                           {bound_bits(model.bend_flat), bound_bits(model.bend_high), face, square.word() | shape.bits});
    patches.records.insert(patches.records.end(), {bound_bits(model.quadratic[0]), bound_bits(model.quadratic[1]),
                                                   bound_bits(model.quadratic[2]), bound_bits(shape.misfit)});
    for (const double side : {-1.0, 1.0}) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // Over the corners of the square, or of its lower half.
            double extent = -std::numeric_limits<double>::infinity();
            for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
                if (!(square.is_diagonal && a + b == 2)) {
                    extent = std::max(extent, side * (a * model.a[axis] + b * model.b[axis]));
                }
            }
            patches.boxes.push_back(model.x0[axis] + side * (extent + model.remainder[axis] + shape.misfit));
        }
    }
}

} // namespace

void append_patches(const FaceShape& shape, std::uint32_t face, int max_level, const Vector3& centre, FacePatches& patches) {
    append({0, 0, 0, shape.is_triangle}, shape, face, max_level, centre, patches);
}

} // namespace elvis
