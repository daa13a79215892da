/**
 * @file damage.hpp
 * Damaged copies of files, each determined by a seed.
 */
#pragma once

#include <cstdint>
#include <string>

namespace elvis::conformance {

struct Damaged {
    std::string content;
    /** What was done, e.g. "cut off at byte 120". */
    std::string what;
};

/** Damage number `index` of the seed: cut off, bytes changed, zeroed, repeated or left out, or a number replaced by a
 * nonsensical one. */
Damaged damage(const std::string& content, std::uint64_t seed, std::uint64_t index);

} // namespace elvis::conformance
