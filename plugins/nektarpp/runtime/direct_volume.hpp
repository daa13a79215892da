/**
 * @file direct_volume.hpp
 * The runtime interface of Nektar++ volumes.
 */
#pragma once

#include <elvis/extrema.h>

namespace nektarpp {

const elvis_runtime* runtime_interface();
const elvis_extrema* extrema_interface();

} // namespace nektarpp
