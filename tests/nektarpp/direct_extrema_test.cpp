// Extrema that the plugin tells, and those that the host finds by itself, against Bernstein forms of the same functions.
#include "direct_fixture.hpp"

#include <core/volume/field/field_extrema.hpp>
#include <elvis/native/extrema.hpp>

#include <catch2/catch.hpp>

using namespace elvis;
using native::Basis;
using native::Shape;
using native::Space;

namespace {

native::Extrema from_forms(const Space& space, const std::vector<double>& coefficients) {
    native::ExtremaSearch search(std::span(&space, 1), 1);
    search.add(0, 0, 1, coefficients);
    return search.finish([&](std::size_t, std::uint64_t, std::uint64_t, std::span<double> out) {
        std::ranges::copy(coefficients, out.begin());
    })[0];
}

} // namespace

TEST_CASE("extrema are found in every shape, and certified", "[nektarpp][direct]") {
    const auto [shape, order] = GENERATE(table<Shape, std::uint32_t>({
        {Shape::hexahedron, 1},
        {Shape::hexahedron, 4},
        {Shape::prism, 4},
        {Shape::tetrahedron, 5},
        {Shape::pyramid, 4},
        {Shape::quadrilateral, 4},
        {Shape::triangle, 5},
    }));
    const Space space{shape, Basis::modified, {order, order, native::dimension(shape) == 3 ? order : 0}};
    CAPTURE(native::name(shape), order);
    const std::vector<double> coefficients = uniform_numbers(native::n_modes(space), 3);
    const TemporaryFolder folder;
    folder.write("one.fld", nektar_writer::field_file({block_of(space, coefficients)}));
    const RuntimeVolume volume = open_direct(folder.write("one.xml", bent_element(shape)));
    const native::Extrema truth = from_forms(space, coefficients);
    const std::optional<FieldExtrema> told = find_extrema(volume, 0, 0, 0);
    REQUIRE(told);
    CHECK(told->certainty == ELVIS_CERTIFIED);
    CHECK(told->minimum.value == Approx(truth.minimum.value).margin(1e-13));
    CHECK(told->maximum.value == Approx(truth.maximum.value).margin(1e-13));
    const FieldExtrema found = search_extrema(volume, 0, 0, 0);
    CHECK(found.certainty == ELVIS_CERTIFIED);

    const double distance = truth.maximum.bound - truth.minimum.bound;
    const double tolerance = extrema_tolerance * distance;
    CHECK(found.maximum.value == Approx(truth.maximum.value).margin(tolerance));
    CHECK(found.minimum.value == Approx(truth.minimum.value).margin(tolerance));
    CHECK(found.maximum.value <= truth.maximum.bound + 1e-12);
    CHECK(found.minimum.value >= truth.minimum.bound - 1e-12);
    CHECK(found.maximum.bound >= truth.maximum.value);
    CHECK(found.minimum.bound <= truth.minimum.value);
    for (const FieldExtremum& extremum : {found.minimum, found.maximum}) {
        double value = 0;
        volume.evaluate_field(0, 0, extremum.element, extremum.xi, std::span(&value, 1), {});
        CHECK(value == extremum.value);
    }
}
