/**
 * @file volume_convergence.hpp
 * The measurements of B. Nelson's dissertation (Utah, 2012), chapter 6: how fast the integrators' errors fall with samples,
 * what time they take, and which of them comes to an error of 0.001 first.
 */
#pragma once

#include <core/bench/volume/convergence_scene.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

struct VolumeConvergenceOptions {
    /** Side of pictures of which errors are measured, and of those of which times are. */
    std::uint32_t size = 32;
    std::uint32_t time_size = 128;
    std::vector<std::uint32_t> orders{2, 4, 6, 8};
    std::uint32_t elements_a_side = 8;
    /** A native volume for what Nelson shows of the canister; none if empty. */
    std::string volume;
};

/** A point of a curve in a figure, by Nelson's number. */
struct ConvergenceRow {
    std::string figure, scene, curve;
    /** Intervals of a rule; or else one of step (world length) and tolerance. */
    double step = 0, tolerance = 0;
    std::uint32_t order = 0, size = 0;
    /** Evaluations of the field, of pixels whose rays meet the volume. */
    double samples_a_pixel = 0;
    double milliseconds = 0, units = 0;
    /** Largest of a channel. */
    double error = 0;
    /** Of pixels, those that say that they are inexact. */
    double inexact_share = 0;
};

/** The power of the step by which the error falls, over the finer half of a curve. */
struct ConvergenceOrder {
    std::string figure, scene, curve;
    double order = 0;
};

/** What it takes to have no channel off by more than 0.001. */
struct ComparisonRow {
    std::string scene, transfer, curve;
    /** The largest step found, 0 for what has none; the tolerance of what has that instead, else 0. */
    double step = 0, tolerance = 0;
    double error = 0;
    /** No step was short enough. */
    bool is_missed = false;
    double samples_a_pixel = 0, milliseconds = 0, units = 0, inexact_share = 0;
    /** Of the better of trapezoid and categories, over these. */
    double fewer_samples = 0, less_time = 0;
};

struct VolumeConvergence {
    std::vector<ConvergenceRow> rows;
    std::vector<ConvergenceOrder> orders;
    std::vector<ComparisonRow> comparison;
};

struct VolumeConvergenceReport {
    std::function<void(const ConvergenceRow&)> row;
    std::function<void(const ConvergenceOrder&)> order;
    std::function<void(const ComparisonRow&)> comparison;
};

/** Takes minutes. */
VolumeConvergence bench_volume_convergence(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                           const VolumeConvergenceOptions& options, double unit_nanoseconds,
                                           const VolumeConvergenceReport& report);

/** volume-convergence.csv, volume-comparison.csv and the plots, in a folder that is made if it does not exist. */
void write_volume_convergence(const std::filesystem::path& folder, const VolumeConvergence& result);

} // namespace elvis
