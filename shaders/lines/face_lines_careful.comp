// Which of the listed pixels surely meet a line, or none, on faces of one class: those that lines/face_lines.comp leaves open, at
// silhouettes and sharp edges, and where something may hide a part of the pixel.
//
// Patches of faces (boundary/face_patch.glsl) that reach into the pyramid of the pixel's rays are divided in the directions of their
// parameters. Squares are dropped that lie outside of the pyramid, and whatever is seen of those is no line if the field takes no
// isovalue on them, and they touch no edge of the face. A square that is not dropped is halved in both directions until it is
// smaller than the pixel halved core_subdivisions times; if one is left, the pixel stays undecided. What is hidden counts, too: a
// pixel may stay undecided for its sake, but is never wrong. Of a closed boundary, though, rays enter and leave the volume by
// turns: all that they meet first they enter by, or all leave by, as the pixel's own ray; squares that are met the other way are
// dropped, too.
//
// A square of the face that the pixel shows may lie inside of the pyramid as a whole, facing the viewer like the pixel's point. Then
// a line on it is met.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "picture/cut_frame.glsl"
#include "boundary/face_patch.glsl"
#include "tiles/hierarchy.glsl"
#include "lines/listed_pixel.glsl"
#include "lines/pixel_pyramid.glsl"
#include "lines/subpixel.glsl"
#if CORE_WITH_CONTOURS
#include "field/shown_model.glsl"
#endif

#define CORE_WORK_LIMIT 3000u
// Levels of squares: from a patch that fills the picture down to subpixels.
#define CORE_MAX_LEVEL 15u

// Nodes of the hierarchy, and squares of one patch, that are still to be looked at.
uint core_stack[CORE_STACK_SIZE];
uint core_squares[3u * CORE_MAX_LEVEL + 4u];

// A square that is waiting, in one word.
uint core_packed_square(uint level, uint across, uint down) { return level | (across << 4) | (down << 18); }

// All in scalars: see Loops in README.md.
struct core_patch_search {
    core_line_marks lines;
    uint stack_size, n_squares, patch_index;
    uint work, n_evaluations;
};

// What the pixel's rays see first.
struct core_pixel_view {
    core_pyramid pyramid;
    core_cut_ray ray;
    elvis_vec3 point;
    // Parameter of that point, the size of coordinates that the ray has there, and that of the smallest squares.
    elvis_real t, far, least_size;
    core_place place;
    // 1 if the ray enters the element there, else -1: squares that rays cross the other way are hidden, if the boundary is closed.
    elvis_real away;
    // The element is of this class, and nothing hides a part of the pixel.
    bool may_find;
};

core_pixel_view core_pixel_view_of(core_listed_pixel listed) {
    const core_cut_column along = core_cut_begin(listed.column);
    const elvis_vec3 terms = (along.size + abs((listed.row - along.row0) * along.base_row)).xyz + abs(core_reference_in_hierarchy.xyz);
    core_pixel_view view;
    view.ray = listed.ray;
    view.point = listed.tangent.point;
    view.t = core_shown_t(listed.pixel, listed.ray);
    view.far = max(max(terms.x, terms.y), terms.z);
    view.pyramid = core_pixel_pyramid(listed.column, listed.row, view.t);
    const elvis_real pixel_size = min(length(core_base_column.xyz + view.t * core_direction_column.xyz),
                                      length(core_base_row.xyz + view.t * core_direction_row.xyz));
    view.least_size = pixel_size / elvis_real(1u << core_subdivisions);
    view.place = core_places[listed.pixel];
    view.away = (view.place.class_and_face & CORE_PLACE_ENTERS) != 0u ? elvis_real(1) : elvis_real(-1);
    view.may_find = core_class_of(view.place) == core_class && !listed.around.is_hidden;
    return view;
}

void core_next_patch(core_pixel_view view, inout core_patch_search search) {
    while (search.n_squares == 0u && search.stack_size > 0u) {
        search.stack_size -= 1u;
        const core_node node = core_fetch_node(core_stack[search.stack_size]);
        const float size = max(max(max(abs(node.lower.x), abs(node.lower.y)), abs(node.lower.z)),
                               max(max(abs(node.upper.x), abs(node.upper.y)), abs(node.upper.z)));
        const float error = 16.0 * CORE_FLOAT_ROUNDOFF * (float(view.far) + size);
        const bool is_touched = !core_box_outside_pyramid(view.pyramid, node, error);
        if (is_touched && !node.is_leaf) {
            core_stack[search.stack_size] = node.child + 1u;
            core_stack[search.stack_size + 1u] = node.child;
            search.stack_size += 2u;
        }
        search.patch_index = is_touched && node.is_leaf ? node.child : search.patch_index;
        search.n_squares = is_touched && node.is_leaf ? 1u : 0u;
        core_squares[0] = 0u;
        if (search.n_squares > 0u || search.stack_size == 0u) {
            break;
        }
    }
}

#if CORE_HAS_TWO_DIMENSIONS
// Both sides of a flat element face the viewer.
bool core_is_crossed_towards(elvis_real side, core_frame frame, int face, elvis_real change, elvis_vec3 direction) {
    return side < elvis_real(0);
}
#else
// Whether all rays of the pixel certainly leave the element by its face near a point, if `side` is 1, or enter it, if that is -1.
// `change`: by how much the Jacobian may differ there, relative to the one at the point.
bool core_is_crossed_towards(elvis_real side, core_frame frame, int face, elvis_real change, elvis_vec3 direction) {
    const elvis_vec3 outward = core_face_constraint(face).xyz;
    const elvis_vec3 ray = core_to_xi(frame, direction);
    const elvis_vec3 next = core_to_xi(frame, elvis_real(0.5LF) * core_direction_column.xyz);
    const elvis_vec3 below = core_to_xi(frame, elvis_real(0.5LF) * core_direction_row.xyz);
    const elvis_vec3 size = abs(ray) + abs(next) + abs(below);
    const elvis_real error = core_model_norm1(outward) * max(max(size.x, size.y), size.z) * change / (elvis_real(1) - change);
    const elvis_real least = side * dot(outward, ray) - abs(dot(outward, next)) - abs(dot(outward, below));
    return frame.is_sound && change < elvis_real(0.5LF) && least > error;
}
#endif

struct core_patch_square {
    uint element;
    int face;
    uint level, across, down;
    // In reference coordinates the square is xi + [-1, 1] a + [-1, 1] b.
    elvis_vec3 xi, a, b;
    // It lies beyond the diagonal of a triangle as a whole. It reaches to an edge of the face.
    bool is_beyond_diagonal, touches_edge;
};

core_patch_square core_patch_square_at(uint patch_index, uint word) {
    const uvec4 more = elvis_fetch4_core_patches(patch_index, 4u), of_face = elvis_fetch4_core_faces(more.z, 0u);
    const core_square of_patch = core_square_of(more.w);
    core_patch_square square;
    square.element = of_face.x;
    square.face = int(of_face.y);
    square.level = word & 15u;
    square.across = (word >> 4) & 16383u;
    square.down = word >> 18;
    const core_face frame = core_face_frame(square.face);
    const elvis_real half_size = elvis_real(of_patch.size) / elvis_real(1u << square.level), half_one = elvis_real(0.5LF);
    const elvis_real u = elvis_real(of_patch.a) - elvis_real(of_patch.size) + elvis_real(2u * square.across + 1u) * half_size;
    const elvis_real v = elvis_real(of_patch.b) - elvis_real(of_patch.size) + elvis_real(2u * square.down + 1u) * half_size;
    square.xi = frame.corner + ((u + elvis_real(1)) * half_one) * frame.a + ((v + elvis_real(1)) * half_one) * frame.b;
    square.a = (half_size * half_one) * frame.a;
    square.b = (half_size * half_one) * frame.b;
    square.is_beyond_diagonal = of_patch.is_diagonal && u + v - elvis_real(2) * half_size >= elvis_real(0);
    const elvis_real edge = max(abs(u), abs(v)) + half_size;
    square.touches_edge = edge >= elvis_real(1) - elvis_real(16) * CORE_ROUNDOFF ||
                          (frame.is_triangle && u + v + elvis_real(2) * half_size >= elvis_real(-16) * CORE_ROUNDOFF);
    return square;
}

// What the pixel sees of a square.
struct core_square_sight {
    core_region region;
    // All of it is out of sight. All of it is seen, on the side that the pixel shows.
    bool is_absent, is_seen;
    bool is_small;
};

core_square_sight core_square_sight_of(core_pixel_view view, core_patch_square square, core_element_image image, bool is_shown) {
    const elvis_vec3 a = square.a, b = square.b, most = abs(a) + abs(b);
    const elvis_real radius = max(max(most.x, most.y), most.z) + elvis_real(8) * CORE_ROUNDOFF;
    core_square_sight sight;
    sight.region = core_region(-a - b, a - b, b - a, a + b, elvis_real(8) * CORE_ROUNDOFF, radius);
    // Points of the square are off its linear image by J times the error of a Newton step.
    const elvis_vec3 image_a = image.jacobian * a, image_b = image.jacobian * b, middle = image.position - image.shift;
    const elvis_real stretch = length(image.jacobian[0]) + length(image.jacobian[1]) + length(image.jacobian[2]);
    const elvis_real noise =
        elvis_real(8) * CORE_ROUNDOFF * (view.far + length(image.shift) + length(image.position) + stretch);
    const elvis_real error = image.curvature * radius * radius * stretch + noise;

    // element/prediction.glsl
    const core_frame inverse = core_frame_at(image.position, image.jacobian, noise);
    const elvis_real change =
        elvis_real(2) * image.curvature * radius + max(max(inverse.xi_error.x, inverse.xi_error.y), inverse.xi_error.z);
    const elvis_vec3 direction = view.ray.direction;
    sight.is_absent = square.is_beyond_diagonal || core_is_outside_pyramid(view.pyramid, middle, image_a, image_b, error) ||
                      (core_is_closed != 0u && core_is_crossed_towards(view.away, inverse, square.face, change, direction));
    const elvis_real both_errors = elvis_real(2) * error;
    const bool is_in_front =
        dot(direction, middle - view.point) + (view.t + core_reference.w) * dot(direction, direction) >
        length(direction) * (length(image_a) + length(image_b) + both_errors);
    sight.is_seen = is_shown && is_in_front && core_is_inside_pyramid(view.pyramid, middle, image_a, image_b, both_errors) &&
                    core_is_crossed_towards(-view.away, inverse, square.face, change, direction);
    sight.is_small = max(length(image_a), length(image_b)) <= elvis_real(0.5LF) * view.least_size ||
                     square.level >= CORE_MAX_LEVEL - 1u;
    return sight;
}

// The element's own boundary is an edge, too: beyond it there is nothing of the face.
struct core_own_edge {
    bool is_beyond, is_touched, is_crossed;
};

core_own_edge core_own_edge_in(core_patch_square square, core_region region) {
    core_own_edge own = core_own_edge(false, false, false);
#if ELVIS_HAS_INSIDE
    const core_inside g = core_inside_at(square.element, square.xi);
    const elvis_real along_a = abs(dot(g.slope, square.a)), along_b = abs(dot(g.slope, square.b));
    const elvis_real slack = core_inside_bend(g, region.radius) + core_model_norm1(g.slope) * region.beyond + g.rounding;
    own.is_beyond = g.value - along_a - along_b > slack;
    own.is_touched = g.value + along_a + along_b > -slack;
    own.is_crossed = g.value + along_a + along_b > slack && g.value - along_a - along_b < -slack;
#endif
    return own;
}

// Looks for lines in the square on top, and divides it where that does not decide.
void core_ask_square(core_pixel_view view, inout core_patch_search search) {
    const bool is_active = search.n_squares > 0u;
    search.n_squares -= is_active ? 1u : 0u;
    const core_patch_square square = core_patch_square_at(search.patch_index, core_squares[search.n_squares]);
    const core_element_image image = core_element_image_at(square.element, square.xi);
    search.n_evaluations += is_active ? 1u : 0u;
    const bool is_shown = view.may_find && square.element == view.place.element && square.face == core_face_of(view.place);
    const core_square_sight sight = core_square_sight_of(view, square, image, is_shown);
    const core_own_edge own = core_own_edge_in(square, sight.region);
    const bool is_judged = is_active && !sight.is_absent && !own.is_beyond;

    core_line_marks lines = search.lines;
    const bool finds_mesh =
        is_judged && lines.wants_mesh && sight.is_seen && ((square.touches_edge && !own.is_touched) || own.is_crossed);
    const bool leaves_mesh =
        is_judged && lines.wants_mesh && (square.touches_edge || own.is_touched) && (is_shown || !lines.is_mesh_open);
    bool finds_contour = false, leaves_contour = false;
#if CORE_WITH_CONTOURS
    elvis_real value;
    const core_model model = core_shown_model(square.element, square.xi, sight.region, value);
    const core_isovalue_test test = core_test_isovalues(model, sight.region);
    finds_contour = is_judged && lines.wants_contour && sight.is_seen && !own.is_touched && test.is_met;
    leaves_contour = is_judged && lines.wants_contour && !test.is_excluded && (is_shown || !lines.is_contour_open);
    const bool has_estimate = is_judged && core_is_model_estimated(square.element);
    lines.is_estimated = lines.is_estimated || has_estimate;
#endif
    core_leave_open(lines, leaves_contour && sight.is_small, leaves_mesh && sight.is_small);
    core_find_lines(lines, finds_contour, finds_mesh);
    // Only what is seen could still decide what is open.
    lines.wants_contour = lines.wants_contour && (view.may_find || !lines.is_contour_open);
    lines.wants_mesh = lines.wants_mesh && (view.may_find || !lines.is_mesh_open);
    search.lines = lines;
    if ((leaves_contour || leaves_mesh) && !sight.is_small) {
        for (uint k = 0u; k < 4u; ++k) {
            core_squares[search.n_squares] =
                core_packed_square(square.level + 1u, 2u * square.across + (k & 1u), 2u * square.down + (k >> 1));
            search.n_squares += 1u;
        }
    }
}

bool core_has_more(core_patch_search search) { return search.n_squares > 0u || search.stack_size > 0u; }

void main() {
    const core_listed_pixel listed = core_listed_pixel_here();
    const core_pixel_view view = core_pixel_view_of(listed);
    core_stack[0] = 0u;
    core_patch_search search =
        core_patch_search(listed.lines, core_wants_lines(listed.lines) ? 1u : 0u, 0u, 0u, 0u, 0u);
    while (core_wants_lines(search.lines) && core_has_more(search) && search.work < CORE_WORK_LIMIT) {
        search.work += 1u;
        core_next_patch(view, search);
        core_ask_square(view, search);
        if (!core_wants_lines(search.lines) || !core_has_more(search)) {
            break;
        }
    }
    core_answer(listed, search.lines, core_has_more(search));
    core_count_evaluations(search.n_evaluations);
}
