/**
 * @file line_walk.hpp
 * Where a straight line enters and leaves elements.
 *
 * In an element the line's preimage is followed by Newton's method in steps that are short against the element, until it leaves
 * the reference shape; where, is found by bisection. On the other side begins the element that holds the line a little farther
 * on. Where none does, the boxes of elements tell where the next one may begin.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>

#include <optional>
#include <vector>

namespace elvis {

/** A place between two elements, or where the volume begins or ends. */
struct LineBreak {
    /** From the line's first point, as a share of its length. */
    double parameter = 0;
    /** The same place, seen from either side; nothing where there is no element. */
    std::optional<ReferencePoint> before, after;
};

/**
 * In order, from the first point to the second. An element is told if the line is in it for more than a millionth of its size.
 * The plugin has to evaluate on the CPU. In two dimensions the volume and the line lie in one plane of constant z.
 */
std::vector<LineBreak> walk_line(const RuntimeVolume& volume, const Vector3& from, const Vector3& to,
                                 const TaskControl* control = nullptr);

} // namespace elvis
