#include "commands.hpp"
#include "volume_argument.hpp"

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/probe/overlaps.hpp>
#include <core/render/field/field_range.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/volume/element/jacobian_check.hpp>
#include <core/volume/field/field_extrema.hpp>

#include <elvis/native/space.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

namespace elvis::commands {

namespace {

using nlohmann::ordered_json;

struct Arguments {
    std::string volume;
    std::string plugin;
    std::uint32_t time_step = 0;
    double jacobian_tolerance = default_jacobian_tolerance;
    bool lists_all = false;
    bool json = false;
};

ordered_json number(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

const char* continuity_name(elvis_continuity continuity) {
    return continuity == ELVIS_CONTINUITY_CONTINUOUS      ? "continuous"
           : continuity == ELVIS_CONTINUITY_DISCONTINUOUS ? "discontinuous"
                                                          : "unknown";
}

/** Elements listed by default: enough to look at, and no flood. */
constexpr std::size_t n_listed_by_default = 20;

ordered_json point(const Vector3& x) { return {number(x[0]), number(x[1]), number(x[2])}; }

/** Signs of the Jacobian determinant: counts, and the elements that are not positive, each with a point to look at. */
ordered_json describe_jacobians(const RuntimeVolume& volume, double tolerance, bool lists_all) {
    const JacobianReport report = check_jacobians(volume, tolerance);
    ordered_json root = {{"n_elements", report.n_negative},
                         {"certainty", report.certainty == ELVIS_CERTIFIED ? "certified" : "estimated"},
                         {"tolerance", tolerance},
                         {"n_positive", report.n_positive},
                         {"n_undecided", report.n_undecided},
                         {"elements", ordered_json::array()},
                         {"undecided", ordered_json::array()}};
    for (const auto& [element, check] : report.findings) {
        const bool is_negative = check.sign == ELVIS_JACOBIAN_NEGATIVE;
        ordered_json& list = root[is_negative ? "elements" : "undecided"];
        if (!lists_all && list.size() == n_listed_by_default) {
            continue;
        }
        std::int64_t element_number = 0;
        volume.element_numbers(element, 1, std::span(&element_number, 1));
        ordered_json entry = {{"element", element_number}, {"xi", point(check.xi)}};
        if (volume.has_evaluation()) {
            Vector3 x{};
            volume.evaluate_mapping(element, check.xi, x, {});
            entry["x"] = point(x);
        }
        entry["determinant"] = number(check.determinant);
        if (!is_negative) {
            entry["lower_bound"] = number(check.lower);
        }
        list.push_back(entry);
    }
    return root;
}

/** Elements that lie in parts of others. */
ordered_json describe_overlaps(const RuntimeVolume& volume, bool lists_all) {
    const std::vector<std::uint64_t> overlapping = overlapping_elements(volume);
    ordered_json root = {{"n_elements", overlapping.size()}, {"certainty", "estimated"}, {"elements", ordered_json::array()}};
    const std::size_t n_listed = lists_all ? overlapping.size() : std::min(overlapping.size(), n_listed_by_default);
    for (std::size_t index = 0; index < n_listed; ++index) {
        std::int64_t element_number = 0;
        volume.element_numbers(overlapping[index], 1, std::span(&element_number, 1));
        root["elements"].push_back(element_number);
    }
    return root;
}

/** Sum of the elements' enclosures, from the plugin: one range a component. */
ordered_json enclosures(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step, elvis_certainty& certainty) {
    ordered_json result = ordered_json::array();
    Background background(std::max(1u, std::thread::hardware_concurrency()));
    for (const FieldRange& range : ranges_from_plugin(background, volume, field, time_step, certainty)) {
        result.push_back({number(range.lower), number(range.upper)});
    }
    return result;
}

ordered_json describe_extremum(const RuntimeVolume& volume, const FieldExtremum& extremum) {
    std::int64_t element_number = 0;
    volume.element_numbers(extremum.element, 1, std::span(&element_number, 1));
    ordered_json entry = {{"value", number(extremum.value)},
                          {"bound", number(extremum.bound)},
                          {"element", element_number},
                          {"xi", point(extremum.xi)}};
    if (volume.has_evaluation()) {
        Vector3 x{};
        volume.evaluate_mapping(extremum.element, extremum.xi, x, {});
        entry["x"] = point(x);
    }
    return entry;
}

ordered_json describe_extrema(const RuntimeVolume& volume, const FieldExtrema& extrema) {
    return {{"range", {number(extrema.minimum.value), number(extrema.maximum.value)}},
            {"certainty", extrema.certainty == ELVIS_CERTIFIED ? "certified" : "sampled"},
            {"minimum", describe_extremum(volume, extrema.minimum)},
            {"maximum", describe_extremum(volume, extrema.maximum)}};
}

/** Extrema of fields: from the CPU, and from samples on a device where that alone can tell, which is not opened before. */
class Extrema {
public:
    explicit Extrema(const RuntimeVolume& volume) : m_volume(volume) {}

    FieldExtrema of(std::uint32_t field, int component, std::uint32_t time_step) {
        if (const auto found = find_extrema(m_volume, field, component, time_step)) {
            return *found;
        }
        if (!m_ranges) {
            m_device.emplace();
            const Precision precision = m_device->summary().has_float64 ? Precision::float64 : Precision::float32;
            m_data.emplace(*m_device, m_volume, precision, nullptr);
            m_ranges.emplace(*m_device, m_volume, *m_data);
        }
        FieldChoice choice;
        choice.field = field;
        choice.component = component;
        return m_ranges->extrema(choice, time_step);
    }

private:
    const RuntimeVolume& m_volume;
    std::optional<Device> m_device;
    std::optional<DeviceVolume> m_data;
    std::optional<VolumeRanges> m_ranges;
};

/** What the field's values are: what colours go by. */
void describe_range(const RuntimeVolume& volume, Extrema& extrema, std::uint32_t field, std::uint32_t time_step,
                    ordered_json& entry) {
    ordered_json ranges = ordered_json::array(), by_component = ordered_json::array();
    elvis_certainty worst = ELVIS_CERTIFIED;
    const auto n_components = static_cast<int>(volume.fields()[field].n_components);
    for (int component = 0; component < n_components; ++component) {
        const FieldExtrema found = extrema.of(field, component, time_step);
        by_component.push_back(describe_extrema(volume, found));
        ranges.push_back(by_component.back()["range"]);
        worst = std::max(worst, found.certainty);
    }
    entry["range_by_component"] = ranges;
    entry["range_certainty"] = worst == ELVIS_CERTIFIED ? "certified" : "sampled";
    entry["extrema_by_component"] = by_component;
    if (n_components > 1) {
        entry["magnitude"] = describe_extrema(volume, extrema.of(field, -1, time_step));
    }
}

/** What encloses the field's values: what pictures leave out by. */
void describe_enclosure(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step, ordered_json& entry) {
    if (volume.has_field_ranges()) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        entry["enclosure_by_component"] = enclosures(volume, field, time_step, certainty);
        entry["enclosure_certainty"] = certainty == ELVIS_CERTIFIED ? "certified" : "sampled";
    }
}

ordered_json describe_fields(const RuntimeVolume& volume, std::uint32_t time_step) {
    ordered_json fields = ordered_json::array();
    Extrema extrema(volume);
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
        try {
            describe_range(volume, extrema, index, time_step, entry);
        } catch (const Error& error) {
            // Without a device all else can still be said.
            entry["range_unknown"] = error.what();
        }
        describe_enclosure(volume, index, time_step, entry);
        fields.push_back(entry);
    }
    return fields;
}

ordered_json describe(const RuntimeVolume& volume, const Arguments& arguments) {
    ordered_json root;
    root["path"] = volume.path();
    root["plugin"] = volume.plugin().id();
    root["n_elements"] = volume.n_elements();
    root["n_faces"] = volume.n_faces();
    root["classes"] = ordered_json::array();
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        root["classes"].push_back({{"shape", native::name(native::Shape{info.shape})},
                                   {"n_elements", info.n_elements},
                                   {"geometry_order", {info.geometry_order[0], info.geometry_order[1], info.geometry_order[2]}},
                                   {"cut", volume.is_cut(index)}});
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<FieldRange, 3> bounds;
    bounds.fill({infinity, -infinity});
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
    root["fields"] = describe_fields(volume, arguments.time_step);
    root["times"] = volume.times();
    root["boundary_groups"] = volume.boundary_groups();
    if (can_check_jacobians(volume)) {
        root["negative_jacobians"] = describe_jacobians(volume, arguments.jacobian_tolerance, arguments.lists_all);
    }
    if (can_find_overlaps(volume)) {
        root["overlapping_elements"] = describe_overlaps(volume, arguments.lists_all);
    }
    root["notes"] = ordered_json::object();
    for (const auto& [key, value] : volume.notes()) {
        root["notes"][key] = value;
    }
    return root;
}

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
    auto a = std::make_shared<Arguments>();
    command->add_option("volume", a->volume, "Volume")->required();
    command->add_option("--plugin", a->plugin, "Id of the runtime plugin (default: the one surest of the file)");
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
        const PluginRegistry registry;
        const RuntimeVolume volume = open_volume(registry, a->volume, a->plugin, {});
        if (a->time_step >= volume.times().size()) {
            throw Error(a->volume, "has " + counted(volume.times().size(), "time step") + ", counted from 0");
        }
        const ordered_json root = describe(volume, *a);
        a->json ? static_cast<void>(std::printf("%s\n", root.dump(2).c_str())) : print_table(root);
    });
}

} // namespace elvis::commands
