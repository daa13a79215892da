/**
 * @file pieces.hpp
 * Checks of questions about ranges of elements, for both interfaces.
 */
#pragma once

#include <core/conformance/check.hpp>
#include <core/conformance/description.hpp>

namespace elvis::conformance {

/** Every range gives the same numbers as the whole. */
void check_pieces(Context& context, const std::vector<Query>& queries);

/** Asked from several threads at once, every question gives the same numbers as before. */
void check_threads(Context& context, const std::vector<Query>& queries);

} // namespace elvis::conformance
