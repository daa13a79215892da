/**
 * @file warp_option.hpp
 * The options --warp and those that go with it.
 */
#pragma once

#include <CLI/CLI.hpp>
#include <elvis/elvis.hpp>

#include <cstdint>
#include <string>

namespace elvis::commands {

struct WarpArguments {
    /** The displacement; empty: there is none. */
    std::string field;
    double factor = 1;
    std::string imaginary;
    /** Degrees. */
    double phase = 0;
};

void add_warp(CLI::App& command, WarpArguments& arguments);

/** Displaced by the fields of that time step, or as it is. */
data warped(data volume, const WarpArguments& arguments, std::uint32_t time_step);

} // namespace elvis::commands
