/**
 * @file compared_pictures.hpp
 * What pictures in parts may differ in from those of the whole volume.
 */
#pragma once

#include "parts_fixture.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace elvis::test {

/** Of a colour channel; what a picture may be off anyway. */
inline constexpr double tolerance = 1e-3;
inline constexpr std::uint32_t doubt = pixel_flag::undecided | pixel_flag::isosurface_undecided |
                                       pixel_flag::contour_undecided | pixel_flag::mesh_line_undecided |
                                       pixel_flag::volume_tolerance;
/** Bits that are the mathematical mask. */
inline constexpr std::uint32_t mask = pixel_flag::contour | pixel_flag::mesh_line | pixel_flag::isosurface;

struct Differences {
    double color = 0, value = 0, depth = 0, normal = 0;
    /** Pixels whose colour is off, that show another element, another mask: all, and such as neither picture flags. */
    std::size_t n_color = 0, n_silent = 0, n_element = 0, n_mask = 0, n_silent_mask = 0;
    std::size_t n_flagged = 0, n_flagged_whole = 0, n_hit = 0;
};

inline void widen(double& largest, double a, double b) {
    if (std::isfinite(a) && std::isfinite(b)) {
        largest = std::max(largest, std::abs(a - b));
    }
}

inline Differences between(const Frame& whole, const Frame& parts) {
    Differences found;
    for (std::size_t pixel = 0; pixel < whole.flags.size(); ++pixel) {
        const bool is_flagged = ((whole.flags[pixel] | parts.flags[pixel]) & doubt) != 0;
        found.n_flagged += (parts.flags[pixel] & doubt) != 0 ? 1 : 0;
        found.n_flagged_whole += (whole.flags[pixel] & doubt) != 0 ? 1 : 0;
        found.n_hit += whole.element[pixel] >= 0 ? 1 : 0;
        double color = 0;
        for (std::size_t channel = 0; channel < 4; ++channel) {
            widen(color, whole.color[4 * pixel + channel], parts.color[4 * pixel + channel]);
        }
        const bool is_met_alike = (whole.element[pixel] >= 0) == (parts.element[pixel] >= 0);
        const bool is_off = color > tolerance || !is_met_alike;
        found.n_color += is_off ? 1 : 0;
        found.n_silent += is_off && !is_flagged ? 1 : 0;
        found.n_element += whole.element[pixel] != parts.element[pixel] ? 1 : 0;
        const bool is_masked_otherwise = ((whole.flags[pixel] ^ parts.flags[pixel]) & mask) != 0;
        found.n_mask += is_masked_otherwise ? 1 : 0;
        found.n_silent_mask += is_masked_otherwise && !is_flagged ? 1 : 0;
        if (!is_flagged) {
            widen(found.color, color, 0);
            widen(found.value, whole.value[pixel], parts.value[pixel]);
            widen(found.depth, whole.depth[pixel], parts.depth[pixel]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                widen(found.normal, whole.normal[3 * pixel + axis], parts.normal[3 * pixel + axis]);
            }
        }
    }
    return found;
}

struct Picture {
    const char* name;
    const char* keys;
};

inline void compare(const Picture& picture, std::uint32_t n_parts, const Frame& whole, const Frame& parts) {
    const Differences found = between(whole, parts);
    CHECK(whole.counts.hit_pixels + whole.counts.volume_pixels > 1000);
    std::printf("%-34s %u parts: largest difference of colour %.1e, value %.1e, depth %.1e, normal %.1e; of %zu pixels "
                "colour is off in %zu (%zu unflagged), element in %zu, mask in %zu (%zu unflagged); flagged %zu, in the whole "
                "%zu\n",
                picture.name, n_parts, found.color, found.value, found.depth, found.normal, found.n_hit, found.n_color,
                found.n_silent, found.n_element, found.n_mask, found.n_silent_mask, found.n_flagged, found.n_flagged_whole);
    INFO(picture.name << ", " << n_parts << " parts");
    CHECK(found.n_silent == 0);
    CHECK(found.n_silent_mask == 0);
    CHECK(found.color <= tolerance);
    // What parts add to doubt is a matter of few pixels, near borders between parts.
    CHECK(found.n_flagged <= found.n_flagged_whole + whole.flags.size() / 20);
}

inline void compare(Stage& stage, const Picture& picture, std::uint32_t n_parts) {
    const Scene scene = stage.scene(picture.keys);
    compare(picture, n_parts, stage.as_whole(scene), stage.in_parts(scene, n_parts));
}

} // namespace elvis::test
