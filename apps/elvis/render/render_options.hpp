/**
 * @file render_options.hpp
 * What `elvis render` is told, and what of it goes into the scene.
 */
#pragma once

#include <apps/elvis/volume_arguments.hpp>

#include <core/base/team.hpp>

#include <elvis/elvis.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

/** What `elvis render` is told on the command line. */
struct RenderArguments {
    /** As given; and the one that is drawn. */
    std::vector<std::string> inputs;
    std::string input;
    /** Further files of the same foreign data set. */
    std::vector<std::string> more_inputs;
    /** What is drawn is a scene file, not a volume. */
    bool is_scene = false;
    std::string output;
    std::vector<std::string> joins;
    WarpArguments warp;
    bool undeformed_edges = false;
    std::string time_steps;
    int phases = 0;
    int turntable = 0;
    std::string turntable_axis;
    std::string film;
    double frames_a_second = 0;
    bool resume = false;
    std::string field;
    std::string threshold;
    std::vector<std::string> cut_planes;
    std::vector<std::string> boundary_groups;
    bool boundary = false;
    std::vector<double> isovalues;
    /** The vector field. */
    std::string streamlines, pathlines;
    double ribbon_width = 0; ///< 0: tubes
    std::string arrows;
    double arrow_spacing = 0;
    std::string volume;
    std::string integrator;
    double volume_step = 0;
    double volume_tolerance = 0;
    std::string contours;
    bool has_contours = false;
    bool mesh_lines = false;
    std::string lic;
    std::string color_map;
    std::string range;
    bool log_scale = false;
    std::string eye, look_at, up;
    double field_of_view = 0;
    double orthographic = 0;
    std::string background;
    std::uint32_t samples = 0;
    std::string annotation;
    std::string lighting;
    std::string size;
    std::string precision;
    std::string device;
    /** "all", or a list. */
    std::string devices;
    std::string buffers;
    std::string stats;
    std::string share;
    int time_step = -1;
    int repeat = 0;
    int bits = 8;
    /** How many, or a file that says it of each element; empty: the volume is drawn as a whole. */
    std::string parts;
    /** Sizes: 2G, 800M. Empty: as much as there is. */
    std::string device_memory, host_memory;
    /** Who draws them; null: this process by itself. */
    DivisibleTeam* team = nullptr;
    bool validation = false;
    bool schema = false;
};

/** What the command line says goes before what the file says. */
void apply_options(const RenderArguments& arguments, scene& shown);

/** Parts of the volume, of --range 2%,98%: 0.02 and 0.98; nothing if it is not given in percent. */
std::optional<std::array<double, 2>> percentiles_of(const RenderArguments& arguments);

/** What passes share, by --share, of elvis_render_options.flags. */
elvis_render_flags sharing_of(const RenderArguments& arguments);

} // namespace elvis::commands
