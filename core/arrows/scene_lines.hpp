/**
 * @file scene_lines.hpp
 * Streamlines and pathlines as a scene asks for them.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>
#include <core/streamline/flow.hpp>
#include <core/streamline/trace.hpp>

#include <array>
#include <string>
#include <vector>

namespace elvis {

struct SceneLines {
    /** What they follow; with its spin, where ribbons are wanted. */
    Flow flow;
    std::vector<Streamline> lines;
};

/**
 * `bounds`: of the volume, which must outlive the flow. Throws Error for volumes in which lines cannot be followed, and for
 * seeds on surfaces that have none.
 */
SceneLines scene_lines(const SceneStreamlines& wanted, const Scene& scene, const RuntimeVolume& volume,
                       const std::array<double, 6>& bounds, const TaskControl& control);

/** All of the scene that the lines rest on. */
std::string lines_key(const SceneStreamlines& wanted, const Scene& scene);

} // namespace elvis
