/*
 * The services that the host offers: log, progress, cancellation, and an error text for each thread.
 */
#include "fixtures.hpp"

#include <core/plugin_host/runtime_volume.hpp>

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <sstream>
#include <thread>

using namespace elvis;
using Catch::Matchers::Contains;
using test::error_of;
using test::fixture;

TEST_CASE("what a plugin logs appears under its id") {
    std::ostringstream lines;
    const auto before = spdlog::default_logger();
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(lines)));
    const RuntimeVolume volume(Plugin::load(fixture("good")), "a.cube");
    spdlog::set_default_logger(before);
    CHECK_THAT(lines.str(), Contains("warning") && Contains("org.elvis.test.good: a cube is opened"));
}

TEST_CASE("progress reaches whoever started the task") {
    TaskControl control;
    double reported = 0;
    std::string activity;
    control.on_progress = [&](double fraction, std::string_view what) {
        reported = fraction;
        activity = what;
    };
    const RuntimeVolume volume(Plugin::load(fixture("good")), "a.cube", {}, &control);
    CHECK(reported == 0.5);
    CHECK(activity == "opening");
}

TEST_CASE("a cancelled open ends with Cancelled") {
    TaskControl control;
    control.cancelled = true;
    CHECK_THROWS_AS(RuntimeVolume(Plugin::load(fixture("good")), "a.cube", {}, &control), Cancelled);
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
