/**
 * @file counted.hpp
 * Numbers of things in texts.
 */
#pragma once

#include <cstdint>
#include <string>

namespace elvis {

/** "1 field", "3 fields". */
inline std::string counted(std::uint64_t count, const std::string& singular) {
    return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

} // namespace elvis
