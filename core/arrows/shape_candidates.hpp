/**
 * @file shape_candidates.hpp
 * Points of shapes that cut a volume, for arrows to stand on.
 */
#pragma once

#include <core/arrows/candidates.hpp>
#include <core/surface/shape.hpp>

#include <optional>
#include <string>

namespace elvis {

/** Covers a sphere, cylinder, cone, torus, triangles, Bezier patches or ribbons; whether the shape is one of these. */
bool add_shape(const CutShape& shape, Candidates& candidates);

/** An expression in x, y and z that is zero on a quadric or implicit surface; nothing for other shapes. */
std::optional<std::string> level_of(const CutShape& shape);

} // namespace elvis
