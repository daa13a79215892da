#include "hang_report.hpp"

#include <core/plugin_host/current_call.hpp>

#include <spdlog/spdlog.h>

#include <map>
#include <thread>

namespace elvis {

namespace {

constexpr std::chrono::seconds first_silence{10};

/** Silence after which each call is named next, by its number. */
using Patience = std::map<std::uint64_t, std::chrono::milliseconds>;

void report(Patience& patience) {
    Patience still_silent;
    for (const current_call::SilentCall& call : current_call::silent_for(first_silence)) {
        const auto known = patience.find(call.number);
        auto next = known == patience.end() ? std::chrono::milliseconds(first_silence) : known->second;
        if (call.silence >= next) {
            spdlog::warn("the plugin {} has been in its function {} for {} s without a sign; it may be slow or hang",
                         call.plugin, call.function, std::chrono::duration_cast<std::chrono::seconds>(call.silence).count());
            next *= 10;
        }
        still_silent[call.number] = next;
    }
    patience = std::move(still_silent);
}

} // namespace

void report_hangs() {
    // It watches until the process ends.
    std::thread([] {
        Patience patience;
        for (;;) {
            std::this_thread::sleep_for(std::chrono::seconds(1));
            report(patience);
        }
    }).detach();
}

} // namespace elvis
