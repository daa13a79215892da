#include <core/session/complete_scene.hpp>

#include <core/scene/frame_request.hpp>
#include <core/scene/resolve.hpp>

namespace elvis {

Scene complete_scene(const Scene& scene, const RuntimeVolume& volume, VolumeRanges& ranges) {
    const FrameRequest request = make_frame_request(scene, volume, ranges);
    Scene complete = scene;
    if (complete.surfaces.empty()) {
        complete.surfaces = drawn_surfaces(scene, volume, ranges);
    }
    set_camera(complete.camera, request.camera);
    return complete;
}

} // namespace elvis
