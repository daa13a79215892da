/**
 * @file bench_suites.hpp
 * The suites of `elvis bench`. Each prints a line for every figure as it comes, unless the answer is JSON, and returns all of
 * them.
 */
#pragma once

#include <core/bench/bench.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

struct BenchArguments {
    std::string suite;
    std::string device;
    std::string data;
    std::vector<std::uint32_t> elements{16, 32};
    std::vector<std::uint32_t> orders{3, 6, 8};
    std::vector<std::uint32_t> sizes{512, 1024};
    /** Which of these the user has named, for the suites that have other defaults. */
    bool names_elements = false, names_orders = false, names_sizes = false;
    std::uint64_t n_jacobians = 1000000;
    std::uint64_t n_polynomials = 1000000;
    std::string output;
    std::string volume;
    /** Of the suite kernels; empty: all solids. */
    std::vector<std::string> shapes;
    std::optional<double> isovalue;
    std::vector<std::string> integrators{"exact"};
    /** Of the suite accuracy. */
    struct Accuracy {
        std::uint64_t count = 1000, seed = 0;
        std::uint32_t size = 200, finder_stride = 50;
        std::vector<Precision> precisions{Precision::float32, Precision::float64};
        std::string method = "interval";
    } accuracy;
    bool json = false;
};

/** As printf, at once; nothing if the answer is JSON. */
[[gnu::format(printf, 2, 3)]] void say(const BenchArguments& arguments, const char* format, ...);

/** What the suites that draw need. */
struct Bench {
    const BenchArguments& arguments;
    const Device& device;
    const PluginRegistry& registry;
    const BenchFolder& folder;
    /** Nanoseconds of U: core/bench/bench.hpp */
    double unit;
};

nlohmann::ordered_json run_hierarchy(const BenchArguments& arguments);
nlohmann::ordered_json run_jacobian(const BenchArguments& arguments);
nlohmann::ordered_json run_roots(const BenchArguments& arguments);
nlohmann::ordered_json run_kernels(const BenchArguments& arguments);
nlohmann::ordered_json run_segments(const Bench& bench);
nlohmann::ordered_json run_surface(const Bench& bench, BenchView view);
nlohmann::ordered_json run_surfaces(const Bench& bench);
nlohmann::ordered_json run_projection(const Bench& bench);
nlohmann::ordered_json run_interface(const Bench& bench);
nlohmann::ordered_json run_growth(const Bench& bench);
nlohmann::ordered_json run_goals(const Bench& bench);
nlohmann::ordered_json run_volume(const Bench& bench);
nlohmann::ordered_json run_combined(const Bench& bench);
nlohmann::ordered_json run_mfem(const Bench& bench);
nlohmann::ordered_json run_volume_convergence(const Bench& bench);

/** Throws an Error in a build without the oracle. `is_good`: whether all that is promised holds. */
nlohmann::ordered_json run_accuracy(const BenchArguments& arguments, bool& is_good);

} // namespace elvis::commands
