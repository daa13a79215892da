// Smallest and largest values of expressions.

#include "some_volume.hpp"

#include <cmath>
#include <utility>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

TEST_CASE("Expressions that grow without limit have no bounds, and others have") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const auto ends = [&](const char* expression) {
        const elvis_range range = volume.range(expression);
        return std::pair{std::isinf(range.lower_bound), std::isinf(range.upper_bound)};
    };
    // The volume is about [0, 1]^3.
    CHECK(ends("1/(x-0.4321)") == std::pair{true, true});
    CHECK(ends("(x-0.4321)^-2") == std::pair{false, true});
    CHECK(ends("log((p-0.5)^2)") == std::pair{true, false});
    CHECK(ends("abs(y-0.3)^-0.5") == std::pair{false, true});
    CHECK(ends("tan(pi*x)").second);
    for (const char* bounded : {"p", "1/(x+2)", "1/((x-0.4321)^2+0.001)", "sin(x-0.4321)/(x-0.4321)", "x > 0.4 ? 1 : 0",
                                "abs(x-0.5) > 0.1 ? 1/(x-0.5) : 0", "log(p+3)", "norm(grad(p))"}) {
        INFO(bounded);
        CHECK(ends(bounded) == std::pair{false, false});
    }
}
