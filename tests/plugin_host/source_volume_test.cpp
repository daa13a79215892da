/*
 * Nothing that a conversion plugin returns is believed unchecked.
 */
#include "fixtures.hpp"

#include <core/plugin_host/source_volume.hpp>

#include <array>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::fixture;
using test::trouble;

namespace {

SourceVolume open(const std::string& name) {
    return SourceVolume(Plugin::load(fixture("troubled_source")), {"geometry.dat", "fields.dat"}, trouble(name));
}

std::string open_error(const std::string& name) {
    return error_of([&] { open(name); });
}

test::BlamesPlugin blames(const std::string& function) {
    return {"geometry.dat: plugin org.elvis.test.troubled-source", function};
}

} // namespace

TEST_CASE("an honest source is read as it is") {
    const SourceVolume source = open("none");
    CHECK(source.info().n_elements == 1);
    CHECK(source.n_values() == 1);
    CHECK(source.paths().size() == 2);
    elvis_source_element element{};
    source.elements(0, 1, std::span(&element, 1));
    CHECK(element.shape == ELVIS_SHAPE_TETRAHEDRON);
    elvis_source_space space{};
    source.spaces(0, 0, 1, std::span(&space, 1));
    CHECK(space.is_contained == 1);
    const std::array<double, 6> xi{-1, -1, -1, 0.25, -0.5, -0.75};
    std::array<double, 2> values{};
    source.sample(0, 0, xi, values);
    CHECK(values == std::array<double, 2>{-1, 0.25});
}

TEST_CASE("a source that can be asked at world positions only is asked there") {
    const SourceVolume source(Plugin::load(fixture("world_source")), {"a.tetrahedron"});
    const std::array<double, 3> xi{-0.5, -1, -1};
    double value = 0;
    source.sample(0, 0, xi, std::span(&value, 1));
    CHECK(value == -0.5);
}

TEST_CASE("an open that fails names the file at fault") {
    CHECK_THAT(open_error("open-with-text"),
               Contains("fields.dat: line 3: fewer values than elements") && Contains("org.elvis.test.troubled-source"));
}

TEST_CASE("nonsense about the source is refused at opening") {
    CHECK_THAT(open_error("dimension"), blames("get_info"));
    CHECK_THAT(open_error("no-elements"), Contains("holds no elements"));
    CHECK_THAT(open_error("no-time"), blames("get_info"));
    CHECK_THAT(open_error("untold-times"), blames("get_info") && Contains("get_time"));
    CHECK_THAT(open_error("nameless-groups"), blames("get_info") && Contains("get_boundary_group"));
    CHECK_THAT(open_error("no-components"), blames("get_field"));
    CHECK_THAT(open_error("transform"), blames("get_field"));
    CHECK_THAT(open_error("same-field"), blames("get_field") && Contains("'x'"));
}

TEST_CASE("nonsense about elements, spaces and positions is refused") {
    for (const char* name : {"shape", "geometry-order", "corner", "face-group"}) {
        INFO(name);
        elvis_source_element element{};
        CHECK_THAT(error_of([&] { open(name).elements(0, 1, std::span(&element, 1)); }), blames("get_elements"));
    }
    elvis_source_space space{};
    CHECK_THAT(error_of([&] { open("field-order").spaces(0, 0, 1, std::span(&space, 1)); }), blames("get_spaces"));
    const std::array<double, 3> xi{-1, -1, -1};
    std::array<double, 3> position{};
    CHECK_THAT(error_of([&] { open("position").evaluate_mapping(0, xi, position); }), blames("evaluate_mapping"));
}
