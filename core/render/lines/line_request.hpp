/**
 * @file line_request.hpp
 * Which lines of a surface are wanted, as kernels know them.
 */
#pragma once

#include <core/render/surface.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

struct LineRequest {
    /** Ascending, less the field's offset. */
    std::vector<double> isovalues;
    bool mesh_lines = false;
    /** How often a pixel is halved at most. */
    std::uint32_t subdivisions = 0;
};

/** Of a surface whose field lacks `offset` on the device. */
inline LineRequest line_request(const Surface& surface, double offset) {
    LineRequest request;
    if (surface.contours) {
        for (const double value : surface.contours->values) {
            request.isovalues.push_back(value - offset);
        }
    }
    request.mesh_lines = surface.mesh_lines.has_value();
    request.subdivisions = surface.subdivisions;
    return request;
}

} // namespace elvis
