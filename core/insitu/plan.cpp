#include "plan.hpp"

#include <core/base/error.hpp>
#include <core/parts/draw_in_parts.hpp>
#include <core/scene/read/json_reader.hpp>

#include <insitu_plan_schema.hpp>

#include <algorithm>
#include <filesystem>
#include <set>

namespace elvis::library {

namespace {

using Json = nlohmann::json;

Vector3 point_of(const std::vector<double>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

Scene scene_in(const JsonObject& output, const std::string& folder) {
    Json said = output.raw("scene");
    if (!said.is_object() && !said.is_string()) {
        output.fail("scene", "is neither a scene nor the path of one");
    }
    const std::filesystem::path here = std::filesystem::path(folder);
    if (said.is_object() && !said.contains("version")) {
        said["version"] = 1;
    }
    Scene scene = said.is_string() ? read_scene((here / said.get<std::string>()).string())
                                   : scene_of(said, (here / output.text("name")).string());
    if (scene.warp || !scene.joined.empty() || scene.animation) {
        output.fail("scene", "has a warp, joined volumes or an animation, which are not drawn of a running solver");
    }
    if (std::ranges::any_of(scene.surfaces,
                            [](const SceneSurface& surface) { return surface.streamlines || surface.arrows; })) {
        output.fail("scene", "has streamlines, pathlines or arrows, which are not drawn of a running solver");
    }
    need_parts_can_draw(scene);
    return scene;
}

PlannedSamples samples_in(const JsonObject& output, const RuntimeVolume& volume) {
    PlannedSamples samples;
    if (output.has("points")) {
        for (const std::vector<double>& point : output.rows("points")) {
            samples.points.push_back(point_of(point));
        }
    } else {
        const JsonObject line = output.object("line");
        const Vector3 from = point_of(line.numbers("from")), to = point_of(line.numbers("to"));
        const std::uint32_t n = line.integer("count");
        for (std::uint32_t at = 0; at < n; ++at) {
            const double part = static_cast<double>(at) / (n - 1);
            samples.points.push_back(plus(scaled(from, 1 - part), scaled(to, part)));
        }
    }
    if (output.has("values")) {
        samples.values = output.texts("values");
    } else {
        for (const FieldInfo& field : volume.fields()) {
            samples.values.push_back(field.name);
        }
    }
    return samples;
}

PlannedNumbers numbers_in(const JsonObject& output, const RuntimeVolume& volume) {
    PlannedNumbers numbers;
    for (const std::string& text : output.texts("quantities")) {
        numbers.quantities.emplace_back(text, volume);
    }
    return numbers;
}

std::string name_in(const JsonObject& output) {
    std::string name = output.text("name");
    constexpr const char* allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
    if (name.empty() || name.front() == '.' || name.find_first_not_of(allowed) != std::string::npos) {
        output.fail("name", "is '" + name + "'; it may have letters, digits, '_', '-' and '.', and does not begin with '.'");
    }
    return name;
}

PlannedOutput output_in(const JsonObject& output, const std::string& folder, const RuntimeVolume& volume) {
    PlannedOutput planned;
    planned.name = name_in(output);
    int n_kinds = 0;
    for (const char* const kind : {"scene", "points", "line", "quantities"}) {
        n_kinds += output.has(kind) ? 1 : 0;
    }
    if (n_kinds != 1) {
        output.fail("name", "is of an output that must have one of 'scene', 'points', 'line' and 'quantities'");
    }
    if (output.has("buffers") && !output.has("scene")) {
        output.fail("buffers", "goes with 'scene' alone");
    }
    if (output.has("values") && !output.has("points") && !output.has("line")) {
        output.fail("values", "goes with 'points' or 'line'");
    }
    if (output.has("every") && output.has("times")) {
        output.fail("times", "and 'every' say both when; give one of the two");
    }
    if (output.has("every")) {
        planned.every = output.integer("every");
    }
    if (output.has("times")) {
        planned.times = output.numbers("times");
        std::ranges::sort(planned.times);
    }
    if (output.has("when")) {
        planned.when.emplace(output.text("when"), volume);
    }
    if (output.has("scene")) {
        planned.what = PlannedPicture{scene_in(output, folder), output.has("buffers") && output.flag("buffers")};
    } else if (output.has("quantities")) {
        planned.what = numbers_in(output, volume);
    } else {
        planned.what = samples_in(output, volume);
    }
    return planned;
}

Json parsed(const std::string& text) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        throw Error("plan", std::string("is no JSON: ") + error.what());
    }
}

} // namespace

bool PlannedOutput::is_due(std::uint64_t step, double time, const std::optional<double>& after) const {
    if (times.empty()) {
        return step % every == 0;
    }
    return std::ranges::any_of(times, [&](double wanted) { return wanted <= time && !(after && wanted <= *after); });
}

std::vector<PlannedOutput> read_plan(const std::string& text, const std::string& folder, const RuntimeVolume& volume) {
    static const Json schema = Json::parse(insitu_plan_schema::files[0].text);
    const Json document = parsed(text);
    const JsonObject root(document, schema, "plan", "");
    root.integer("version");
    std::vector<PlannedOutput> plan;
    std::set<std::string> names;
    for (const JsonObject& output : root.objects("outputs")) {
        plan.push_back(output_in(output, folder, volume));
        if (!names.insert(plan.back().name).second) {
            output.fail("name", "is that of another output, too");
        }
    }
    return plan;
}

} // namespace elvis::library
