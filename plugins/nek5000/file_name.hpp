/**
 * @file file_name.hpp
 * What names of files tell: parts, time steps, the session.
 */
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis_nek5000 {

/** The same time step's other part: NAME0.f00001 and NAME1.f00001, A0/NAME0.f00001 and A1/NAME1.f00001; as many digits as
 * n_parts has. */
std::optional<std::string> part_path(const std::string& path, std::uint32_t own_part, std::uint32_t part,
                                     std::uint32_t n_parts);

/** Files of the same set (NAME0.f or NAME.fld) with lower numbers, the latest first. */
std::vector<std::string> earlier_steps(const std::string& path);

/** Whether the session's name ends in _reg: values at equidistant points. */
bool is_regular(const std::string& path, std::uint32_t n_parts);

/** Where the session's mesh (.re2) may lie; the name without a prefix of three letters comes second. */
std::vector<std::string> mesh_paths(const std::string& path, std::uint32_t n_parts);

} // namespace elvis_nek5000
