#include "bench_suites.hpp"

#include <core/base/error.hpp>
#include <core/bench/kernel_limits.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace elvis::commands {

namespace {

using Value = std::optional<std::uint64_t>;

std::string text(const Value& value) { return value ? std::to_string(*value) : "-"; }

nlohmann::ordered_json json(const Value& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json to_json(const KernelRow& row) {
    const KernelStatistics& told = row.statistics;
    return {{"kernel", row.kernel},
            {"shape", row.shape},
            {"precision", name_of(row.precision)},
            {"share", row.share},
            {"is_hot", row.is_hot},
            {"registers", json(told.registers)},
            {"spills", json(told.spills)},
            {"scratch_bytes", json(told.scratch_bytes)},
            {"waves", json(told.waves)},
            {"code_bytes", json(told.code_bytes)},
            {"spirv_bytes", row.spirv_bytes},
            {"subgroup_size", told.subgroup_size},
            {"milliseconds", told.milliseconds}};
}

void print_row(const BenchArguments& arguments, const KernelRow& row) {
    const KernelStatistics& told = row.statistics;
    say(arguments, "%-32s %-12s %-8s %5.1f%% %s %9s %6s %8s %5s %9s %7llu %7.0f\n", row.kernel.c_str(), row.shape.c_str(),
        name_of(row.precision), 100 * row.share, row.is_hot ? "hot" : "   ", text(told.registers).c_str(),
        text(told.spills).c_str(), text(told.scratch_bytes).c_str(), text(told.waves).c_str(), text(told.code_bytes).c_str(),
        static_cast<unsigned long long>(row.spirv_bytes), told.milliseconds);
}

void print_summary(const BenchArguments& arguments, const std::vector<KernelRow>& rows) {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        const bool is_double = precision == Precision::float64;
        const std::uint64_t waves = is_double ? 4 : 8;
        std::size_t n_hot = 0, n_spilling = 0, n_large = 0, n_few = 0;
        for (const KernelRow& row : rows) {
            if (row.precision == precision && row.is_hot) {
                ++n_hot;
                n_spilling += row.statistics.spills.value_or(0) > 0 ? 1u : 0u;
                n_large += row.statistics.scratch_bytes.value_or(0) > 16384 ? 1u : 0u;
                n_few += row.statistics.waves.value_or(waves) < waves ? 1u : 0u;
            }
        }
        if (n_hot > 0) {
            say(arguments,
                "%s: of %zu hot kernels, %zu spill, %zu take more than 16 KiB of scratch memory a wave, %zu leave "
                "fewer than %llu waves\n",
                name_of(precision), n_hot, n_spilling, n_large, n_few, static_cast<unsigned long long>(waves));
        }
    }
}

void write_file(const std::string& folder, const KernelLimits& limits) {
    std::filesystem::create_directories(folder);
    const std::string path = (std::filesystem::path(folder) / "kernels.csv").string();
    std::ofstream file(path);
    write_limits(file, limits);
    file.close();
    if (!file) {
        throw Error(path, "cannot be written");
    }
}

} // namespace

nlohmann::ordered_json run_kernels(const BenchArguments& arguments) {
    const KernelInspector inspector(arguments.device);
    const PluginRegistry registry;
    const BenchFolder folder(arguments.data);
    KernelsOptions options;
    options.precisions = arguments.accuracy.precisions;
    if (!arguments.shapes.empty()) {
        options.shapes = arguments.shapes;
    }
    if (!arguments.volume.empty()) {
        options.volumes = {arguments.volume};
    }
    if (arguments.names_sizes) {
        options.size = arguments.sizes.front();
    }
    say(arguments, "%s, subgroups of %u\n", inspector.summary().name.c_str(), inspector.subgroup_size());
    if (!inspector.tells()) {
        say(arguments, "its driver does not tell what it made of kernels (VK_KHR_pipeline_executable_properties)\n");
    }
    say(arguments, "%-32s %-12s %-8s %6s %3s %9s %6s %8s %5s %9s %7s %7s\n", "kernel", "shape", "precision", "time", "",
        "registers", "spills", "scratch", "waves", "code", "spirv", "ms");
    std::vector<KernelRow> rows;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_kernels(inspector, registry, folder, options, [&](const KernelRow& row) {
        rows.push_back(row);
        list.push_back(to_json(row));
        print_row(arguments, row);
    });
    print_summary(arguments, rows);
    if (!arguments.output.empty()) {
        write_file(arguments.output, limits_of(rows, inspector.summary().driver));
    }
    return {{"device", inspector.summary().name}, {"rows", list}};
}

} // namespace elvis::commands
