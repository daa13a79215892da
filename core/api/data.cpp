#include "call.hpp"

#include <core/base/counted.hpp>
#include <core/base/infinity.hpp>
#include <core/expression/poles.hpp>
#include <core/render/field/chosen_values.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/volume/describe_volume.hpp>
#include <core/session/volume/open_volume.hpp>
#include <core/session/volume/warped.hpp>

#include <algorithm>
#include <limits>

namespace elvis::library {

Data::Data(std::shared_ptr<Context> with, std::unique_ptr<TaskControl> watch, RuntimeVolume of)
    : context(std::move(with)), control(std::move(watch)), volume(std::move(of)),
      extrema(volume, [this]() -> const Device& { return context->device(); }) {}

Data::~Data() {
    const HostScope scope(context->host);
    m_warped.reset();
    m_others.clear();
    m_on_demand.reset();
    m_renderer.reset();
    m_prober.reset();
}

Renderer& Data::renderer(Precision precision) {
    if (!m_renderer || m_precision != precision) {
        m_renderer.reset();
        m_renderer.emplace(context->device(), volume, precision, control.get());
        m_precision = precision;
    }
    return *m_renderer;
}

std::vector<Renderer*> Data::other_renderers(Precision precision) {
    const auto& devices = context->other_devices();
    if (!devices.empty() && !reopen) {
        throw InvalidArgument(volume.path(), "is not from a file: one device draws it, not several");
    }
    if (m_others_precision != precision) {
        m_others.clear();
        m_others_precision = precision;
    }
    std::vector<Renderer*> renderers;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (i == m_others.size()) {
            m_others.push_back(std::make_unique<Other>(reopen(), std::nullopt));
            m_others[i]->renderer.emplace(*devices[i], m_others[i]->volume, precision, control.get());
        }
        renderers.push_back(&*m_others[i]->renderer);
    }
    return renderers;
}

VolumeOnDemand& Data::on_demand(Precision precision, const MemoryBudget& budget) {
    if (!context->other_devices().empty()) {
        throw InvalidArgument("scene", "'memory' does not go with several devices");
    }
    m_others.clear();
    m_renderer.reset();
    if (!m_on_demand || m_on_demand->precision != precision || m_on_demand->budget != budget) {
        m_on_demand.reset();
        m_on_demand = std::unique_ptr<OnDemand>(
            new OnDemand{precision, budget, {volume, context->device(), precision, budget, control.get()}});
    }
    return m_on_demand->drawing;
}

FieldExtrema Data::extrema_of(const FieldChoice& field, std::uint32_t time_step) {
    return m_renderer && field.expression ? m_renderer->ranges().extrema(field, time_step) : extrema.of(field, time_step);
}

Prober& Data::prober(ProbeOptions::Evaluation evaluation) {
    if (!m_prober || m_evaluation != evaluation) {
        m_prober.emplace(volume, ProbeOptions{evaluation, context->wanted_device});
        m_evaluation = evaluation;
    }
    return *m_prober;
}

void Data::forget_work() {
    m_warped.reset();
    m_others.clear();
    m_on_demand.reset();
    m_renderer.reset();
    m_prober.reset();
    beside.clear();
    streamlines = {};
    arrow_sets = {};
}

std::shared_ptr<Data> Data::warped(const SceneWarp& warp, std::uint32_t time_step) {
    if (!m_warped || m_warped->warp != warp || m_warped->time_step != time_step) {
        if (std::ranges::any_of(volume.fields(), &FieldInfo::is_by_place)) {
            throw Error(volume.path(), "has fields of another volume that are found by place: it cannot be displaced (warp)");
        }
        if (!source) {
            throw Error(volume.path(), "only native volumes, and what is converted to them, can be displaced (warp)");
        }
        m_warped.reset();
        auto watch = std::make_unique<TaskControl>();
        watch->wants_to_stop = control->wants_to_stop;
        const auto open = [numbers = source(), warp, time_step, name = volume.path(), held = source, with = watch.get()] {
            return open_warped(numbers, warp, time_step, name, with);
        };
        RuntimeVolume displaced = open();
        watch->wants_to_stop = {};
        auto data = std::make_shared<Data>(context, std::move(watch), std::move(displaced));
        data->reopen = open;
        m_warped = {warp, time_step, std::move(data)};
    }
    return m_warped->data;
}

void Data::forget_fields(std::optional<std::uint32_t> only) {
    m_warped.reset();
    streamlines.forget();
    arrow_sets.forget();
    extrema.forget_fields();
    m_on_demand.reset();
    if (m_renderer) {
        m_renderer->forget_fields(only);
    }
    for (const auto& other : m_others) {
        other->renderer->forget_fields(only);
    }
}

const std::array<double, 6>& Data::bounds() {
    if (!m_bounds) {
        m_bounds = bounds_of(volume).first;
    }
    return *m_bounds;
}

namespace {

std::int64_t number_of(const RuntimeVolume& volume, std::uint64_t element) {
    std::int64_t number = 0;
    volume.element_numbers(element, 1, std::span(&number, 1));
    return number;
}

Vector3 position_of(const RuntimeVolume& volume, const FieldExtremum& at) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    Vector3 position{nan, nan, nan};
    if (volume.has_evaluation()) {
        volume.evaluate_mapping(at.element, at.xi, position, {});
    }
    return position;
}

elvis_range range_of(const RuntimeVolume& volume, const FieldExtrema& found) {
    elvis_range range{};
    range.certainty = found.certainty;
    range.minimum = found.minimum.value;
    range.maximum = found.maximum.value;
    range.lower_bound = found.minimum.bound;
    range.upper_bound = found.maximum.bound;
    range.minimum_element = number_of(volume, found.minimum.element);
    range.maximum_element = number_of(volume, found.maximum.element);
    std::ranges::copy(found.minimum.xi, range.minimum_xi);
    std::ranges::copy(found.maximum.xi, range.maximum_xi);
    std::ranges::copy(position_of(volume, found.minimum), range.minimum_position);
    std::ranges::copy(position_of(volume, found.maximum), range.maximum_position);
    return range;
}

/** Infinite bounds where an expression has a pole. */
void tell_poles(const RuntimeVolume& volume, const FieldChoice& field, std::uint32_t time_step, FieldExtrema& extrema) {
    if (!field.expression || is_by_place(field, volume) || !volume.has_evaluation()) {
        return;
    }
    for (auto [extremum, limit] : {std::pair{&extrema.minimum, -infinity}, {&extrema.maximum, infinity}}) {
        if (std::isfinite(extremum->value) &&
            is_near_pole(*field.expression, volume, time_step, extremum->element, extremum->xi)) {
            extremum->bound = limit;
        }
    }
}

} // namespace

std::shared_ptr<Data> open_data(const std::shared_ptr<Context>& context, const std::vector<std::string>& paths,
                                const std::string& plugin, const std::string& options, const elvis_task* task) {
    auto control = std::make_unique<TaskControl>();
    follow(*control, task);
    control->check();
    const VolumeFile file = find_volume(*context->plugins, paths, plugin, options, *control);
    const auto open = [file, watch = control.get()] { return file.open(watch); };
    RuntimeVolume volume = open();
    follow(*control, nullptr);
    auto state = std::make_shared<Data>(context, std::move(control), std::move(volume));
    state->reopen = open;
    if (file.plugin->id() == native_plugin_id) {
        state->source = [file] { return native_source(file.path); };
    }
    return state;
}

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_open(elvis_context* context, elvis_string path, elvis_string plugin, elvis_string options,
                             const elvis_task* task, elvis_data** data) {
    return call(context, [&] {
        need(data, "data");
        *data = nullptr;
        need(path, "path");
        *data = new elvis_data{open_data(context->state, {path}, text_or_empty(plugin), text_or_empty(options), task)};
    });
}

elvis_result elvis_data_open_files(elvis_context* context, const elvis_string* paths, uint32_t n_paths, elvis_string plugin,
                                   elvis_string options, const elvis_task* task, elvis_data** data) {
    return call(context, [&] {
        need(data, "data");
        *data = nullptr;
        const std::vector<std::string> files = texts(paths, n_paths, "paths");
        if (files.empty()) {
            throw InvalidArgument("paths", "there are none");
        }
        *data = new elvis_data{open_data(context->state, files, text_or_empty(plugin), text_or_empty(options), task)};
    });
}

elvis_result elvis_scene_open_volume(const elvis_scene* scene, const elvis_task* task, elvis_data** data) {
    return call(scene, [&] {
        need(data, "data");
        *data = nullptr;
        const Scene& said = scene->state.scene;
        if (said.volume.empty()) {
            throw InvalidArgument("volume", "the scene names none");
        }
        std::vector<std::string> files{said.volume};
        files.insert(files.end(), said.more_files.begin(), said.more_files.end());
        std::shared_ptr<Data> opened = open_data(scene->state.context, files, said.plugin, said.plugin_options, task);
        std::vector<JoinedData> others;
        for (const SceneJoin& join : said.joined) {
            std::vector<std::string> theirs{join.path};
            theirs.insert(theirs.end(), join.more_files.begin(), join.more_files.end());
            others.push_back(
                {join.name,
                 join.path.empty() ? opened : open_data(scene->state.context, theirs, join.plugin, join.plugin_options, task),
                 join.time_step});
        }
        *data = new elvis_data{others.empty() ? std::move(opened) : join_data(opened, others, task)};
    });
}

elvis_result elvis_data_from_runtime(elvis_context* context, const elvis_runtime* runtime, elvis_volume* volume,
                                     elvis_string name, elvis_data** data) {
    return call(context, [&] {
        need(data, "data");
        *data = nullptr;
        const elvis_runtime table = known_part(runtime, "runtime");
        const std::string called = name != nullptr ? name : "volume";
        RuntimeVolume opened(Plugin::of_program(table, called), volume, called);
        *data = new elvis_data{std::make_shared<Data>(context->state, std::make_unique<TaskControl>(), std::move(opened))};
    });
}

elvis_result elvis_space_count_modes(elvis_context* context, elvis_shape shape, const elvis_space* space, uint64_t* n_modes) {
    return call(context, [&] {
        need(n_modes, "n_modes");
        elvis_space known = known_part(space, "space");
        known.nodes = nullptr;
        *n_modes = ToModes(known, shape, "space").n_modes();
    });
}

elvis_result elvis_data_from_arrays(elvis_context* context, const elvis_arrays* arrays, elvis_string name,
                                    const elvis_task* task, elvis_data** data) {
    return call(context, [&] {
        need(data, "data");
        *data = nullptr;
        const std::string called = name != nullptr ? name : "volume";
        auto control = std::make_unique<TaskControl>();
        follow(*control, task);
        auto own = std::make_unique<Arrays>(known_part(arrays, "arrays"), called, *control);
        RuntimeVolume opened = own->open(called, control.get());
        follow(*control, nullptr);
        auto state = std::make_shared<Data>(context->state, std::move(control), std::move(opened));
        state->source = [arrays = own.get()] { return arrays->copy(); };
        state->arrays = std::move(own);
        *data = new elvis_data{std::move(state)};
    });
}

elvis_result elvis_data_update_field(elvis_data* data, uint32_t field, uint32_t time_step, uint32_t element_class,
                                     const double* values) {
    return call(data, [&] {
        const DataTask task(*data->state, nullptr);
        if (!data->state->arrays) {
            throw InvalidArgument("data", "is not from arrays");
        }
        data->state->arrays->update(field, time_step, element_class, values);
        data->state->forget_fields(field);
    });
}

elvis_result elvis_data_fields_changed(elvis_data* data, uint32_t field) {
    return call(data, [&] {
        const DataTask task(*data->state, nullptr);
        const std::size_t n_fields = data->state->volume.fields().size();
        if (field != ELVIS_ALL_FIELDS && field >= n_fields) {
            throw InvalidArgument("field", "the volume has " + counted(n_fields, "field"));
        }
        data->state->forget_fields(field != ELVIS_ALL_FIELDS ? std::optional(field) : std::nullopt);
    });
}

elvis_result elvis_data_warp(elvis_data* data, const elvis_warp* warp, const elvis_task* task, elvis_data** warped) {
    return call(data, [&] {
        need(warped, "warped");
        *warped = nullptr;
        const elvis_warp known = known_part(warp, "warp");
        need(known.field, "field");
        SceneWarp wanted{known.field, {}, known.factor, known.phase};
        if (known.imaginary != nullptr) {
            wanted.imaginary = known.imaginary;
        }
        const DataTask running(*data->state, task);
        check_time_step(data->state->volume, known.time_step);
        *warped = new elvis_data{data->state->warped(wanted, known.time_step)};
    });
}

void elvis_data_release(elvis_data* data) { delete data; }

elvis_result elvis_data_get_info(elvis_data* data, elvis_data_info* info) {
    return call(data, [&] {
        const DataTask task(*data->state, nullptr);
        const RuntimeVolume& volume = data->state->volume;
        elvis_data_info ours{};
        ours.dimension = volume.dimension();
        ours.n_elements = volume.n_elements();
        ours.n_classes = static_cast<std::uint32_t>(volume.classes().size());
        ours.n_fields = static_cast<std::uint32_t>(volume.fields().size());
        ours.n_time_steps = static_cast<std::uint32_t>(volume.times().size());
        ours.n_boundary_groups = static_cast<std::uint32_t>(volume.boundary_groups().size());
        std::ranges::copy(data->state->bounds(), ours.bounds);
        give(ours, info, "info");
    });
}

elvis_result elvis_data_get_field(elvis_data* data, uint32_t field, elvis_field* out) {
    return call(data, [&] {
        const auto& fields = data->state->volume.fields();
        if (field >= fields.size()) {
            throw InvalidArgument("field", "the volume has " + counted(fields.size(), "field"));
        }
        const FieldInfo& info = fields[field];
        elvis_field ours{};
        ours.n_components = info.n_components;
        ours.name = info.name.c_str();
        ours.unit = info.unit.c_str();
        ours.continuity = info.continuity;
        ours.transform = info.transform;
        ours.max_jump = info.max_jump;
        give(ours, out, "out");
    });
}

elvis_result elvis_data_get_time(elvis_data* data, uint32_t time_step, double* time) {
    return call(data, [&] {
        need(time, "time");
        check_time_step(data->state->volume, time_step);
        *time = data->state->volume.times()[time_step];
    });
}

elvis_result elvis_data_describe(elvis_data* data, const elvis_describe_options* options, const elvis_task* task, char** text) {
    return call(data, [&] {
        need(text, "text");
        elvis_describe_options known{};
        if (options != nullptr) {
            known = known_part(options, "options");
        }
        const DataTask running(*data->state, task);
        check_time_step(data->state->volume, known.time_step);
        DescribeOptions how;
        how.time_step = known.time_step;
        how.is_brief = (known.flags & ELVIS_DESCRIBE_BRIEF) != 0;
        how.lists_all = (known.flags & ELVIS_DESCRIBE_ALL) != 0;
        how.with_outline = (known.flags & ELVIS_DESCRIBE_OUTLINE) != 0;
        if ((known.flags & ELVIS_DESCRIBE_JACOBIAN_TOLERANCE) != 0) {
            how.jacobian_tolerance = known.jacobian_tolerance;
        }
        *text = text_for_caller(describe_volume(data->state->volume, how, data->state->extrema).dump(2));
    });
}

elvis_result elvis_data_get_range(elvis_data* data, elvis_string field, uint32_t time_step, elvis_range* range) {
    return call(data, [&] {
        need(field, "field");
        const DataTask task(*data->state, nullptr);
        const RuntimeVolume& volume = data->state->volume;
        check_time_step(volume, time_step);
        const FieldChoice choice = choose_field(volume, std::string(field));
        FieldExtrema extrema = data->state->extrema_of(choice, time_step);
        tell_poles(volume, choice, time_step, extrema);
        give(range_of(volume, extrema), range, "range");
    });
}
