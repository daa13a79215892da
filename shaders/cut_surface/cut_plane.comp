// Where the rays of a picture meet one cut plane, for the elements of one class: finds the element, evaluates the field.
//
// Several planes and classes merge in core_samples: the nearest plane wins; on one plane, the element on the viewer's side, then
// the lowest number. One field evaluation a pixel and class, after the search.
//
// With CORE_LINES, what needs no closer look is decided about lines: pixels whose square lies inside one element, and in which the
// field certainly takes an isovalue or certainly none. The others are left to lines/cut_lines.comp.
//
// A work group is a tile of pixels, an invocation one of its columns: what the whole tile shares is fetched once.

layout(local_size_x = CORE_TILE_WIDTH) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "tiles/node_tiles.glsl"
#include "picture/samples.glsl"

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2) CORE_READ_WORDS(core_tiles);
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first_listed;
    // Counted from 1; 0 is no surface.
    uint core_surface_number;
    // Components of the field: the only one, or all that make up the length of the vector.
    uint core_first_component;
    uint core_end_component;
    // Elements that share a point may have other values there: one of them is listed.
    uint core_lists_others;
    // Of values: what makes no difference to the picture.
    float core_value_tolerance;
    uint core_n_isovalues;
};

#define CORE_LISTED_BINDING 6
#include "tiles/listed_tile.glsl"

uint core_first_entry() { return core_listed_tile(core_first_listed) * CORE_TILE_STRIDE + 1u; }

uint core_entry(uint i) { return CORE_WORD(core_tiles, core_first_entry() + i); }

#define CORE_OTHERS_BINDING 7
#include "cut_surface/other_elements.glsl"
#define CORE_OPEN_POINTS_BINDING 8
#define CORE_WANTED_REACHES_BINDING 9
#include "cut_surface/open_points.glsl"
#include "arithmetic/count.glsl"
#include "picture/show.glsl"
#include "picture/distrust_column.glsl"
#define CORE_ON_PLANE 1
#include "cut_surface/locate.glsl"

#if CORE_LINES
layout(set = 0, binding = 5) CORE_READ_REALS(core_isovalues);

#define CORE_WITH_CONTOURS 1
#include "lines/isovalue_test.glsl"
#include "lines/shown_square.glsl"

struct core_pixel_lines {
    elvis_real value;
    bool is_settled, has_contour, is_estimated;
};

core_pixel_lines core_lines_of_pixel(uint element, elvis_vec3 xi, uvec2 pixel, elvis_vec3 direction) {
    const core_element_image image = core_element_image_at(element, xi);
    const core_cut_square square =
        core_cut_corners(core_picture_square(elvis_real(pixel.x), elvis_real(pixel.y), elvis_real(0.5LF)));
    const core_subpixel subpixel =
        core_shown_square_at(image, square, core_plane_normal.xyz, direction, CORE_NO_FACE).subpixel;
    const core_isovalue_test test = core_isovalues_in(image, subpixel.region);
    core_pixel_lines lines;
    lines.value = test.value;
    lines.is_settled = square.all_hit && subpixel.is_inside && (test.is_excluded || test.is_met);
    lines.has_contour = lines.is_settled && test.is_met;
    lines.is_estimated = test.is_estimated;
    return lines;
}
#endif

void main() {
    const uint tile = core_listed_tile(core_first_listed), tiles_per_row = (core_size.x + CORE_TILE_WIDTH - 1u) / CORE_TILE_WIDTH;
    const uint column = tile % tiles_per_row * CORE_TILE_WIDTH + gl_LocalInvocationID.x;
    const uint first_row = tile / tiles_per_row * CORE_TILE_HEIGHT;
    const uint n_entries = CORE_WORD(core_tiles, core_first_entry() - 1u);
    const uint end_row = n_entries > 0u && column < core_size.x ? min(first_row + CORE_TILE_HEIGHT, core_size.y) : first_row;
    uint n_steps = 0u, n_failures = 0u, n_evaluations = 0u;
    const core_cut_column ray = core_cut_begin(elvis_real(column));
    const elvis_real data_error = core_data_error();
    core_track track = core_no_track();
    uint row = first_row;
    while (row < end_row) {
        core_cut_point point = core_cut_pixel(ray, elvis_real(row));
        point.error += data_error;
        const core_location found = core_locate(point, point.is_hit || point.is_doubtful ? n_entries : 0u, track);
        const bool has_found = found.element != CORE_NO_ELEMENT;
        const elvis_vec3 xi = elvis_vec3(found.x, found.y, found.z);
#if CORE_LINES
        const core_pixel_lines lines =
            core_lines_of_pixel(has_found ? found.element : 0u, xi, uvec2(column, row), point.direction);
        const elvis_real value = lines.value;
#else
        const elvis_real value = core_shown_value(has_found ? found.element : 0u, xi);
#endif
        const bool is_news = has_found || found.n_failures > 0u || found.is_cut_short;
        if (is_news && point.is_doubtful) {
            core_marks[row * core_size.x + column].flags |= CORE_FLAG_UNDECIDED_IN_FRONT;
        }
        if (is_news && point.is_hit) {
            const uint pixel = row * core_size.x + column;
            const uint n_done = core_merge(pixel, point, found, value);
            n_evaluations += n_done;
            core_list_other(pixel, found);
#if CORE_LINES
            if (n_done > 0u && lines.is_settled) {
                core_marks[pixel].owner |= CORE_OWNER_SETTLED;
                core_marks[pixel].flags |=
                    (lines.has_contour ? CORE_FLAG_CONTOUR : 0u) | (lines.is_estimated ? CORE_FLAG_ESTIMATED : 0u);
            }
#endif
        }
        core_list_open_point(row * core_size.x + column, found);
        n_steps += found.n_steps;
        n_failures += found.n_failures;
        row += 1u;
        if (row >= end_row) {
            break;
        }
    }
    core_distrust_column(column, first_row, row, end_row, core_surface_number >> 31);
    if (end_row > first_row) {
        core_count(0u, n_evaluations);
        core_count(1u, n_steps);
        core_count(2u, n_failures);
    }
}
