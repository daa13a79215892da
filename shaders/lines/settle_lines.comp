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
#include "picture/cut_frame.glsl"
#include "element/face_frame.glsl"
#include "element/place.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 1, std430) readonly buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_normals_block { elvis_real core_normals[]; };
// [0]: evaluations, [1]: listed pixels.
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5, std430) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };
layout(set = 0, binding = 6, std430) buffer core_places_block { core_place core_places[]; };
layout(set = 0, binding = 7, std430) writeonly buffer core_list_block { uint core_list[]; };
#if !CORE_ON_FACES
layout(set = 0, binding = 8, std430) readonly buffer core_bending_block { elvis_real core_bending[]; };
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
#include "lines/subpixel.glsl"
#include "lines/own_face.glsl"
#include "picture/surroundings.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

// The column's next pixel that shows an element of the class, from a row on.
uint core_next_row(uint column, uint row, uint end_row) {
    bool is_idle = true;
    while (is_idle && row < end_row) {
        const uint pixel = row * core_size.x + column;
        const bool is_outside = core_samples[pixel].number == CORE_NO_NUMBER;
        const bool is_mine = is_outside ? core_takes_outside != 0u : core_class_of(core_places[pixel]) == core_class;
        is_idle = core_marks[pixel].owner == 0u || !is_mine;
        row += is_idle ? 1u : 0u;
        if (!is_idle || row >= end_row) {
            break;
        }
    }
    return row;
}

void main() {
    const uint column = gl_WorkGroupID.x * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = (core_first_tile_row + gl_WorkGroupID.y) * CORE_TILE_HEIGHT;
    const uint end_row = column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    uint n_evaluations = 0u;
    uint row = core_next_row(column, first_row, end_row);
    while (row < end_row) {
        const uint pixel = row * core_size.x + column;
        const bool is_outside = core_samples[pixel].number == CORE_NO_NUMBER;
        const core_place place = core_places[pixel];
        const uint element = is_outside ? 0u : place.element;
        const elvis_vec3 xi = elvis_vec3(place.x, place.y, place.z);
        elvis_vec3 position;
        elvis_mat3 jacobian;
        elvis_mapping_jacobian(element, xi, position, jacobian);
        jacobian = core_full_jacobian(jacobian);
        const elvis_vec3 shift = core_reference.xyz - elvis_origin(element);
        const elvis_real curvature = elvis_fetch_core_curvatures(element, 0u);
#if CORE_ON_FACES
        const core_own_subpixel own = core_own_subpixel_at(xi, position, jacobian, shift, max(core_face_of(place), 0), curvature,
                                                   elvis_real(column), elvis_real(row), elvis_real(0.5LF));
        core_subpixel subpixel = own.subpixel;
        const core_tangent tangent = own.tangent;
        const core_surroundings around = core_look_around(uvec2(column, row), pixel, true, tangent);
        const bool is_usable = own.square.all_hit && !around.is_hidden;
        const bool fills = true, is_estimated = false;
        const uint entering = own.enters ? CORE_PLACE_ENTERS : 0u;
#else
        const core_cut_column along = core_cut_begin(elvis_real(column));
        const elvis_real down = elvis_real(row) - along.row0;
        const elvis_vec3 direction = (along.direction + down * along.direction_row).xyz;
        const elvis_real stretch = length(direction);
        core_tangent tangent;
        tangent.point = (along.base + down * along.base_row).xyz +
                        (core_samples[pixel].depth / stretch - along.reference_distance) * direction;
        tangent.normal = elvis_vec3(core_normals[3u * pixel], core_normals[3u * pixel + 1u], core_normals[3u * pixel + 2u]);
        const core_surroundings around = core_look_around(uvec2(column, row), pixel, true, tangent);
        const core_cut_square square = core_tangent_square(tangent, elvis_real(column), elvis_real(row), elvis_real(0.5LF));
        const core_departure bent =
            core_departure_in(tangent, square, core_bending[pixel], around.turning, -dot(tangent.normal, direction) / stretch);
        const elvis_real error = square.error + bent.distance + CORE_ROUNDOFF * max(max(abs(shift.x), abs(shift.y)), abs(shift.z));
        const elvis_vec3 origin = shift - position;
        core_subpixel subpixel = core_subpixel_at(xi, core_frame_at(position, jacobian, error), origin + square.corner0, origin + square.corner1,
                                      origin + square.corner2, origin + square.corner3, curvature, tangent.normal, direction,
                                      CORE_NO_FACE);
        const bool is_usable = square.all_hit && !around.is_hidden;
        const bool fills = around.is_smooth, is_estimated = !around.is_smooth || bent.is_estimated;
        const uint entering = 0u;
#endif
#if ELVIS_HAS_INSIDE
        core_judge_inside(subpixel, element, xi);
#endif
        const bool is_inside = !is_outside && is_usable && subpixel.is_inside;
        const bool is_filled = is_inside && fills;
        const bool has_mesh_line = !is_outside && core_with_mesh_lines != 0u && is_usable && subpixel.is_crossed;
        const bool is_mesh_open = core_with_mesh_lines != 0u && !has_mesh_line && !is_filled;
        bool is_contour_open = false, has_contour = false, rests_on_estimates = is_estimated;
#if CORE_WITH_CONTOURS
        elvis_real value;
        const core_model model = core_shown_model(element, xi, subpixel.region, value);
        const core_isovalue_test test = core_test_isovalues(model, subpixel.region);
        has_contour = is_inside && test.is_met;
        is_contour_open = !has_contour && !(is_filled && test.is_excluded);
        const bool is_model_estimated = core_is_model_estimated(element);
        rests_on_estimates = rests_on_estimates || is_model_estimated;
#endif
        n_evaluations += 1u;
        const uint flags = (has_contour ? CORE_FLAG_CONTOUR : 0u) | (has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) |
                           (rests_on_estimates && !is_outside ? CORE_FLAG_ESTIMATED : 0u);
        if (flags != 0u) {
            core_marks[pixel].flags |= flags;
        }
        const uint open = (is_contour_open ? CORE_LIST_CONTOUR : 0u) | (is_mesh_open ? CORE_LIST_MESH_LINE : 0u);
        if (open != 0u) {
            core_places[pixel].class_and_face |= entering | (is_filled ? CORE_PLACE_FILLED : 0u);
            core_list[atomicAdd(core_counts[1], 1u)] = pixel | open;
        }
        row = core_next_row(column, row + 1u, end_row);
        if (row >= end_row) {
            break;
        }
    }

    // Then no pixel of the column is to be trusted.
    const bool is_cut_short = end_row > first_row && (row < end_row || core_has_driver_given_up(core_class >> 31));
    core_distrust_column(column, first_row, is_cut_short ? end_row : first_row);
    if (end_row > first_row) {
        const uint all_evaluations = subgroupAdd(n_evaluations);
        if (subgroupElect()) {
            atomicAdd(core_counts[0], all_evaluations);
        }
    }
}
