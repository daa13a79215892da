/**
 * @file record_type.hpp
 * Types of records in files, and of what of them is wanted in memory. Every function is called while a Lock is held.
 */
#pragma once

#include "object.hpp"

#include <optional>
#include <span>

namespace elvis::hdf5 {

/** The type of a member; nothing if there is none of that name. */
std::optional<Handle> find_type(hid_t type, std::span<const std::string> member, const Place& place);

std::string member_name(hid_t record, unsigned index);

/**
 * The type in memory of all numbers of a member, one after the other, each a `number`. HDF5 finds members of records by their
 * names, and skips what memory does not have.
 */
Handle packed_type(hid_t type, hid_t number, std::span<const std::string> member, const Place& place);

/** Significant bits of the numbers in a type, the least of all; 53 if there are none of fewer. */
unsigned mantissa_bits(hid_t type, const Place& place);

} // namespace elvis::hdf5
