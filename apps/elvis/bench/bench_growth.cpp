#include "bench_suites.hpp"

#include <core/base/error.hpp>
#include <core/bench/goals.hpp>
#include <core/bench/growth.hpp>

namespace elvis::commands {

nlohmann::ordered_json run_growth(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    GrowthOptions options;
    options.elements_a_side = arguments.names_elements ? arguments.elements : options.elements_a_side;
    options.orders = arguments.names_orders ? arguments.orders : options.orders;
    options.size = arguments.names_sizes ? arguments.sizes.front() : options.size;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_growth(bench.device, bench.registry, bench.folder, options, [&](const GrowthRow& row) {
        list.push_back({{"picture", row.picture},
                        {"n_elements", row.n_elements},
                        {"order", row.order},
                        {"milliseconds", row.milliseconds},
                        {"wall_milliseconds", row.wall_milliseconds},
                        {"hit_pixels", row.hit_pixels},
                        {"nanoseconds_a_pixel", row.nanoseconds_a_pixel},
                        {"evaluations_a_pixel", row.evaluations_a_pixel},
                        {"newton_steps_a_pixel", row.newton_steps_a_pixel},
                        {"first_milliseconds", row.first_milliseconds},
                        {"n_coefficients", row.n_coefficients},
                        {"device_bytes", row.device_bytes},
                        {"host_bytes", row.host_bytes},
                        {"device_bytes_a_coefficient", row.device_bytes_a_coefficient()},
                        {"host_bytes_a_coefficient", row.host_bytes_a_coefficient()}});
        say(arguments,
            "%-10s p%u %8llu elements  %6.0f ns a pixel: %5.2f values, %5.2f steps  %8.1f ms  first %8.0f ms  bytes a "
            "coefficient: device %5.1f, host %5.1f\n",
            row.picture.c_str(), row.order, static_cast<unsigned long long>(row.n_elements), row.nanoseconds_a_pixel,
            row.evaluations_a_pixel, row.newton_steps_a_pixel, row.milliseconds, row.first_milliseconds,
            row.device_bytes_a_coefficient(), row.host_bytes_a_coefficient());
    });
    return list;
}

nlohmann::ordered_json run_goals(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    if (arguments.volume.empty()) {
        throw Error("elvis bench goals",
                    "it draws the canister: convert tests/data/elvis/bulletH1P2.dat, and name what you get with --volume FILE");
    }
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const std::uint32_t width = arguments.names_sizes ? arguments.sizes.front() : 0;
    bench_goals(bench.device, bench.registry, arguments.volume, width, [&](const GoalRow& row) {
        // A device without a clock: what the host sees, which is longer.
        const double milliseconds = row.device_milliseconds.value_or(row.wall_milliseconds);
        const bool is_met = milliseconds <= row.goal_milliseconds;
        list.push_back({{"name", row.name},
                        {"width", row.width},
                        {"height", row.height},
                        {"covered_pixels", row.covered_pixels},
                        {"device_milliseconds", nullptr},
                        {"wall_milliseconds", row.wall_milliseconds},
                        {"goal_milliseconds", row.goal_milliseconds},
                        {"is_met", is_met},
                        {"parts", row.parts}});
        if (row.device_milliseconds) {
            list.back()["device_milliseconds"] = *row.device_milliseconds;
        }
        say(arguments, "%-10s %4ux%-4u  %8.3f ms  wall %8.3f ms  goal %6.2f ms: %s\n", row.name.c_str(), row.width, row.height,
            milliseconds, row.wall_milliseconds, row.goal_milliseconds, is_met ? "met" : "not met");
        for (const auto& [name, part] : row.parts) {
            say(arguments, "    %8.3f ms  %s\n", part, name.c_str());
        }
    });
    return list;
}

} // namespace elvis::commands
