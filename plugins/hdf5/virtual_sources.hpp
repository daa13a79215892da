/**
 * @file virtual_sources.hpp
 * Other files in which the numbers of a virtual dataset lie.
 */
#pragma once

#include "object.hpp"

namespace elvis::hdf5 {

/** Ends with an error if one is missing: HDF5 itself would give zeros without a word. Called while a Lock is held. */
void check_virtual_sources(const Handle& creation_list, const Place& place);

} // namespace elvis::hdf5
