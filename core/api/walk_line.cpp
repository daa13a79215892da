#include "call.hpp"
#include "columns.hpp"

#include <core/probe/line_walk.hpp>

#include <elvis/answers.h>

#include <cmath>

namespace elvis::library {

namespace {

Vector3 finite_point(const double* coordinates, const char* name) {
    need(coordinates, name);
    const Vector3 point{coordinates[0], coordinates[1], coordinates[2]};
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2])) {
        throw InvalidArgument(name, "is not finite");
    }
    return point;
}

nlohmann::ordered_json side_json(const RuntimeVolume& volume, const ReferencePoint& point, const std::vector<double>& values) {
    std::int64_t number = 0;
    volume.element_numbers(point.element, 1, {&number, 1});
    return {{"element", number}, {"xi", point.xi}, {"values", values}};
}

std::string breaks_json(const RuntimeVolume& volume, const Vector3& from, const Vector3& to,
                        const std::vector<LineBreak>& breaks, const Columns& columns, std::uint32_t time_step) {
    std::vector<ReferencePoint> points;
    for (const LineBreak& each : breaks) {
        for (const std::optional<ReferencePoint>& side : {each.before, each.after}) {
            if (side) {
                points.push_back(*side);
            }
        }
    }
    const std::vector<std::vector<double>> values = values_at(volume, columns, time_step, points);
    const Vector3 direction = minus(to, from);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::size_t next = 0;
    const auto side = [&](const std::optional<ReferencePoint>& point) {
        nlohmann::ordered_json answer;
        if (point) {
            answer = side_json(volume, *point, values[next++]);
        }
        return answer;
    };
    for (const LineBreak& each : breaks) {
        nlohmann::ordered_json place = {{"parameter", each.parameter},
                                        {"distance", each.parameter * length(direction)},
                                        {"position", plus(from, scaled(direction, each.parameter))}};
        place["before"] = side(each.before);
        place["after"] = side(each.after);
        list.push_back(std::move(place));
    }
    return list.dump();
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_walk_line(elvis_data* data, const double from[3], const double to[3], const elvis_string* fields,
                                  uint32_t n_fields, uint32_t time_step, const elvis_task* task, char** text) {
    return call(data, [&] {
        need(text, "text");
        const Vector3 first = finite_point(from, "from"), last = finite_point(to, "to");
        if (first == last) {
            throw InvalidArgument("from, to", "are the same point");
        }
        Data& state = *data->state;
        check_time_step(state.volume, time_step);
        const DataTask running(state, task);
        const Columns columns = columns_of(state.volume, fields, n_fields);
        const std::vector<LineBreak> breaks = walk_line(state.volume, first, last, state.control.get());
        *text = text_for_caller(breaks_json(state.volume, first, last, breaks, columns, time_step));
    });
}
