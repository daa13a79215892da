/**
 * @file saved_cycle.hpp
 * Which files a time step consists of: those named by the user, or those that a VisItDataCollection's root file names.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis_mfem {

struct SavedField {
    std::string name;
    std::string path;
};

struct SavedCycle {
    std::string mesh;
    std::vector<SavedField> fields;
    double time = 0;
};

/** Whether a file is a root file (.mfem_root). */
bool is_root(const std::string& path);

/** Time steps of root files, or one of a mesh and solutions. Throws elvis::api::Error. */
std::vector<SavedCycle> find_cycles(const std::vector<std::string>& paths);

} // namespace elvis_mfem
