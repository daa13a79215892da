// The scene's key volume_rendering: what is read, and what is refused.

#include "fixture.hpp"

#include <core/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <map>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

SceneVolumeRendering read(const std::string& text) {
    const TemporaryFolder folder;
    const Scene scene = read_scene(folder.write("scene.json", R"({"version": 1, "volume_rendering": )" + text + "}"));
    REQUIRE(scene.volume_rendering.has_value());
    return *scene.volume_rendering;
}

std::string fault(const std::string& text) {
    const std::string error = error_of([&] { read(text); });
    CHECK_THAT(error, Contains("scene.json"));
    CHECK(error.find('\n') == std::string::npos);
    return error;
}

json schema() { return json::parse(scene_schema_text()); }

json schema_of_volume_rendering() { return schema().at("properties").at("volume_rendering").at("properties"); }

} // namespace

TEST_CASE("Nothing said of volume rendering leaves it open, or at its defaults") {
    const TemporaryFolder folder;
    CHECK_FALSE(read_scene(folder.write("scene.json", R"({"version": 1})")).volume_rendering);
    const SceneVolumeRendering rendering = read("{}");
    CHECK_FALSE(rendering.field);
    CHECK(rendering.is_colored_by_map());
    CHECK(rendering.has_default_density());
    CHECK(rendering.integrator == Integrator::exact);
    CHECK_FALSE(rendering.step);
    CHECK(rendering.tolerance == 0.001);
    CHECK(rendering.skips_by_range);
    // What the schema says.
    const json properties = schema_of_volume_rendering();
    CHECK(rendering.tolerance == properties.at("tolerance").at("default"));
    CHECK(rendering.skips_by_range == properties.at("range_skipping").at("default"));
    CHECK(rendering.unit_distance == properties.at("unit_distance").at("default"));
    CHECK(integrator_named(properties.at("integrator").at("default").get<std::string>()) == rendering.integrator);
}

TEST_CASE("Every key of the schema is read") {
    using Check = bool (*)(const SceneVolumeRendering&);
    const std::map<std::string, std::pair<std::string, Check>> cases = {
        {"field", {R"({"field": "p"})", [](const auto& r) { return r.field == "p"; }}},
        {"transfer",
         {R"({"transfer": {"color": [[0, 1, 0, 0]], "density": [[0, 1], [1, 2]]}})",
          [](const auto& r) { return r.transfer && r.transfer->density.size() == 2 && r.transfer->color[0].rgb[0] == 1; }}},
        {"color_map",
         {R"({"color_map": {"name": "magma"}})", [](const auto& r) { return r.color_map && r.color_map->name == "magma"; }}},
        {"density",
         {R"({"density": [[0, 1], [1, 7]]})",
          [](const auto& r) { return r.density.size() == 2 && r.density[1].density == 7; }}},
        {"opacity",
         {R"({"opacity": [[0, 0], [1, 0.25]]})",
          [](const auto& r) { return r.opacity.size() == 2 && r.opacity[1].opacity == 0.25 && r.opacity[1].midpoint == 0.5; }}},
        {"unit_distance",
         {R"({"opacity": [[0, 0]], "unit_distance": 0.5})", [](const auto& r) { return r.unit_distance == 0.5; }}},
        {"peaks",
         {R"({"peaks": [{"value": 1, "width": 0.5, "density": 3}, {"value": 2, "width": 1, "density": 4, "color": [1, 0, 0.5]}]})",
          [](const auto& r) {
              return r.peaks.size() == 2 && r.peaks[0].value == 1 && r.peaks[0].width == 0.5 && r.peaks[0].density == 3 &&
                     !r.peaks[0].color && r.peaks[1].color == Rgb{1, 0, 0.5};
          }}},
        {"integrator",
         {R"({"integrator": "categories"})", [](const auto& r) { return r.integrator == Integrator::categories; }}},
        {"step",
         {R"({"integrator": "trapezoid", "step": 0.125})",
          [](const auto& r) { return r.integrator == Integrator::trapezoid && r.step == 0.125; }}},
        {"tolerance", {R"({"tolerance": 1e-5})", [](const auto& r) { return r.tolerance == 1e-5; }}},
        {"range_skipping", {R"({"range_skipping": false})", [](const auto& r) { return !r.skips_by_range; }}},
        {"visible", {R"({"visible": false})", [](const auto& r) { return !r.is_shown; }}},
    };
    const json properties = schema_of_volume_rendering();
    for (const auto& [key, ignored] : properties.items()) {
        INFO(key);
        const auto found = cases.find(key);
        REQUIRE(found != cases.end());
        CHECK(found->second.second(read(found->second.first)));
        CHECK_FALSE(found->second.second(SceneVolumeRendering{}));
    }
    CHECK(cases.size() == properties.size());
}

TEST_CASE("The schema's integrators are those there are") {
    const json words = schema_of_volume_rendering().at("integrator").at("enum");
    REQUIRE(words.size() == integrator_names().size());
    for (std::size_t i = 0; i < words.size(); ++i) {
        CHECK(words[i] == integrator_names()[i].first);
        CHECK(integrator_named(words[i].get<std::string>()) == integrator_names()[i].second);
        CHECK(read(json{{"integrator", words[i]}}.dump()).integrator == integrator_names()[i].second);
    }
    CHECK_FALSE(integrator_named("simpson"));
}

TEST_CASE("A transfer function in a file is looked for beside the scene") {
    const SceneVolumeRendering rendering = read(R"({"transfer": "functions/levels.json"})");
    CHECK_THAT(rendering.transfer_file, Contains("elvis-") && Catch::Matchers::EndsWith("/functions/levels.json"));
    CHECK_FALSE(rendering.is_colored_by_map());
    CHECK_FALSE(rendering.has_default_density());
}

TEST_CASE("What is wrong with volume rendering in a scene is said in one line") {
    CHECK_THAT(fault(R"({"transferr": "x.json"})"),
               Contains("'volume_rendering.transferr' is unknown; the nearest known key is 'transfer'"));
    CHECK_THAT(fault("[]"), Contains("'volume_rendering' must be an object"));
    CHECK_THAT(fault(R"({"transfer": 3})"), Contains("'volume_rendering.transfer' must be an object"));
    CHECK_THAT(fault(R"({"transfer": {"color": [[0, 1, 0, 0]]}})"), Contains("'volume_rendering.transfer.density' is missing"));
    CHECK_THAT(fault(R"({"transfer": {"color": [[0, 1, 0, 0]], "density": [[0, 1]], "peaks": []}})"),
               Contains("'volume_rendering.transfer.peaks' is unknown"));
    CHECK_THAT(fault(R"({"transfer": {"color": [[0, 1, 0, 0], [-1, 1, 0, 0]], "density": [[0, 1]]}})"),
               Contains("'volume_rendering.transfer.color[1]' has the value -1 after 0"));
    for (const char* other :
         {R"("color_map": {})", R"("density": [[0, 1]])", R"("opacity": [[0, 1]])", R"("unit_distance": 2)"}) {
        CHECK_THAT(fault(R"({"transfer": "x.json", )" + std::string(other) + "}"), Contains("means nothing beside 'transfer'"));
    }
    CHECK_THAT(fault(R"({"density": [[0, 1]], "opacity": [[0, 1]]})"),
               Contains("'volume_rendering.density' means nothing beside 'opacity'"));
    CHECK_THAT(fault(R"({"density": [[0, 1]], "unit_distance": 2})"), Contains("means nothing without 'opacity'"));
    CHECK_THAT(fault(R"({"density": [[0, 1], [1]]})"), Contains("'volume_rendering.density[1]' is [1]"));
    CHECK_THAT(fault(R"({"density": [[0, -1]]})"), Contains("'volume_rendering.density[0]' is -1; it must be at least 0"));
    CHECK_THAT(fault(R"({"opacity": [[0, 1.5]]})"),
               Contains("'volume_rendering.opacity[0]' is 1.5; it must be at least 0, at most 1"));
    CHECK_THAT(fault(R"({"opacity": [[0, 1]], "unit_distance": 0})"), Contains("it must be above 0"));
    CHECK_THAT(fault(R"({"peaks": []})"), Contains("'volume_rendering.peaks' is empty"));
    CHECK_THAT(fault(R"({"peaks": {}})"), Contains("'volume_rendering.peaks' must be a list"));
    CHECK_THAT(fault(R"({"peaks": [{"value": 1, "width": 0.1}]})"), Contains("'volume_rendering.peaks[0].density' is missing"));
    CHECK_THAT(fault(R"({"peaks": [{"value": 1, "width": 0, "density": 1}]})"),
               Contains("peaks[0].width") && Contains("above 0"));
    CHECK_THAT(fault(R"({"peaks": [{"value": 1, "width": 1e-17, "density": 1}]})"), Contains("lost in rounding"));
    CHECK_THAT(fault(R"({"peaks": [{"value": 1, "width": 1, "density": 1, "colour": [1, 0, 0]}]})"),
               Contains("'volume_rendering.peaks[0].colour' is unknown; the nearest known key is 'color'"));
    CHECK_THAT(fault(R"({"integrator": "simpson"})"), Contains("'volume_rendering.integrator' is \"simpson\"; allowed are"));
    CHECK_THAT(fault(R"({"step": 0.1})"), Contains("'volume_rendering.step' means nothing where 'integrator' is \"exact\""));
    CHECK_THAT(fault(R"({"integrator": "riemann", "step": 0})"), Contains("above 0"));
    CHECK_THAT(fault(R"({"integrator": "riemann", "tolerance": 0.1})"),
               Contains("'volume_rendering.tolerance' means nothing where 'integrator' is"));
    CHECK_THAT(fault(R"({"tolerance": 0})"), Contains("above 0"));
    CHECK_THAT(fault(R"({"range_skipping": 1})"), Contains("true or false"));
    CHECK_THAT(fault(R"({"color_map": {"nam": "magma"}})"), Contains("'volume_rendering.color_map.nam' is unknown"));
}
