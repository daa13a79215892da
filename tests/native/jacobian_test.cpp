// Signs of Jacobian determinants.
#include "bounds/derivative_forms.hpp"
#include "bounds/determinant_form.hpp"
#include "jacobian_corpus.hpp"
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <map>

using namespace elvis::native;

namespace {

// Value of a Bernstein form at eta, from its definition.
double bernstein_value(Shape shape, const Sizes& sizes, const double* form, const Point& eta) {
    const Sizes places = storage_places(shape);
    std::array<std::vector<double>, 3> basis;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const std::size_t n = sizes[places[direction]] - 1;
        double binomial = 1;
        for (std::size_t k = 0; k <= n; ++k) {
            basis[places[direction]].push_back(binomial * std::pow((1 + eta[direction]) / 2, k) *
                                               std::pow((1 - eta[direction]) / 2, n - k));
            binomial *= static_cast<double>(n - k) / static_cast<double>(k + 1);
        }
    }
    double sum = 0;
    for (const double a : basis[0])
        for (const double b : basis[1])
            for (const double c : basis[2])
                sum += a * b * c * *form++;
    return sum;
}

// Three components with coefficients in [-1, 1]; continuous at the apex of tensor pyramids.
std::vector<double> random_mapping(const Space& space, Points& points) {
    std::vector<double> result;
    for (int i = 0; i < 3; ++i) {
        std::vector<double> part = points.coefficients(space);
        if (space.basis == Basis::tensor) {
            const std::size_t n2 = space.order[1] + 1, n3 = space.order[2] + 1;
            const double apex = part[1];
            for (std::size_t p = 0; p <= space.order[0]; ++p)
                for (std::size_t q = 0; q < n2; ++q)
                    part[(p * n2 + q) * n3 + 1] = p < 2 && q < 2 ? apex : 0;
        }
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

std::vector<Space> mapping_spaces() {
    std::vector<Space> result;
    for (const Space& space : test_spaces())
        if (dimension(space.shape) == 3 && space.order[0] > 0 && space.order[0] <= 5)
            result.push_back(space);
    return result;
}

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

namespace {

// The determinant's form of one element, with the bound of its error.
struct Form {
    std::vector<double> numbers;
    double error = 0;
};

Form determinant_form(const Space& space, const std::vector<double>& coefficients) {
    const DerivativeForms forms(space);
    const DeterminantForm determinant(forms.columns());
    const std::size_t n = n_modes(space);
    std::vector<double> workspace(forms.workspace_size());
    std::array<std::vector<double>, 3> parts;
    std::array<const double*, 9> columns{};
    std::array<double, 9> magnitudes{}, errors{};
    for (std::size_t i = 0; i < 3; ++i) {
        parts[i].resize(forms.size());
        double magnitude = 0;
        forms.evaluate<1>(coefficients.data() + i * n, workspace.data(), parts[i].data(), &magnitude);
        for (std::size_t j = 0; j < 3; ++j) {
            const auto& column = forms.columns()[j];
            columns[3 * j + i] = parts[i].data() + column.offset;
            errors[3 * j + i] = column.error * magnitude;
            for (std::size_t k = 0; k < product(column.sizes); ++k)
                magnitudes[3 * j + i] = std::max(magnitudes[3 * j + i], std::abs(columns[3 * j + i][k]));
            magnitudes[3 * j + i] += errors[3 * j + i];
        }
    }
    Form result{std::vector<double>(determinant.size()), determinant_error(magnitudes, errors, determinant.gamma())};
    workspace.resize(determinant.workspace_size());
    determinant.evaluate<1>(columns, workspace.data(), result.numbers.data());
    return result;
}

} // namespace

TEST_CASE("Rounding stays within the bound that is stated for it") {
    // The same element three times as large has exactly 27 times the determinant, but other roundings.
    Points points(53);
    double largest_share = 0;
    for (const Space& space : mapping_spaces()) {
        CAPTURE(text(space));
        std::vector<double> coefficients = random_mapping(space, points);
        const Form once = determinant_form(space, coefficients);
        for (double& c : coefficients) {
            // Few bits, so that the multiplication is exact.
            REQUIRE(std::abs(c) < 2);
            c = 3 * static_cast<double>(static_cast<float>(c));
        }
        std::vector<double> third = coefficients;
        for (double& c : third)
            c /= 3;
        const Form small = determinant_form(space, third), large = determinant_form(space, coefficients);
        double difference = 0, size = 0;
        for (std::size_t k = 0; k < small.numbers.size(); ++k) {
            difference = std::max(difference, std::abs(large.numbers[k] - 27 * small.numbers[k]));
            size = std::max(size, std::abs(small.numbers[k]));
        }
        REQUIRE(difference <= large.error + 27 * small.error);
        CHECK(once.error < 1e-8 * size); // elements more tangled than any mesh has
        largest_share = std::max(largest_share, difference / (large.error + 27 * small.error));
    }
    // A bound that is never reached to a thousandth would decide less than it could.
    CHECK(largest_share > 1e-3);
}

TEST_CASE("The product of columns without error stays within its own bound") {
    Points points(54);
    for (const Space& space : mapping_spaces()) {
        CAPTURE(text(space));
        const DeterminantForm determinant(DerivativeForms(space).columns());
        const DerivativeForms forms(space);
        std::array<std::vector<double>, 9> once, thrice;
        std::array<const double*, 9> columns{}, large_columns{};
        std::array<double, 9> magnitudes{};
        for (std::size_t k = 0; k < 9; ++k) {
            for (std::size_t i = 0; i < product(forms.columns()[k / 3].sizes); ++i) {
                once[k].push_back(static_cast<float>(points.number()));
                thrice[k].push_back(3 * once[k].back());
                magnitudes[k] = std::max(magnitudes[k], std::abs(once[k].back()));
            }
            columns[k] = once[k].data();
            large_columns[k] = thrice[k].data();
        }
        std::vector<double> workspace(determinant.workspace_size()), small(determinant.size()), large(determinant.size());
        determinant.evaluate<1>(columns, workspace.data(), small.data());
        determinant.evaluate<1>(large_columns, workspace.data(), large.data());
        const double bound = determinant_error(magnitudes, {}, determinant.gamma());
        double difference = 0;
        for (std::size_t k = 0; k < small.size(); ++k)
            difference = std::max(difference, std::abs(large[k] - 27 * small[k]));
        REQUIRE(difference <= 2 * 27 * bound);
        CHECK((difference > 0 || determinant.size() == 1));
    }
}

TEST_CASE("Bernstein forms of the Jacobian's columns and determinant agree with gradients of the modes") {
    Points points(50);
    for (const Space& space : mapping_spaces()) {
        CAPTURE(text(space));
        const DerivativeForms forms(space);
        const DeterminantForm determinant(forms.columns());
        const std::vector<double> coefficients = random_mapping(space, points);
        const std::size_t n = n_modes(space);
        std::array<std::vector<double>, 3> parts;
        std::array<double, 3> magnitudes{};
        std::vector<double> workspace(forms.workspace_size());
        std::array<const double*, 9> columns{};
        for (std::size_t i = 0; i < 3; ++i) {
            parts[i].resize(forms.size());
            forms.evaluate<1>(coefficients.data() + i * n, workspace.data(), parts[i].data(), &magnitudes[i]);
            for (std::size_t j = 0; j < 3; ++j)
                columns[3 * j + i] = parts[i].data() + forms.columns()[j].offset;
        }
        std::vector<double> product_workspace(determinant.workspace_size()), product_form(determinant.size());
        determinant.evaluate<1>(columns, product_workspace.data(), product_form.data());
        const double largest = std::abs(*std::max_element(product_form.begin(), product_form.end(),
                                                          [](double a, double b) { return std::abs(a) < std::abs(b); }));
        std::vector<double> values(n), gradients(3 * n);
        for (int sample = 0; sample < 10; ++sample) {
            const Point eta = points.eta(space.shape);
            const Point xi = expand(space.shape, eta);
            evaluate_modes(space, xi, values, gradients);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) {
                    double expected = 0;
                    for (std::size_t mode = 0; mode < n; ++mode)
                        expected += coefficients[i * n + mode] * gradients[3 * mode + j];
                    const auto& column = forms.columns()[j];
                    const double found = bernstein_value(space.shape, column.sizes, columns[3 * j + i], eta);
                    REQUIRE(std::abs(found - expected) < 1e-11 * magnitudes[i]);
                }
            const double expected = determinant_at(space, coefficients, xi);
            REQUIRE(std::abs(bernstein_value(space.shape, determinant.sizes(), product_form.data(), eta) - expected) <
                    1e-11 * largest);
        }
        // The stated bounds are bounds, and useful ones: far below the coefficients.
        for (const auto& column : forms.columns()) {
            CHECK(column.error < 1e-9 * column.bound);
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < product(column.sizes); ++k)
                    REQUIRE(std::abs(parts[i][column.offset + k]) <= column.bound * magnitudes[i]);
        }
    }
}

TEST_CASE("Forms have the least degree that their shape allows") {
    const auto sizes = [](Shape shape, std::uint32_t n) {
        return DeterminantForm(DerivativeForms({shape, Basis::modified, {n, n, n}}).columns()).sizes();
    };
    CHECK(sizes(Shape::hexahedron, 1) == Sizes{3, 3, 3});
    CHECK(sizes(Shape::hexahedron, 2) == Sizes{6, 6, 6});
    CHECK(sizes(Shape::tetrahedron, 1) == Sizes{1, 1, 1});
    CHECK(sizes(Shape::tetrahedron, 2) == Sizes{4, 4, 4});
    CHECK(sizes(Shape::prism, 2) == Sizes{5, 6, 5});
}

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
