// How much of a kernel is given to the device at once, on a device that is made up.
#include <core/vulkan/kernel/dispatch_pace.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;

namespace {

struct Run {
    double longest = 0, total = 0;
    std::uint64_t n_parts = 0;
};

/** Runs this many groups; `cost` gives the milliseconds of a part. */
template <class Cost> Run run(DispatchPace& pace, std::uint64_t n_groups, const Cost& cost) {
    Run result;
    for (std::uint64_t done = 0; done < n_groups; ++result.n_parts) {
        const std::uint64_t n = pace.next(n_groups - done);
        REQUIRE(n > 0);
        REQUIRE(n <= n_groups - done);
        const double milliseconds = cost(done, n);
        pace.took(n, milliseconds);
        result.longest = std::max(result.longest, milliseconds);
        result.total += milliseconds;
        done += n;
    }
    return result;
}

} // namespace

TEST_CASE("Parts of a kernel come to take as long as wanted") {
    for (const double each : {1e-4, 0.01, 1.0}) {
        DispatchPace pace(2);
        const auto even = [each](std::uint64_t, std::uint64_t n) { return each * static_cast<double>(n); };
        const auto n_groups = static_cast<std::uint64_t>(2000 / each);
        run(pace, n_groups, even);
        const Run second = run(pace, n_groups, even);
        CAPTURE(each);
        CHECK(second.longest < 1.1 * DispatchPace::wanted_milliseconds);
        CHECK(static_cast<double>(second.n_parts) < 1.2 * second.total / DispatchPace::wanted_milliseconds);
    }
}

TEST_CASE("What takes long in a picture is known in the next one, however long the background before it is") {
    DispatchPace pace(2);
    // A tenth of the picture takes a hundred times as long.
    const auto picture = [](std::uint64_t done, std::uint64_t n) {
        double sum = 0;
        for (std::uint64_t group = done; group < done + n; ++group) {
            sum += group >= 45000 && group < 55000 ? 0.2 : 0.002;
        }
        return sum;
    };
    run(pace, 100000, picture);
    const Run second = run(pace, 100000, picture);
    CHECK(second.longest < 10 * DispatchPace::wanted_milliseconds);
    // A submission costs 0.05 ms.
    CHECK(0.05 * static_cast<double>(second.n_parts) < 0.05 * second.total);
}

TEST_CASE("A device that needs many groups to be busy gets them") {
    DispatchPace pace(1024);
    // As on a GPU: a thousand groups take as long as one.
    const auto waiting = [](std::uint64_t, std::uint64_t n) { return 15 * std::ceil(static_cast<double>(n) / 1000.0); };
    run(pace, 50000, waiting);
    const Run second = run(pace, 50000, waiting);
    CHECK(second.n_parts <= 50);
}

TEST_CASE("The compilation that a driver hides in the first part is no measure") {
    DispatchPace pace(2);
    const std::uint64_t first = pace.next(1000000);
    pace.took(first, 3000);
    CHECK(pace.next(1000000) >= first);
}

TEST_CASE("Of what is submitted together parts take longer, and a first submission of unknown cost has small ones") {
    DispatchPace pace(1024, DispatchPace::wanted_collected_milliseconds);
    // Times become known when all have been submitted.
    for (std::uint64_t left = 100000; left > 0;) {
        const std::uint64_t n = pace.next(left);
        REQUIRE(n <= 1024);
        left -= n;
    }
    for (int submission = 0; submission < 8; ++submission) {
        const std::uint64_t n = pace.next(1000000);
        pace.took(n, 0.01 * static_cast<double>(n));
    }
    CHECK(static_cast<double>(pace.next(1000000)) * 0.01 > 0.9 * DispatchPace::wanted_collected_milliseconds);
    CHECK(static_cast<double>(pace.next(1000000)) * 0.01 < 1.1 * DispatchPace::wanted_collected_milliseconds);
}
