/**
 * @file partner_files.hpp
 * A volume is opened by one path; Nektar++ keeps mesh and fields in files of their own. README.md says which are taken.
 */
#pragma once

#include <string>
#include <vector>

namespace nektarpp {

/**
 * Mesh first, then fields: those that `options` names, else those beside `path` that a solver would have called so.
 * Throws elvis::api::Error if a mesh is missing, or options are wrong.
 */
std::vector<std::string> find_files(const std::string& path, const std::string& options);

} // namespace nektarpp
