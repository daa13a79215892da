// What cannot be integrated is said.
#include "integrated.hpp"

#include <core/base/error.hpp>

#include <catch2/catch.hpp>

namespace elvis::test {
namespace {

using Catch::Contains;
using Domain = IntegralRequest::Domain;

TEST_CASE("integrals that make no sense are refused with the reason") {
    const GeneratedVolume box(R"("mesh": "box", "elements": 2, "field": "taylor-green", "order": 3)");
    CHECK_THROWS_WITH(integral_of(box, over(Domain::volume, "velocity", true)), Contains("not through a volume"));
    CHECK_THROWS_WITH(integral_of(box, over(Domain::boundary, "pressure", true)), Contains("pressure"));
    CHECK_THROWS_WITH(integral_of(box, over(Domain::volume, "presure")), Contains("pressure"));
    IntegralRequest request = over(Domain::boundary, "");
    request.groups = {"wall"};
    CHECK_THROWS_WITH(integral_of(box, request), Contains("wall"));
    request = over(Domain::volume, "");
    request.time_step = 3;
    CHECK_THROWS_WITH(integral_of(box, request), Contains("time step 3"));
    TaskControl control;
    control.cancelled = true;
    CHECK_THROWS_AS(integrate(*box, over(Domain::volume, ""), control), Cancelled);
}

TEST_CASE("a plugin without evaluation on the CPU is named") {
    const RuntimeVolume volume = oracle::open_volume(ELVIS_ANALYTIC_SAMPLE);
    const TaskControl control;
    CHECK_THROWS_WITH(integrate(volume, {}, control), Contains("cannot evaluate on the CPU"));
}

} // namespace
} // namespace elvis::test
