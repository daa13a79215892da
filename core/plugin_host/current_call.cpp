#include <core/plugin_host/current_call.hpp>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>

namespace elvis::current_call {

namespace {

using Clock = std::chrono::steady_clock;

struct Call;

/** The calls of all threads, whether one is under way or not. */
struct Threads {
    std::mutex mutex;
    std::set<Call*> calls;
    std::atomic<std::uint64_t> n_calls = 0;
};

Threads& threads() {
    // Threads may end after static objects are gone.
    static auto* const all = new Threads;
    return *all;
}

/** Of one thread, which alone writes it. */
struct Call {
    /** Guards what other threads read. Never held for long. */
    std::mutex mutex;
    const char* plugin = nullptr;
    const char* function = nullptr;
    Clock::time_point last_sign;
    std::uint64_t number = 0;

    Call() {
        const std::lock_guard lock(threads().mutex);
        threads().calls.insert(this);
    }
    ~Call() {
        const std::lock_guard lock(threads().mutex);
        threads().calls.erase(this);
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    void set(const char* new_plugin, const char* new_function) {
        const std::lock_guard lock(mutex);
        plugin = new_plugin;
        function = new_function;
        last_sign = Clock::now();
        number = ++threads().n_calls;
    }
};

thread_local Call call;

/** The same for signal handlers, in which `call` must not be made. */
struct Names {
    const char* plugin;
    const char* function;
};

thread_local Names names{nullptr, nullptr};

} // namespace

void begin(const char* plugin, const char* function) {
    names = {plugin, function};
    call.set(plugin, function);
}

void give_sign() {
    const std::lock_guard lock(call.mutex);
    call.last_sign = Clock::now();
}

void end() {
    names = {nullptr, nullptr};
    call.set(nullptr, nullptr);
}

const char* plugin() { return names.plugin; }
const char* function() { return names.function; }

std::vector<SilentCall> silent_for(std::chrono::milliseconds silence) {
    std::vector<SilentCall> silent;
    const std::lock_guard lock(threads().mutex);
    for (Call* each : threads().calls) {
        const std::lock_guard call_lock(each->mutex);
        const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - each->last_sign);
        if (each->plugin != nullptr && since >= silence) {
            silent.push_back({each->plugin, each->function, since, each->number});
        }
    }
    return silent;
}

} // namespace elvis::current_call
