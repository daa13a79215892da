/**
 * @file call.hpp
 * Where calls of elvis.h begin and end: exceptions become results and texts, and log lines go to the context.
 */
#pragma once

#include "handles.hpp"

#include <core/base/error.hpp>
#include <core/plugin_host/table_copy.hpp>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

namespace elvis::library {

/** A mistake of the caller. */
class InvalidArgument : public Error {
public:
    using Error::Error;
};

/** Throws unless the caller gave something. `name` is the argument's. */
inline void need(const void* argument, const char* name) {
    if (argument == nullptr) {
        throw InvalidArgument(name, "is NULL");
    }
}

/** A list of texts that the caller gave. `name` is the argument's. */
inline std::vector<std::string> texts(const elvis_string* list, std::uint32_t n, const char* name) {
    std::vector<std::string> all;
    if (n > 0) {
        need(list, name);
    }
    for (std::uint32_t index = 0; index < n; ++index) {
        need(list[index], name);
        all.emplace_back(list[index]);
    }
    return all;
}

/** What failed last on this thread, of that context or, with null, of elvis_context_create. */
void set_error(const Context* context, std::string text);
const char* error_of(const Context* context);
/** The result that stands for what is being thrown; its text is set. */
elvis_result result_of_exception(const Context* context) noexcept;

/** Whose the caller's handle is; null for null. */
inline Context* context_of(const elvis_context* handle) { return handle != nullptr ? handle->state.get() : nullptr; }
inline Context* context_of(const elvis_data* handle) { return handle != nullptr ? handle->state->context.get() : nullptr; }
inline Context* context_of(const elvis_scene* handle) { return handle != nullptr ? handle->state.context.get() : nullptr; }
inline Context* context_of(const elvis_picture* handle) {
    return handle != nullptr ? handle->state.data->context.get() : nullptr;
}

inline Context* context_of(const elvis_lines* handle) { return handle != nullptr ? handle->state.context.get() : nullptr; }
inline Context* context_of(const elvis_animation* handle) {
    return handle != nullptr ? handle->state.data->context.get() : nullptr;
}

/** Does `what` for the context of the caller's handle. */
template <class Handle, class What> elvis_result call(const Handle* handle, What what) noexcept {
    Context* const context = context_of(handle);
    try {
        need(context, "handle");
        const HostScope scope(context->host);
        std::move(what)();
        return ELVIS_OK;
    } catch (...) {
        return result_of_exception(context);
    }
}

/** Throws unless the volume has it. */
void check_time_step(const RuntimeVolume& volume, std::uint32_t time_step);

/** A copy that the caller releases (elvis_text_release). */
char* text_for_caller(const std::string& text);

/** Text or "". */
inline std::string text_or_empty(elvis_string text) { return text != nullptr ? text : ""; }

/** A struct of the caller's: as much of it as both sides know, the rest zero. */
template <class Struct> Struct known_part(const Struct* theirs, const char* name) {
    need(theirs, name);
    if (theirs->struct_size < sizeof theirs->struct_size) {
        throw InvalidArgument(name, "its struct_size is not set");
    }
    return copy_known_part(*theirs);
}

/** Writes as much of a struct as the caller has room for. */
template <class Struct> void give(const Struct& ours, Struct* theirs, const char* name) {
    need(theirs, name);
    const std::size_t size = theirs->struct_size;
    if (size < sizeof theirs->struct_size) {
        throw InvalidArgument(name, "its struct_size is not set");
    }
    std::memcpy(theirs, &ours, std::min(size, sizeof ours));
    theirs->struct_size = static_cast<std::uint32_t>(size);
}

/** While it lives, data is this call's, and its control is watched and stopped as the caller's task says. */
class DataTask {
public:
    DataTask(Data& data, const elvis_task* task);
    ~DataTask();
    DataTask(const DataTask&) = delete;
    DataTask& operator=(const DataTask&) = delete;

private:
    std::lock_guard<std::mutex> m_lock;
    Data& m_data;
};

/** Lets a control be watched and stopped as a task says; null: neither. */
void follow(TaskControl& control, const elvis_task* task);

} // namespace elvis::library
