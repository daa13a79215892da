/**
 * @file interface.hpp
 * What the plugin interface costs: a cut plane through a native volume by the native plugin's snippet, as ordinary pictures
 * draw it, against the same kernel with the functions it calls written by hand for that volume (by_hand.glsl): orders as
 * numbers, no bases in general, buffers read without fetch functions.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <string>

namespace elvis {

struct InterfaceOptions {
    /** A native volume of hexahedra and prisms with geometry of order 1 and a scalar field of order 2; empty: waves of 16^3
     * hexahedra. */
    std::string volume;
    std::uint32_t size = 1024;
    /** Of each of the two, in turns. */
    std::uint32_t n_runs = 41;
};

struct InterfaceResult {
    /** Of the plane's kernels, milliseconds (bench.hpp). */
    struct Time {
        double least = 0, median = 0;
    };
    Time plugin, by_hand;
    /** Of the plugin's time to that by hand, the median of pairs of runs that follow each other. */
    double ratio = 0;
    std::uint64_t n_elements = 0;
    std::string field;
    std::uint32_t size = 0;
    /** Pixels that show an element, and those in which the two disagree about which. */
    std::uint64_t hit_pixels = 0, other_pixels = 0;
    /** Largest difference of the field where they agree, over the range of the field that is seen. */
    double largest_difference = 0;
    /** Of all pixels; alike where the pictures are. */
    std::uint64_t plugin_newton_steps = 0, by_hand_newton_steps = 0;
};

/** Float32. An Error if the volume has other classes or orders. */
InterfaceResult bench_interface(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                const InterfaceOptions& options);

} // namespace elvis
