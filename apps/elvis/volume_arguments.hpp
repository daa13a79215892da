/**
 * @file volume_arguments.hpp
 * Which volume a command is about: its files, what is joined to it, how it is displaced.
 */
#pragma once

#include <CLI/CLI.hpp>
#include <elvis/elvis.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

/** --warp and the options that go with it. */
struct WarpArguments {
    /** The displacement; empty: there is none. */
    std::string field;
    double factor = 1;
    std::string imaginary;
    /** Degrees. */
    double phase = 0;
};

struct VolumeArguments {
    /** Geometry first. */
    std::vector<std::string> files;
    /** Its id, or empty. */
    std::string plugin;
    /** --join, as given. */
    std::vector<std::string> joins;
    WarpArguments warp;
};

/** NAME=FILE, NAME=FILE@STEP or, of the same file, NAME=@STEP. */
struct JoinArgument {
    std::string name;
    /** Empty: the same. */
    std::string file;
    std::optional<std::uint32_t> time_step;
};

/** Throws UsageError. */
JoinArgument parse_join(const std::string& text);

void add_warp(CLI::App& command, WarpArguments& arguments);
void add_join(CLI::App& command, std::vector<std::string>& joins);
/** The files, --plugin, --join, and those of --warp. */
void add_volume_arguments(CLI::App& command, VolumeArguments& arguments);

/** Joined, and displaced by the fields of that time step. Shows progress, and an interrupt stops it. */
data open_volume(const context& library, const VolumeArguments& arguments, std::uint32_t time_step);

} // namespace elvis::commands
