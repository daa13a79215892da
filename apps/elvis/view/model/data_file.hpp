/**
 * @file data_file.hpp
 * What a scene shows, as files of numbers: meshes of surfaces, lines, values along a line and on grids.
 */
#pragma once

#include "line_probe.hpp"
#include "numbers.hpp"

#include <elvis/elvis.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace elvis::view {

/** One thing that can be written. */
struct Writable {
    enum class Kind { mesh, lines, line_probe, grid };

    Kind kind = Kind::grid;
    /** Of a mesh which surface; of all else what is shown there: label, field, time step. */
    NumbersQuestion what{};
    /** Of lines: index among the scene's surfaces. */
    std::uint32_t surface = 0;
    LineProbe line{};

    friend bool operator==(const Writable&, const Writable&) = default;
};

/** Which values go along. */
enum class WrittenValues { none, shown, all };

/** A file that is wanted. */
struct DataFile {
    Writable what;
    std::string path;
    WrittenValues values = WrittenValues::shown;
    /** Of meshes: how far from the surface, as a share of the diagonal of the bounds. */
    double tolerance = 1e-3;
    /** Of meshes: if there are any, the lines on the surface where its field has these values. */
    std::vector<double> contours{};
    /** Of grids: points along x, y and z. */
    std::array<std::size_t, 3> n_points{};
};

/** Surfaces, streamlines and pathlines that are shown, the line probe, and grids over the volume. Never empty. */
std::vector<Writable> writables_of(const Scene& scene, const VolumeFacts& volume, const std::optional<LineProbe>& line);

/** Of names of such files, with their dots, the usual one first. */
const std::vector<const char*>& endings_of(Writable::Kind kind);
/** What cannot be written under that name, for people; empty if all can. */
std::string problem_of(const DataFile& file);
/** Some 64 points along the longest side of the bounds, as many as fit along the others. */
std::array<std::size_t, 3> usual_grid(const VolumeFacts& volume);

/** What became of it. */
struct WrittenReport {
    std::vector<std::string> facts, doubts;
};

/**
 * Of a volume as the scene displaces it, but for lines: they displace it themselves. `shown`: the scene. The file appears
 * whole or not at all.
 */
WrittenReport write_data_file(const context& library, const data& volume, const scene& shown, const DataFile& file,
                              const task& watch);

} // namespace elvis::view
