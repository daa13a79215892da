#include <core/base/infinity.hpp>
#include <core/plugin_host/all_bounds.hpp>
#include <core/session/volume/describe_volume.hpp>

#include <core/base/background.hpp>
#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/overlaps.hpp>
#include <core/render/field/field_range.hpp>
#include <core/volume/outline.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <thread>

namespace elvis {

namespace {

using nlohmann::ordered_json;

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

FieldChoice choice(std::uint32_t field, int component) {
    FieldChoice choice;
    choice.field = field;
    choice.component = component;
    return choice;
}

/** What the field's values are: what colours go by. */
void describe_range(const RuntimeVolume& volume, ExtremaFinder& extrema, std::uint32_t field, std::uint32_t time_step,
                    ordered_json& entry) {
    ordered_json ranges = ordered_json::array(), by_component = ordered_json::array();
    elvis_certainty worst = ELVIS_CERTIFIED;
    const auto n_components = static_cast<int>(volume.fields()[field].n_components);
    for (int component = 0; component < n_components; ++component) {
        const FieldExtrema found = extrema.of(choice(field, component), time_step);
        by_component.push_back(describe_extrema(volume, found));
        ranges.push_back(by_component.back()["range"]);
        worst = std::max(worst, found.certainty);
    }
    entry["range_by_component"] = ranges;
    entry["range_certainty"] = worst == ELVIS_CERTIFIED ? "certified" : "sampled";
    entry["extrema_by_component"] = by_component;
    if (n_components > 1) {
        entry["magnitude"] = describe_extrema(volume, extrema.of(choice(field, -1), time_step));
    }
}

/** What encloses the field's values: what pictures leave out by. */
void describe_enclosure(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step, ordered_json& entry) {
    if (volume.has_field_ranges() && !volume.fields()[field].is_by_place) {
        elvis_certainty certainty = ELVIS_ESTIMATED;
        entry["enclosure_by_component"] = enclosures(volume, field, time_step, certainty);
        entry["enclosure_certainty"] = certainty == ELVIS_CERTIFIED ? "certified" : "sampled";
    }
}

ordered_json describe_fields(const RuntimeVolume& volume, const DescribeOptions& options, ExtremaFinder& extrema) {
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
        if (options.is_brief) {
            fields.push_back(entry);
            continue;
        }
        try {
            describe_range(volume, extrema, index, options.time_step, entry);
        } catch (const Error& error) {
            // Without a device all else can still be said.
            entry["range_unknown"] = error.what();
        }
        describe_enclosure(volume, index, options.time_step, entry);
        fields.push_back(entry);
    }
    return fields;
}

} // namespace

std::pair<std::array<double, 6>, elvis_certainty> bounds_of(const RuntimeVolume& volume) {
    std::array<double, 6> bounds{infinity, infinity, infinity, -infinity, -infinity, -infinity};
    elvis_certainty certainty = ELVIS_ESTIMATED;
    const std::vector<double> boxes = all_bounds(volume, certainty);
    for (std::size_t at = 0; at < boxes.size(); ++at) {
        const std::size_t axis = at % 6;
        bounds[axis] = axis < 3 ? std::min(bounds[axis], boxes[at]) : std::max(bounds[axis], boxes[at]);
    }
    return {bounds, certainty};
}

ordered_json describe_volume(const RuntimeVolume& volume, const DescribeOptions& options, ExtremaFinder& extrema) {
    if (options.time_step >= volume.times().size()) {
        throw Error(volume.path(), "has " + counted(volume.times().size(), "time step") + ", counted from 0");
    }
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
    const auto [bounds, certainty] = bounds_of(volume);
    root["bounds"] = {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
    root["bounds_certainty"] = certainty == ELVIS_CERTIFIED ? "certified" : "estimated";
    if (options.with_outline) {
        Background background(std::max(1u, std::thread::hardware_concurrency()));
        root["outline"] = outline_points(volume, background);
    }
    root["fields"] = describe_fields(volume, options, extrema);
    root["times"] = volume.times();
    root["boundary_groups"] = volume.boundary_groups();
    if (!options.is_brief && can_check_jacobians(volume)) {
        root["negative_jacobians"] = describe_jacobians(volume, options.jacobian_tolerance, options.lists_all);
    }
    if (!options.is_brief && can_find_overlaps(volume)) {
        root["overlapping_elements"] = describe_overlaps(volume, options.lists_all);
    }
    root["notes"] = ordered_json::object();
    for (const auto& [key, value] : volume.notes()) {
        root["notes"][key] = value;
    }
    return root;
}

} // namespace elvis
