// Book-keeping of written rows.
#include <file/coverage.hpp>

#include <catch2/catch.hpp>

#include <random>
#include <vector>

using elvis::native::Coverage;

TEST_CASE("Coverage finds the first row that is missing") {
    std::mt19937 random(1);
    const auto any = [&](std::uint64_t end) { return std::uniform_int_distribution<std::uint64_t>(0, end - 1)(random); };
    for (int run = 0; run < 200; ++run) {
        constexpr std::uint64_t n = 40;
        Coverage coverage;
        std::vector<bool> rows(n, false);
        for (int i = 0; i < 30; ++i) {
            const std::uint64_t first = any(n);
            const std::uint64_t count = any(std::min<std::uint64_t>(8, n - first) + 1);
            coverage.add(first, count);
            for (std::uint64_t row = first; row < first + count; ++row)
                rows[row] = true;
            std::uint64_t missing = 0;
            while (missing < n && rows[missing])
                ++missing;
            REQUIRE(coverage.first_missing(n) == missing);
        }
    }
}
