// Which files are opened together, time steps, and what is refused.
#include "direct_fixture.hpp"

#include <catch2/catch.hpp>

using namespace elvis;
using Catch::Contains;
using elvis::test::error_of;
using native::Basis;
using native::Shape;
using native::Space;

namespace {

/** A constant field at a time, in a space of the element. */
std::string constant_field(double value, double time, const Space& space = {Shape::hexahedron, Basis::modified, {1, 1, 1}}) {
    std::vector<double> coefficients(native::n_modes(space), space.basis == Basis::modified ? 0.0 : value);
    if (space.basis == Basis::modified) {
        // Vertex modes: both indices of each direction below 2.
        for (std::size_t mode = 0; mode < coefficients.size(); ++mode) {
            const std::size_t n = space.order[0] + 1;
            coefficients[mode] = mode % n < 2 && mode / n % n < 2 && mode / n / n < 2 ? value : 0;
        }
    }
    return nektar_writer::field_file({block_of(space, coefficients)},
                                     std::string("<Time>").append(std::to_string(time)).append("</Time>"));
}

double value_in(const RuntimeVolume& volume, std::uint32_t step) {
    double value = 0;
    volume.evaluate_field(0, step, 0, std::vector<double>{0.2, 0.1, -0.3}, {&value, 1}, {});
    return value;
}

/** A session's mesh in a folder of its own. */
struct Session {
    TemporaryFolder folder;
    std::string mesh = folder.write("s.xml", bent_element(Shape::hexahedron));

    std::string failure(const std::string& path, const std::string& options = {}) const {
        return error_of([&] { open_direct(path, options); });
    }
};

} // namespace

TEST_CASE("a mesh is opened with the result of its name, a result with its mesh", "[nektarpp][direct]") {
    const Session session;
    CHECK(open_direct(session.mesh).fields().empty());
    const std::string result = session.folder.write("s.fld", constant_field(5, 1));
    session.folder.write("s_0.chk", constant_field(1, 0));
    session.folder.write("s_10.chk", constant_field(3, 0.5));
    session.folder.write("s_2.chk", constant_field(2, 0.25));
    for (const std::string& path : {session.mesh, result}) {
        const RuntimeVolume volume = open_direct(path);
        CHECK(volume.times() == std::vector<double>{1});
        CHECK(value_in(volume, 0) == Approx(5));
        REQUIRE(volume.notes().size() == 2);
        CHECK(volume.notes()[0].second == session.mesh);
        CHECK(volume.notes()[1].second == result);
    }
    const RuntimeVolume one = open_direct(session.folder.path("s_2.chk"));
    CHECK(value_in(one, 0) == Approx(2));
    CHECK(one.times() == std::vector<double>{0.25});
}

TEST_CASE("checkpoints are time steps", "[nektarpp][direct]") {
    const Session session;
    session.folder.write("s_0.chk", constant_field(1, 0));
    session.folder.write("s_10.chk", constant_field(3, 0.5, {Shape::hexahedron, Basis::modified, {4, 4, 4}}));
    session.folder.write("s_2.chk", constant_field(2, 0.25));
    session.folder.write("s_x.chk", "no field");
    const auto check = [](const RuntimeVolume& volume) {
        CHECK(volume.times() == std::vector<double>{0, 0.25, 0.5});
        // The space holds every step.
        CHECK(volume.class_field(0, 0).order[0] == 4);
        for (const std::uint32_t step : {2u, 0u, 1u, 2u}) {
            CHECK(value_in(volume, step) == Approx(step + 1));
        }
    };
    check(open_direct(session.mesh));
    session.folder.write("s.fld", constant_field(5, 1));
    check(open_direct(session.mesh, R"({"fields": "s_*.chk"})"));
    check(open_direct(session.mesh, R"({"fields": ["s_0.chk", "s_2.chk", "s_10.chk"]})"));
    check(open_direct(session.folder.path("s_0.chk"), R"({"fields": ["s_2.chk", "s_10.chk"]})"));
}

TEST_CASE("the volume's options name files of any name", "[nektarpp][direct]") {
    const Session session;
    const std::string result = session.folder.write("other/result.fld", constant_field(7, 1));
    CHECK(value_in(open_direct(session.mesh, R"({"fields": ["other/result.fld"]})"), 0) == Approx(7));
    CHECK(value_in(open_direct(result, R"({"mesh": "../s.xml"})"), 0) == Approx(7));
    CHECK_THAT(session.failure(result), Contains("no mesh called result.xml, result_xml") && Contains("elvis convert"));
    CHECK_THAT(session.failure(session.mesh, R"({"field": "x"})"), Contains("'field'") && Contains("known are 'mesh'"));
    CHECK_THAT(session.failure(session.mesh, R"({"fields": 3})"), Contains("'fields'"));
    CHECK_THAT(session.failure(session.mesh, R"({"fields": "a_*.chk"})"), Contains("no file has a name like"));
    CHECK_THAT(session.failure(session.mesh, R"({"mesh": "t.xml"})"), Contains("name another"));
    CHECK_THAT(session.failure(session.mesh, "[1]"), Contains("no JSON object"));
    CHECK_THAT(session.failure(session.folder.path().string()), Contains("P0000000"));
}

TEST_CASE("what cannot be drawn as it is is refused with what to do", "[nektarpp][direct]") {
    const Session session;
    session.folder.write("s.fld", constant_field(1, 0, {Shape::hexahedron, Basis::gll_lagrange, {17, 1, 1}}));
    CHECK_THAT(session.failure(session.mesh), Contains("hexahedron 7") && Contains("18 modes") && Contains("elvis convert"));
    // Lagrange bases of different orders are not nested, and a basis that changes is two.
    session.folder.write("a.fld", constant_field(1, 0, {Shape::hexahedron, Basis::gll_lagrange, {2, 2, 2}}));
    session.folder.write("b.fld", constant_field(1, 1, {Shape::hexahedron, Basis::gll_lagrange, {3, 3, 3}}));
    session.folder.write("c.fld", constant_field(1, 1));
    for (const char* second : {"b.fld", "c.fld"}) {
        CHECK_THAT(session.failure(session.mesh, std::string(R"({"fields": ["a.fld", ")") + second + R"("]})"),
                   Contains("changes its basis") && Contains("elvis convert"));
    }
}

TEST_CASE("a step that cannot be read is an error when it is asked for", "[nektarpp][direct]") {
    const Session session;
    session.folder.write("s_0.chk", constant_field(1, 0));
    std::string damaged = constant_field(2, 1);
    damaged.replace(damaged.find("BITSIZE=\"64\">") + 13, 6, "!!!!!!");
    session.folder.write("s_1.chk", damaged);
    const RuntimeVolume volume = open_direct(session.mesh);
    CHECK(value_in(volume, 0) == Approx(1));
    CHECK_THAT(error_of([&] { value_in(volume, 1); }), Contains("s_1.chk"));
    CHECK(value_in(volume, 0) == Approx(1));
}
