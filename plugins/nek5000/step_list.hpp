/**
 * @file step_list.hpp
 * Lists of time steps, NAME.nek5000.
 */
#pragma once

#include <elvis/plugin.hpp>

#include "byte_file.hpp"

namespace elvis_nek5000 {

bool is_step_list(const ByteFile& file);

/** The first parts of the steps that are there; of those that are not the host is told. */
std::vector<std::string> read_step_list(const ByteFile& file, const elvis::api::Host& host);

} // namespace elvis_nek5000
