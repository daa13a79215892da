// What the generator makes of right and wrong descriptions.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cmath>

using namespace elvis;

namespace {

std::string failure(const std::string& description) {
    try {
        generate(description);
    } catch (const Error& error) {
        return error.what();
    }
    return "no failure";
}

std::string box(const std::string& keys) { return R"({"generator":1,"mesh":"box",)" + keys + "}"; }

elvis_source_space space(const SourceVolume& source, std::uint32_t field, std::uint64_t element = 0) {
    std::vector<elvis_source_space> spaces(1);
    source.spaces(field, element, 1, spaces);
    return spaces[0];
}

double value(const SourceVolume& source, std::uint32_t step, std::uint64_t element, std::size_t index) {
    const std::array<double, 3> xi{-0.5, -0.5, -0.25};
    std::vector<double> values(source.n_values());
    source.sample(step, element, xi, values);
    return values[index];
}

} // namespace

TEST_CASE("wrong descriptions are refused by key", "[generator]") {
    using Catch::Contains;
    CHECK_THAT(failure("{"), Contains("description.json") && Contains("JSON"));
    CHECK_THAT(failure("[]"), Contains("object"));
    CHECK_THAT(failure("{}"), Contains("\"generator\"") && Contains("missing"));
    CHECK_THAT(failure(R"({"generator":2,"mesh":"box","field":"sphere"})"), Contains("\"generator\""));
    CHECK_THAT(failure(R"({"generator":1,"field":"sphere"})"), Contains("\"mesh\"") && Contains("missing"));
    CHECK_THAT(failure(box(R"("field":"sphere","element":[2,2,2])")), Contains("\"element\"") && Contains("\"elements\""));
    CHECK_THAT(failure(R"({"generator":1,"mesh":"bal","field":"sphere"})"), Contains("\"bal\"") && Contains("\"ball\""));
    CHECK_THAT(failure(box(R"("field":"sfere")")), Contains("\"field\"") && Contains("\"sphere\""));
    CHECK_THAT(failure(box(R"("field":"sphere","shape":"hexa")")), Contains("\"shape\""));
    CHECK_THAT(failure(box(R"("field":"sphere","box":[[0,0,0],[1,0,1]])")), Contains("\"box\""));
    CHECK_THAT(failure(box(R"("field":"sphere","box":[0,1])")), Contains("\"box\""));
    CHECK_THAT(failure(box(R"("field":"sphere","elements":[2,0,2])")), Contains("\"elements\""));
    CHECK_THAT(failure(box(R"("field":"sphere","elements":[2,2.5,2])")), Contains("\"elements\"") && Contains("whole"));
    CHECK_THAT(failure(box(R"("field":"sphere","elements":"many")")), Contains("\"elements\""));
    CHECK_THAT(failure(box(R"("field":"sphere","order":31)")), Contains("\"order\"") && Contains("30"));
    CHECK_THAT(failure(box(R"("field":"sphere","order":[2,0,2])")), Contains("\"order\""));
    CHECK_THAT(failure(box(R"("field":"sphere","shape":"prism","order":[2,3,2])")), Contains("\"order\""));
    CHECK_THAT(failure(box(R"("field":"sphere","geometry_order":0)")), Contains("\"geometry_order\""));
    CHECK_THAT(failure(box(R"("field":"sphere","radius":2)")), Contains("\"radius\""));
    CHECK_THAT(failure(box(R"("field":"sphere","shape":"mixed","elements":3)")), Contains("\"elements\""));
    CHECK_THAT(failure(box(R"("order":2)")), Contains("\"field\""));
    CHECK_THAT(failure(box(R"("field":"sphere","fields":["sphere"])")), Contains("\"field\""));
    CHECK_THAT(failure(box(R"("fields":["sphere","sphere"])")), Contains("\"fields\"") && Contains("name"));
    CHECK_THAT(failure(box(R"("fields":["sphere",{"field":"sinc","ordr":2}])")), Contains("\"fields[1].ordr\""));
    CHECK_THAT(failure(box(R"("field":"polynomial","coefficients":[[1,2,3]])")), Contains("\"coefficients\""));
    CHECK_THAT(failure(R"({"generator":1,"mesh":"ball","field":"polynomial","degree":16})"),
               Contains("order") && Contains("32"));
    CHECK_THAT(failure(R"({"generator":1,"mesh":"shell","field":"sphere","inner_radius":1.5})"), Contains("\"inner_radius\""));
    CHECK_THAT(failure(R"({"generator":1,"mesh":"twisted-tetrahedron","field":"sphere","elements":2})"),
               Contains("\"elements\""));
    CHECK(failure(box(R"("field":"sphere")")) == "no failure");
}

TEST_CASE("only descriptions are recognised", "[generator]") {
    const TemporaryFolder folder;
    const auto plugin = Plugin::load(GENERATOR_PLUGIN);
    const auto confidence = [&](const std::string& path) {
        std::uint32_t result = 0;
        elvis_host host{};
        host.struct_size = sizeof host;
        host.set_error = [](const elvis_host*, const char*, const char*) {};
        CHECK(plugin->converter()->probe(&host, path.c_str(), &result) == ELVIS_OK);
        return result;
    };
    CHECK(confidence(folder.write("a.json", " {\n \"mesh\": \"box\", \"generator\": 1}")) == 100);
    CHECK(confidence(folder.write("b.json", R"({"version":1,"volume":"x.h5"})")) == 0);
    CHECK(confidence(folder.write("c.dat", "Finite Element Volume")) == 0);
    CHECK(confidence(folder.write("d", "")) == 0);
}

TEST_CASE("spaces say which order is exact", "[generator]") {
    const SourceVolume straight = generate(box(R"("fields":["sphere",{"field":"polynomial","coefficients":[[3,1,0,2.0]]},
        {"field":"polynomial","name":"low","degree":3,"order":2},"element","sinc","jump"])"));
    CHECK(space(straight, 0).order[2] == 2);
    CHECK(space(straight, 1).order[0] == 3);
    CHECK(space(straight, 1).order[1] == 1);
    CHECK(space(straight, 1).order[2] == 1);
    CHECK(space(straight, 1).is_contained == 1);
    CHECK(space(straight, 2).order[0] == 2);
    CHECK(space(straight, 2).is_contained == 0);
    CHECK(space(straight, 3).order[0] == 0);
    CHECK(space(straight, 3).is_contained == 1);
    CHECK(space(straight, 4).order[0] == 4);
    CHECK(space(straight, 4).is_contained == 0);
    CHECK(straight.fields()[0].continuity == ELVIS_CONTINUITY_CONTINUOUS);
    CHECK(straight.fields()[3].continuity == ELVIS_CONTINUITY_DISCONTINUOUS);
    CHECK(straight.fields()[5].continuity == ELVIS_CONTINUITY_DISCONTINUOUS);

    const SourceVolume curved =
        generate(R"({"generator":1,"mesh":"ball","shape":"tetrahedron","geometry_order":3,"field":"polynomial","degree":2})");
    CHECK(space(curved, 0).order[0] == 6);
    CHECK(space(curved, 0).is_contained == 1);
}

TEST_CASE("fields have the values of the page", "[generator]") {
    // One element: the point is x = (-0.5, -0.5, -0.25).
    const SourceVolume source = generate(box(R"("elements":1,"time_steps":3,"fields":["sphere","element","distance",
        {"field":"polynomial","degree":1},"taylor-green","sinc","waves"])"));
    const double x = -0.5, z = -0.25, r = std::sqrt(0.5625);
    REQUIRE(source.n_values() == 10);
    CHECK(source.times() == std::vector<double>{0, 1, 2});
    CHECK(value(source, 0, 0, 0) == Approx(0.5625));
    CHECK(value(source, 2, 0, 0) == Approx(3 * 0.5625));
    CHECK(value(source, 0, 0, 1) == 0);
    CHECK(value(source, 0, 0, 2) == Approx(r));
    CHECK(value(source, 0, 0, 3) == Approx(1 + x / 2 + x / 3 + z / 4));
    CHECK(source.fields()[4].name == "velocity");
    CHECK(value(source, 1, 0, 4) == Approx(std::exp(-0.1) * std::sin(x) * std::cos(x) * std::cos(z)));
    CHECK(value(source, 1, 0, 5) == Approx(-std::exp(-0.1) * std::cos(x) * std::sin(x) * std::cos(z)));
    CHECK(value(source, 1, 0, 6) == 0);
    CHECK(source.fields()[5].name == "pressure");
    CHECK(value(source, 1, 0, 7) == Approx(std::exp(-0.2) / 16 * 2 * std::cos(2 * x) * (std::cos(2 * z) + 2)));
    CHECK(value(source, 0, 0, 8) == Approx(std::sin(6.283185307179586 * r) / (6.283185307179586 * r)));
    CHECK(value(source, 0, 0, 9) == Approx(std::sin(3.5 * x) * std::cos(3.5 * x) + std::sin(3.5 * x) * std::cos(3.5 * z) +
                                           std::sin(3.5 * z) * std::cos(3.5 * x)));

    const SourceVolume many = generate(box(R"("elements":[5,1,1],"fields":["element","jump"])"));
    CHECK(value(many, 0, 3, 0) == 3);
    CHECK(std::abs(value(many, 0, 3, 1) - value(many, 0, 2, 1)) > 0.01);
}
