// Bernstein forms of the Jacobian's columns and determinant, and bounds of their rounding.
#include "bounds/derivative_forms.hpp"
#include "bounds/determinant_form.hpp"
#include "jacobian_corpus.hpp"
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <cmath>

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

std::vector<Space> mapping_spaces() {
    std::vector<Space> result;
    for (const Space& space : test_spaces())
        if (dimension(space.shape) == 3 && space.order[0] > 0 && space.order[0] <= 5)
            result.push_back(space);
    return result;
}

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
