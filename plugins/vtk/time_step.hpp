/**
 * @file time_step.hpp
 * Time steps that the user's files name, and the files of each. Collections (.pvd) and parallel files (.pvtu) are followed.
 */
#pragma once

#include "file/piece.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis_vtk {

struct TimeStep {
    /** As a collection or a VTKHDF file says. */
    std::optional<double> time;
    /** .vtu files, or one VTKHDF file. */
    std::vector<std::string> files;
    /** Which of the VTKHDF file's steps. */
    std::size_t index_in_file = 0;
    /** Steps of the same file and with the same numbers are known to have the same mesh. Empty if only a comparison tells. */
    std::vector<std::uint64_t> mesh_key;
};

/** In the order of their times within each path. */
std::vector<TimeStep> find_time_steps(const std::vector<std::string>& paths);

bool have_same_mesh(const TimeStep& a, const TimeStep& b);

/** Calls visit for every piece that has cells, with one file open at a time; gives TimeValue of the field data, if any. */
std::optional<double> visit_pieces(const TimeStep& step, const std::function<void(const Piece&)>& visit);

} // namespace elvis_vtk
