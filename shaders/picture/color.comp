// Colours of a surface's samples: a table of (value, r, g, b), piecewise linear, with colours of its own below, above and for NaN;
// lines over it; nothing where it is clipped.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"
#include "picture/view.glsl"
#include "arithmetic/finite.glsl"
#include "arithmetic/read_only.glsl"
#include "picture/samples.glsl"
#include "picture/seen_point.glsl"
// A kernel without light costs nothing for it; nor does one without lines, or planes that clip.
#if CORE_IS_CLIPPED
#include "picture/place_error.glsl"
#endif
#if CORE_IS_LIT
#define CORE_LIGHTS_BINDING 7
#include "picture/lighting.glsl"
layout(set = 0, binding = 8) CORE_READ_REALS(core_normals);
#endif
#if CORE_HAS_WIDE_LINES
#include "picture/line_stretch.glsl"
layout(set = 0, binding = 7 + 2 * CORE_IS_LIT + CORE_IS_SHADED) CORE_READ_WORDS(core_stretches);
#endif
#if CORE_IS_SHADED
// Factors of colours, by line integral convolution (picture/lic.comp).
layout(set = 0, binding = 7 + 2 * CORE_IS_LIT) CORE_READ_REALS(core_shades);
#endif

layout(set = 0, binding = 1) CORE_READ_SAMPLES(core_samples);
// In this order: points of the table; colours below, above, for NaN, and where nothing is seen; colours of undecided contours, of
// mesh lines and undecided ones; opacity, and colour outside of elements; limits of values: up to the first they have no
// place on the table's scale, and below the second and above the third they are outside of it; planes that clip; isovalues with
// the colours of their contours.
layout(set = 0, binding = 2) CORE_READ_ROWS(core_rows);
layout(set = 0, binding = 3, std430) writeonly buffer core_colors_block { elvis_vec4 core_colors[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
// The same, as they are before.
layout(set = 0, binding = 6) CORE_READ_MARKS(core_old_marks);
// Four words a surface: 1 where there are values below, above, and such that are no numbers; where a pixel shows it.
layout(set = 0, binding = 5, std430) buffer core_special_block { uint core_special_values[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_pixels;
    uint core_groups_x;
    uint core_width;
    uint core_n_points;
    uint core_n_isovalues;
    uint core_n_clips;
    // Flags of every pixel that is hit.
    uint core_common_flags;
    uint core_surface_number;
    // CORE_STYLE_...
    uint core_contour_style;
    uint core_mesh_style;
    // Half the widths of lines, in pixels.
    float core_contour_reach;
    float core_mesh_reach;
    // The surface has one normal, that of the rays' plane.
    uint core_is_plane;
};

#define CORE_STYLE_UNDECIDED 1u
#define CORE_STYLE_COLOR 2u
#define CORE_STYLE_ONLY_DECIDED 4u

elvis_vec4 core_special(uint which) { return CORE_ROW(core_rows, core_n_points + which); }

// The point that the pixel sees, relative to the reference point, and the direction of its ray, of any length.
elvis_vec3 core_position(uint pixel, elvis_real depth, out elvis_vec3 direction) {
    elvis_real t;
    return core_seen_point(elvis_vec2(pixel % core_width, pixel / core_width), depth, direction, t);
}

#if CORE_IS_CLIPPED
// Whether that point is cut away, and whether rounding decides it.
struct core_clipping {
    bool is_cut, is_undecided;
};

elvis_real core_above_plane(uint pixel, elvis_vec4 plane) {
    elvis_vec3 direction;
    return dot(plane.xyz, core_position(pixel, CORE_SAMPLE_DEPTH(core_samples, pixel), direction)) + plane.w;
}

// How much that changes from the pixel to its neighbours on the surface, which tells how steep the surface is seen.
elvis_real core_change_above_plane(uint pixel, elvis_vec4 plane, elvis_real above) {
    const ivec2 place = ivec2(pixel % core_width, pixel / core_width), last = ivec2(core_width, core_n_pixels / core_width) - 1;
    elvis_real change = elvis_real(0);
    for (int i = 0; i < 4; ++i) {
        const ivec2 there = clamp(place + (i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5)), ivec2(0), last);
        const uint other = uint(there.y) * core_width + uint(there.x);
        change = CORE_MARK(core_old_marks, other).owner != 0u ? max(change, abs(core_above_plane(other, plane) - above)) : change;
    }
    return change;
}

core_clipping core_clipping_at(uint pixel) {
    elvis_vec3 direction;
    const elvis_real depth = CORE_SAMPLE_DEPTH(core_samples, pixel);
    const elvis_real reach = abs(depth) + length(core_position(pixel, depth, direction));
    const uint flags = CORE_MARK(core_old_marks, pixel).flags;
    const elvis_real off_surface = (flags & CORE_FLAG_VAGUE) == 0u       ? elvis_real(0)
                                   : (flags & CORE_FLAG_UNDECIDED) == 0u ? core_near.y
                                                                         : CORE_FAR;
    bool is_cut = false, is_surely_cut = false, is_open = false;
    for (uint i = 0u; i < core_n_clips; ++i) {
        const elvis_vec4 plane = core_special(9u + i);
        const elvis_real above = core_above_plane(pixel, plane);
        const elvis_real error = (CORE_HEIGHT_ERROR * reach + off_surface) * length(plane.xyz) +
                                 CORE_PLACE_ERROR * core_change_above_plane(pixel, plane, above);
        is_cut = is_cut || above < elvis_real(0);
        is_surely_cut = is_surely_cut || above < -error;
        is_open = is_open || abs(above) <= error;
    }
    return core_clipping(is_cut, is_open && !is_surely_cut);
}
#endif

// The isovalue nearest to a value, of which there is at least one, and the colour of its contour.
elvis_vec4 core_nearest_isovalue(elvis_real value) {
    elvis_vec4 nearest = core_special(9u + core_n_clips);
    elvis_real distance = elvis_real(3.0e38LF);
    for (uint i = 0u; i < core_n_isovalues; ++i) {
        const elvis_vec4 isovalue = core_special(9u + core_n_clips + i);
        nearest = abs(isovalue.x - value) < distance ? isovalue : nearest;
        distance = min(distance, abs(isovalue.x - value));
    }
    return nearest;
}

#if CORE_HAS_LINES
struct core_lines {
    bool is_contour, is_contour_undecided, is_mesh_line, is_mesh_undecided;
};

// Whether there is a line, or it is open whether there is one: in the pixel, or so near to its middle.
struct core_line_here {
    bool is_met, is_undecided;
};

core_line_here core_line_near(uint pixel, uint kind, float reach, uint met, uint open) {
    const uint flags = CORE_MARK(core_old_marks, pixel).flags;
    core_line_here line = core_line_here((flags & met) != 0u, (flags & open) != 0u);
#if CORE_HAS_WIDE_LINES
    const ivec2 size = ivec2(core_width, core_n_pixels / core_width), place = ivec2(pixel % core_width, pixel / core_width);
    // What meets a pixel is no farther from its middle than its corners are.
    const int most = reach > 0.5 ? int(reach + 0.7072) : 0;
    const ivec2 first = max(place - most, ivec2(0)), last = min(place + most, size - 1);
    for (int row = first.y; row <= last.y && most > 0; ++row) {
        for (int column = first.x; column <= last.x; ++column) {
            const uint word = CORE_WORD(core_stretches, 2u * (uint(row) * core_width + uint(column)) + kind);
            if (word != 0u) {
                const vec2 to_here = vec2(place - ivec2(column, row));
                const float square = core_square_to_stretch(to_here, core_stretch_begin(word), core_stretch_end(word));
                const bool is_near = square <= reach * reach, is_decided = (word & CORE_STRETCH_DECIDED) != 0u;
                line.is_met = line.is_met || (is_near && is_decided);
                line.is_undecided = line.is_undecided || (is_near && !is_decided);
            }
        }
    }
#endif
    return line;
}

// Pixels of which it is open whether they meet a line are drawn as if they did, unless they have a colour of their own or are to be
// left out.
core_lines core_lines_at(uint pixel) {
    core_lines lines;
    // As in picture/line_stretch.glsl.
    const core_line_here contour = core_line_near(pixel, 0u, core_contour_reach, CORE_FLAG_CONTOUR, CORE_FLAG_CONTOUR_UNDECIDED);
    const core_line_here mesh = core_line_near(pixel, 1u, core_mesh_reach, CORE_FLAG_MESH_LINE, CORE_FLAG_MESH_UNDECIDED);
    lines.is_contour_undecided = contour.is_undecided;
    lines.is_contour =
        contour.is_met ||
        (lines.is_contour_undecided && (core_contour_style & (CORE_STYLE_UNDECIDED | CORE_STYLE_ONLY_DECIDED)) == 0u);
    lines.is_mesh_undecided = mesh.is_undecided;
    lines.is_mesh_line = mesh.is_met || (lines.is_mesh_undecided && (core_mesh_style & CORE_STYLE_UNDECIDED) == 0u);
    return lines;
}

// Lines have their colours whatever the light. What is decided goes over what is not, contours over mesh lines.
elvis_vec4 core_with_lines(elvis_vec4 color, core_lines lines, elvis_vec4 contour_color) {
    const bool has_contour_color = lines.is_contour && (core_contour_style & CORE_STYLE_COLOR) != 0u;
    const bool shows_undecided_contour =
        lines.is_contour_undecided && !lines.is_contour && (core_contour_style & CORE_STYLE_UNDECIDED) != 0u;
    const bool has_mesh_color = lines.is_mesh_line && (core_mesh_style & CORE_STYLE_COLOR) != 0u;
    color = lines.is_mesh_undecided && !lines.is_mesh_line ? core_special(6u) : color;
    color = has_mesh_color ? core_special(5u) : color;
    color = shows_undecided_contour ? core_special(4u) : color;
    return has_contour_color ? contour_color : color;
}
#endif

// How many of the table's points, at most `n_points`, are not above the value.
uint core_points_up_to(elvis_real value, uint n_points) {
    uint low = 0u, high = n_points;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        const bool is_below = CORE_ROW(core_rows, middle).x <= value;
        low = is_below ? middle + 1u : low;
        high = is_below ? high : middle;
    }
    return low;
}

// What a pixel shows of its surface.
struct core_shown {
    elvis_real value;
    // There is something that is not cut away; it lies in no element.
    bool is_seen, is_outside;
    // The value is no number; it has no place on the table's scale; it is below the table.
    bool is_nan, has_no_place, is_below;
};

// The table's colour, or one of those for what has none there.
elvis_vec4 core_table_color(inout core_shown shown, bool is_drawn) {
    const uint low = core_points_up_to(shown.value, is_drawn && !shown.is_nan && !shown.is_outside ? core_n_points : 0u);
    const elvis_vec4 from = CORE_ROW(core_rows, low > 0u ? low - 1u : 0u);
    const elvis_vec4 to = CORE_ROW(core_rows, min(low, core_n_points - 1u));
    const elvis_real extent = to.x - from.x;
    const elvis_real t = extent > elvis_real(0) ? (shown.value - from.x) / extent : elvis_real(0);
    shown.is_below = low == 0u;
    const bool is_above = low == core_n_points && shown.value > from.x;
    const uint special = shown.is_seen ? (shown.has_no_place ? 2u : (shown.is_below ? 0u : 1u)) : 3u;
    const bool is_special = !shown.is_seen || shown.has_no_place || shown.is_below || is_above;
    const elvis_vec4 color = is_special ? core_special(special) : elvis_vec4(from.yzw + t * (to.yzw - from.yzw), elvis_real(1));
    return shown.is_seen && shown.is_outside ? elvis_vec4(core_special(7u).yzw, elvis_real(1)) : color;
}

#if CORE_IS_LIT
elvis_vec3 core_lit_at(uint pixel, elvis_vec3 color) {
    elvis_vec3 direction;
    const elvis_vec3 position = core_position(pixel, CORE_SAMPLE_DEPTH(core_samples, pixel), direction);
    const elvis_vec3 normal = core_is_plane != 0u ? core_plane_normal.xyz : CORE_REAL3(core_normals, 3u * pixel);
    return core_lit(color, normal, position, -normalize(direction));
}
#endif

// Of a pixel that is seen: what core_special_values tells of the surface.
void core_note_special(core_shown shown, elvis_vec4 limits) {
    const bool is_far = !shown.is_outside && (shown.value < limits.y || shown.value > limits.z);
    if (shown.has_no_place || is_far) {
        core_special_values[4u * core_surface_number + (shown.has_no_place ? 2u : (shown.is_below ? 0u : 1u))] = 1u;
    }
    // Few write what nearly all would.
    if (core_special_values[4u * core_surface_number + 3u] == 0u) {
        core_special_values[4u * core_surface_number + 3u] = 1u;
    }
}

void main() {
    const uint pixel = gl_WorkGroupID.y * core_groups_x * CORE_GROUP_SIZE + gl_GlobalInvocationID.x;
    const bool is_inside = pixel < core_n_pixels;
    const uint owner = is_inside ? CORE_MARK(core_old_marks, pixel).owner : 0u;
    const bool is_drawn = owner != 0u;
    core_shown shown = core_shown(elvis_real(0), is_drawn, false, false, false, false);
#if CORE_HAS_LINES
    core_lines lines = core_lines(false, false, false, false);
    elvis_vec4 contour_color = elvis_vec4(0);
#endif
    if (is_drawn) {
        shown.value = CORE_SAMPLE_VALUE(core_samples, pixel);
        shown.is_seen = (CORE_MARK(core_old_marks, pixel).flags & CORE_FLAG_CUT) == 0u;
        shown.is_outside = CORE_SAMPLE_NUMBER(core_samples, pixel) == CORE_NO_NUMBER;
#if CORE_HAS_LINES
        lines = core_lines_at(pixel);
#endif
    }
    uint doubt = 0u;
#if CORE_IS_CLIPPED
    if (is_drawn) {
        const core_clipping clipping = core_clipping_at(pixel);
        shown.is_seen = shown.is_seen && !clipping.is_cut;
        doubt = clipping.is_undecided ? (clipping.is_cut ? CORE_FLAG_UNDECIDED_IN_FRONT : CORE_FLAG_UNDECIDED) : 0u;
    }
#endif
    shown.is_nan = !core_is_finite(shown.value) && !shown.is_outside;
#if CORE_HAS_LINES
    if (lines.is_contour) {
        const elvis_vec4 isovalue = core_nearest_isovalue(shown.value);
        shown.value = shown.is_nan || (core_contour_style & CORE_STYLE_COLOR) != 0u ? shown.value : isovalue.x;
        contour_color = elvis_vec4(isovalue.yzw, elvis_real(1));
    }
#endif
    const elvis_vec4 limits = core_special(8u);
    shown.has_no_place = shown.is_nan || (shown.value <= limits.x && !shown.is_outside);
    elvis_vec4 color = core_table_color(shown, is_drawn);
    if (shown.is_seen) {
#if CORE_IS_LIT
        // A colour that says "no element here" stays as it is.
        color.xyz = shown.is_outside ? color.xyz : core_lit_at(pixel, color.xyz);
#endif
#if CORE_IS_SHADED
        color.xyz *= shown.is_outside || shown.has_no_place ? elvis_real(1) : CORE_REAL(core_shades, pixel);
#endif
        core_note_special(shown, limits);
#if CORE_HAS_LINES
        color = core_with_lines(color, lines, contour_color);
#endif
        color.w *= core_special(7u).x;
    }
    if (is_inside) {
        core_colors[pixel] = color;
    }

    // On a face that no other element shares the domain may end; on one that is shared the field may have two values.
    const bool is_on_face = (owner & CORE_OWNER_ON_FACE) != 0u;
    const bool is_undecided = is_on_face && ((owner & CORE_OWNER_SHARED) == 0u || (owner & CORE_OWNER_AMBIGUOUS) != 0u);
    const bool is_overlap = (owner & CORE_OWNER_OVERLAP) != 0u;
    const uint flags = core_common_flags | doubt | (shown.is_nan ? CORE_FLAG_NAN : 0u) |
                       (is_undecided || is_overlap ? CORE_FLAG_UNDECIDED : 0u) | (is_overlap ? CORE_FLAG_OVERLAP : 0u);
    if (is_drawn && flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
}
