/**
 * @file field_info.hpp
 * What is known of a field of a volume.
 */
#pragma once

#include <elvis/runtime.h>

#include <cstdint>
#include <string>

namespace elvis {

struct FieldInfo {
    std::string name;
    std::string unit;
    std::uint32_t n_components = 1;
    elvis_continuity continuity = ELVIS_CONTINUITY_UNKNOWN;
    elvis_transform transform = ELVIS_TRANSFORM_NONE;
    double max_jump = 0; ///< NaN if unknown
    /** Of another volume, and found there by place: the processor evaluates it, and nothing is known of it between points. */
    bool is_by_place = false;
};

} // namespace elvis
