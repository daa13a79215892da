#include "call.hpp"

#include <core/located/located_fields.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/session/volume/joined.hpp>
#include <core/session/volume/warped.hpp>

#include <algorithm>
#include <functional>
#include <utility>

namespace elvis::library {

namespace {

using Source = std::shared_ptr<const native::VolumeSource>;

/** What the numbers of data come from, as they are now; null of what is not native. */
Source source_of(Data& data) {
    const DataTask task(data, nullptr);
    return data.source ? data.source() : nullptr;
}

/** Opens the volume of data once more. `task` outlives it. */
RuntimeVolume opened(Data& data, const Source& source, const TaskControl* task) {
    if (source) {
        return serve_native(source, data.volume.path(), task);
    }
    if (!data.reopen) {
        refuse_joined(data.volume.path());
    }
    return data.reopen();
}

bool has_same_elements(const Source& own, const Source& other) {
    try {
        return own && other && (own == other || native::JoinedVolume::has_same_elements(*own, *other));
    } catch (const native::FileError& failure) {
        throw Error(failure.what());
    }
}

/** Joined volumes whose elements are the same, and those whose fields are found by place. */
struct Others {
    std::vector<native::Joined> same;
    std::vector<JoinedData> by_place;
};

Others sorted(const std::shared_ptr<Data>& data, const Source& own, const std::vector<JoinedData>& others) {
    Others result;
    for (const JoinedData& other : others) {
        const Source source = other.data == data ? own : source_of(*other.data);
        if (has_same_elements(own, source)) {
            result.same.push_back({other.name, source, other.time_step});
        } else {
            result.by_place.push_back(other);
        }
    }
    return result;
}

void check_names(const RuntimeVolume& volume, const std::vector<JoinedData>& others) {
    for (const JoinedData& other : others) {
        const auto has_name = [&](const JoinedData& one) { return one.name == other.name; };
        if (!native::JoinedVolume::is_name(other.name)) {
            throw Error(volume.path(),
                        "no fields can be joined: '" + other.name + "' is no name: letters, digits and _, no digit first");
        }
        if (std::ranges::count_if(others, has_name) > 1) {
            throw Error(volume.path(), "no fields can be joined: '" + other.name + "' is joined twice");
        }
    }
}

void need_by_place(const RuntimeVolume& volume) {
    if (!volume.has_evaluation() || volume.is_cut() || volume.fields().empty()) {
        throw Error(volume.path(), "the plugin " + volume.plugin().id() +
                                       " does not evaluate whole elements with fields on the CPU, in which the fields of other "
                                       "elements could be found by place");
    }
}

} // namespace

std::shared_ptr<Data> join_data(const std::shared_ptr<Data>& data, const std::vector<JoinedData>& others,
                                const elvis_task* task) {
    check_names(data->volume, others);
    Source own = source_of(*data);
    const Others sides = sorted(data, own, others);
    // Temporary files last as long as the data that hold them.
    std::vector<std::shared_ptr<Data>> held{data};
    std::ranges::transform(others, std::back_inserter(held), &JoinedData::data);
    auto watch = std::make_unique<TaskControl>();
    follow(*watch, task);
    watch->check();
    if (!sides.same.empty()) {
        own = joined_source(own, sides.same, data->volume.path());
    }
    const auto open = [own, held, by_place = sides.by_place, with = watch.get()] {
        RuntimeVolume volume = opened(*held.front(), own, with);
        for (const JoinedData& other : by_place) {
            need_by_place(volume);
            volume.add_by_place(std::make_shared<const LocatedFields>(
                other.name, opened(*other.data, source_of(*other.data), with), other.time_step, volume.times().size()));
        }
        return volume;
    };
    RuntimeVolume volume = open();
    follow(*watch, nullptr);
    auto state = std::make_shared<Data>(data->context, std::move(watch), std::move(volume));
    state->reopen = open;
    if (own && sides.by_place.empty()) {
        state->source = [own, held] { return own; };
    }
    return state;
}

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_data_join(elvis_data* data, const elvis_join* joins, uint32_t n_joins, const elvis_task* task,
                             elvis_data** joined) {
    return call(data, [&] {
        need(joined, "joined");
        *joined = nullptr;
        std::vector<JoinedData> others;
        if (n_joins > 0) {
            known_part(joins, "joins");
        }
        for (std::uint32_t i = 0; i < n_joins; ++i) {
            const elvis_join known = copy_entry(joins, i);
            need(known.name, "name");
            need(known.data, "data");
            others.push_back({known.name, known.data->state, std::nullopt});
            if (known.time_step != ELVIS_SAME_TIME_STEP) {
                others.back().time_step = known.time_step;
            }
        }
        *joined = new elvis_data{join_data(data->state, others, task)};
    });
}
