#include "volume_facts.hpp"

#include <core/base/bounds.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace elvis::view {

namespace {

/** As people call it, of its id. */
std::string plugin_name(const context& library, const std::string& id) {
    const auto known = nlohmann::json::parse(library.list_plugins());
    for (const nlohmann::json& plugin : known["plugins"]) {
        if (plugin["id"] == id) {
            return plugin["name"];
        }
    }
    return id;
}

std::vector<FieldFacts> fields_of(const data& volume, std::uint32_t n_fields) {
    std::vector<FieldFacts> fields;
    for (std::uint32_t index = 0; index < n_fields; ++index) {
        const elvis_field field = volume.field(index);
        fields.push_back({field.name, field.unit, field.n_components});
    }
    return fields;
}

/** Of classes, each once, in their order. */
std::vector<std::string> shapes_of(const nlohmann::json& classes) {
    std::vector<std::string> shapes;
    for (const nlohmann::json& element_class : classes) {
        const std::string shape = element_class["shape"];
        if (std::ranges::find(shapes, shape) == shapes.end()) {
            shapes.push_back(shape);
        }
    }
    return shapes;
}

} // namespace

double VolumeFacts::diagonal() const { return diagonal_of(bounds); }

elvis_extent VolumeFacts::extent() const {
    auto extent = detail::sized<elvis_extent>();
    std::ranges::copy(shown_bounds, extent.bounds);
    extent.outline = outline.empty() ? nullptr : outline.front().data();
    extent.n_outline = outline.size();
    return extent;
}

VolumeFacts facts_of(const data& volume, const context& library) {
    const elvis_data_info info = volume.info();
    auto options = detail::sized<elvis_describe_options>();
    options.flags = ELVIS_DESCRIBE_BRIEF | ELVIS_DESCRIBE_OUTLINE;
    const auto description = nlohmann::json::parse(volume.describe(options));
    VolumeFacts facts;
    facts.path = description["path"];
    facts.plugin = plugin_name(library, description["plugin"]);
    facts.dimension = info.dimension;
    facts.n_elements = info.n_elements;
    std::ranges::copy(info.bounds, facts.bounds.begin());
    facts.shown_bounds = facts.bounds;
    facts.outline = description["outline"].get<std::vector<Vector3>>();
    facts.fields = fields_of(volume, info.n_fields);
    facts.times = description["times"].get<std::vector<double>>();
    facts.boundary_groups = description["boundary_groups"].get<std::vector<std::string>>();
    facts.has_faces = description["n_faces"] > 0;
    facts.shapes = shapes_of(description["classes"]);
    return facts;
}

void add_further_volumes(VolumeFacts& facts, const context& library, const Scene& scene, const std::string& folder) {
    const std::vector<Vector3> own_outline = facts.outline;
    for (const Json& further : part_of(scene, "volumes")) {
        std::array<double, 6> bounds = facts.bounds;
        std::vector<Vector3> outline = own_outline;
        if (further.contains("path")) {
            Json file = further;
            for (const char* const key : {"offset", "field", "time_step"}) {
                file.erase(key);
            }
            const Json named = {{"version", 1}, {"volume", file}};
            const VolumeFacts other = facts_of(library.parse_scene(named.dump(), folder).open_volume(), library);
            bounds = other.bounds;
            outline = other.outline;
        }
        const auto offset = further.value("offset", Vector3{});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            facts.shown_bounds[axis] = std::min(facts.shown_bounds[axis], bounds[axis] + offset[axis]);
            facts.shown_bounds[axis + 3] = std::max(facts.shown_bounds[axis + 3], bounds[axis + 3] + offset[axis]);
        }
        std::ranges::transform(outline, std::back_inserter(facts.outline),
                               [&](const Vector3& point) { return plus(point, offset); });
    }
}

} // namespace elvis::view
