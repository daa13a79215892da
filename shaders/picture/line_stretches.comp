// Where lines pass through the pixels that meet them, as far as their neighbours tell. Wide lines are drawn around these stretches
// (picture/color.comp).
//
// A contour: values are linear between the middles of pixels; of several isovalues it is the one nearest to the pixel's own value. A
// mesh line parts pixels that show its element from pixels that do not; of the straight lines that may do so, it is the one in the
// middle.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "arithmetic/finite.glsl"
#include "picture/samples.glsl"
#include "picture/line_stretch.glsl"

layout(set = 0, binding = 0) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 1) CORE_READ_MARKS(core_marks);
layout(set = 0, binding = 2) CORE_READ_REALS(core_isovalues);
// Two a pixel; zero before.
layout(set = 0, binding = 3, std430) writeonly buffer core_stretches_block { uint core_stretches[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    uint core_n_isovalues;
};

// Of a pixel beside another one; that itself where the picture ends.
uint core_pixel_beside(ivec2 place, ivec2 way) {
    const ivec2 last = ivec2(core_width, core_n_pixels / core_width) - 1;
    const ivec2 there = clamp(place + way, ivec2(0), last);
    return uint(there.y) * core_width + uint(there.x);
}

// Of a line at a distance from the pixel's middle along a normal of length one, which is zero where nothing is known: the middle.
uint core_stretch_across(vec2 normal, float distance_, bool is_decided) {
    // The line meets the square.
    const float reach = 0.4999 * (abs(normal.x) + abs(normal.y));
    const vec2 foot = clamp(distance_, -reach, reach) * normal, along = vec2(-normal.y, normal.x);
    float first = -1.0, last = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        const bool is_crossed = abs(along[axis]) > 1e-6;
        const float one = is_crossed ? (-0.5 - foot[axis]) / along[axis] : -1.0;
        const float other = is_crossed ? (0.5 - foot[axis]) / along[axis] : 1.0;
        first = max(first, min(one, other));
        last = min(last, max(one, other));
    }
    return core_stretch_word(foot + first * along, foot + max(first, last) * along, is_decided);
}

bool core_has_value(uint pixel) {
    return CORE_MARK(core_marks, pixel).owner != 0u && core_is_finite(CORE_SAMPLE_VALUE(core_samples, pixel));
}

// How a value changes from pixel to pixel, from those that show the same element, else from any.
float core_slope_along(uint pixel, ivec2 place, ivec2 way) {
    const uint before = core_pixel_beside(place, -way), behind = core_pixel_beside(place, way);
    const bool is_before = before != pixel && core_has_value(before);
    const bool is_behind = behind != pixel && core_has_value(behind);
    const uint number = CORE_SAMPLE_NUMBER(core_samples, pixel);
    const bool is_own_before = is_before && CORE_SAMPLE_NUMBER(core_samples, before) == number;
    const bool is_own_behind = is_behind && CORE_SAMPLE_NUMBER(core_samples, behind) == number;
    const bool takes_any = !is_own_before && !is_own_behind;
    const bool takes_before = is_own_before || (takes_any && is_before), takes_behind = is_own_behind || (takes_any && is_behind);
    const elvis_real value = CORE_SAMPLE_VALUE(core_samples, pixel);
    const elvis_real from_before = takes_before ? value - CORE_SAMPLE_VALUE(core_samples, before) : elvis_real(0);
    const elvis_real to_behind = takes_behind ? CORE_SAMPLE_VALUE(core_samples, behind) - value : elvis_real(0);
    return float(from_before + to_behind) / (takes_before && takes_behind ? 2.0 : 1.0);
}

// From the value to the nearest isovalue.
float core_way_to_isovalue(elvis_real value) {
    elvis_real nearest = elvis_real(3.0e38LF);
    for (uint i = 0u; i < core_n_isovalues; ++i) {
        const elvis_real way = CORE_REAL(core_isovalues, i) - value;
        nearest = abs(way) < abs(nearest) ? way : nearest;
    }
    return float(nearest);
}

uint core_contour_stretch(uint pixel, ivec2 place, bool is_decided) {
    const bool is_known = core_has_value(pixel);
    const vec2 slope = is_known ? vec2(core_slope_along(pixel, place, ivec2(1, 0)), core_slope_along(pixel, place, ivec2(0, 1))) : vec2(0);
    // Slopes of any size: their squares need not be numbers.
    const float size = max(abs(slope.x), abs(slope.y));
    const vec2 scaled = size > 0.0 ? slope / size : vec2(0);
    const float steepness = length(scaled);
    const float way = is_known ? core_way_to_isovalue(CORE_SAMPLE_VALUE(core_samples, pixel)) : 0.0;
    return core_stretch_across(steepness > 0.0 ? scaled / steepness : vec2(0), size > 0.0 ? way / size / steepness : 0.0, is_decided);
}

// 1: the pixel shows another element; -1: the same. 0: the surface is not seen there, which counts as another one if there is none else.
int core_side_of(uint own, uint pixel, bool takes_unseen) {
    const bool is_seen = CORE_MARK(core_marks, pixel).owner != 0u;
    return !is_seen ? (takes_unseen ? 1 : 0) : CORE_SAMPLE_NUMBER(core_samples, pixel) == own ? -1 : 1;
}

// Pixels to each side that are asked, and how many that are.
#define CORE_STRETCH_REACH 2
#define CORE_STRETCH_PIXELS 25

ivec2 core_stretch_way(int i) {
    const int across = 2 * CORE_STRETCH_REACH + 1;
    return ivec2(i % across, i / across) - CORE_STRETCH_REACH;
}

// All pixels that are asked, and the squares of those that the line does not meet, lie on their side of it. With the normal estimated by
// sums over both sides, lines are found to 0.09 of a pixel (root of the mean square), and to 0.35 of one.
uint core_mesh_stretch(uint pixel, ivec2 place, bool is_decided) {
    const uint own = CORE_MARK(core_marks, pixel).owner != 0u ? CORE_SAMPLE_NUMBER(core_samples, pixel) : CORE_NO_NUMBER;
    bool has_other = false;
    for (int i = 0; i < CORE_STRETCH_PIXELS; ++i) {
        has_other = has_other || core_side_of(own, core_pixel_beside(place, core_stretch_way(i)), false) > 0;
    }
    vec2 to_other = vec2(0);
    for (int i = 0; i < CORE_STRETCH_PIXELS; ++i) {
        const ivec2 way = core_stretch_way(i);
        to_other += float(core_side_of(own, core_pixel_beside(place, way), !has_other)) * vec2(way);
    }
    const float size = length(to_other);
    const vec2 normal = size > 0.0 ? to_other / size : vec2(0);
    // The line is no farther from the middle of a pixel that it meets.
    const float reach = 0.5 * (abs(normal.x) + abs(normal.y));
    float least = size > 0.0 ? 0.0 : -reach, most = reach;
    for (int i = 0; i < CORE_STRETCH_PIXELS; ++i) {
        const ivec2 way = core_stretch_way(i);
        const uint there = core_pixel_beside(place, way);
        const int side = core_side_of(own, there, !has_other);
        const bool is_met = (CORE_MARK(core_marks, there).flags & (CORE_FLAG_MESH_LINE | CORE_FLAG_MESH_UNDECIDED)) != 0u;
        const float distance_ = dot(normal, vec2(way)), square = is_met ? 0.0 : reach;
        least = side < 0 && distance_ < reach ? max(least, min(distance_ + square, reach)) : least;
        most = side > 0 && distance_ > -reach ? min(most, max(distance_ - square, -reach)) : most;
    }
    return core_stretch_across(normal, 0.5 * (least + most), is_decided);
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    if (pixel >= core_n_pixels) {
        return;
    }
    const ivec2 place = ivec2(pixel % core_width, pixel / core_width);
    const uint flags = CORE_MARK(core_marks, pixel).flags;
    if ((flags & (CORE_FLAG_CONTOUR | CORE_FLAG_CONTOUR_UNDECIDED)) != 0u) {
        core_stretches[2u * pixel + CORE_STRETCH_CONTOUR] = core_contour_stretch(pixel, place, (flags & CORE_FLAG_CONTOUR) != 0u);
    }
    if ((flags & (CORE_FLAG_MESH_LINE | CORE_FLAG_MESH_UNDECIDED)) != 0u) {
        core_stretches[2u * pixel + CORE_STRETCH_MESH_LINE] = core_mesh_stretch(pixel, place, (flags & CORE_FLAG_MESH_LINE) != 0u);
    }
}
