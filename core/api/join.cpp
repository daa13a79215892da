#include "call.hpp"

#include <core/session/volume/joined.hpp>
#include <core/session/volume/warped.hpp>

#include <utility>

namespace elvis::library {

namespace {

/** What the numbers of data come from, as they are now. */
std::shared_ptr<const native::VolumeSource> source_of(Data& data) {
    const DataTask task(data, nullptr);
    if (!data.source) {
        refuse_joined(data.volume.path());
    }
    return data.source();
}

} // namespace

std::shared_ptr<Data> join_data(const std::shared_ptr<Data>& data, const std::vector<JoinedData>& others,
                                const elvis_task* task) {
    const std::shared_ptr<const native::VolumeSource> own = source_of(*data);
    std::vector<native::Joined> joined;
    // Temporary files last as long as the data that hold them.
    std::vector<std::shared_ptr<Data>> held{data};
    for (const JoinedData& other : others) {
        joined.push_back({other.name, other.data == data ? own : source_of(*other.data), other.time_step});
        held.push_back(other.data);
    }
    auto watch = std::make_unique<TaskControl>();
    follow(*watch, task);
    watch->check();
    const auto source = joined_source(own, std::move(joined), data->volume.path());
    const auto open = [source, held, name = data->volume.path(), with = watch.get()] {
        return serve_native(source, name, with);
    };
    RuntimeVolume volume = open();
    follow(*watch, nullptr);
    auto state = std::make_shared<Data>(data->context, std::move(watch), std::move(volume));
    state->reopen = open;
    state->source = [source, held] { return source; };
    return state;
}

} // namespace elvis::library

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
