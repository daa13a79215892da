// Crossings of polynomials whose roots are known.
#include "random.hpp"

#include <core/segment/colleague.hpp>
#include <core/segment/crossings.hpp>

#include <catch2/catch.hpp>

using namespace elvis;
using namespace elvis::segment;

namespace {

constexpr double error = 1e-12;

template <class Real>
std::vector<Crossing<Real>> all_crossings(const Polynomial<Real>& p, Real tolerance, const std::vector<Real>& values) {
    std::vector<Crossing<Real>> found;
    Isolation isolation;
    while (!isolation.is_over()) {
        const Crossing<Real> crossing = next_crossing<Real>(p, tolerance, values, isolation);
        if (crossing.kind != CrossingKind::none) {
            found.push_back(crossing);
        }
    }
    return found;
}

} // namespace

TEST_CASE("Simple roots are found in order, each verified by its bracket") {
    test::Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<double> roots;
        const int n = 1 + trial % 6;
        for (int i = 0; i < n; ++i) {
            roots.push_back((i + random.between(0.15, 0.85)) / n);
        }
        const Polynomial<double> p = test::from_roots(roots, 2 + trial % 12 < n ? n : 2 + trial % 12, 100);
        const auto found = all_crossings(p, error, {0.0});
        REQUIRE(found.size() == roots.size());
        for (std::size_t i = 0; i < roots.size(); ++i) {
            CHECK(found[i].t == Approx(roots[i]).margin(1e-10));
            CHECK(found[i].kind == CrossingKind::verified);
            CHECK(found[i].lower <= found[i].t);
            CHECK(found[i].t <= found[i].upper);
        }
    }
}

TEST_CASE("Roots outside of the segment are none") {
    for (const std::vector<double>& roots : std::vector<std::vector<double>>{{-0.1, 1.1}, {1.001}, {-1e-6, 2}}) {
        CHECK(all_crossings(test::from_roots(roots, 6), error, {0.0}).empty());
    }
    // None at all: complex roots, close to the segment.
    Polynomial<double> p = test::from_roots({0.5, 0.5}, 8);
    for (int i = 0; i <= p.degree; ++i) {
        p[i] += 1e-9;
    }
    CHECK(all_crossings(p, error, {0.0}).empty());
}

TEST_CASE("Double roots are touches, triple roots cross") {
    for (const double root : {0.3, 0.5, 0.625}) {
        for (const double shift : {0.0, 5e-13}) {
            Polynomial<double> p = test::from_roots({root, root}, 5);
            for (int i = 0; i <= p.degree; ++i) {
                p[i] += shift;
            }
            const auto found = all_crossings(p, error, {0.0});
            REQUIRE(!found.empty());
            for (const Crossing<double>& crossing : found) {
                CHECK(crossing.t == Approx(root).margin(3e-6));
                CHECK(crossing.kind != CrossingKind::verified);
            }
        }
        const auto found = all_crossings(test::from_roots({root, root, root}, 7), error, {0.0});
        REQUIRE(!found.empty());
        for (const Crossing<double>& crossing : found) {
            CHECK(crossing.t == Approx(root).margin(3e-4));
        }
    }
}

TEST_CASE("Two roots closer than single precision are still two in double precision") {
    const auto found = all_crossings(test::from_roots({0.4, 0.4 + 1e-5}, 8), 1e-14, {0.0});
    REQUIRE(found.size() == 2);
    CHECK(found[0].t == Approx(0.4).margin(1e-9));
    CHECK(found[1].t == Approx(0.4 + 1e-5).margin(1e-9));
}

TEST_CASE("Roots at the ends are found, on a cell's end once") {
    for (const double root : {0.0, 1.0, 0.5, 0.25}) {
        const auto found = all_crossings(test::from_roots({root}, 6), error, {0.0});
        REQUIRE(found.size() == 1);
        CHECK(found[0].t == Approx(root).margin(1e-12));
    }
    // Three with the middle one where the first cut is.
    const auto found = all_crossings(test::from_roots({0.2, 0.5, 0.9}, 8, 10), error, {0.0});
    REQUIRE(found.size() >= 3);
    CHECK(found.size() <= 4);
    CHECK(found[1].t == Approx(0.5).margin(1e-10));
    // Within the error beyond the end: only the field can tell.
    Polynomial<double> near = test::from_roots({1 + 1e-13}, 4);
    const auto beside = all_crossings(near, error, {0.0});
    REQUIRE(beside.size() == 1);
    CHECK(beside[0].kind == CrossingKind::touch);
    CHECK(beside[0].t == 1);
}

TEST_CASE("Constants are one touch or nothing") {
    Polynomial<double> p{8, {}};
    p.c.fill(2.0);
    CHECK(all_crossings(p, error, {1.0}).empty());
    const auto found = all_crossings(p, error, {1.0, 2.0, 3.0});
    REQUIRE(found.size() == 1);
    CHECK(found[0].kind == CrossingKind::touch);
    CHECK(found[0].index == 1);
}

TEST_CASE("NaN is nowhere crossed") {
    Polynomial<double> p{8, {}};
    p.c.fill(std::nan(""));
    CHECK(all_crossings(p, error, {0.0}).empty());
}

TEST_CASE("Of several values each crossing is found, in order along the segment") {
    // From 0 up to 1 and down to 0 again: 4 t (1 - t).
    const Polynomial<double> p = test::from_roots({0, 1}, 4, -4);
    const auto found = all_crossings(p, error, {-0.5, 0.36, 0.75, 0.84, 1.5});
    const std::vector<std::pair<std::uint32_t, double>> known{{1, 0.1}, {2, 0.25}, {3, 0.3}, {3, 0.7}, {2, 0.75}, {1, 0.9}};
    REQUIRE(found.size() == known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
        CHECK(found[i].index == known[i].first);
        CHECK(found[i].t == Approx(known[i].second).margin(1e-12));
    }
}

TEMPLATE_TEST_CASE("Crossings of random polynomials are those of dense samples", "", float, double) {
    test::Random random(4);
    for (int trial = 0; trial < 3000; ++trial) {
        const auto chebyshev = random.chebyshev<TestType>(2 + trial % 7);
        const TestType rounding = bernstein_rounding(chebyshev);
        const std::vector<TestType> values{TestType(-0.25), 0, TestType(0.5)};
        const auto found = all_crossings(to_bernstein(chebyshev), rounding, values);
        const auto& last =
            std::adjacent_find(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.t > b.t; });
        CHECK(last == found.end());
        // Samples that are certainly on both sides have a crossing between them.
        constexpr int n_samples = 256;
        for (std::uint32_t index = 0; index < values.size(); ++index) {
            const auto difference = [&](int i) {
                return chebyshev_value(chebyshev, static_cast<TestType>(i) / n_samples) - values[index];
            };
            for (int i = 0; i < n_samples; ++i) {
                const TestType before = difference(i), behind = difference(i + 1);
                if (before * behind < 0 && std::min(std::abs(before), std::abs(behind)) > 2 * rounding) {
                    CHECK(std::any_of(found.begin(), found.end(), [&](const auto& crossing) {
                        return crossing.index == index && crossing.t >= static_cast<TestType>(i) / n_samples &&
                               crossing.t <= static_cast<TestType>(i + 1) / n_samples;
                    }));
                }
            }
        }
    }
}

TEST_CASE("The colleague matrix gives known roots") {
    // T_5 has its roots at (1 + cos(pi (k + 1/2) / 5)) / 2; higher coefficients that vanish do not disturb.
    Polynomial<double> p{9, {0, 0, 0, 0, 0, 1}};
    const std::vector<double> roots = roots_by_colleague(p, 0);
    REQUIRE(roots.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(roots[i] == Approx((1 - std::cos(M_PI * (static_cast<double>(i) + 0.5) / 5)) / 2).margin(1e-14));
    }
    CHECK(roots_by_colleague({4, {0.5, 1}}, 0) == std::vector<double>{0.25});
    CHECK(roots_by_colleague({4, {0.5}}, 0).empty());
}
