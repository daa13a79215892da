// What is known of the lines in one pixel, and how it is marked.

#ifndef CORE_LINE_MARKS
#define CORE_LINE_MARKS

#include "element/place.glsl"
#include "picture/samples.glsl"

// [0]: evaluations; others: entries of lists of pixels.
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5) CORE_READ_REALS(core_isovalues);

#include "arithmetic/count.glsl"

struct core_line_marks {
    // What is looked for, and not yet found.
    bool wants_contour, wants_mesh;
    bool has_contour, has_mesh_line;
    // Something is left of which it cannot be told whether it shows such a line.
    bool is_contour_open, is_mesh_open;
    // The answer rests on bounds that are estimates.
    bool is_estimated;
};

// Nothing is found yet of what is looked for.
core_line_marks core_no_lines_yet(bool wants_contour, bool wants_mesh) {
    return core_line_marks(wants_contour, wants_mesh, false, false, false, false, false);
}

bool core_is_looking(const core_line_marks lines) { return lines.wants_contour || lines.wants_mesh; }

void core_record_lines(inout core_line_marks lines, bool finds_contour, bool finds_mesh) {
    lines.has_contour = lines.has_contour || finds_contour;
    lines.has_mesh_line = lines.has_mesh_line || finds_mesh;
    lines.wants_contour = lines.wants_contour && !finds_contour;
    lines.wants_mesh = lines.wants_mesh && !finds_mesh;
}

void core_leave_open(inout core_line_marks lines, bool leaves_contour, bool leaves_mesh) {
    lines.is_contour_open = lines.is_contour_open || leaves_contour;
    lines.is_mesh_open = lines.is_mesh_open || leaves_mesh;
}

// Leaves open what was found, if it may not be seen.
void core_doubt_lines(bool is_doubtful, inout core_line_marks lines) {
    core_leave_open(lines, is_doubtful && lines.has_contour, is_doubtful && lines.has_mesh_line);
    lines.has_contour = lines.has_contour && !is_doubtful;
    lines.has_mesh_line = lines.has_mesh_line && !is_doubtful;
}

// What is not decided. Two truths, and no word of two bits that is compared with zero: NVIDIA's driver 580.159 was seen to lose all pixels
// of which both were open.
struct core_undecided {
    bool is_contour, is_mesh;
};

// `is_cut_short`: more would have been looked at.
core_undecided core_undecided_lines(const core_line_marks lines, bool is_cut_short) {
    return core_undecided(!lines.has_contour && (lines.is_contour_open || (lines.wants_contour && is_cut_short)),
                          !lines.has_mesh_line && (lines.is_mesh_open || (lines.wants_mesh && is_cut_short)));
}

bool core_is_any(const core_undecided open) { return open.is_contour || open.is_mesh; }

// Of a list.
uint core_word_of(uint pixel, const core_undecided open) {
    return pixel | (open.is_contour ? CORE_LIST_CONTOUR : 0u) | (open.is_mesh ? CORE_LIST_MESH_LINE : 0u);
}

// `undecided`: what stays so for good.
void core_mark_lines(uint pixel, const core_line_marks lines, const core_undecided undecided) {
    const uint flags = (lines.has_contour ? CORE_FLAG_CONTOUR : 0u) | (lines.has_mesh_line ? CORE_FLAG_MESH_LINE : 0u) |
                       (undecided.is_contour ? CORE_FLAG_CONTOUR_UNDECIDED : 0u) |
                       (undecided.is_mesh ? CORE_FLAG_MESH_UNDECIDED : 0u) |
                       (lines.is_estimated ? CORE_FLAG_ESTIMATED : 0u);
    if (flags != 0u) {
        core_marks[pixel].flags |= flags;
    }
}

#endif
