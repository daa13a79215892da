#include "commands.hpp"
#include "library_context.hpp"
#include "open_volume.hpp"
#include "volume_arguments.hpp"

#include <core/base/counted.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {

namespace {

using nlohmann::ordered_json;

struct InfoArguments {
    VolumeArguments volume;
    std::uint32_t time_step = 0;
    double jacobian_tolerance = 1e-9;
    bool lists_all = false;
    bool json = false;
};

std::string text_of(const ordered_json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

void print_jacobians(const ordered_json& root) {
    std::printf("  Jacobian determinant (%s): negative somewhere in %s, undecided in %s, positive in %s\n",
                text_of(root["certainty"]).c_str(), counted(root["n_elements"], "element").c_str(),
                root["n_undecided"].dump().c_str(), root["n_positive"].dump().c_str());
    const auto print_list = [](const ordered_json& list, const ordered_json& n_all, const char* word) {
        for (const ordered_json& entry : list) {
            std::printf("    element %s: %s %s at xi %s%s%s\n", entry["element"].dump().c_str(), word,
                        entry["determinant"].dump().c_str(), entry["xi"].dump().c_str(), entry.contains("x") ? ", x " : "",
                        entry.contains("x") ? entry["x"].dump().c_str() : "");
        }
        if (n_all > list.size()) {
            std::printf("    and %zu more (--all lists them)\n", n_all.get<std::size_t>() - list.size());
        }
    };
    print_list(root["elements"], root["n_elements"], "negative,");
    print_list(root["undecided"], root["n_undecided"], "undecided, smallest seen");
}

void print_overlaps(const ordered_json& root) {
    std::printf("  overlaps (%s): in %s\n", text_of(root["certainty"]).c_str(), counted(root["n_elements"], "element").c_str());
    if (!root["elements"].empty()) {
        const bool is_all = root["n_elements"] == root["elements"].size();
        std::printf("    elements %s%s\n", root["elements"].dump().c_str(), is_all ? "" : " and more (--all lists them)");
    }
}

/** "[0.25, -1]": six digits, for people. */
std::string numbers_text(const ordered_json& value) {
    if (value.is_array()) {
        std::string text;
        for (const ordered_json& item : value) {
            text += (text.empty() ? "" : ", ") + numbers_text(item);
        }
        return "[" + text + "]";
    }
    std::array<char, 32> text{};
    if (!value.is_number() || std::snprintf(text.data(), text.size(), "%.6g", value.get<double>()) < 0) {
        return "unknown";
    }
    return text.data();
}

/** One line for a scalar, else one for each component and one for the magnitude. */
void print_ranges(const ordered_json& field) {
    const auto print_extrema = [](const std::string& name, const ordered_json& extrema) {
        std::printf("    %s%s (%s)", name.c_str(), numbers_text(extrema["range"]).c_str(),
                    text_of(extrema["certainty"]).c_str());
        if (extrema["minimum"].contains("x")) {
            std::printf(", at x %s and %s", numbers_text(extrema["minimum"]["x"]).c_str(),
                        numbers_text(extrema["maximum"]["x"]).c_str());
        }
        std::printf("\n");
    };
    if (field.contains("extrema_by_component")) {
        const ordered_json& extrema = field["extrema_by_component"];
        for (std::size_t component = 0; component < extrema.size(); ++component) {
            print_extrema(extrema.size() > 1 ? "range of [" + std::to_string(component) + "] " : "range ", extrema[component]);
        }
    }
    if (field.contains("range_unknown")) {
        std::printf("    range unknown: %s\n", text_of(field["range_unknown"]).c_str());
    }
    if (field.contains("magnitude")) {
        print_extrema("range of the magnitude ", field["magnitude"]);
    }
    if (field.contains("enclosure_by_component")) {
        std::printf("    enclosed by the elements' bounds %s (%s)\n", numbers_text(field["enclosure_by_component"]).c_str(),
                    text_of(field["enclosure_certainty"]).c_str());
    }
}

void print_table(const ordered_json& root) {
    std::printf("%s\n  served by %s\n  %s, %s\n", text_of(root["path"]).c_str(), text_of(root["plugin"]).c_str(),
                counted(root["n_elements"], "element").c_str(), counted(root["n_faces"], "face").c_str());
    for (const ordered_json& element_class : root["classes"]) {
        std::printf("    %s %s, geometry order %s%s\n", element_class["n_elements"].dump().c_str(),
                    text_of(element_class["shape"]).c_str(), element_class["geometry_order"].dump().c_str(),
                    element_class["cut"] ? ", cut (elvis_inside)" : "");
    }
    std::printf("  bounds %s (%s)\n", root["bounds"].dump().c_str(), text_of(root["bounds_certainty"]).c_str());
    for (const ordered_json& field : root["fields"]) {
        const std::string continuity = text_of(field["continuity"]);
        std::printf("  field %s: %s, %s, largest jump %s\n    orders %s\n", text_of(field["name"]).c_str(),
                    counted(field["components"], "component").c_str(),
                    continuity == "unknown" ? "continuity unknown" : continuity.c_str(),
                    field["max_jump"].is_null() ? "unknown" : field["max_jump"].dump().c_str(),
                    field["order_by_class"].dump().c_str());
        print_ranges(field);
    }
    std::printf("  times %s\n  boundary groups %s\n", root["times"].dump().c_str(), root["boundary_groups"].dump().c_str());
    if (root.contains("negative_jacobians")) {
        print_jacobians(root["negative_jacobians"]);
    }
    if (root.contains("overlapping_elements")) {
        print_overlaps(root["overlapping_elements"]);
    }
    for (const auto& [key, value] : root["notes"].items()) {
        std::printf("  %s: %s\n", key.c_str(), text_of(value).c_str());
    }
}

} // namespace

void add_info(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "Say what is in a volume");
    auto a = std::make_shared<InfoArguments>();
    add_volume_arguments(*command, a->volume);
    command->add_option("--time-step", a->time_step, "Time step whose ranges are given");
    command
        ->add_option("--jacobian-tolerance", a->jacobian_tolerance,
                     "Elements whose smallest Jacobian determinant is closer to zero than this times its largest may stay "
                     "undecided")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--all", a->lists_all,
                      "List all elements with a negative or undecided Jacobian or that overlap, not the first 20");
    command->add_flag("--json", a->json, "Answer in JSON");
    command->callback([a] {
        const context library = library_context();
        const data volume = open_volume(library, a->volume, a->time_step);
        auto options = detail::sized<elvis_describe_options>();
        options.flags = ELVIS_DESCRIBE_JACOBIAN_TOLERANCE | (a->lists_all ? ELVIS_DESCRIBE_ALL : 0u);
        options.time_step = a->time_step;
        options.jacobian_tolerance = a->jacobian_tolerance;
        const ordered_json root = ordered_json::parse(volume.describe(options));
        a->json ? static_cast<void>(std::printf("%s\n", root.dump(2).c_str())) : print_table(root);
    });
}

} // namespace elvis::commands
