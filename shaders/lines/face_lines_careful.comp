// Which of the listed pixels surely meet a line, or none, on faces of one class: those that lines/surface_lines.comp leaves open, at
// silhouettes and sharp edges, and where something may hide a part of the pixel.
//
// Patches of faces (boundary/face_patch.glsl) that reach into the pyramid of the pixel's rays are divided in the directions of their
// parameters. Squares are dropped that lie outside of the pyramid, and those that show no line: on which the field takes no
// isovalue, and which touch no edge of the face. A square that is not dropped is divided in four until it is smaller than the smallest
// subpixels; if one is left then, the pixel stays undecided. What is hidden counts, too: a pixel may stay undecided for its sake, but is
// never wrong. Of a closed boundary, though, rays enter and leave the volume in turn: all that they meet first they enter by, or all
// leave by, as the pixel's own ray does. Squares that are met the other way are dropped, too. But where a square is met so near to the eye
// that it does not count (core_near), rays may begin on either side of the boundary: such a square leaves the pixel undecided.
//
// A square of the face that the pixel shows may lie inside of the pyramid as a whole, facing the viewer like the pixel's point and all of
// the face between. Then a line on it is met.

layout(local_size_x = 32) in;

#include "lines/listed_pixel.glsl"
#include "lines/pixel_pyramid.glsl"
#include "boundary/face_patch.glsl"
#include "lines/isovalue_test.glsl"
#include "lines/one_sheet.glsl"

#define CORE_WORK_LIMIT 3000u
// Levels of squares: from a patch that fills the picture down to subpixels.
#define CORE_MOST_LEVEL 15u

// Squares of the patch that are still to be looked at: level, column and row in one word.
uint core_squares[3u * CORE_MOST_LEVEL + 4u];

struct core_surface {
    core_listed_pixel listed;
    core_pyramid pyramid;
    // Parameter of the point that the pixel's own ray meets. Size of coordinates there, and of the smallest squares.
    elvis_real t, far, least_size;
    core_place place;
    // The place is of this class, and nothing hides a part of the pixel.
    bool may_find;
};

core_surface core_surface_in(core_listed_pixel listed) {
    const core_cut_column along = core_cut_begin(listed.column);
    const elvis_vec3 terms = (along.size + abs((listed.row - along.row0) * along.base_row)).xyz + abs(core_reference_in_hierarchy.xyz);
    const elvis_real t = core_shown_t(listed.pixel, listed.ray);
    const elvis_real pixel_size = min(length(core_base_column.xyz + t * core_direction_column.xyz),
                                      length(core_base_row.xyz + t * core_direction_row.xyz));
    const core_place place = core_places[listed.pixel];
    return core_surface(listed, core_pixel_pyramid(listed.column, listed.row, t), t, max(max(terms.x, terms.y), terms.z),
                        pixel_size / elvis_real(1u << core_subdivisions), place,
                        core_class_of(place) == core_class && !listed.around.may_be_hidden);
}

bool core_reaches(core_surface surface, core_node node) {
    const vec3 largest = max(abs(node.lower), abs(node.upper));
    const float size = max(max(largest.x, largest.y), largest.z);
    return core_box_reaches_pyramid(surface.pyramid, node, 16.0 * CORE_FLOAT_ROUNDOFF * (float(surface.far) + size));
}

void core_select_item(core_surface surface, uint patch_index, inout core_line_search search) {
    search.item = patch_index;
    search.n_squares = 1u;
    core_squares[0] = 0u;
}

// Whether all rays of the pixel certainly leave the element by its face near a point, if `side` is 1, or enter it, if that is -1. Both
// sides of an element of two dimensions face the viewer. `change`: by how much the Jacobian may differ there, relative to the one at the
// point.
bool core_is_crossed_towards(elvis_real side, core_frame frame, int face, elvis_real change, elvis_vec3 direction) {
#if CORE_HAS_TWO_DIMENSIONS
    return side < elvis_real(0);
#else
    const elvis_vec3 outward = core_face_constraint(face).xyz;
    const elvis_vec3 ray = core_to_xi(frame, direction);
    const elvis_vec3 next = core_to_xi(frame, elvis_real(0.5LF) * core_direction_column.xyz);
    const elvis_vec3 below = core_to_xi(frame, elvis_real(0.5LF) * core_direction_row.xyz);
    const elvis_vec3 size = abs(ray) + abs(next) + abs(below);
    const elvis_real error = core_model_norm1(outward) * max(max(size.x, size.y), size.z) * change / (elvis_real(1) - change);
    const elvis_real least = side * dot(outward, ray) - abs(dot(outward, next)) - abs(dot(outward, below));
    return frame.is_sound && change < elvis_real(0.5LF) && least > error;
#endif
}

struct core_face_square {
    uint element;
    int face;
    uint level, across, down;
    // In reference coordinates the square is xi + [-1, 1] a + [-1, 1] b.
    elvis_vec3 xi, a, b;
    // It lies beyond the diagonal of a triangle as a whole; a part of it does.
    bool is_beyond, is_partly_beyond;
    bool touches_edge;
};

core_face_square core_face_square_at(uint patch_index, uint word) {
    const uvec4 more = elvis_fetch4_core_patches(patch_index, 4u), of_face = elvis_fetch4_core_faces(more.z, 0u);
    const core_square of_patch = core_square_of(more.w);
    core_face_square square;
    square.element = of_face.x;
    square.face = int(of_face.y);
    square.level = word & 15u;
    square.across = (word >> 4) & 16383u;
    square.down = word >> 18;
    const core_face frame = core_face_frame(square.face);
    const elvis_real size = elvis_real(of_patch.size), half_size = size / elvis_real(1u << square.level);
    const elvis_real u = elvis_real(of_patch.a) - size + elvis_real(2u * square.across + 1u) * half_size;
    const elvis_real v = elvis_real(of_patch.b) - size + elvis_real(2u * square.down + 1u) * half_size;
    const elvis_real half_one = elvis_real(0.5LF);
    square.xi = frame.corner + ((u + elvis_real(1)) * half_one) * frame.a + ((v + elvis_real(1)) * half_one) * frame.b;
    square.a = (half_size * half_one) * frame.a;
    square.b = (half_size * half_one) * frame.b;
    square.is_beyond = of_patch.is_diagonal && u + v - elvis_real(2) * half_size >= elvis_real(0);
    square.is_partly_beyond = frame.is_triangle && u + v + elvis_real(2) * half_size > elvis_real(16) * CORE_ROUNDOFF;
    const elvis_real edge = max(abs(u), abs(v)) + half_size;
    square.touches_edge = edge >= elvis_real(1) - elvis_real(16) * CORE_ROUNDOFF ||
                          (frame.is_triangle && u + v + elvis_real(2) * half_size >= elvis_real(-16) * CORE_ROUNDOFF);
    return square;
}

// What the pixel sees of a square.
struct core_sight {
    core_region region;
    // The pixel sees nothing of it.
    bool is_absent;
    // The pixel sees all of it, on the side that it shows.
    bool is_seen;
    // It may be met before crossings count.
    bool may_precede;
    // It is as small as squares get.
    bool is_small;
};

core_sight core_sight_of(core_surface surface, core_face_square square, core_element_image image, bool is_shown) {
    const elvis_vec3 a = square.a, b = square.b, most = abs(a) + abs(b);
    const elvis_real radius = max(max(most.x, most.y), most.z) + elvis_real(8) * CORE_ROUNDOFF;
    core_sight sight;
    sight.region = core_region(-a - b, a - b, b - a, a + b, elvis_real(8) * CORE_ROUNDOFF, radius);
    // Points of the square are off its linear image by J times the error of a Newton step.
    const elvis_vec3 image_a = image.jacobian * a, image_b = image.jacobian * b, middle = image.position - image.shift;
    const elvis_real stretch = length(image.jacobian[0]) + length(image.jacobian[1]) + length(image.jacobian[2]);
    const elvis_real noise =
        elvis_real(8) * CORE_ROUNDOFF * (surface.far + length(image.shift) + length(image.position) + stretch);
    const elvis_real error = image.curvature * radius * radius * stretch + noise, both_errors = elvis_real(2) * error;

    // element/prediction.glsl
    const core_frame inverse = core_frame_at(image.position, image.jacobian, noise);
    const elvis_real change =
        elvis_real(2) * image.curvature * radius + max(max(inverse.xi_error.x, inverse.xi_error.y), inverse.xi_error.z);
    const elvis_real away = (surface.place.class_and_face & CORE_PLACE_ENTERS) != 0u ? elvis_real(1) : elvis_real(-1);
    const elvis_vec3 direction = surface.listed.ray.direction;
    const elvis_real speed = length(direction), reach = speed * (length(image_a) + length(image_b) + both_errors);
    const elvis_real ahead =
        dot(direction, middle - surface.listed.tangent.point) + (surface.t + core_reference.w) * dot(direction, direction);
    const bool is_in_front = ahead > reach;
    sight.may_precede = core_is_closed != 0u && ahead - reach <= speed * core_near.x && ahead + reach >= elvis_real(0);
    sight.is_absent = square.is_beyond ||
                      core_least_depth(surface.pyramid, elvis_real(1), middle, image_a, image_b, error) < elvis_real(0) ||
                      (core_is_closed != 0u && !sight.may_precede &&
                       core_is_crossed_towards(away, inverse, square.face, change, direction));
    sight.is_seen = is_shown && is_in_front &&
                    core_least_depth(surface.pyramid, elvis_real(-1), middle, image_a, image_b, both_errors) > elvis_real(0) &&
                    core_is_crossed_towards(-away, inverse, square.face, change, direction);
    sight.is_small = max(length(image_a), length(image_b)) <= elvis_real(0.5LF) * surface.least_size ||
                     square.level >= CORE_MOST_LEVEL - 1u;
    return sight;
}

// The element's own boundary is an edge, too: beyond it there is nothing of the face.
struct core_own_edge {
    bool is_beyond, is_touched, is_crossed;
};

core_own_edge core_own_edge_in(core_face_square square, core_region region) {
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

void core_divide(core_face_square square, inout core_line_search search) {
    for (uint k = 0u; k < 4u; ++k) {
        core_squares[search.n_squares] =
            (square.level + 1u) | ((2u * square.across + (k & 1u)) << 4) | ((2u * square.down + (k >> 1)) << 18);
        search.n_squares += 1u;
    }
}

// Looks for lines in the last square of the patch, and divides it where that does not decide.
void core_ask(core_surface surface, inout core_line_search search) {
    const bool is_active = search.item != CORE_NO_ITEM;
    search.n_squares -= is_active ? 1u : 0u;
    const core_face_square square = core_face_square_at(is_active ? search.item : 0u, core_squares[search.n_squares]);
    const core_element_image image = core_element_image_at(square.element, square.xi);
    search.n_evaluations += is_active ? 1u : 0u;
    const bool is_shown =
        surface.may_find && square.element == surface.place.element && square.face == core_face_of(surface.place);
    const core_sight sight = core_sight_of(surface, square, image, is_shown);
    const core_own_edge own = core_own_edge_in(square, sight.region);
    const bool is_judged = is_active && !sight.is_absent && !own.is_beyond;
    bool is_seen = is_judged && sight.is_seen;
    if (is_seen && !CORE_HAS_TWO_DIMENSIONS) {
        const elvis_vec3 shown = elvis_vec3(surface.place.x, surface.place.y, surface.place.z);
        const bool enters = (surface.place.class_and_face & CORE_PLACE_ENTERS) != 0u;
        is_seen = core_is_one_sheet(square.element, square.face, shown, square.xi, surface.listed.ray.direction, enters);
    }

    core_line_marks lines = search.lines;
    const core_isovalue_test test = core_isovalues_in(image, sight.region);
    const bool leaves_contour =
        is_judged && lines.wants_contour && (!test.is_excluded || sight.may_precede) && (is_shown || !lines.is_contour_open);
    const bool leaves_mesh =
        is_judged && lines.wants_mesh && (square.touches_edge || own.is_touched || sight.may_precede) && (is_shown || !lines.is_mesh_open);
    // Beyond the face its field goes on, but is not shown.
    const bool is_all_face = !square.is_partly_beyond && !own.is_touched;
    core_record_lines(lines, is_seen && lines.wants_contour && is_all_face && test.is_met,
                      is_seen && lines.wants_mesh && ((square.touches_edge && !own.is_touched) || own.is_crossed));
    core_leave_open(lines, leaves_contour && sight.is_small, leaves_mesh && sight.is_small);
    lines.is_estimated = lines.is_estimated || (is_judged && test.is_estimated);
    // Only what is seen could still decide what is open.
    lines.wants_contour = lines.wants_contour && (surface.may_find || !lines.is_contour_open);
    lines.wants_mesh = lines.wants_mesh && (surface.may_find || !lines.is_mesh_open);
    search.lines = lines;
    search.goes_on = core_is_looking(lines);
    if ((leaves_contour || leaves_mesh) && !sight.is_small) {
        core_divide(square, search);
    }
    search.item = search.n_squares > 0u ? search.item : CORE_NO_ITEM;
}

#include "lines/line_search.glsl"

void main() {
    const core_listed_pixel listed = core_listed_pixel_here();
    const core_surface surface = core_surface_in(listed);
    core_line_search search = core_begin_listed(listed, 0u, true, true);
    core_search_lines(surface, search);
    core_store_or_relist(listed, search);
}
