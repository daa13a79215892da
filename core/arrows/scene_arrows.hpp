/**
 * @file scene_arrows.hpp
 * Arrows of scenes, as glyphs that can be drawn.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>

#include <array>
#include <map>
#include <memory>
#include <string>

namespace elvis {

/** Of one volume. One thread at a time. */
class SceneArrowSets {
public:
    /**
     * Gives the scene's arrows, at its time step, their glyphs; those of earlier scenes are kept for a while. Surfaces without
     * any arrow are hidden. `bounds`: of the volume. Vectors are evaluated in double precision. How many arrows there are goes
     * to the log, once. Throws Error for what is no vector field, for surfaces on which no arrows can stand, and for volumes
     * that are not evaluated on the CPU.
     */
    void provide(Scene& scene, const RuntimeVolume& volume, const std::array<double, 6>& bounds, const TaskControl& control);
    /** Values of fields have changed. */
    void forget() { m_known.clear(); }

private:
    std::map<std::string, std::shared_ptr<const ArrowSet>> m_known;
};

} // namespace elvis
