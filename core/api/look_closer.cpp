#include "drawing.hpp"

#include <core/session/pick.hpp>
#include <core/session/volume/field_samples.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace elvis::library {

namespace {

static_assert(ELVIS_SAMPLES_A_PIECE == n_points_a_piece && ELVIS_SAMPLE_PIECES == n_pieces);

nlohmann::ordered_json number(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

nlohmann::ordered_json fields_json(const RuntimeVolume& volume, const std::vector<FieldSample>& samples) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (std::size_t index = 0; index < samples.size(); ++index) {
        const FieldInfo& info = volume.fields()[index];
        list.push_back({{"name", info.name},
                        {"unit", info.unit},
                        {"values", samples[index].values},
                        {"gradients", samples[index].gradients},
                        {"gradient_is_estimated", samples[index].gradient_is_estimated}});
    }
    return list;
}

nlohmann::ordered_json picked_json(const RuntimeVolume& volume, const Picked& picked) {
    nlohmann::ordered_json root = {{"hit", picked.is_hit}};
    if (!picked.is_hit) {
        return root;
    }
    root["position"] = picked.position;
    root["depth"] = picked.depth;
    root["normal"] = picked.normal;
    root["value"] = number(picked.shown_value);
    root["element"] = picked.element ? nlohmann::ordered_json(*picked.element) : nlohmann::ordered_json();
    root["also"] = picked.also;
    root["xi"] = picked.xi;
    root["jacobian"] = number(picked.jacobian);
    root["scaled_jacobian"] = number(picked.scaled_jacobian);
    root["order"] = number(picked.order);
    root["fields"] = fields_json(volume, picked.fields);
    root["remark"] = picked.remark;
    return root;
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_pick(elvis_data* data, const elvis_scene* scene, double column, double row, const elvis_task* task,
                             char** text) {
    return call(data, [&] {
        need(text, "text");
        need(scene, "scene");
        if (!std::isfinite(column) || !std::isfinite(row)) {
            throw InvalidArgument("column, row", "are no finite numbers");
        }
        need_one_volume(scene->state.scene, "picking");
        const std::shared_ptr<Data> with = shown_data(data->state, scene->state.scene, task);
        Data& state = *with;
        Scene shown = scene_for(state, scene->state.scene);
        const DataTask running(state, task);
        provide_glyphs(state, shown);
        const Picked picked = pick(shown, {column, row}, state.volume, state.renderer(precision_of(shown)),
                                   [&]() -> Prober& { return state.prober(ProbeOptions::Evaluation::automatic); });
        *text = text_for_caller(picked_json(state.volume, picked).dump());
    });
}

elvis_result elvis_data_sample(elvis_data* data, const elvis_scene* scene, elvis_string field, uint32_t piece, double* values,
                               uint32_t* n_values) {
    return call(data, [&] {
        need(values, "values");
        need(n_values, "n_values");
        need(scene, "scene");
        if (piece >= ELVIS_SAMPLE_PIECES) {
            throw InvalidArgument("piece", "is one of ELVIS_SAMPLE_PIECES, counted from 0");
        }
        const std::shared_ptr<Data> with = shown_data(data->state, scene->state.scene, nullptr);
        Data& state = *with;
        const Scene shown = scene_for(state, scene->state.scene);
        const DataTask running(state, nullptr);
        need_samples(state.volume);
        const std::vector<double> some =
            field_samples(state.prober(ProbeOptions::Evaluation::automatic), state.volume, state.bounds(), shown,
                          field != nullptr ? std::optional<std::string>(field) : shown.field, piece);
        std::ranges::copy(some, values);
        *n_values = static_cast<std::uint32_t>(some.size());
    });
}

elvis_result elvis_data_get_percentiles(elvis_data* data, const elvis_scene* scene, uint32_t n_parts, const double* parts,
                                        double* values, const elvis_task* task) {
    return call(data, [&] {
        need(parts, "parts");
        need(values, "values");
        need(scene, "scene");
        const std::span<const double> wanted(parts, n_parts);
        if (!std::ranges::all_of(wanted, [](double part) { return part >= 0 && part <= 1; })) {
            throw InvalidArgument("parts", "are numbers from 0 to 1");
        }
        const std::shared_ptr<Data> with = shown_data(data->state, scene->state.scene, task);
        Data& state = *with;
        Scene shown = scene_for(state, scene->state.scene);
        const DataTask running(state, task);
        need_samples(state.volume);
        shown.range_steps = steps_of_animation(shown, state.volume);
        std::ranges::copy(percentiles(state.prober(ProbeOptions::Evaluation::automatic), state.volume, state.bounds(), shown,
                                      wanted, *state.control),
                          values);
    });
}
