/**
 * @file convert_together.hpp
 * Conversion by many processes, which the library has no word for.
 */
#pragma once

#include "conversion.hpp"

#include <core/base/team.hpp>

#include <string>

namespace elvis::commands {

/** By all of a team. Returns the report, JSON; of others than the first it is of nothing. Throws Error. */
std::string convert_together(const Conversion& conversion, Team& team);

} // namespace elvis::commands
