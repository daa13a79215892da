/**
 * @file isosurface_study.hpp
 * The study of accuracy: isosurfaces of many random fields against the oracle's, by as many threads as the machine has cores.
 */
#pragma once

#include "isosurface_accuracy.hpp"
#include <core/oracle/isosurface/root_finders.hpp>

#include <functional>
#include <string>
#include <vector>

namespace elvis::oracle {

struct IsosurfaceStudyOptions {
    /** Of the first field, and how many. */
    std::uint64_t seed = 0, count = 1000;
    std::uint32_t size = 200;
    /** None: the oracle alone. */
    std::vector<Precision> precisions{Precision::float32, Precision::float64};
    IsosurfaceMethod method = IsosurfaceMethod::interval;
    /** The oracle's ways to find roots are compared on every so many rays; 0: not at all. */
    std::uint32_t finder_stride = 50;
    std::string device;
};

/** What must hold of a picture: nothing is wrong that does not say so but, in float32, at grazing rays. */
bool holds(const IsosurfaceComparison& comparison, Precision precision);

struct IsosurfaceStudy {
    std::uint64_t n_fields = 0;
    /** One a precision. */
    std::vector<IsosurfaceComparison> comparisons;
    std::uint64_t n_projected_pixels = 0, n_evaluations = 0;
    FinderComparison finders;
    std::uint64_t n_oracle_failures = 0;

    bool is_good(const std::vector<Precision>& precisions) const;
};

/** `report` gets a line for each field of which something does not hold, from one thread at a time. */
IsosurfaceStudy study_isosurfaces(const PluginRegistry& registry, const IsosurfaceStudyOptions& options,
                                  const std::function<void(const std::string&)>& report);

} // namespace elvis::oracle
