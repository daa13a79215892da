#include "call.hpp"

#include <core/base/counted.hpp>
#include <core/vulkan/memory/memory_limit.hpp>

#include <cstdlib>

namespace elvis::library {

namespace {

struct LastError {
    const Context* context = nullptr;
    std::string text;
};
thread_local LastError last_error;

} // namespace

void set_error(const Context* context, std::string text) { last_error = {context, std::move(text)}; }

const char* error_of(const Context* context) { return last_error.context == context ? last_error.text.c_str() : ""; }

elvis_result result_of_exception(const Context* context) noexcept {
    const auto fail = [context](elvis_result result, const char* text) {
        try {
            set_error(context, text);
        } catch (...) {
            last_error.text.clear(); // There is no memory for the text.
        }
        return result;
    };
    try {
        throw;
    } catch (const Cancelled& error) {
        return fail(ELVIS_ERROR_CANCELLED, error.what());
    } catch (const InvalidArgument& error) {
        return fail(ELVIS_ERROR_INVALID_ARGUMENT, error.what());
    } catch (const UsageError& error) {
        return fail(ELVIS_ERROR_INVALID_ARGUMENT, error.what());
    } catch (const OutOfMemory& error) {
        return fail(ELVIS_ERROR_OUT_OF_MEMORY, error.what());
    } catch (const std::bad_alloc&) {
        return fail(ELVIS_ERROR_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return fail(ELVIS_ERROR_FAILED, error.what());
    } catch (...) {
        return fail(ELVIS_ERROR_FAILED, "a callback threw something");
    }
}

void check_time_step(const RuntimeVolume& volume, std::uint32_t time_step) {
    if (time_step >= volume.times().size()) {
        throw InvalidArgument(volume.path(), "has " + counted(volume.times().size(), "time step") + ", counted from 0");
    }
}

char* text_for_caller(const std::string& text) {
    auto* copy = static_cast<char*>(std::malloc(text.size() + 1));
    if (copy == nullptr) {
        throw std::bad_alloc();
    }
    std::memcpy(copy, text.c_str(), text.size() + 1);
    return copy;
}

void follow(TaskControl& control, const elvis_task* task) {
    control.wants_to_stop = {};
    control.on_progress = {};
    if (task == nullptr) {
        return;
    }
    const elvis_task known = known_part(task, "task");
    if (known.is_cancelled != nullptr) {
        control.wants_to_stop = [known] { return known.is_cancelled(known.user) != 0; };
    }
    if (known.progress != nullptr) {
        // A mutex is not copied with the function: all copies report through one.
        control.on_progress = [known, mutex = std::make_shared<std::mutex>()](double fraction, std::string_view activity) {
            const std::lock_guard lock(*mutex);
            known.progress(known.user, fraction, std::string(activity).c_str());
        };
    }
}

DataTask::DataTask(Data& data, const elvis_task* task) : m_lock(data.mutex), m_data(data) {
    follow(*m_data.control, task);
    m_data.control->check();
}

DataTask::~DataTask() {
    m_data.control->wants_to_stop = {};
    m_data.control->on_progress = {};
}

} // namespace elvis::library

void elvis_text_release(char* text) { std::free(text); }
