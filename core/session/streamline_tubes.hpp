/**
 * @file streamline_tubes.hpp
 * Streamlines of scenes, as tubes or ribbons that can be drawn.
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
class StreamlineTubes {
public:
    /**
     * Gives the scene's streamlines, at its time step, their tubes or ribbons; those of earlier scenes are kept for a while.
     * Surfaces without any line are hidden. `bounds`: of the volume. What became of the lines goes to the log, once. Throws
     * Error for what is no flow, and for volumes in which lines cannot be followed.
     */
    void provide(Scene& scene, const RuntimeVolume& volume, const std::array<double, 6>& bounds, const TaskControl& control);
    /** Values of fields have changed. */
    void forget() { m_known.clear(); }

private:
    std::map<std::string, CutShape> m_known;
};

} // namespace elvis
