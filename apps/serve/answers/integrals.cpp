#include "integrals.hpp"
#include "displaced.hpp"

#include <apps/elvis/answers/integrals/answers_as_json.hpp>

#include <algorithm>
#include <optional>

namespace elvis::serve {

nlohmann::json integral_of(const Served& served, const Scene& scene, const IntegralWishes& wishes, const task& watch) {
    const elvis::scene shown = served.library_scene(scene);
    const auto expression = [&](const std::string& field) { return field.empty() ? field : shown.expression(field); };
    const std::string field = expression(wishes.field), level_field = expression(wishes.level_field);
    const std::vector<elvis_string> groups = detail::c_strings(wishes.groups);
    auto wanted = detail::sized<elvis_integration>();
    wanted.domain = wishes.domain;
    wanted.field = detail::or_null(field);
    wanted.groups = groups.data();
    wanted.n_groups = static_cast<std::uint32_t>(groups.size());
    wanted.time_step = view::time_step_of(scene);
    wanted.is_flux = wishes.is_flux ? 1 : 0;
    std::ranges::copy(wishes.plane, wanted.plane);
    wanted.level_field = detail::or_null(level_field);
    wanted.isovalue = wishes.isovalue;
    wanted.tolerance = wishes.tolerance;
    const std::optional<data> warped = displaced(served, scene, watch);
    const elvis_integral found = (warped ? *warped : served.volume).integrate(wanted, watch);
    return {{"integral", commands::integral_json(found)}, {"doubts", commands::doubts_of(found)}};
}

nlohmann::json extrema_of(const Served& served, const Scene& scene, const std::string& field, const task& watch) {
    const std::string text = served.library_scene(scene).expression(field);
    const std::optional<data> warped = displaced(served, scene, watch);
    return {
        {"extrema", commands::extrema_json(text, (warped ? *warped : served.volume).range(text, view::time_step_of(scene)))}};
}

} // namespace elvis::serve
