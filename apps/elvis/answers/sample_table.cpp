#include "sample_table.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::commands {

namespace {

std::vector<SampledColumn> columns_of(const data& volume, const SampleWishes& wishes) {
    std::vector<std::string> names = wishes.fields;
    for (std::uint32_t field = 0; wishes.fields.empty() && field < volume.info().n_fields; ++field) {
        names.emplace_back(volume.field(field).name);
    }
    std::vector<SampledColumn> columns;
    std::uint32_t first = 0;
    for (const std::string& name : names) {
        const char* text = name.c_str();
        columns.push_back({name, volume.count_values(&text, 1), first});
        first += columns.back().n_components;
    }
    return columns;
}

void ask_points(const data& volume, const SampleWishes& wishes, const task& watch, SampleTable& table) {
    const std::size_t n = table.points.size();
    table.elements.resize(n);
    table.values.resize(n * table.n_values);
    table.gradients.resize(wishes.with_gradients ? 3 * table.values.size() : 0);
    std::vector<elvis_string> names;
    for (const SampledColumn& column : table.columns) {
        names.push_back(column.name.c_str());
    }
    auto probe = detail::sized<elvis_probe>();
    probe.time_step = wishes.time_step;
    probe.n_points = n;
    probe.positions = table.points.positions.data();
    probe.n_fields = static_cast<std::uint32_t>(names.size());
    probe.fields = names.data();
    probe.elements = table.elements.data();
    probe.values = table.values.data();
    probe.gradients = wishes.with_gradients ? table.gradients.data() : nullptr;
    volume.probe(probe, watch);
}

std::optional<SampledBreak::Side> side_of(const nlohmann::json& side) {
    if (side.is_null()) {
        return std::nullopt;
    }
    SampledBreak::Side read{side.at("element").get<std::int64_t>(), {}};
    for (const nlohmann::json& value : side.at("values")) {
        read.values.push_back(value.is_null() ? std::nan("") : value.get<double>());
    }
    return read;
}

void walk(const data& volume, const SampleWishes& wishes, const task& watch, SampleTable& table) {
    std::vector<std::string> names;
    for (const SampledColumn& column : table.columns) {
        names.push_back(column.name);
    }
    double behind = 0;
    const auto& corners = table.points.corners;
    for (std::size_t piece = 1; piece < corners.size(); ++piece) {
        if (corners[piece] == corners[piece - 1]) {
            continue;
        }
        const auto places =
            nlohmann::json::parse(volume.walk_line(corners[piece - 1], corners[piece], names, wishes.time_step, watch));
        for (const nlohmann::json& place : places) {
            table.breaks.push_back({behind + place.at("distance").get<double>(),
                                    place.at("position").get<std::array<double, 3>>(), side_of(place.at("before")),
                                    side_of(place.at("after"))});
        }
        behind += std::hypot(corners[piece][0] - corners[piece - 1][0], corners[piece][1] - corners[piece - 1][1],
                             corners[piece][2] - corners[piece - 1][2]);
    }
}

} // namespace

std::string SampledColumn::component(std::uint32_t index) const {
    return n_components > 1 ? name + "[" + std::to_string(index) + "]" : name;
}

std::size_t SampleTable::n_outside() const {
    return static_cast<std::size_t>(std::ranges::count_if(elements, [](std::int64_t element) { return element < 0; }));
}

SampleTable sample(const data& volume, SamplePoints points, const SampleWishes& wishes, const task& watch) {
    SampleTable table;
    table.points = std::move(points);
    table.columns = columns_of(volume, wishes);
    for (const SampledColumn& column : table.columns) {
        table.n_values += column.n_components;
    }
    ask_points(volume, wishes, watch, table);
    try {
        walk(volume, wishes, watch, table);
    } catch (const cancelled&) {
        throw;
    } catch (const error& reason) {
        table.no_breaks_because = reason.what();
    }
    return table;
}

} // namespace elvis::commands
