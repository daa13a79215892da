/**
 * @file source.hpp
 * The conversion interface of Nektar++ meshes and fields.
 */
#pragma once

#include <elvis/converter.h>

namespace nektarpp {

const elvis_converter* converter_interface();

} // namespace nektarpp
