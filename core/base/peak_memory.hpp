/**
 * @file peak_memory.hpp
 * How much memory the process has had.
 */
#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace elvis {

/** Most bytes so far; 0 if the system does not tell. */
inline std::uint64_t peak_memory() {
    rusage usage{};
    constexpr std::uint64_t kibibyte = 1024;
    return ::getrusage(RUSAGE_SELF, &usage) == 0 ? kibibyte * static_cast<std::uint64_t>(usage.ru_maxrss) : 0;
}

} // namespace elvis
