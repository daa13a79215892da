/**
 * @file direct_volume.hpp
 * The runtime interface of Nektar++ volumes.
 */
#pragma once

#include <elvis/apex_bounds.h>
#include <elvis/extrema.h>

namespace nektarpp {

const elvis_runtime* runtime_interface();
const elvis_extrema* extrema_interface();
const elvis_apex_bounds* apex_bounds_interface();

} // namespace nektarpp
