/*
 * The services that the host offers: log, progress, cancellation, and an error text for each thread.
 */
#include "fixtures.hpp"

#include <core/base/host.hpp>
#include <core/plugin_host/current_call.hpp>
#include <core/plugin_host/host_services.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <vector>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::fixture;

TEST_CASE("what a plugin logs appears under its id") {
    Host host;
    std::vector<std::string> warnings;
    host.log = [&](LogLevel level, std::string_view line) {
        if (level == LogLevel::warning) {
            warnings.emplace_back(line);
        }
    };
    const HostScope scope(host);
    const RuntimeVolume volume(Plugin::load(fixture("good")), "a.cube");
    CHECK(warnings == std::vector<std::string>{"org.elvis.test.good: a cube is opened"});
}

TEST_CASE("what a plugin logs on a thread of its own reaches the host that opened the volume") {
    Host host;
    std::vector<std::string> lines;
    host.log = [&](LogLevel, std::string_view line) { lines.emplace_back(line); };
    std::optional<HostServices> services;
    {
        const HostScope scope(host);
        services.emplace("org.elvis.test", nullptr);
    }
    std::thread([&] { services->table()->log(services->table(), ELVIS_LOG_ERROR, "alone"); }).join();
    CHECK(lines == std::vector<std::string>{"org.elvis.test: alone"});
}

TEST_CASE("progress reaches whoever started the task") {
    TaskControl control;
    double reported = 0;
    std::string activity;
    control.on_progress = [&](double fraction, std::string_view what) {
        reported = fraction;
        activity = what;
    };
    const RuntimeVolume volume(Plugin::load(fixture("good")), "a.cube", "", &control);
    CHECK(reported == 0.5);
    CHECK(activity == "opening");
}

TEST_CASE("a cancelled open ends with Cancelled") {
    TaskControl control;
    control.cancelled = true;
    CHECK_THROWS_AS(RuntimeVolume(Plugin::load(fixture("good")), "a.cube", "", &control), Cancelled);
}

TEST_CASE("each thread hears the error of its own call") {
    const RuntimeVolume volume(Plugin::load(fixture("troubled")), "a.cube");
    std::atomic<int> n_wrong = 0;
    const auto fail_often = [&](std::uint64_t record) {
        for (int i = 0; i < 2000; ++i) {
            elvis_fill_request request{};
            request.first = record;
            request.count = 1;
            double number = 0;
            try {
                volume.fill_buffer(request, &number);
                ++n_wrong;
            } catch (const Error& error) {
                n_wrong += error.cause().find("record " + std::to_string(record) + " is broken") == std::string::npos;
            }
        }
    };
    std::thread other(fail_often, 1);
    fail_often(2);
    other.join();
    CHECK(n_wrong == 0);
}

TEST_CASE("a call that gives no sign is named, as long as it lasts") {
    using namespace std::chrono_literals;
    const auto silence = [] {
        const auto silent = current_call::silent_for(0ms);
        REQUIRE(silent.size() == 1);
        CHECK(silent[0].plugin == "org.elvis.test.slow");
        CHECK(silent[0].function == "open");
        return silent[0].silence;
    };
    current_call::begin("org.elvis.test.slow", "open");
    std::this_thread::sleep_for(300ms);
    const auto before = silence();
    CHECK(before >= 300ms);
    std::thread([&] { CHECK(silence() >= before); }).join();
    current_call::give_sign();
    CHECK(silence() < before);
    CHECK(current_call::silent_for(1h).empty());
    current_call::end();
    CHECK(current_call::silent_for(0ms).empty());
}

TEST_CASE("the calls of a plugin's functions are under way while they last") {
    TaskControl control;
    std::vector<current_call::SilentCall> calls;
    control.on_progress = [&](double, std::string_view) { calls = current_call::silent_for(std::chrono::milliseconds(0)); };
    const RuntimeVolume volume(Plugin::load(fixture("good")), "a.cube", "", &control);
    REQUIRE(calls.size() == 1);
    CHECK(calls[0].plugin == "org.elvis.test.good");
    CHECK(calls[0].function == "open");
    CHECK(current_call::silent_for(std::chrono::milliseconds(0)).empty());
}
