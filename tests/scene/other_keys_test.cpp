// Which keys of a scene mean something beside which others: the schema says it, and the reader keeps to it.

#include <core/scene/scene.hpp>
#include <tests/support/error_of.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <functional>

using namespace elvis;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

std::string fault(const std::string& parts) {
    return test::error_of([&] { scene_of(json::parse(R"({"version": 1, )" + parts + "}"), "scene.json"); });
}

/** Every object that the schema knows, by what it says of its keys. */
void visit_objects(const json& node, const std::function<void(const json& properties)>& visit) {
    if (node.is_object() && node.contains("properties")) {
        visit(node["properties"]);
    }
    for (const json& inner : node) {
        if (inner.is_structured()) {
            visit_objects(inner, visit);
        }
    }
}

} // namespace

TEST_CASE("Keys that mean nothing beside others are refused, with both their names") {
    CHECK(fault(R"("surfaces": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "axis": [0, 0, 1]}])") ==
          "scene.json: 'surfaces[0].axis' means nothing where 'type' is \"sphere\"");
    CHECK(fault(R"("contours": {"values": [1], "count": 2})") ==
          "scene.json: 'contours.count' means nothing beside 'values'; give one of the two");
    CHECK_THAT(fault(R"("contours": {"values": [1], "range": [0, 1]})"),
               Contains("'contours.range' means nothing beside 'values'"));
    CHECK_THAT(fault(R"("surfaces": [{"type": "streamlines", "flow": "u", "seeds": [[0, 0, 0]], "seed_grid": 3}])"),
               Contains("'surfaces[0].seed_grid' means nothing beside 'seeds'"));
    CHECK_THAT(fault(R"("surfaces": [{"type": "arrows", "vectors": "u", "color": [0, 0, 0], "color_map": {}}])"),
               Contains("'surfaces[0].color' means nothing beside 'color_map'"));
    CHECK_THAT(fault(R"("surfaces": [{"type": "wireframe", "groups": ["wall"], "orders": [1, 2]}])"),
               Contains("'surfaces[0].groups' means nothing beside 'orders'"));
    CHECK_THAT(fault(R"("surfaces": [{"type": "isosurface", "values": [1], "degree": 3}])"),
               Contains("'surfaces[0].degree' means nothing where 'method' is \"interval\""));
    CHECK_THAT(fault(R"("surfaces": [{"type": "plane", "plane": [0, 0, 1, 0], "point": [0, 0, 0]}])"),
               Contains("'surfaces[0].plane' means nothing beside 'point'"));
    CHECK_THAT(fault(R"("color_map": {"name": "gray", "points": [[0, 0, 0, 0]]})"), Contains("means nothing beside"));
    CHECK_THAT(fault(R"("lighting": {"lights": [{"type": "point", "direction": [0, 0, 1]}]})"),
               Contains("'lighting.lights[0].direction' means nothing where 'type' is \"point\""));
    // A word that is none is told of as such.
    CHECK_THAT(fault(R"("surfaces": [{"type": "spere", "center": [0, 0, 0]}])"), Contains("'surfaces[0].type' is \"spere\""));
    CHECK_THAT(fault(R"("surfaces": [{"type": "arrows"}])"), Contains("'surfaces[0].vectors' is missing"));
    CHECK_THAT(fault(R"("surfaces": [{"type": "plane", "normal": [0, 0, 1]}])"), Contains("'surfaces[0].point' is missing"));
}

TEST_CASE("What the schema says of other keys is about keys and words that there are") {
    int n = 0;
    visit_objects(json::parse(scene_schema_text()), [&](const json& properties) {
        for (const auto& [key, node] : properties.items()) {
            INFO(key);
            const json with = node.value("with", json::object()), excludes = node.value("excludes", json::array());
            for (const auto& [other, values] : with.items()) {
                const json& known = properties.at(other).at("enum");
                for (const json& value : values) {
                    CHECK(std::find(known.begin(), known.end(), value) != known.end());
                }
                ++n;
            }
            for (const json& other : excludes) {
                CHECK(properties.contains(other.get<std::string>()));
                CHECK(other != key);
                ++n;
            }
        }
    });
    CHECK(n > 50);
}
