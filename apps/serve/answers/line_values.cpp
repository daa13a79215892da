#include "line_values.hpp"
#include "displaced.hpp"

#include <apps/elvis/answers/sample_curve.hpp>
#include <apps/elvis/answers/sample_table.hpp>

#include <optional>
#include <sstream>

namespace elvis::serve {

namespace {

using nlohmann::json;

json element_json(const std::optional<commands::SampledBreak::Side>& side) { return side ? json(side->element) : json(); }

} // namespace

json values_along(const Served& served, const Scene& scene, const LineWishes& wishes, const task& watch) {
    const elvis::scene shown = served.library_scene(scene);
    commands::SampleWishes asked{{}, view::time_step_of(scene), false};
    for (const std::string& field : wishes.fields) {
        asked.fields.push_back(shown.expression(field));
    }
    const std::optional<data> warped = displaced(served, scene, watch);
    const commands::SampleTable table = commands::sample(
        warped ? *warped : served.volume, commands::points_along({wishes.from, wishes.to}, wishes.count), asked, watch);
    json series = json::array();
    for (const commands::SampledCurve& curve : commands::curves_of(table)) {
        series.push_back({{"name", curve.name}, {"points", curve.points}});
    }
    json breaks = json::array();
    for (const commands::SampledBreak& each : table.breaks) {
        breaks.push_back({{"at", each.arc_length}, {"before", element_json(each.before)}, {"after", element_json(each.after)}});
    }
    std::ostringstream csv;
    commands::put_csv(table, csv);
    return {{"series", std::move(series)},
            {"breaks", std::move(breaks)},
            {"no_breaks_because", table.no_breaks_because},
            {"length", table.points.arc_lengths.back()},
            {"n_outside", table.n_outside()},
            {"csv", csv.str()}};
}

} // namespace elvis::serve
