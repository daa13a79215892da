/**
 * @file source.hpp
 * The conversion interface of Nektar++ meshes and fields.
 */
#pragma once

#include <elvis/converter.h>
#include <elvis/parts.h>

namespace nektarpp {

const elvis_converter* converter_interface();
const elvis_parts* parts_interface();

} // namespace nektarpp
