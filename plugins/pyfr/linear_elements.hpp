/**
 * @file linear_elements.hpp
 * Which elements of a mesh are linear.
 */
#pragma once

#include "mesh.hpp"

#include <elvis/plugin.hpp>

#include <vector>

namespace elvis_pyfr {

/**
 * For each element, from its nodes. The files' own flags are not used, because PyFR's importer sets them with a tolerance of
 * 1e-5. Positions that are not finite are an error.
 */
std::vector<bool> find_linear_elements(const Mesh& mesh, const elvis::api::Host& host);

} // namespace elvis_pyfr
