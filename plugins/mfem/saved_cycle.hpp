/**
 * @file saved_cycle.hpp
 * Which files a time step consists of: those named by the user, or those that a VisItDataCollection's root file names, with all
 * parts.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis_mfem {

/** A field: a file a part. */
struct SavedField {
    std::string name;
    std::vector<std::string> paths;
};

struct SavedCycle {
    /** A file a part: several where a parallel program has written them. */
    std::vector<std::string> meshes;
    std::vector<SavedField> fields;
    double time = 0;
};

/** Whether a file is a root file (.mfem_root). */
bool is_root(const std::string& path);

/**
 * Time steps of root files, or one of a mesh and solutions. A name that ends with the number of a part, such as mesh.000000,
 * stands for all parts that lie beside it. Throws elvis::api::Error.
 */
std::vector<SavedCycle> find_cycles(const std::vector<std::string>& paths);

} // namespace elvis_mfem
