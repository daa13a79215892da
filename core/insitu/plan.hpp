/**
 * @file plan.hpp
 * What is made of a running solver, and when (insitu.md).
 */
#pragma once

#include "reductions.hpp"

#include <core/base/vector3.hpp>
#include <core/scene/scene.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace elvis::library {

struct PlannedPicture {
    Scene scene;
    bool with_buffers = false;
};

struct PlannedSamples {
    std::vector<Vector3> points;
    /** Fields and expressions. */
    std::vector<std::string> values;
};

struct PlannedNumbers {
    std::vector<Quantity> quantities;
};

struct PlannedOutput {
    std::string name;
    /** Without times: at steps that this divides. */
    std::uint64_t every = 1;
    /** Ascending. */
    std::vector<double> times;
    std::optional<Quantity> when;
    std::variant<PlannedPicture, PlannedSamples, PlannedNumbers> what;

    /** But for `when`. `after`: time of the step before; none at the first. */
    bool is_due(std::uint64_t step, double time, const std::optional<double>& after) const;
};

/** Reads a plan. Paths in it are seen from `folder`. Throws Error that names the place. */
std::vector<PlannedOutput> read_plan(const std::string& text, const std::string& folder, const RuntimeVolume& volume);

} // namespace elvis::library
