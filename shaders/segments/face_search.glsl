// Where a ray enters an element through its faces, in elements so curved that a point outside of them may be taken for the ray's
// (core_segment_enter): all such places, as far as the faces' curvatures hold (segments/face_cone.glsl), or the word that this cannot be
// told.
//
// The parameters s and r of a face fill a square, or half of one (element/face_frame.glsl). In the middle of a square, with half of its
// side h, the face's tangents and normal are a frame in which the ray is a line. With the curvature C, the points of the face in the
// square are within C h^2 of its tangent plane, and along the ray the height above the face changes as there, but for a share of
// 2 C h / (1 - 2 C h) of the ray's motion. That tells
//
//   the line passes the square farther away     the ray does not meet it
//   the height surely grows                     the ray only leaves there
//   the height surely falls                     it enters there once at most: Newton's method tells where
//   else                                        the square is cut in four
//
// Through a face whose normals lie within a cone the ray enters once at most. Where Newton's method finds it to meet what continues such a
// face beyond an edge, nearer than the normals may leave the cone, it does not meet the face.
//
// The kernel brings segments/segment.glsl.

#include "element/face_frame.glsl"

// How often a square is cut; evaluations in a face; Newton steps from a square.
#if ELVIS_REAL_IS_DOUBLE
#define CORE_SQUARE_LEVELS 15
#else
#define CORE_SQUARE_LEVELS 12
#endif
#define CORE_FACE_EVALUATIONS 400u
#define CORE_FACE_STEPS 8u
// Longest step of Newton's method that is followed.
#define CORE_FACE_REACH elvis_real(2)
// Squares: the first one, and what comes behind the last one.
#define CORE_WHOLE_FACE 1u
#define CORE_NO_SQUARE 2u

struct core_face_search {
    // Bits of the faces that are still to be searched; those through which the ray surely enters, and so does once
    // (segments/start_bounds.glsl).
    uint open, once;
    // Of the first open face. The quarters of a square are 4 square to 4 square + 3.
    uint square;
    // In the face; of Newton's method from the square, 0 before that.
    uint n_evaluations, n_steps;
    // By the height there is one entry in the square at most.
    bool is_single;
    // Where Newton's method has got to.
    elvis_real s, r;
};

// What an evaluation has told.
struct core_face_entry {
    bool is_found, is_undecided;
    elvis_real t, error;
};

struct core_face_square {
    // Of its middle.
    elvis_real s, r;
    elvis_real half_side;
    int level;
    // Of a triangle's square, half is not in the face.
    bool is_in_face;
};

uint core_even_bits(uint word) {
    word &= 0x55555555u;
    word = (word | word >> 1u) & 0x33333333u;
    word = (word | word >> 2u) & 0x0f0f0f0fu;
    word = (word | word >> 4u) & 0x00ff00ffu;
    return (word | word >> 8u) & 0x0000ffffu;
}

core_face_square core_square_of(bool is_triangle, uint square) {
    const int level = findMSB(square) / 2;
    const uint n = 1u << level, place = square ^ (1u << (2 * level));
    const uint column = core_even_bits(place), row = core_even_bits(place >> 1u);
    const elvis_real half_side = elvis_real(0.5LF) / elvis_real(n);
    return core_face_square(half_side * elvis_real(2u * column + 1u), half_side * elvis_real(2u * row + 1u), half_side, level,
                            !is_triangle || column + row < n);
}

// The next one that is not in this one.
uint core_next_square(uint square) { return (square + 1u) >> (findLSB(square + 1u) & ~1); }

// Cuts off from an interval where |value + t rate| is above `most`.
void core_cut_slab(elvis_real value, elvis_real rate, elvis_real most, inout elvis_real from, inout elvis_real to) {
    const elvis_real inverse = elvis_real(1) / max(abs(rate), elvis_real(1e-30LF));
    const elvis_real middle = (rate < elvis_real(0) ? value : -value) * inverse;
    from = max(from, middle - most * inverse);
    to = min(to, middle + most * inverse);
}

// By how much the point is outside of the face.
elvis_real core_face_excess(bool is_triangle, elvis_real s, elvis_real r) {
    return max(-min(s, r), (is_triangle ? s + r : max(s, r)) - elvis_real(1));
}

// Within this distance, by how much the height may change otherwise along a ray that moves by `motion` in a frame.
elvis_real core_height_change(elvis_real motion, elvis_real curvature, elvis_real distance) {
    const elvis_real share = elvis_real(2) * curvature * distance;
    return share < elvis_real(0.5LF) ? motion * share / (elvis_real(1) - share) : elvis_real(1e30LF);
}

elvis_real core_face_curvature(uint element, int face) {
    return elvis_real(core_unpack_face_curvature(elvis_fetch_core_cones(element, CORE_CONE_CURVATURES + uint(face) / 3u), face));
}

// One evaluation, in the first open face. Entries before `from` and behind `to` need not be found.
core_face_entry core_search_face(const core_traced_ray ray, uint element, elvis_real from, elvis_real to, inout core_face_search search) {
    const int number = max(findLSB(search.open), 0);
    const core_face face = core_face_frame(number);
    const core_face_square square = core_square_of(face.is_triangle, search.square);
    const bool is_once = (search.once >> number & 1u) != 0u, is_stepping = search.n_steps > 0u;
    const elvis_real s = is_stepping ? search.s : square.s, r = is_stepping ? search.r : square.r;
    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, face.corner + s * face.a + r * face.b, position, jacobian);
    const core_frame frame = core_frame_at(position, core_face_tangents(face, jacobian), ray.error);
    const elvis_real curvature = core_face_curvature(element, number);

    // The ray in the frame: s, r and the height, from the point of the face. The nearest parameter rounds least.
    const elvis_real near =
        dot(position - core_segment_target(ray, element, elvis_real(0)), ray.direction) / dot(ray.direction, ray.direction);
    const elvis_vec3 at = core_to_xi(frame, core_segment_target(ray, element, near) - position);
    const elvis_vec3 slope = core_to_xi(frame, ray.direction);
    const elvis_real motion = core_max_norm(slope), noise = core_max_norm(frame.xi_error);
    const bool is_sound = frame.is_sound && core_is_finite(at.x + at.y + at.z);

    // What the square may hold.
    const elvis_real half_side = square.half_side, bend = curvature * half_side * half_side;
    elvis_real first = from - near, last = to - near;
    core_cut_slab(at.x, slope.x, half_side + bend + noise, first, last);
    core_cut_slab(at.y, slope.y, half_side + bend + noise, first, last);
    core_cut_slab(at.z, slope.z, bend + frame.xi_error.z, first, last);
    const elvis_real change = core_height_change(motion, curvature, half_side);
    const bool is_empty = !square.is_in_face || (is_sound && (first > last || slope.z > change));
    const bool is_single = is_stepping ? search.is_single : slope.z < -change;
    const bool begins = !is_stepping && !is_empty && is_sound && (is_single || is_once);

    // Where Newton's method leads.
    const elvis_real root = near - at.z / slope.z;
    const elvis_real next_s = s + at.x + (root - near) * slope.x, next_r = r + at.y + (root - near) * slope.y;
    const elvis_real step = max(abs(next_s - s), abs(next_r - r)), left = core_prediction_error(curvature, step);
    const elvis_real height = length(frame.row2);
    const bool is_there = is_stepping && is_sound && core_is_near(curvature, step) && left <= ray.tolerance * ray.speed * height;
    const elvis_real slack = elvis_real(2) * left + noise;
    const bool is_found = is_there && slope.z < elvis_real(0) && core_face_excess(face.is_triangle, next_s, next_r) <= slack;
    const elvis_real distance = max(abs(next_s - square.s), abs(next_r - square.r));
    // There is no other one in the square: this is the only one in the face or in the square, or from here on the height surely falls all
    // over the square.
    const bool is_only = (is_found && is_once) || (is_single && distance <= half_side + slack) ||
                         slope.z < -core_height_change(motion, curvature, distance + half_side);
    // The mapping is known in the element only.
    const elvis_real outside = face.is_triangle ? elvis_real(0.5LF) * max(next_s + next_r - elvis_real(1), elvis_real(0)) : elvis_real(0);
    const elvis_real inner_s = clamp(next_s - outside, elvis_real(0), elvis_real(1));
    const elvis_real inner_r = clamp(next_r - outside, elvis_real(0), face.is_triangle ? elvis_real(1) - inner_s : elvis_real(1));
    const bool moves = max(abs(inner_s - s), abs(inner_r - r)) > elvis_real(0.0625LF) * step;
    // The ray meets the face once at most; here it meets what continues it beyond an edge. Predictions are off in s and r as the
    // height moves along the ray.
    const elvis_real oblique = elvis_real(1) + max(abs(slope.x), abs(slope.y)) / max(abs(slope.z), elvis_real(1e-30LF));
    const elvis_real off = core_prediction_error(oblique * curvature, step) + oblique * noise;
    const bool is_beyond = is_once && is_stepping && is_sound && core_is_near(oblique * curvature, step) &&
                           slope.z < -core_height_change(motion, curvature, step + off) &&
                           core_face_excess(face.is_triangle, next_s, next_r) > elvis_real(2) * off;
    const bool has_stopped = is_stepping && (is_there || !is_sound || !core_is_finite(step) || step > CORE_FACE_REACH ||
                                             search.n_steps >= CORE_FACE_STEPS || !moves);

    const bool is_settled = is_stepping ? is_there && is_only : is_empty;
    const bool is_open = is_stepping ? has_stopped && !is_settled : !is_empty && !begins;
    // Smaller squares tell no more.
    const bool is_smallest = square.level >= CORE_SQUARE_LEVELS || (is_sound && bend < frame.xi_error.z);
    const bool is_left = is_settled || (is_open && is_smallest);
    search.n_evaluations += 1u;
    search.square = is_beyond ? CORE_NO_SQUARE : is_left ? core_next_square(search.square) : is_open ? 4u * search.square : search.square;
    search.n_steps = is_left || is_open ? 0u : search.n_steps + 1u;
    search.is_single = is_single;
    search.s = inner_s;
    search.r = inner_r;
    const bool is_done = (is_found && is_once) || search.square == CORE_NO_SQUARE;
    const bool is_given_up = !is_done && search.n_evaluations >= CORE_FACE_EVALUATIONS;
    if (is_done || is_given_up) {
        search.open &= search.open - 1u;
        search.square = CORE_WHOLE_FACE;
        search.n_evaluations = search.n_steps = 0u;
    }
    return core_face_entry(is_found, (is_open && is_smallest && !is_beyond) || is_given_up, root,
                           (left + frame.xi_error.z) / max(-slope.z, elvis_real(1e-30LF)));
}
