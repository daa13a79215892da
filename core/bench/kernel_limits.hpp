/**
 * @file kernel_limits.hpp
 * What a compiler may at most need for each kernel, kept in a file: so that a change which costs a GPU registers is seen
 * without one.
 *
 * The file: a line with the name of the driver behind '#', a line of names, and a line for each kernel, shape and precision:
 * kernel,shape,precision,spills,scratch_bytes,waves.
 */
#pragma once

#include <core/bench/kernels.hpp>

#include <compare>
#include <iosfwd>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace elvis {

struct KernelKey {
    std::string kernel, shape;
    Precision precision = Precision::float32;
    friend auto operator<=>(const KernelKey&, const KernelKey&) = default; // NOLINT(modernize-use-nullptr): clang-tidy's own 0
};

struct KernelLimit {
    std::uint64_t spills = 0, scratch_bytes = 0, waves = 0;
};

struct KernelLimits {
    /** The driver's name and version: others need other registers for the same kernel. */
    std::string driver;
    /** Where a kernel has several variants, the worst of each. */
    std::map<KernelKey, KernelLimit> of;
};

KernelLimits limits_of(std::span<const KernelRow> rows, const std::string& driver);
void write_limits(std::ostream& file, const KernelLimits& limits);
/** An Error if the file is not as above. */
KernelLimits read_limits(const std::string& path);

/** A line for each kernel that needs more than is allowed, or that the limits lack. */
std::vector<std::string> worse_kernels(const KernelLimits& found, const KernelLimits& allowed);

} // namespace elvis
