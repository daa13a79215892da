/**
 * @file array_mesh.hpp
 * Which faces the elements of arrays share.
 */
#pragma once

#include <core/base/cancel.hpp>

#include <elvis/elvis.h>
#include <elvis/native/description.hpp>

#include <string>
#include <vector>

namespace elvis::library {

/**
 * Found as conversion finds them (core/convert/topology). `geometry`: coefficients by class; `classes` as the caller has them.
 * Throws InvalidArgument for corners or groups that cannot be.
 */
std::vector<native::Face> faces_of_mesh(const native::Description& description,
                                        const std::vector<std::vector<double>>& geometry,
                                        const std::vector<elvis_array_class>& classes, const std::string& name,
                                        const TaskControl& control);

} // namespace elvis::library
