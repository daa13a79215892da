#include <core/session/check_scene.hpp>

#include <core/render/field/picture_ranges.hpp>
#include <core/scene/frame_request.hpp>
#include <core/streamline/flow.hpp>

namespace elvis {

namespace {

/** Ranges that suit every colour map: what is found with them says nothing about values. */
class AssumedRanges final : public PictureRanges {
public:
    AssumedRanges() {
        m_extrema.minimum.value = 1;
        m_extrema.maximum.value = 2;
    }
    const std::array<double, 6>& bounds() const override { return m_bounds; }
    const std::vector<Vector3>& outline() override { return m_outline; }
    const FieldExtrema& extrema(const FieldChoice&, std::uint32_t) override { return m_extrema; }
    FieldRange range(const FieldChoice&, std::uint32_t, elvis_certainty*) override { return m_extrema.range(); }
    double value_rounding(const FieldChoice&, std::uint32_t) override { return 0; }

private:
    std::array<double, 6> m_bounds = {0, 0, 0, 1, 1, 1};
    std::vector<Vector3> m_outline;
    FieldExtrema m_extrema;
};

} // namespace

void check_scene(const Scene& scene, const RuntimeVolume& volume) {
    Scene whole = scene;
    // Where it stands by itself is a matter of the volume's bounds.
    whole.camera = {};
    whole.camera.eye = Vector3{0, 0, 1};
    whole.camera.look_at = Vector3{};
    whole.camera.up = Vector3{0, 1, 0};
    if (whole.surfaces.empty()) {
        // What is shown by itself is looked for in the volume.
        whole.surfaces.push_back({.geometry = volume.dimension() == 2 ? SurfaceGeometry(FlatElements{}) : CutPlane{}});
    }
    for (SceneSurface& surface : whole.surfaces) {
        surface.is_shown = true;
        if (surface.streamlines) {
            Flow(volume, surface.streamlines->flow, scene.time_step);
        }
        if (surface.arrows) {
            Flow(volume, surface.arrows->vectors, scene.time_step);
        }
    }
    if (whole.volume_rendering) {
        whole.volume_rendering->is_shown = true;
    }
    if (scene.warp) {
        choose_field(volume, scene.warp->field);
    }
    AssumedRanges ranges;
    make_frame_request(whole, volume, ranges);
}

} // namespace elvis
