#include "volume_facts.hpp"

#include <core/base/bounds.hpp>

#include <elvis/native/space.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace elvis::view {

namespace {

/** As people call it, of its id. */
std::string plugin_name(const context& library, const std::string& id) {
    for (const nlohmann::json& plugin : nlohmann::json::parse(library.list_plugins())["plugins"]) {
        if (plugin["id"] == id) {
            return plugin["name"];
        }
    }
    return id;
}

std::vector<FieldInfo> fields_of(const data& volume, std::uint32_t n_fields) {
    std::vector<FieldInfo> fields;
    for (std::uint32_t index = 0; index < n_fields; ++index) {
        const elvis_field field = volume.field(index);
        fields.push_back({field.name, field.unit, field.n_components, field.continuity, field.transform, field.max_jump});
    }
    return fields;
}

/** Of classes, each once, in their order. */
std::vector<std::uint32_t> shapes_of(const nlohmann::json& classes) {
    std::vector<std::uint32_t> shapes;
    for (const nlohmann::json& element_class : classes) {
        for (std::uint32_t shape = ELVIS_SHAPE_HEXAHEDRON; shape <= ELVIS_SHAPE_TRIANGLE; ++shape) {
            const bool is_new = std::ranges::find(shapes, shape) == shapes.end();
            if (is_new && element_class["shape"] == native::name(native::Shape{shape})) {
                shapes.push_back(shape);
            }
        }
    }
    return shapes;
}

} // namespace

double VolumeFacts::diagonal() const { return diagonal_of(bounds); }

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
    facts.outline = description["outline"].get<std::vector<Vector3>>();
    facts.fields = fields_of(volume, info.n_fields);
    facts.times = description["times"].get<std::vector<double>>();
    facts.boundary_groups = description["boundary_groups"].get<std::vector<std::string>>();
    facts.has_faces = description["n_faces"] > 0;
    facts.shapes = shapes_of(description["classes"]);
    return facts;
}

} // namespace elvis::view
