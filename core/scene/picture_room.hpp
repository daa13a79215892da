/**
 * @file picture_room.hpp
 * The part of the picture that annotation leaves to the volume.
 */
#pragma once

#include <cstddef>

namespace elvis {

struct Scene;

/** In pixels. What is taken is at the sides: by colour bars at the left or right, by the title at the top. */
struct PictureRoom {
    double width = 1, height = 1;
    double left = 0, right = 0, top = 0;

    /** Halves of what is left, in halves of the picture's height: the largest s and v of a point around its middle. */
    double half_width() const { return (width - left - right) / height; }
    double half_height() const { return (height - top) / height; }
};

/** By the lengths of usual numbers and the bars that the scene's fields and colour maps want, before there is a picture. */
PictureRoom room_for_volume(const Scene& scene);

} // namespace elvis
