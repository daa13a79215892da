/**
 * @file shared_faces.hpp
 * Faces between the parts of a parallel mesh.
 */
#pragma once

#include "part.hpp"

#include <memory>
#include <vector>

namespace elvis_mfem {

/**
 * By part, of each boundary element whether another part has it, too: MFEM writes what parts share among the boundary of each,
 * though it is none of the whole. Faces are the same if their middles are.
 */
std::vector<std::vector<bool>> shared_faces(const std::vector<std::unique_ptr<const Part>>& parts);

} // namespace elvis_mfem
