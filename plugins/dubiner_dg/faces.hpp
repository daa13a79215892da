/**
 * @file faces.hpp
 * Faces of the mesh, found from vertex numbers.
 */
#pragma once

#include "file.hpp"

#include <elvis/element.h>

#include <vector>

namespace elvis::dubiner {

/**
 * Every face once; elements by their position in the file. Throws api::Error where three elements share a face, or a boundary
 * face is none.
 * @param path  for messages
 */
std::vector<elvis_face> find_faces(const File& file, const std::string& path);

} // namespace elvis::dubiner
