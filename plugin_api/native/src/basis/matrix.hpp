/**
 * @file matrix.hpp
 * Dense matrices of the device form, stored row by row.
 */
#pragma once

#include <Eigen/Dense>

namespace elvis::native::device {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

} // namespace elvis::native::device
