/*
 * Nothing that a runtime plugin returns is believed unchecked.
 */
#include "fixtures.hpp"

#include <core/plugin_host/runtime_volume.hpp>

#include <array>
#include <cmath>
#include <limits>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::fixture;
using test::trouble;

namespace {

RuntimeVolume open(const std::string& name) {
    return RuntimeVolume(Plugin::load(fixture("troubled")), "a.cube", trouble(name));
}

std::string open_error(const std::string& name) {
    return error_of([&] { open(name); });
}

test::BlamesPlugin blames(const std::string& function) { return {"a.cube: plugin org.elvis.test.troubled", function}; }

} // namespace

TEST_CASE("an honest volume is read as it is") {
    const RuntimeVolume volume = open("none");
    CHECK(volume.path() == "a.cube");
    CHECK(volume.dimension() == 3);
    CHECK(volume.n_elements() == 1);
    REQUIRE(volume.classes().size() == 1);
    CHECK(volume.classes()[0].shape == ELVIS_SHAPE_HEXAHEDRON);
    CHECK(volume.classes()[0].geometry_order[2] == 1);
    REQUIRE(volume.fields().size() == 1);
    CHECK(volume.fields()[0].name == "x");
    CHECK(volume.fields()[0].unit.empty());
    // Left alone by the plugin: unknown, not zero.
    CHECK(std::isnan(volume.fields()[0].max_jump));
    CHECK(volume.times() == std::vector<double>{0.0});
    CHECK(volume.field_index("x") == 0);
    CHECK(volume.buffer(0, 0).name == "scale");
    CHECK(volume.snippet(0).prefix == "cube");
    std::array<double, 6> bounds{};
    CHECK(volume.bounds(0, 1, bounds) == ELVIS_CERTIFIED);
    CHECK(bounds == std::array<double, 6>{-1, -1, -1, 1, 1, 1});
    std::int64_t number = 0;
    volume.element_numbers(0, 1, std::span(&number, 1));
    CHECK(number == 41);
    FieldRange range;
    CHECK(volume.field_ranges(0, 0, 0, 1, std::span(&range, 1)) == ELVIS_CERTIFIED);
    CHECK(range.lower == -1);
    DerivativeBounds slope;
    REQUIRE(volume.has_derivative_bounds());
    CHECK(volume.derivative_bounds(0, 0, 0, 1, std::span(&slope, 1)) == ELVIS_CERTIFIED);
    CHECK(slope.first == 1);
    CHECK(slope.second == 0);
    CHECK_FALSE(volume.has_evaluation());
    CHECK_THAT(error_of([&] { (void)volume.field_index("y"); }), Contains("'y'") && Contains("x"));
}

TEST_CASE("an open that fails is told with the plugin's words, or the lack of them") {
    CHECK_THAT(open_error("open-with-text"), Contains("part-two.dat: line 7: an unknown word 'tetrahedrom'") &&
                                                 Contains("org.elvis.test.troubled") && Contains("open"));
    CHECK_THAT(open_error("open-silently"), Contains("a.cube") && Contains("not supported") && Contains("gives no reason"));
    CHECK_THAT(open_error("open-nothing"), blames("open"));
}

TEST_CASE("a text left by a call that succeeded is not blamed for a later failure") {
    const std::string text = open_error("stale-text");
    CHECK_THAT(text, Contains("get_class") && Contains("gives no reason") && !Contains("stale"));
}

TEST_CASE("nonsense about the volume is refused at opening") {
    CHECK_THAT(open_error("dimension"), blames("get_info"));
    CHECK_THAT(open_error("no-elements"), Contains("holds no elements"));
    CHECK_THAT(open_error("too-many-elements"), blames("get_info"));
    CHECK_THAT(open_error("four-billion-fields"), blames("get_info"));
    CHECK_THAT(open_error("no-time"), blames("get_info"));
    CHECK_THAT(open_error("notes"), blames("get_info"));
    CHECK_THAT(open_error("groups"), blames("get_info"));
    CHECK_THAT(open_error("class-too-large"), blames("get_class"));
    CHECK_THAT(open_error("class-too-small"), blames("get_class"));
    CHECK_THAT(open_error("shape"), blames("get_class"));
    CHECK_THAT(open_error("flat"), blames("get_class"));
    CHECK_THAT(open_error("nameless-field"), blames("get_field"));
    CHECK_THAT(open_error("no-components"), blames("get_field"));
    CHECK_THAT(open_error("same-field"), blames("get_field") && Contains("'x'"));
}

TEST_CASE("nonsense that would reach the shader is refused") {
    CHECK_THAT(error_of([] { (void)open("constant").class_field(0, 0); }), blames("get_class_field"));
    CHECK_THAT(error_of([] { (void)open("constant-name").class_field(0, 0); }), blames("get_class_field"));
    CHECK_THAT(error_of([] { (void)open("reserved-prefix").snippet(0); }), blames("get_snippet"));
    CHECK_THAT(error_of([] { (void)open("no-sources").snippet(0); }), blames("get_snippet"));
    for (const char* name : {"buffer-name", "buffer-kind", "buffer-class", "empty-record", "huge-record"}) {
        INFO(name);
        CHECK_THAT(error_of([&] { (void)open(name).buffer(0, 0); }), blames("get_buffer"));
    }
}

TEST_CASE("what a later version may leave out is passed over, what it needs is refused") {
    CHECK(open("later-ability").snippet(0).prefix == "cube");
    CHECK_THAT(error_of([] { (void)open("later-need").snippet(0); }),
               Contains("a.cube: plugin org.elvis.test.troubled needs a later version of ElVis") && Contains("0x20000"));
    CHECK_THAT(error_of([] { (void)open("later-dependence").buffer(0, 0); }),
               Contains("a later version") && Contains("'scale'") && Contains("0x40"));
}

TEST_CASE("bounds, ranges, numbers and faces out of range are refused") {
    for (const char* name : {"nan-bounds", "infinite-bounds", "reversed-bounds", "bounds-certainty"}) {
        INFO(name);
        std::array<double, 6> bounds{};
        CHECK_THAT(error_of([&] { (void)open(name).bounds(0, 1, bounds); }), blames("get_bounds"));
    }
    for (const char* name : {"nan-range", "reversed-range"}) {
        INFO(name);
        FieldRange range;
        CHECK_THAT(error_of([&] { (void)open(name).field_ranges(0, 0, 0, 1, std::span(&range, 1)); }),
                   blames("get_field_ranges"));
    }
    DerivativeBounds slope;
    for (const char* name : {"negative-slope", "infinite-bend", "bend-certainty"}) {
        INFO(name);
        CHECK_THAT(error_of([&] { (void)open(name).derivative_bounds(0, 0, 0, 1, std::span(&slope, 1)); }),
                   blames("get_field_derivative_bounds"));
        CHECK_THAT(error_of([&] { (void)open(name).apex_bounds(0, 0, 0, 1, std::span(&slope, 1)); }),
                   blames("get_field_apex_bounds"));
    }
    // "Cannot tell" is an answer.
    CHECK_NOTHROW((void)open("unknown-bend").derivative_bounds(0, 0, 0, 1, std::span(&slope, 1)));
    CHECK(std::isnan(slope.second));
    std::int64_t number = 0;
    CHECK_THAT(error_of([&] { open("negative-number").element_numbers(0, 1, std::span(&number, 1)); }),
               blames("get_element_numbers"));
    std::array<elvis_face, 6> faces{};
    CHECK_NOTHROW(open("faces").faces(0, 6, faces));
    CHECK(faces[5].local_face == 5);
    for (const char* name : {"faces-element", "faces-neighbour", "faces-local", "faces-tetrahedron", "faces-group"}) {
        INFO(name);
        CHECK_THAT(error_of([&] { open(name).faces(0, 6, faces); }), blames("get_faces"));
    }
}

TEST_CASE("signs of Jacobians that cannot be are refused") {
    JacobianCheck check;
    CHECK(open("jacobian").check_jacobians(0, 1e-9, std::span(&check, 1)) == ELVIS_CERTIFIED);
    CHECK(check.sign == ELVIS_JACOBIAN_NEGATIVE);
    CHECK(check.xi == std::array{0.0, 0.5, 0.0});
    CHECK(check.determinant == -2);
    // Nothing said is nothing known.
    CHECK(open("silent-check").check_jacobians(0, 1e-9, std::span(&check, 1)) == ELVIS_ESTIMATED);
    CHECK(check.sign == ELVIS_JACOBIAN_UNDECIDED);
    CHECK(check.lower == -std::numeric_limits<double>::infinity());
    for (const char* name : {"jacobian-sign", "jacobian-point", "jacobian-value", "jacobian-bound"}) {
        INFO(name);
        CHECK_THAT(error_of([&] { open(name).check_jacobians(0, 1e-9, std::span(&check, 1)); }), blames("check_jacobians"));
    }
}

TEST_CASE("a volume of a plugin that only converts is an error") {
    CHECK_THAT(error_of([] { RuntimeVolume(Plugin::load(fixture("world_source")), "a.cube"); }),
               Contains("org.elvis.test.world-source") && Contains("serves no volumes"));
}
