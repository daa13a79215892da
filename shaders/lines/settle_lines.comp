// What the element that a pixel shows tells by itself of the lines that the pixel meets, on any surface but planes. Pixels that
// need more are listed.
//
// The pixel's square is one subpixel (lines/subpixel.glsl). Where all of it lies in the element, the element's part of the surface fills
// the square: no other element is met, and whatever lies behind does not matter. On faces the linear model of the face itself
// tells so (lines/own_face.glsl); elsewhere the surface must also be smooth around the pixel, because it may end. Something in
// front of it could hide a part: where a neighbouring pixel sees such a thing, nothing is settled. A boundary that runs through the
// square between two of its corners is a mesh line, whatever else there is.
//
// A work group is a tile of pixels, an invocation one of its columns.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "lines/line_marks.glsl"

layout(set = 0, binding = 1) CORE_READ_SAMPLES(core_samples);
layout(set = 0, binding = 2) CORE_READ_REALS(core_normals);
layout(set = 0, binding = 6, std430) buffer core_places_block { core_place core_places[]; };
layout(set = 0, binding = 7, std430) writeonly buffer core_list_block { uint core_list[]; };
#if !CORE_ON_FACES
layout(set = 0, binding = 8) CORE_READ_REALS(core_bending);
#endif
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_tile_row;
    uint core_class;
    // Lists the pixels that show no element, too.
    uint core_takes_outside;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_with_mesh_lines;
};

#include "picture/distrust_column.glsl"
#include "lines/own_face.glsl"
#include "lines/isovalue_test.glsl"
#include "picture/surroundings.glsl"

// The column's next pixel that shows an element of the class, from a row on.
uint core_next_row(uint column, uint row, uint end_row) {
    bool is_idle = true;
    while (is_idle && row < end_row) {
        const uint pixel = row * core_size.x + column;
        const bool is_outside = CORE_SAMPLE_NUMBER(core_samples, pixel) == CORE_NO_NUMBER;
        const bool is_mine = is_outside ? core_takes_outside != 0u : core_class_of(core_places[pixel]) == core_class;
        is_idle = core_marks[pixel].owner == 0u || !is_mine;
        row += is_idle ? 1u : 0u;
        if (!is_idle || row >= end_row) {
            break;
        }
    }
    return row;
}

// The pixel's square on the surface. `is_estimated`: where it lies rests on estimates.
core_shown_square core_pixel_square(core_element_image image, core_place place, uvec2 at, uint pixel, out bool is_estimated,
                                    out bool may_end_near) {
    const core_picture_square in_picture = core_picture_square(elvis_real(at.x), elvis_real(at.y), elvis_real(0.5LF));
#if CORE_ON_FACES
    core_shown_square square = core_own_square_at(image, max(core_face_of(place), 0), in_picture);
    const core_surroundings around = core_look_around(at, pixel, true, square.tangent);
    square.is_whole_pixel = true;
    is_estimated = false;
    may_end_near = core_may_end_near(pixel, square.corners, square.tangent);
#else
    const core_cut_ray ray = core_cut_ray_at(in_picture.column, in_picture.row);
    const core_tangent tangent = core_shown_tangent(pixel, ray);
    const core_surroundings around = core_look_around(at, pixel, true, tangent);
    core_cut_square corners = core_tangent_square(tangent, in_picture);
    may_end_near = core_may_end_near(pixel, corners, tangent);
    // What a loose bound decides is no estimate.
    const core_departure bent = core_departure_in(corners, tangent, ray, in_picture.half_size, CORE_REAL(core_bending, pixel),
                                                  around.turning, true);
    corners.error += bent.distance;
    core_shown_square square = core_shown_square_at(image, corners, tangent.normal, ray.direction, CORE_NO_FACE);
    square.is_whole_pixel = around.is_smooth;
    is_estimated = !around.is_smooth || bent.is_estimated;
#endif
    square.is_seen = square.corners.all_hit && !around.may_be_hidden;
    return square;
}

void core_settle(uvec2 at, uint pixel) {
    const bool is_outside = CORE_SAMPLE_NUMBER(core_samples, pixel) == CORE_NO_NUMBER;
    const core_place place = core_places[pixel];
    const core_element_image image =
        core_element_image_at(is_outside ? 0u : place.element, elvis_vec3(place.x, place.y, place.z));
    bool is_estimated, may_end_near;
    const core_shown_square square = core_pixel_square(image, place, at, pixel, is_estimated, may_end_near);
    const bool is_seen = !is_outside && square.is_seen;
    const bool is_inside = is_seen && square.subpixel.is_inside, is_filled = is_inside && square.is_whole_pixel;
    core_line_marks lines = core_no_lines_yet(CORE_WITH_CONTOURS != 0, core_with_mesh_lines != 0u);
    lines.has_mesh_line = lines.wants_mesh && is_seen && square.subpixel.is_crossed;
    lines.is_mesh_open = lines.wants_mesh && !is_filled;
    const core_isovalue_test test = core_isovalues_in(image, square.subpixel.region);
    lines.has_contour = is_inside && test.is_met;
    lines.is_contour_open = lines.wants_contour && !(is_filled && test.is_excluded);
    lines.is_estimated = !is_outside && (is_estimated || test.is_estimated);
    core_doubt_lines(may_end_near, lines);
    core_mark_lines(pixel, lines, core_undecided(false, false));
    const core_undecided open = core_undecided_lines(lines, false);
    if (core_is_any(open)) {
        core_places[pixel].class_and_face |=
            (square.enters ? CORE_PLACE_ENTERS : 0u) | (is_filled ? CORE_PLACE_FILLED : 0u);
        core_list[atomicAdd(core_counts[1], 1u)] = core_word_of(pixel, open);
    }
}

void main() {
    const uint column = gl_WorkGroupID.x * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = (core_first_tile_row + gl_WorkGroupID.y) * CORE_TILE_HEIGHT;
    const uint end_row = column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    uint n_evaluations = 0u;
    uint row = core_next_row(column, first_row, end_row);
    while (row < end_row) {
        core_settle(uvec2(column, row), row * core_size.x + column);
        n_evaluations += 1u;
        row = core_next_row(column, row + 1u, end_row);
        if (row >= end_row) {
            break;
        }
    }

    core_distrust_column(column, first_row, row, end_row, core_class >> 31);
    if (end_row > first_row) {
        core_count(0u, n_evaluations);
    }
}
