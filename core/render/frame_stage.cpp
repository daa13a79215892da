#include <core/render/frame_stage.hpp>

#include <algorithm>

namespace elvis {

namespace {

/** Of volume rendering, before it is exact: what a picture of 8 bits just shows. */
constexpr double coarse_tolerance = 1e-2;
/** Halvings of pixels where lines are looked for, before they are exact. */
constexpr std::uint32_t coarse_subdivisions = 2;

bool has_tolerance(Integrator integrator) { return !has_steps(integrator); }

bool is_coarser(const VolumeRendering& volume) {
    return has_tolerance(volume.integrator) && volume.tolerance < coarse_tolerance;
}

bool is_coarser(const Surface& surface) { return surface.has_lines() && surface.subdivisions > coarse_subdivisions; }

} // namespace

bool has_refinement(const FrameRequest& request) {
    return (request.volume && is_coarser(*request.volume)) ||
           std::any_of(request.surfaces.begin(), request.surfaces.end(),
                       [](const Surface& surface) { return is_coarser(surface); });
}

FrameRequest request_for(const FrameRequest& request, FrameStage stage, std::uint32_t divisor, bool with_lines) {
    FrameRequest result = request;
    if (stage == FrameStage::exact) {
        return result;
    }
    result.width = std::max(1u, (request.width + divisor - 1) / divisor);
    result.height = std::max(1u, (request.height + divisor - 1) / divisor);
    for (double& shift : result.camera.image_shift) {
        shift /= divisor;
    }
    if (result.volume && is_coarser(*result.volume)) {
        result.volume->tolerance = coarse_tolerance;
    }
    for (Surface& surface : result.surfaces) {
        if (is_coarser(surface)) {
            surface.subdivisions = coarse_subdivisions;
        }
        if (surface.lic) {
            surface.lic->length /= divisor;
            surface.lic->grain = std::max(1u, surface.lic->grain / divisor);
        }
        if (!with_lines) {
            surface.contours.reset();
            surface.mesh_lines.reset();
        }
    }
    return result;
}

} // namespace elvis
