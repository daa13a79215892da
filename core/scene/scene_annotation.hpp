/**
 * @file scene_annotation.hpp
 * What a scene says about annotation, and what is then written on the picture.
 */
#pragma once

#include <core/annotation/annotation.hpp>

#include <optional>
#include <string>
#include <vector>

namespace elvis {

class RuntimeVolume;

/** By default a color bar for each colour map, axes, and the volume's name. */
struct SceneAnnotation {
    /** The volume's name and time if absent; nothing if empty. */
    std::optional<std::string> title;
    bool has_color_bars = true;
    bool has_axes = true;
    /** Font, colour, sizes and texts; the rest is filled in from the scene. */
    AnnotationRequest style;
};

/** As people write it: name, name[component], |name| for the magnitude of a vector, or the expression. */
std::string field_label(const RuntimeVolume& volume, const FieldChoice& field);

/**
 * What is written on a picture of the scene: a bar for each pair of field and colour map that its surfaces show, in their
 * order, then that of the volume itself, with the colours that it would have if it were opaque. `frame` tells which colours for
 * special values occur.
 */
AnnotationRequest make_annotation_request(const SceneAnnotation& annotation, const FrameRequest& request, const Frame& frame,
                                          const RuntimeVolume& volume);

} // namespace elvis
