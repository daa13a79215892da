// The proven curvature of polynomial mappings: never below what a dense sample shows, and not much above.
#include <tests/support/test_volumes.hpp>

#include <core/base/vector3.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/volume/device_volume.hpp>
#include <core/volume/element/mapping_curvature.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

namespace elvis {
namespace {

struct Term {
    std::array<int, 3> power;
    Vector3 factor;
};

/** x = xi + sum of terms. */
class Polynomial {
public:
    explicit Polynomial(std::vector<Term> terms) : m_terms(std::move(terms)) {}

    Vector3 at(const Vector3& xi) const { return plus(xi, derivative(xi, {})); }
    std::array<double, 9> jacobian(const Vector3& xi) const {
        std::array<double, 9> result{1, 0, 0, 0, 1, 0, 0, 0, 1};
        for (std::size_t j = 0; j < 3; ++j) {
            const Vector3 column = derivative(xi, {j});
            for (std::size_t i = 0; i < 3; ++i) {
                result[3 * i + j] += column[i];
            }
        }
        return result;
    }
    /** Of the terms. */
    Vector3 derivative(const Vector3& xi, const std::vector<std::size_t>& directions) const {
        Vector3 sum{};
        for (const Term& term : m_terms) {
            double value = 1;
            std::array<int, 3> power = term.power;
            for (const std::size_t direction : directions) {
                value *= power[direction];
                --power[direction];
            }
            for (std::size_t i = 0; i < 3 && value != 0; ++i) {
                value *= std::pow(xi[i], power[i]);
            }
            sum = plus(sum, scaled(term.factor, value));
        }
        return sum;
    }

private:
    std::vector<Term> m_terms;
};

ElementMapping mapping_of(const Polynomial& polynomial) {
    return [&polynomial](std::uint64_t, std::span<const double> xi, std::span<double> positions, std::span<double> jacobians) {
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            const Vector3 at{xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]};
            if (!positions.empty()) {
                std::ranges::copy(polynomial.at(at), positions.begin() + static_cast<std::ptrdiff_t>(3 * point));
            }
            if (!jacobians.empty()) {
                std::ranges::copy(polynomial.jacobian(at), jacobians.begin() + static_cast<std::ptrdiff_t>(9 * point));
            }
        }
    };
}

bool is_inside(elvis_shape shape, const Vector3& xi) {
    return shape == ELVIS_SHAPE_HEXAHEDRON || (shape == ELVIS_SHAPE_PRISM && xi[0] + xi[2] <= 1e-12) ||
           (shape == ELVIS_SHAPE_TETRAHEDRON && xi[0] + xi[1] + xi[2] <= -1 + 1e-12);
}

/** Points of a lattice, corners and edges among them. */
std::vector<Vector3> lattice(elvis_shape shape, int n) {
    std::vector<Vector3> points;
    for (int place = 0; place < n * n * n; ++place) {
        const auto at = [n](int index) { return -1 + 2.0 * index / (n - 1); };
        const Vector3 xi{at(place % n), at(place / n % n), at(place / n / n)};
        if (is_inside(shape, xi)) {
            points.push_back(xi);
        }
    }
    return points;
}

std::array<double, 9> inverse_of(const std::array<double, 9>& m) {
    const Vector3 a{m[0], m[1], m[2]}, b{m[3], m[4], m[5]}, c{m[6], m[7], m[8]};
    const Vector3 columns[] = {cross(b, c), cross(c, a), cross(a, b)};
    std::array<double, 9> result{};
    for (std::size_t i = 0; i < 9; ++i) {
        result[i] = columns[i % 3][i / 3] / dot(a, columns[0]);
    }
    return result;
}

/** sup |J(a)^-1 D^2x(b)| / 2 over the points given. */
double sampled(const Polynomial& polynomial, const std::vector<Vector3>& of_jacobians, const std::vector<Vector3>& of_bends) {
    std::vector<std::array<Vector3, 9>> bends;
    for (const Vector3& xi : of_bends) {
        auto& of_point = bends.emplace_back();
        for (std::size_t entry = 0; entry < 9; ++entry) {
            of_point[entry] = polynomial.derivative(xi, {entry / 3, entry % 3});
        }
    }
    double largest = 0;
    for (const Vector3& xi : of_jacobians) {
        const std::array<double, 9> inverse = inverse_of(polynomial.jacobian(xi));
        for (const auto& bend : bends) {
            for (std::size_t i = 0; i < 9; i += 3) {
                const Vector3 row{inverse[i], inverse[i + 1], inverse[i + 2]};
                for (unsigned signs = 0; signs < 4; ++signs) {
                    double sum = 0;
                    for (std::size_t k = 0; k < 3; ++k) {
                        sum += std::abs(dot(row, bend[k]) + ((signs & 1u) != 0 ? 1 : -1) * dot(row, bend[3 + k]) +
                                        ((signs & 2u) != 0 ? 1 : -1) * dot(row, bend[6 + k]));
                    }
                    largest = std::max(largest, sum / 2);
                }
            }
        }
    }
    return largest;
}

double proven(const Polynomial& polynomial, elvis_shape shape, const std::array<std::uint32_t, 3>& order) {
    std::array<float, 1> curvature{};
    std::array<ElementBends, 1> bends{};
    CurvatureBounder(shape, order)(mapping_of(polynomial), 0, curvature, bends);
    return curvature[0];
}

ElementBends bends_of(const Polynomial& polynomial, elvis_shape shape, const std::array<std::uint32_t, 3>& order) {
    std::array<float, 1> curvature{};
    std::array<ElementBends, 1> bends{};
    CurvatureBounder(shape, order)(mapping_of(polynomial), 0, curvature, bends);
    return bends[0];
}

/** shaders/element/local_curvature.glsl. */
double curvature_at(const Polynomial& polynomial, const ElementBends& bends, const Vector3& xi) {
    const std::array<double, 9> inverse = inverse_of(polynomial.jacobian(xi));
    const std::array<float, 9>& of = bends.vectors;
    double largest = 0;
    for (std::size_t i = 0; i < 9; i += 3) {
        double sum = 0;
        for (std::size_t m = 0; m < 9; m += 3) {
            sum += std::abs(inverse[i] * of[m] + inverse[i + 1] * of[m + 1] + inverse[i + 2] * of[m + 2]);
        }
        largest = std::max(largest, 0.5001 * sum);
    }
    return largest;
}

/** All terms that the shape's orders allow, of degree 2 or more, small enough that the element does not fold. */
Polynomial random_polynomial(elvis_shape shape, int order, double bend, std::mt19937& engine) {
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<Term> terms;
    double sum = 0;
    for (int place = 0; place < (order + 1) * (order + 1) * (order + 1); ++place) {
        const std::array<int, 3> power{place % (order + 1), place / (order + 1) % (order + 1),
                                       place / (order + 1) / (order + 1)};
        const bool is_of_space = shape == ELVIS_SHAPE_HEXAHEDRON ||
                                 (shape == ELVIS_SHAPE_PRISM && power[0] + power[2] <= order) ||
                                 power[0] + power[1] + power[2] <= order;
        const int degree = power[0] + power[1] + power[2];
        if (is_of_space && degree >= 2) {
            // Coefficients fall, as those of smooth boundaries do.
            const double size = std::pow(0.4, degree);
            terms.push_back({power, {size * number(engine), size * number(engine), size * number(engine)}});
            sum += size * degree;
        }
    }
    for (Term& term : terms) {
        term.factor = scaled(term.factor, bend / sum);
    }
    return Polynomial(std::move(terms));
}

} // namespace

TEST_CASE("no sample of a polynomial mapping bends more than its proven curvature") {
    std::mt19937 engine(20);
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_TETRAHEDRON}) {
        for (std::uint32_t order = 1; order <= 8; ++order) {
            double worst = 0;
            std::size_t n_bounded = 0;
            for (const double bend : {0.02, 0.2, 0.6, 1.2}) {
                for (int repeat = 0; repeat < 2; ++repeat) {
                    const Polynomial polynomial = random_polynomial(shape, static_cast<int>(order), bend, engine);
                    const double bound = proven(polynomial, shape, {order, order, order});
                    const double shown = sampled(polynomial, lattice(shape, 4), lattice(shape, 7));
                    INFO("shape " << shape << ", order " << order << ", bend " << bend);
                    CHECK(bound >= shown);
                    if (bound < unknown_curvature && shown > 1e-6) {
                        worst = std::max(worst, bound / shown);
                        ++n_bounded;
                    }
                }
            }
            std::cout << "shape " << shape << ", order " << order << ": bounds up to " << worst << " times too large, "
                      << n_bounded << " known\n";
        }
    }
}

TEST_CASE("no prediction from a point bends more than the point's own curvature") {
    std::mt19937 engine(21);
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_TETRAHEDRON}) {
        double worst = 0, share = 0;
        std::size_t n_points = 0;
        for (const std::uint32_t order : {1u, 2u, 3u, 5u}) {
            for (const double bend : {0.02, 0.3, 0.8}) {
                const Polynomial polynomial = random_polynomial(shape, static_cast<int>(order), bend, engine);
                const ElementBends bends = bends_of(polynomial, shape, {order, order, order});
                const double of_element = proven(polynomial, shape, {order, order, order});
                for (const Vector3& xi : lattice(shape, 4)) {
                    const double bound = curvature_at(polynomial, bends, xi),
                                 shown = sampled(polynomial, {xi}, lattice(shape, 7));
                    INFO("shape " << shape << ", order " << order << ", bend " << bend);
                    CHECK(bound >= shown);
                    if (of_element < unknown_curvature && shown > 1e-6) {
                        worst = std::max(worst, bound / shown);
                        share += bound / of_element;
                        ++n_points;
                    }
                }
            }
        }
        std::cout << "shape " << shape << ": bounds at points up to " << worst << " times too large, on average "
                  << share / static_cast<double>(n_points) << " of the element's\n";
    }
}

namespace {

double quadratic(const SymmetricMatrix& m, const Vector3& u) {
    return m[0] * u[0] * u[0] + m[3] * u[1] * u[1] + m[5] * u[2] * u[2] +
           2 * (m[1] * u[0] * u[1] + m[2] * u[0] * u[2] + m[4] * u[1] * u[2]);
}

/**
 * x = xi + 5 a (a.xi) + w (a.xi)^2, and small terms: long along a, which is none of the coordinates' directions, and bent to w.
 * As w is across a, the element does not fold.
 */
Polynomial long_and_bent(int degree, std::mt19937& engine) {
    std::uniform_real_distribution<double> number(-1, 1);
    const auto any = [&] { return Vector3{number(engine), number(engine), number(engine)}; };
    const Vector3 a{0.2, 1, 1}, w = scaled(cross(any(), a), 20);
    std::vector<Term> terms;
    for (std::size_t j = 0; j < 3; ++j) {
        std::array<int, 3> power{};
        power[j] = 1;
        terms.push_back({power, scaled(a, 5 * a[j])});
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<int, 3> square = power;
            ++square[k];
            terms.push_back({square, scaled(w, a[j] * a[k])});
        }
    }
    for (int term = 0; term < 4 * (degree - 2); ++term) {
        terms.push_back({{term % 2, 1, degree - 1 - term % 2}, scaled(any(), 0.02)});
    }
    return Polynomial(std::move(terms));
}

/** p . D^2x(xi)(u, v). */
double second_derivative(const Polynomial& polynomial, const Vector3& xi, const Vector3& u, const Vector3& v,
                         const Vector3& p) {
    double sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = 0; k < 3; ++k) {
            sum += u[j] * v[k] * dot(p, polynomial.derivative(xi, {j, k}));
        }
    }
    return sum;
}

} // namespace

TEST_CASE("second derivatives are bounded by an element's forms in all directions, and little across a long one") {
    std::mt19937 engine(22);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto any = [&] { return Vector3{number(engine), number(engine), number(engine)}; };
    double sharpest = 0, across = 0;
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_TETRAHEDRON}) {
        for (const std::uint32_t degree : {2u, 3u, 4u}) {
            const Polynomial polynomial = long_and_bent(static_cast<int>(degree), engine);
            const BendForm form = bends_of(polynomial, shape, {degree, degree, degree}).form;
            INFO("shape " << shape << ", degree " << degree);
            REQUIRE(form != BendForm{});
            for (int sample = 0; sample < 200; ++sample) {
                const Vector3 u = any(), v = any(), p = any();
                const double bound =
                    std::sqrt(quadratic(form.ways, p) * quadratic(form.lengths, u) * quadratic(form.lengths, v));
                for (const Vector3& xi : lattice(shape, 4)) {
                    const double shown = std::abs(second_derivative(polynomial, xi, u, v, p));
                    REQUIRE(shown <= bound);
                    sharpest = std::max(sharpest, shown / bound);
                }
            }
            across = std::max(across, quadratic(form.lengths, {0, 1, -1}) / quadratic(form.lengths, {0, 1, 1}));
        }
    }
    std::cout << "forms: up to " << sharpest << " of the bound, " << across << " of it across\n";
    CHECK(sharpest > 0.9);
    CHECK(across < 0.02);
}

TEST_CASE("only elements without a proven curvature have forms, and those hold") {
    std::mt19937 engine(23);
    const Polynomial mild = random_polynomial(ELVIS_SHAPE_TETRAHEDRON, 3, 0.3, engine);
    REQUIRE(proven(mild, ELVIS_SHAPE_TETRAHEDRON, {3, 3, 3}) < unknown_curvature);
    CHECK(bends_of(mild, ELVIS_SHAPE_TETRAHEDRON, {3, 3, 3}).form == BendForm{});
    // x = (10 xi1, xi2 + 6 xi1^2, xi3): sheared, it does not fold, and its second derivative is (0, 12, 0).
    const Polynomial sheared(std::vector<Term>{{{1, 0, 0}, {9, 0, 0}}, {{2, 0, 0}, {0, 6, 0}}});
    REQUIRE(proven(sheared, ELVIS_SHAPE_HEXAHEDRON, {2, 1, 1}) == unknown_curvature);
    const BendForm form = bends_of(sheared, ELVIS_SHAPE_HEXAHEDRON, {2, 1, 1}).form;
    const double bound = std::sqrt(quadratic(form.ways, {0, 1, 0})) * quadratic(form.lengths, {1, 0, 0});
    CHECK(bound >= 12);
    CHECK(bound < 12.1);
    CHECK(quadratic(form.lengths, {0, 1, 1}) < 0.01 * quadratic(form.lengths, {1, 0, 0}));
    CHECK(bend_form_of({}, {}) == BendForm{});
}

TEST_CASE("what bends only between the points where curvatures are measured is known to bend") {
    // The Jacobian is 1 + 0.8 x (x^2 - 1) (x^2 - 1/4): it is 1 at the ends, the middle and half-way between.
    const Polynomial polynomial(
        std::vector<Term>{{{6, 0, 0}, {0.8 / 6, 0, 0}}, {{4, 0, 0}, {-0.25, 0, 0}}, {{2, 0, 0}, {0.1, 0, 0}}});
    const double shown = sampled(polynomial, lattice(ELVIS_SHAPE_HEXAHEDRON, 9), lattice(ELVIS_SHAPE_HEXAHEDRON, 17));
    REQUIRE(shown > 0.5);
    const native::Space space = oracle::space_of(native::Shape::hexahedron, 6);
    oracle::VolumeData data;
    data.classes.push_back(oracle::make_class(space, space, {[&](const oracle::Vector& xi) {
                                                  const Vector3 x = polynomial.at({xi[0], xi[1], xi[2]});
                                                  return oracle::Vector(x[0], x[1], x[2]);
                                              }},
                                              [](const oracle::Vector& x) { return x[0]; }));
    const TemporaryFile file("bump.h5");
    oracle::write_volume(file.path(), data);
    const RuntimeVolume volume = oracle::open_volume(file.path());
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        DeviceVolume on_device(test::device(), volume, precision, nullptr);
        on_device.select(0, 0, {0});
        REQUIRE(on_device.curvatures(0).size() == 1);
        CHECK(on_device.curvatures(0)[0] >= shown);
        CHECK(on_device.curvatures(0)[0] < unknown_curvature);
    }
}

TEST_CASE("elements that fold, or are flat, have no curvature") {
    for (const double bend : {0.6, 0.5}) {
        const Polynomial folded(std::vector<Term>{{{2, 0, 0}, {bend, 0, 0}}});
        CHECK(proven(folded, ELVIS_SHAPE_HEXAHEDRON, {2, 1, 1}) == unknown_curvature);
    }
    // Seen while a bound is looked for, and bent so much that none is looked for.
    for (const double bend : {0.7, 9.0}) {
        const Polynomial folded(std::vector<Term>{{{2, 0, 0}, {bend, 0, 0}}});
        CHECK(bends_of(folded, ELVIS_SHAPE_HEXAHEDRON, {2, 1, 1}) == ElementBends{});
    }
    const Polynomial bent(std::vector<Term>{{{2, 0, 0}, {0.45, 0, 0}}});
    CHECK(proven(bent, ELVIS_SHAPE_HEXAHEDRON, {2, 1, 1}) == unknown_curvature);
    CHECK(bends_of(bent, ELVIS_SHAPE_HEXAHEDRON, {2, 1, 1}) != ElementBends{});
    const Polynomial flat(std::vector<Term>{{{0, 0, 1}, {0, 0, -1}}});
    CHECK(proven(flat, ELVIS_SHAPE_HEXAHEDRON, {1, 1, 1}) == unknown_curvature);
    const Polynomial nowhere(std::vector<Term>{{{1, 0, 0}, {std::nan(""), 0, 0}}});
    CHECK(proven(nowhere, ELVIS_SHAPE_HEXAHEDRON, {1, 1, 1}) == unknown_curvature);
}

} // namespace elvis
