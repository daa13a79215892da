// Both root finders on random polynomials.
#include <core/bench/roots.hpp>

#include <catch2/catch.hpp>

using namespace elvis;

TEST_CASE("No root that a true evaluation confirms is missed by the Bernstein form") {
    const Device device;
    std::uint64_t n_with_root = 0;
    bench_roots(&device, 44000, [&](const RootsResult& result) {
        INFO("degree " << result.degree << (result.on_device ? ", device" : ", CPU")
                       << (result.precision == Precision::float64 ? ", float64" : ", float32"));
        n_with_root += result.n_with_root;
        // Single precision is for degrees up to 8.
        if (result.precision == Precision::float64 || result.degree <= 8) {
            CHECK(result.bernstein_missed == 0);
            CHECK(result.bernstein_false <= (result.precision == Precision::float64 ? 0u : 2u));
            CHECK(result.n_touching <= result.n_polynomials / 1000);
        }
        // Now and then two roots come out as a complex pair.
        CHECK(result.colleague_missed <= result.n_polynomials / 500);
        CHECK(result.colleague_false <= result.n_polynomials / 500);
        CHECK(result.bernstein_error <= (result.precision == Precision::float64 ? 1e-8 : 1e-3));
    });
    CHECK(n_with_root > 44000);
}
