#include "commands.hpp"
#include "long_task.hpp"
#include <apps/elvis/render/output_endings.hpp>

#include <core/base/counted.hpp>
#include <core/export/vtu_export.hpp>
#include <core/session/volume/open_volume.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {

namespace {

struct ExportArguments {
    std::vector<std::string> files;
    std::string output;
    std::string plugin;
    std::uint32_t time_step = 0;
    int order = 0;
};

void run_export(const ExportArguments& arguments) {
    need_ending("--output", arguments.output, {".vtu"});
    const PluginRegistry registry;
    ExportOptions options;
    options.time_step = arguments.time_step;
    if (arguments.order > 0) {
        options.order = static_cast<std::uint32_t>(arguments.order);
    }
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    const VolumeFile file = find_volume(registry, arguments.files, arguments.plugin, {}, control);
    const RuntimeVolume volume = file.open(&control);
    const ExportReport report = export_vtu(volume, arguments.output, options, control);
    std::printf("%s of order up to %u with %s written to %s\n", counted(report.n_cells, "cell").c_str(), report.largest_order,
                counted(report.n_points, "point").c_str(), arguments.output.c_str());
}

} // namespace

void add_export(CLI::App& app) {
    auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command = app.add_subcommand("export", "Write a volume as VTK's Lagrange cells (.vtu), for ParaView and others");
    command->add_option("volume", arguments->files, "Volume, whatever its format (geometry first, then field files)")
        ->required();
    command->add_option("-o,--output", arguments->output, "File to write, .vtu")->required();
    command->add_option("--plugin", arguments->plugin, "Plugin by id; default: the one surest of the file");
    command->add_option("--time-step", arguments->time_step, "Time step, counted from 0");
    command
        ->add_option("--order", arguments->order,
                     "Order of the cells; default: the largest that the plugin gives for geometry and fields, which is exact "
                     "if it is no smaller than theirs")
        ->check(CLI::Range(1, 20));
    command->callback([arguments] { run_export(*arguments); });
}

} // namespace elvis::commands
