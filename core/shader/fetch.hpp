/**
 * @file fetch.hpp
 * GLSL that reads record buffers.
 *
 * For record buffer number N of a kernel, with P parts of R records each:
 *
 *   vec4   core_row_N(uint record, uint row)       numbers 4*row .. 4*row+3 of the record (dvec4, uvec4)
 *   float  core_number_N(uint record, uint index)  number `index` (double, uint)
 *
 * A texel holds four floats, four uints or, as bits, two doubles. With several parts the right one is found by comparing the
 * record with the parts' borders: drivers for CPUs cannot index descriptors by a value that differs between lanes, and read all
 * parts anyway. A record beyond the last reads as zero then; with one part, that is left to the driver's bounds check.
 */
#pragma once

#include <core/vulkan/buffer.hpp>
#include <core/vulkan/device.hpp>

#include <string>

namespace elvis {

/** What fetch_functions calls for buffers of doubles; to be written once, and not for devices without doubles. */
std::string fetch_helpers();

/** Declarations and both functions for record buffer `number`, whose parts stand at `first_binding` .. */
std::string fetch_functions(const Device& device, const RecordBuffer& records, std::uint32_t number,
                            std::uint32_t first_binding);

/**
 * #defines of elvis_fetch_NAME and elvis_fetch4_NAME for record buffer `number`, giving elvis_real or uint. In a debug build,
 * record and index pass through core_index (core/shader/index_checks.hpp).
 */
std::string fetch_macros(const std::string& name, const RecordBuffer& records, std::uint32_t number, bool is_debug_build);

/** The #undefs that belong to them. */
std::string fetch_undefs(const std::string& name);

} // namespace elvis
