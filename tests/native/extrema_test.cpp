// The extrema of fields: near the true ones, enclosed, at the place that is told, whatever the order of blocks.
#include "spaces.hpp"

#include <elvis/native/extrema.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace elvis::native;

namespace {

/** A field over several elements of one class, in memory. */
struct Data {
    Space space;
    std::uint32_t n_components = 1;
    std::vector<double> coefficients;

    std::size_t record() const { return n_components * n_modes(space); }
    std::uint64_t n_elements() const { return coefficients.size() / record(); }
    std::span<const double> part(std::uint64_t first, std::uint64_t count) const {
        return std::span(coefficients).subspan(first * record(), count * record());
    }

    double value(std::uint64_t element, std::size_t entry, const Point& xi) const {
        const auto component = [&](std::size_t index) {
            return evaluate(space, part(element, 1).subspan(index * n_modes(space), n_modes(space)), xi);
        };
        if (entry < n_components)
            return component(entry);
        double sum = 0;
        for (std::size_t index = 0; index < n_components; ++index)
            sum += component(index) * component(index);
        return std::sqrt(sum);
    }
};

/** Blocks of that many elements, the last block first if `backwards`. */
std::vector<Extrema> search(const Data& data, std::uint64_t block, bool backwards = false) {
    ExtremaSearch search(std::span(&data.space, 1), data.n_components);
    std::vector<std::uint64_t> firsts;
    for (std::uint64_t first = 0; first < data.n_elements(); first += block)
        firsts.push_back(first);
    if (backwards)
        std::reverse(firsts.begin(), firsts.end());
    for (const std::uint64_t first : firsts) {
        const std::uint64_t count = std::min(block, data.n_elements() - first);
        search.add(0, first, count, data.part(first, count));
    }
    return search.finish([&](std::size_t, std::uint64_t first, std::uint64_t count, std::span<double> out) {
        std::ranges::copy(data.part(first, count), out.begin());
    });
}

/** The extrema hold for dense samples, and are where they are said to be. */
void check(const Data& data, const std::vector<Extrema>& found, std::size_t entry) {
    const Extrema& extrema = found.at(entry);
    const double distance = extrema.maximum.value - extrema.minimum.value;
    // Evaluation rounds modes of up to 20, a hundred times.
    constexpr double rounding = 1e-12;
    CHECK(extrema.maximum.bound - extrema.maximum.value <= extrema_tolerance * distance + rounding);
    CHECK(extrema.minimum.value - extrema.minimum.bound <= extrema_tolerance * distance + rounding);
    CHECK(extrema.maximum.bound >= extrema.maximum.value);
    CHECK(extrema.minimum.bound <= extrema.minimum.value);
    for (const Extremum& extremum : {extrema.minimum, extrema.maximum}) {
        CHECK(is_inside(data.space.shape, extremum.xi));
        CHECK(data.value(extremum.element, entry, extremum.xi) == Approx(extremum.value).margin(rounding));
    }
    constexpr int n = 12;
    double lower = std::numeric_limits<double>::infinity(), upper = -lower;
    const int depth = dimension(data.space.shape) == 3 ? n : 0;
    for (std::uint64_t element = 0; element < data.n_elements(); ++element)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j)
                for (int k = 0; k <= depth; ++k) {
                    const Point eta{2.0 * i / n - 1, 2.0 * j / n - 1, depth == 0 ? 0.0 : 2.0 * k / n - 1};
                    const double value = data.value(element, entry, expand(data.space.shape, eta));
                    lower = std::min(lower, value);
                    upper = std::max(upper, value);
                }
    CHECK(lower >= extrema.minimum.bound - rounding);
    CHECK(upper <= extrema.maximum.bound + rounding);
}

/** Nodal values at Gauss-Lobatto points of order 2 in the cube. */
template <class Function> std::vector<double> quadratic(Function function) {
    std::vector<double> result;
    for (const double z : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double x : {-1.0, 0.0, 1.0})
                result.push_back(function(x, y, z));
    return result;
}

} // namespace

TEST_CASE("Extrema enclose every sample, in every space") {
    Points points(70);
    for (const Space& space : test_spaces()) {
        CAPTURE(text(space));
        for (const std::uint32_t n_components : {1u, 3u}) {
            Data data{space, n_components, {}};
            // Random functions of a tensor pyramid are not continuous at the apex, where one value is asked for.
            const bool is_apex_open = space.basis == Basis::tensor;
            for (std::uint32_t i = 0; i < 3 * n_components; ++i) {
                std::vector<double> one = points.coefficients(space);
                if (is_apex_open)
                    std::fill(one.begin(), one.end(), points.number());
                data.coefficients.insert(data.coefficients.end(), one.begin(), one.end());
            }
            const std::vector<Extrema> found = search(data, 2);
            REQUIRE(found.size() == n_extrema(n_components));
            for (std::size_t entry = 0; entry < found.size(); ++entry)
                if (!is_apex_open || entry == 0)
                    check(data, found, entry);
        }
    }
}

TEST_CASE("Extrema inside of an element are found where they are") {
    const Space space{Shape::hexahedron, Basis::gll_lagrange, {2, 2, 2}};
    const auto hill = quadratic([](double x, double y, double z) {
        return 5 - (x - 0.3) * (x - 0.3) - 2 * (y + 0.2) * (y + 0.2) - (z - 0.55) * (z - 0.55);
    });
    const std::vector<Extrema> found = search({space, 1, hill}, 1);
    // Lowest in the corner (-1, 1, -1).
    const double lowest = 5 - 1.3 * 1.3 - 2 * 1.2 * 1.2 - 1.55 * 1.55;
    CHECK(found[0].minimum.value == Approx(lowest).epsilon(1e-14));
    CHECK(found[0].minimum.xi == Point{-1, 1, -1});
    CHECK(found[0].maximum.value == Approx(5).margin(extrema_tolerance * (5 - lowest)));
    CHECK(found[0].maximum.bound >= 5);
    CHECK(std::abs(found[0].maximum.xi[0] - 0.3) < 0.05);
    CHECK(std::abs(found[0].maximum.xi[1] + 0.2) < 0.05);
    CHECK(std::abs(found[0].maximum.xi[2] - 0.55) < 0.05);
}

TEST_CASE("The magnitude of a vector has extrema of its own") {
    const Space space{Shape::hexahedron, Basis::gll_lagrange, {2, 2, 2}};
    Data data{space, 2, quadratic([](double, double y, double) { return -y; })};
    const auto second = quadratic([](double x, double, double) { return x; });
    data.coefficients.insert(data.coefficients.end(), second.begin(), second.end());
    const std::vector<Extrema> found = search(data, 1);
    REQUIRE(found.size() == 3);
    CHECK(found[2].maximum.value == Approx(std::sqrt(2.0)));
    CHECK(found[2].minimum.value == Approx(0).margin(extrema_tolerance * 2));
    CHECK(found[2].minimum.bound == 0);
}

TEST_CASE("Extrema do not depend on the blocks") {
    Points points(71);
    const Space space{Shape::prism, Basis::modified, {3, 3, 3}};
    Data data{space, 2, {}};
    for (int i = 0; i < 2 * 3000; ++i) {
        const std::vector<double> one = points.coefficients(space);
        data.coefficients.insert(data.coefficients.end(), one.begin(), one.end());
    }
    const std::vector<Extrema> whole = search(data, 3000);
    for (const auto& [block, backwards] : {std::pair{1ul, false}, std::pair{7ul, true}, std::pair{1024ul, true}}) {
        const std::vector<Extrema> parts = search(data, block, backwards);
        for (std::size_t entry = 0; entry < whole.size(); ++entry)
            for (const auto side : {&Extrema::minimum, &Extrema::maximum}) {
                const Extremum &a = whole[entry].*side, &b = parts[entry].*side;
                CHECK(a.value == b.value);
                CHECK(a.bound == b.bound);
                CHECK(a.element == b.element);
                CHECK(a.xi == b.xi);
            }
    }
}

TEST_CASE("Elements that are not finite are passed over") {
    const Space space{Shape::tetrahedron, Basis::modified, {1, 1, 1}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Extrema> found = search({space, 1, {1, 2, 3, 4, nan, 9, 9, 9, 5, 6, 7, 8}}, 3);
    CHECK(found[0].minimum.value == 1);
    CHECK(found[0].maximum.value == 8);
    CHECK(found[0].maximum.element == 2);
    CHECK(std::isnan(search({space, 1, {nan, 1, 1, 1}}, 1)[0].maximum.value));
}
