#include "commands.hpp"
#include "volume_argument.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace elvis::commands {

namespace {

using nlohmann::ordered_json;

struct Arguments {
    std::string volume;
    std::string plugin;
    std::uint32_t time_step = 0;
    bool json = false;
};

const char* shape_name(elvis_shape shape) {
    constexpr const char* names[] = {"hexahedron", "prism", "pyramid", "tetrahedron", "quadrilateral", "triangle"};
    return names[shape];
}

ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

const char* continuity_name(elvis_continuity continuity) {
    return continuity == ELVIS_CONTINUITY_CONTINUOUS      ? "continuous"
           : continuity == ELVIS_CONTINUITY_DISCONTINUOUS ? "discontinuous"
                                                          : "unknown";
}

/** Elements whose Jacobian determinant is negative at one of 125 points spread over the cube around the shape, clipped to it.
 */
std::uint64_t count_negative_jacobians(const RuntimeVolume& volume) {
    std::uint64_t n_negative = 0;
    for (const ClassInfo& element_class : volume.classes()) {
        std::vector<double> xi;
        for (int node = 0; node < 125; ++node) {
            const double x = 0.5 * (node % 5) - 1, y = 0.5 * (node / 5 % 5) - 1, z = 0.5 * (node / 25) - 1;
            const bool is_inside = element_class.shape == ELVIS_SHAPE_PRISM         ? x + z <= 0
                                   : element_class.shape == ELVIS_SHAPE_PYRAMID     ? x + z <= 0 && y + z <= 0
                                   : element_class.shape == ELVIS_SHAPE_TETRAHEDRON ? x + y + z <= -1
                                                                                    : true;
            if (is_inside) {
                xi.insert(xi.end(), {x, y, z});
            }
        }
        std::vector<double> jacobians(3 * xi.size());
        for (std::uint64_t element = 0; element < element_class.n_elements; ++element) {
            volume.evaluate_mapping(element_class.first_element + element, xi, {}, jacobians);
            bool is_negative = false;
            for (std::size_t at = 0; at < jacobians.size(); at += 9) {
                const double* j = &jacobians[at];
                const double determinant = j[0] * (j[4] * j[8] - j[5] * j[7]) - j[1] * (j[3] * j[8] - j[5] * j[6]) +
                                           j[2] * (j[3] * j[7] - j[4] * j[6]);
                is_negative = is_negative || determinant < 0;
            }
            n_negative += is_negative ? 1 : 0;
        }
    }
    return n_negative;
}

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
};

/** Range of each component over the volume, from the plugin. */
std::vector<Range> component_ranges(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step,
                                    elvis_certainty& certainty) {
    const std::size_t n_components = volume.fields()[field].n_components;
    std::vector<Range> total(n_components);
    constexpr std::uint64_t block = 65536;
    std::vector<FieldRange> ranges;
    certainty = ELVIS_CERTIFIED;
    for (std::uint64_t first = 0; first < volume.n_elements(); first += block) {
        ranges.resize(std::min(block, volume.n_elements() - first) * n_components);
        certainty = std::max(certainty, volume.field_ranges(field, time_step, first, ranges.size() / n_components, ranges));
        for (std::size_t index = 0; index < ranges.size(); ++index) {
            Range& range = total[index % n_components];
            range.lower = std::min(range.lower, ranges[index].lower);
            range.upper = std::max(range.upper, ranges[index].upper);
        }
    }
    return total;
}

ordered_json describe_fields(const RuntimeVolume& volume, std::uint32_t time_step) {
    ordered_json fields = ordered_json::array();
    for (std::uint32_t index = 0; index < volume.fields().size(); ++index) {
        const FieldInfo& field = volume.fields()[index];
        ordered_json entry = {{"name", field.name},
                              {"components", field.n_components},
                              {"unit", field.unit},
                              {"continuity", continuity_name(field.continuity)},
                              {"max_jump", number(field.max_jump)}};
        ordered_json orders = ordered_json::array();
        for (std::uint32_t element_class = 0; element_class < volume.classes().size(); ++element_class) {
            const ClassFieldInfo info = volume.class_field(element_class, index);
            orders.push_back({info.order[0], info.order[1], info.order[2]});
        }
        entry["order_by_class"] = orders;
        if (volume.has_field_ranges()) {
            elvis_certainty certainty = ELVIS_ESTIMATED;
            ordered_json ranges = ordered_json::array();
            for (const Range& range : component_ranges(volume, index, time_step, certainty)) {
                ranges.push_back({number(range.lower), number(range.upper)});
            }
            entry["range_by_component"] = ranges;
            entry["range_certainty"] = certainty == ELVIS_CERTIFIED ? "certified" : "estimated";
        }
        fields.push_back(entry);
    }
    return fields;
}

ordered_json describe(const RuntimeVolume& volume, std::uint32_t time_step) {
    ordered_json root;
    root["path"] = volume.path();
    root["plugin"] = volume.plugin().id();
    root["n_elements"] = volume.n_elements();
    root["n_faces"] = volume.n_faces();
    root["classes"] = ordered_json::array();
    for (const ClassInfo& info : volume.classes()) {
        root["classes"].push_back(
            {{"shape", shape_name(info.shape)},
             {"n_elements", info.n_elements},
             {"geometry_order", {info.geometry_order[0], info.geometry_order[1], info.geometry_order[2]}}});
    }
    Range bounds[3];
    std::vector<double> boxes(6 * volume.n_elements());
    const elvis_certainty certainty = volume.bounds(0, volume.n_elements(), boxes);
    for (std::size_t at = 0; at < boxes.size(); at += 6) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bounds[axis].lower = std::min(bounds[axis].lower, boxes[at + axis]);
            bounds[axis].upper = std::max(bounds[axis].upper, boxes[at + 3 + axis]);
        }
    }
    root["bounds"] = {{bounds[0].lower, bounds[1].lower, bounds[2].lower}, {bounds[0].upper, bounds[1].upper, bounds[2].upper}};
    root["bounds_certainty"] = certainty == ELVIS_CERTIFIED ? "certified" : "estimated";
    root["fields"] = describe_fields(volume, time_step);
    root["times"] = volume.times();
    root["boundary_groups"] = volume.boundary_groups();
    if (volume.has_evaluation() && volume.dimension() == 3) {
        // From samples: an element that is negative between them is not counted.
        root["negative_jacobians"] = {{"n_elements", count_negative_jacobians(volume)}, {"certainty", "estimated"}};
    }
    root["notes"] = ordered_json::object();
    for (const auto& [key, value] : volume.notes()) {
        root["notes"][key] = value;
    }
    return root;
}

std::string text_of(const ordered_json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

void print_table(const ordered_json& root) {
    std::printf("%s\n  served by %s\n  %s elements, %s faces\n", text_of(root["path"]).c_str(), text_of(root["plugin"]).c_str(),
                root["n_elements"].dump().c_str(), root["n_faces"].dump().c_str());
    for (const ordered_json& element_class : root["classes"]) {
        std::printf("    %s %s, geometry order %s\n", element_class["n_elements"].dump().c_str(),
                    text_of(element_class["shape"]).c_str(), element_class["geometry_order"].dump().c_str());
    }
    std::printf("  bounds %s (%s)\n", root["bounds"].dump().c_str(), text_of(root["bounds_certainty"]).c_str());
    for (const ordered_json& field : root["fields"]) {
        std::printf("  field %s: %s components, %s, largest jump %s\n    orders %s\n", text_of(field["name"]).c_str(),
                    field["components"].dump().c_str(), text_of(field["continuity"]).c_str(), field["max_jump"].dump().c_str(),
                    field["order_by_class"].dump().c_str());
        if (field.contains("range_by_component")) {
            std::printf("    range %s (%s)\n", field["range_by_component"].dump().c_str(),
                        text_of(field["range_certainty"]).c_str());
        }
    }
    std::printf("  times %s\n  boundary groups %s\n", root["times"].dump().c_str(), root["boundary_groups"].dump().c_str());
    if (root.contains("negative_jacobians")) {
        std::printf("  elements with a negative Jacobian among samples: %s\n",
                    root["negative_jacobians"]["n_elements"].dump().c_str());
    }
    for (const auto& [key, value] : root["notes"].items()) {
        std::printf("  %s: %s\n", key.c_str(), text_of(value).c_str());
    }
}

} // namespace

void add_info(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "Say what is in a volume");
    auto a = std::make_shared<Arguments>();
    command->add_option("volume", a->volume, "Volume")->required();
    command->add_option("--plugin", a->plugin, "Id of the runtime plugin (default: the one surest of the file)");
    command->add_option("--time-step", a->time_step, "Time step whose ranges are given");
    command->add_flag("--json", a->json, "Answer in JSON");
    command->callback([a] {
        const PluginRegistry registry;
        const RuntimeVolume volume = open_volume(registry, a->volume, a->plugin, {});
        if (a->time_step >= volume.times().size()) {
            throw Error(a->volume, "has " + std::to_string(volume.times().size()) + " time steps, counted from 0");
        }
        const ordered_json root = describe(volume, a->time_step);
        a->json ? static_cast<void>(std::printf("%s\n", root.dump(2).c_str())) : print_table(root);
    });
}

} // namespace elvis::commands
