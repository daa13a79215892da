#include "files/sample_files.hpp"
#include "sample_points.hpp"

#include <apps/elvis/commands.hpp>
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/number_list.hpp>
#include <apps/elvis/open_volume.hpp>
#include <apps/elvis/render/output_endings.hpp>
#include <apps/elvis/volume_arguments.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {
namespace {

struct SampleArguments {
    VolumeArguments volume;
    std::vector<std::string> line;
    std::string polyline, points, grid, box, plane, size, output, device;
    std::size_t count = 1000;
    SampleWishes wishes;
};

/** min x y z, max x y z. */
std::array<double, 6> box_of(const data& volume, const SampleArguments& arguments) {
    std::array<double, 6> box{};
    if (arguments.box.empty()) {
        std::ranges::copy(volume.info().bounds, box.begin());
    } else {
        std::ranges::copy(numbers("--box", arguments.box, 6, 6), box.begin());
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(box[axis] <= box[3 + axis])) {
            throw UsageError("--box", "is x0,y0,z0,x1,y1,z1 with the smaller coordinates first");
        }
    }
    return box;
}

SamplePoints along_line(std::vector<std::array<double, 3>> corners, const char* option, std::size_t count) {
    if (corners.size() < 2 || std::ranges::adjacent_find(corners, std::not_equal_to()) == corners.end()) {
        throw UsageError(option, "needs two points that differ");
    }
    return points_along(std::move(corners), count);
}

SamplePoints points_of(const data& volume, const SampleArguments& arguments) {
    if (!arguments.line.empty()) {
        return along_line({point("--line", arguments.line[0]), point("--line", arguments.line[1])}, "--line", arguments.count);
    }
    if (!arguments.polyline.empty()) {
        return along_line(read_points(arguments.polyline), "--polyline", arguments.count);
    }
    if (!arguments.points.empty()) {
        SamplePoints points;
        for (const auto& point : read_points(arguments.points)) {
            points.positions.insert(points.positions.end(), point.begin(), point.end());
        }
        return points;
    }
    if (!arguments.grid.empty()) {
        const std::size_t n_numbers = std::ranges::count(arguments.grid, 'x') == 1 ? 2 : 3;
        const std::vector<std::size_t> n = grid_size("--grid", arguments.grid, n_numbers);
        return grid_in(box_of(volume, arguments), {n[0], n[1], n_numbers == 2 ? 1 : n[2]});
    }
    const std::vector<double> plane = numbers("--cut-plane", arguments.plane, 4, 4);
    if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0) {
        throw UsageError("--cut-plane", "'" + arguments.plane + "' has a normal of length zero");
    }
    const std::vector<std::size_t> n = grid_size("--size", arguments.size, 2);
    return grid_on_plane({plane[0], plane[1], plane[2], plane[3]}, box_of(volume, arguments), n[0], n[1]);
}

void need_one_kind(const SampleArguments& arguments) {
    const int n_kinds = int{!arguments.line.empty()} + int{!arguments.polyline.empty()} + int{!arguments.points.empty()} +
                        int{!arguments.grid.empty()} + int{!arguments.plane.empty()};
    if (n_kinds != 1) {
        throw UsageError("elvis sample", "takes one of --line, --polyline, --points, --grid and --cut-plane");
    }
}

/** What a file of that kind cannot hold is said before anything is computed. */
void need_fitting_ending(const SampleArguments& arguments) {
    need_ending("--output", arguments.output, {".csv", ".npz", ".h5", ".vti", ".svg"});
    if (arguments.output.ends_with(".svg") && arguments.line.empty() && arguments.polyline.empty()) {
        throw UsageError("--output", "'" + arguments.output + "': plots are of --line and --polyline");
    }
    if (arguments.output.ends_with(".vti") && arguments.grid.empty()) {
        throw UsageError("--output", "'" + arguments.output + "': images are of --grid");
    }
}

void run_sample(const SampleArguments& arguments) {
    need_one_kind(arguments);
    need_fitting_ending(arguments);
    const context library = library_context(arguments.device);
    const data volume = open_volume(library, arguments.volume, arguments.wishes.time_step);
    TaskControl control;
    SampleTable table;
    {
        const ProgressBar progress(control);
        const InterruptGuard guard(control);
        table = sample(volume, points_of(volume, arguments), arguments.wishes,
                       {[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                        [&] { return control.is_cancelled(); }});
    }
    write_samples(table, arguments.output);
    std::printf("%s written to %s; %zu in no element", counted(table.points.size(), "point").c_str(), arguments.output.c_str(),
                table.n_outside());
    if (!table.points.corners.empty()) {
        std::printf("; elements begin or end at %s", counted(table.breaks.size(), "place").c_str());
    }
    std::printf("\n");
    if (!table.no_breaks_because.empty()) {
        std::fprintf(stderr, "warning: where elements begin and end is not told: %s\n", table.no_breaks_because.c_str());
    }
}

} // namespace

void add_sample(CLI::App& app) {
    auto arguments = std::make_shared<SampleArguments>();
    CLI::App* command =
        app.add_subcommand("sample", "Write fields along lines, at points, on planes and grids, in double precision");
    add_volume_arguments(*command, arguments->volume);
    command->add_option("--line", arguments->line, "From x,y,z to x,y,z")->expected(2);
    command->add_option("--polyline", arguments->polyline,
                        "Through the points of a file: three numbers a line; # starts a comment");
    command->add_option("--count", arguments->count, "Points on lines and polylines, evenly spaced")
        ->check(CLI::Range(2, 100'000'000))
        ->capture_default_str();
    command->add_option("--points", arguments->points, "At the points of a file");
    command->add_option("--grid", arguments->grid, "On NxMxK points of the volume's bounds; NxM: in the middle of their depth");
    command->add_option("--box", arguments->box, "x0,y0,z0,x1,y1,z1 in place of the volume's bounds");
    command->add_option("--cut-plane", arguments->plane, "On the plane a,b,c,d: ax+by+cz+d=0, within the bounds");
    command->add_option("--size", arguments->size, "NxM points on the plane; default: 512x512");
    command->add_option("--field", arguments->wishes.fields, "Field or expression (repeatable); default: all fields")
        ->allow_extra_args(false);
    command->add_flag("--gradients", arguments->wishes.with_gradients, "World gradients, too");
    command->add_option("--time-step", arguments->wishes.time_step, "Time step, counted from 0");
    command->add_option("--device", arguments->device, "Device for plugins that do not evaluate on the CPU: name or index");
    command
        ->add_option("-o,--output", arguments->output, "File to write: .csv, .npz, .h5, of grids .vti, of lines a plot, .svg")
        ->required();
    command->callback([arguments] {
        arguments->size = arguments->size.empty() ? "512x512" : arguments->size;
        run_sample(*arguments);
    });
}

} // namespace elvis::commands
