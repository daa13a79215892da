// Signs of Jacobian determinants.
#include "jacobian_corpus.hpp"
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <map>

using namespace elvis::native;

namespace {

double smallest_sample(const CorpusElement& element, int n) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int k = 0; k <= n; ++k) {
                // The apex has no single determinant.
                const double top = element.space.shape == Shape::pyramid ? 1 - 1e-6 : 1;
                const Point eta{2.0 * i / n - 1, 2.0 * j / n - 1, std::min(2.0 * k / n - 1, top)};
                least = std::min(least, determinant_at(element.space, element.coefficients, expand(element.space.shape, eta)));
            }
    return least;
}

} // namespace

TEST_CASE("A thousand elements of known sign are all told right") {
    const std::vector<CorpusElement> corpus = jacobian_corpus(7, 250);
    REQUIRE(corpus.size() == 1000);
    int n_negative = 0;
    for (const CorpusElement& element : corpus) {
        INFO(text(element.space) << ": " << element.origin);
        JacobianChecker checker(element.space);
        JacobianCheck check;
        checker(element.coefficients, std::span(&check, 1));
        const double sampled = smallest_sample(element, 6);
        if (element.is_negative) {
            ++n_negative;
            REQUIRE(check.sign == JacobianSign::negative);
            REQUIRE(is_inside(element.space.shape, check.xi));
            const double there = determinant_at(element.space, element.coefficients, check.xi);
            CHECK(std::abs(there - check.determinant) < 1e-9);
            CHECK(there < 0);
        } else {
            REQUIRE(check.sign == JacobianSign::positive);
            CHECK(check.lower > 0);
            CHECK(check.lower <= sampled * (1 + 1e-9));
        }
    }
    CHECK(n_negative > 300);
    CHECK(n_negative < 700);
}

TEST_CASE("What an element is told does not depend on the elements beside it") {
    // Of one space, in blocks of every length around the number that is worked on at once.
    Points points(51);
    const Space space{Shape::hexahedron, Basis::modified, {2, 2, 2}};
    std::vector<double> coefficients;
    constexpr std::size_t n = 37;
    for (std::size_t element = 0; element < n; ++element) {
        const double amplitude = 0.02 * static_cast<double>(element);
        const auto part = fit_mapping(space, [&](const Point& xi) {
            return Point{xi[0] + amplitude * points.number(), xi[1] + amplitude * points.number(),
                         xi[2] + amplitude * points.number()};
        });
        coefficients.insert(coefficients.end(), part.begin(), part.end());
    }
    const std::size_t size = 3 * n_modes(space);
    JacobianChecker checker(space);
    std::vector<JacobianCheck> all(n);
    checker(coefficients, all);
    std::map<JacobianSign, int> seen;
    for (std::size_t element = 0; element < n; ++element) {
        JacobianCheck alone;
        checker(std::span(coefficients).subspan(element * size, size), std::span(&alone, 1));
        CHECK(alone.sign == all[element].sign);
        CHECK((alone.lower == all[element].lower || std::isnan(alone.lower)));
        CHECK((alone.determinant == all[element].determinant || std::isnan(alone.determinant)));
        ++seen[alone.sign];
    }
    CHECK(seen[JacobianSign::positive] > 3);
    CHECK(seen[JacobianSign::negative] > 3);
}

TEST_CASE("A determinant that touches zero is undecided, whatever the tolerance") {
    for (const double tolerance : {1e-3, 1e-9, 0.0})
        for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::tetrahedron}) {
            CAPTURE(name(shape), tolerance);
            // det = 1 + xi1 is zero on a face; det = (xi1 + xi2)^2 on a plane; det = 0 everywhere.
            const std::array<std::function<Point(const Point&)>, 3> mappings{
                [](const Point& xi) {
                    return Point{xi[0] + xi[0] * xi[0] / 2, xi[1], xi[2]};
                },
                [](const Point& xi) {
                    return Point{std::pow(xi[0] + xi[1], 3) / 3, xi[1], xi[2]};
                },
                [](const Point& xi) {
                    return Point{xi[0], xi[1], xi[0] + xi[1]};
                }};
            for (const auto& mapping : mappings) {
                const Space space{shape, Basis::modified, {3, 3, 3}};
                JacobianChecker checker(space, {.tolerance = tolerance, .max_parts = 200});
                const auto coefficients = fit_mapping(space, mapping);
                JacobianCheck check;
                checker(coefficients, std::span(&check, 1));
                // The fit is rounded, so that the stored mapping may be negative by a rounding; it is never called positive.
                CHECK(check.sign != JacobianSign::positive);
                if (check.sign == JacobianSign::negative)
                    CHECK(std::abs(check.determinant) < 1e-12);
                else
                    CHECK(check.lower <= 0);
            }
        }
    // With coefficients that are exact, neither sign may be claimed.
    const Space space{Shape::hexahedron, Basis::modified, {1, 1, 1}};
    std::vector<double> flat;
    for (const std::size_t direction : {0U, 1U, 2U})
        for (std::size_t mode = 0; mode < 8; ++mode)
            flat.push_back(direction == 2 ? 0.0 : (mode >> direction) % 2 == 0 ? -1.0 : 1.0);
    JacobianCheck check;
    JacobianChecker checker(space);
    checker(flat, std::span(&check, 1));
    CHECK(check.sign == JacobianSign::undecided);
    CHECK(check.lower <= 0);
}

TEST_CASE("The tolerance bounds what is left undecided") {
    const Space space{Shape::hexahedron, Basis::modified, {3, 3, 3}};
    const auto checked = [&](double minimum, double tolerance) {
        const auto coefficients = fit_mapping(space, [&](const Point& xi) {
            return Point{minimum * xi[0] + std::pow(xi[0] - 0.3, 3) / 3, xi[1], xi[2]};
        });
        JacobianChecker checker(space, {.tolerance = tolerance});
        JacobianCheck check;
        checker(coefficients, std::span(&check, 1));
        return check;
    };
    CHECK(checked(1e-6, 1e-9).sign == JacobianSign::positive);
    CHECK(checked(-1e-6, 1e-9).sign == JacobianSign::negative);
    CHECK(checked(-1e-6, 1e-9).xi[0] == Approx(0.3).margin(2e-3));
    // Left open early, but what is said of it is true.
    const JacobianCheck open = checked(1e-6, 1e-2);
    CHECK(open.sign == JacobianSign::undecided);
    CHECK(open.lower > -0.03);
    CHECK(open.lower < 1e-6);
    CHECK(open.determinant >= 1e-6 * (1 - 1e-9));
}

TEST_CASE("Small elements far from the origin are still decided") {
    for (const Basis basis : {Basis::modified, Basis::orthogonal, Basis::gll_lagrange}) {
        const Space space{Shape::hexahedron, basis, {2, 2, 2}};
        const auto coefficients = fit_mapping(space, [](const Point& xi) {
            return Point{1e4 + 1e-4 * (xi[0] + 0.4 * xi[1] * xi[1]), 1e4 + 1e-4 * (xi[1] + 0.4 * xi[0] * xi[2]),
                         1e4 + 1e-4 * xi[2]};
        });
        JacobianCheck check;
        JacobianChecker checker(space);
        checker(coefficients, std::span(&check, 1));
        CHECK(check.sign == JacobianSign::positive);
    }
}

TEST_CASE("Coefficients that are not finite, and pyramids torn at the apex, are undecided without a bound") {
    Points points(52);
    Space space{Shape::prism, Basis::modified, {2, 2, 2}};
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
        std::vector<double> coefficients = random_mapping(space, points);
        coefficients[5] = bad;
        JacobianCheck check;
        JacobianChecker checker(space);
        checker(coefficients, std::span(&check, 1));
        CHECK(check.sign == JacobianSign::undecided);
        CHECK(check.lower == -std::numeric_limits<double>::infinity());
    }
    space = {Shape::pyramid, Basis::tensor, {2, 2, 2}};
    std::vector<double> coefficients = fit_mapping(space, [](const Point& xi) { return xi; });
    JacobianCheck check;
    JacobianChecker checker(space);
    checker(coefficients, std::span(&check, 1));
    CHECK(check.sign == JacobianSign::positive);
    // Mode (0, 1, 1) lives at the apex alone.
    coefficients[4] += 1e-3;
    checker(coefficients, std::span(&check, 1));
    CHECK(check.sign == JacobianSign::undecided);
    CHECK(check.lower == -std::numeric_limits<double>::infinity());
}

TEST_CASE("The apex of a pyramid is no witness, points close to it are") {
    // det = 1 - 1.2 xi3 is negative above xi3 = 5/6 only.
    for (const Basis basis : {Basis::modified, Basis::orthogonal, Basis::tensor}) {
        const Space space{Shape::pyramid, basis, {2, 2, 2}};
        const auto coefficients = fit_mapping(space, [](const Point& xi) {
            return Point{xi[0], xi[1], xi[2] - 0.6 * xi[2] * xi[2]};
        });
        JacobianCheck check;
        JacobianChecker checker(space);
        checker(coefficients, std::span(&check, 1));
        REQUIRE(check.sign == JacobianSign::negative);
        CHECK(check.xi[2] < 1);
        CHECK(check.xi[2] > 5.0 / 6);
        CHECK(determinant_at(space, coefficients, check.xi) < 0);
    }
    // A straight pyramid over a concave base: its determinant depends on the direction at the apex, and is negative along some.
    const Space space{Shape::pyramid, Basis::modified, {1, 1, 1}};
    std::vector<double> coefficients;
    const std::array<Point, 5> corner_of_mode{{{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {-0.3, -0.3, -1}}};
    for (std::size_t direction = 0; direction < 3; ++direction)
        for (const Point& point : corner_of_mode)
            coefficients.push_back(point[direction]);
    JacobianCheck check;
    JacobianChecker checker(space);
    checker(coefficients, std::span(&check, 1));
    REQUIRE(check.sign == JacobianSign::negative);
    CHECK(check.xi[2] < 1);
    CHECK(determinant_at(space, coefficients, check.xi) < 0);
}

TEST_CASE("Spaces without a volume are refused") {
    CHECK_THROWS_AS(JacobianChecker({Shape::triangle, Basis::modified, {2, 2, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(JacobianChecker({Shape::hexahedron, Basis::modified, {0, 0, 0}}), std::invalid_argument);
}
