/**
 * @file direct_volume.hpp
 * The runtime interface of Nektar++ volumes.
 */
#pragma once

#include <elvis/runtime.h>

namespace nektarpp {

const elvis_runtime* runtime_interface();

} // namespace nektarpp
