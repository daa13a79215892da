/**
 * @file handles.hpp
 * Points in the picture by which surfaces and lights are moved.
 */
#pragma once

#include "camera_motion.hpp"
#include "items.hpp"

#include <optional>
#include <vector>

namespace elvis::view {

struct Handle {
    enum class Kind {
        along, ///< moves along a line
        free   ///< moves in the plane through it that faces the viewer
    };
    Kind kind = Kind::free;
    Vector3 position{};
    /** Of `along`: unit. */
    Vector3 direction{};
    /** A line is drawn to there. */
    std::optional<Vector3> tied_to;
    /** What it does, for people. */
    const char* help = "";
    /** For tests: "move", "turn", "radius". */
    const char* name = "";
};

/** Of an item; none for those that have no place of their own. */
std::vector<Handle> handles_of(const Scene& scene, const ItemId& item, const VolumeFacts& volume);

/** Where a handle goes that is dragged from one place of the picture to another. */
Vector3 dragged_to(const Handle& handle, const Camera& camera, const PictureSize& size, const PicturePoint& from,
                   const PicturePoint& to);

/** The scene after the handle of that number has been moved to a position. */
Scene with_moved_handle(const Scene& scene, const ItemId& item, const VolumeFacts& volume, std::size_t handle,
                        const Vector3& position);

} // namespace elvis::view
