/**
 * @file vtk_fixture.hpp
 * What the tests of VTK's files share.
 */
#pragma once

#include "fixture.hpp"

#include <string>
#include <vector>

using elvis::test::read_file;

/** Opens with the plugin under test. */
elvis::SourceVolume open_vtk(const std::vector<std::string>& paths);

/** A file of tests/data/vtk. */
std::string sample_file(const std::string& name);

/** What opening a file of that content says is wrong with it, or "no failure". */
std::string failure_of(const std::string& content, const std::string& name = "wrong.vtu");

/** One line of a reference that VTK wrote (make_reference.py). */
struct VtkReference {
    std::uint64_t cell = 0;
    int type = 0;
    std::array<double, 3> parametric{};
    std::array<double, 3> position{};
    /** u, then v. */
    std::array<double, 4> values{};
};

std::vector<VtkReference> read_reference(const std::string& name);

/** Largest differences. */
struct Difference {
    double position = 0;
    double value = 0;
};

/** How far the source, and where it is asked for the converted volume, are from what VTK said. */
Difference source_difference(const elvis::SourceVolume& source, const std::vector<VtkReference>& references);
Difference converted_difference(const elvis::SourceVolume& source, const ConvertedVolume& volume,
                                const std::vector<VtkReference>& references);
