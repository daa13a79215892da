// The linear model of the mapping in an octant (isosurface/octant.glsl), its curvature there, and a box.
//
// The kernel brings core_words, which the records are written to, core_centre, that of the hierarchies, and core_curvatures.

#include "arithmetic/finite.glsl"
#include "element/bend_form.glsl"
#include "element/element_frame.glsl"
#include "element/face_frame.glsl"
#include "element/local_curvature.glsl"
#include "element/measured_curvature.glsl"
#include "isosurface/octant.glsl"

#define CORE_WORDS 32u
// Of elements that are nearly linear it is not measured for each octant.
#define CORE_SMALL_CURVATURE elvis_real(0.05LF)
// What is proven of the element holds in its octants. Where it is larger than this, what is measured of each octant is smaller by so much
// that pictures would take twice as long.
#define CORE_MOST_PROVEN_CURVATURE elvis_real(1)
// In elements with a curvature above CORE_MOST_MEASURED_CURVATURE the proven bound at the octant's point counts, where one is known.
// A linearization that leaves out more than this much of the octant's half side is of no use. With less than a quarter, the far solution of
// a prediction (element/prediction.glsl) lies 1/(2C) away or more, which is the octant's side: it lies outside of it. Octants that are
// small already, beside places where the mapping is nearly singular, would stay without a linear model.
#define CORE_SMALL_LEVEL 5u
#define CORE_MOST_BENDING(code) (((code) & 7u) < CORE_SMALL_LEVEL ? elvis_real(0.25LF) : elvis_real(0.5LF))

// Of elements with forms, octants are small enough if the curvature by N times half their length is below this: a quarter, and the far
// solution of a prediction from any point lies outside; it is less, because the curvature is another one there. The linearization may
// then leave out more.
#define CORE_MOST_BEND_BY_FORMS elvis_real(0.15LF)
#define CORE_MOST_BENDING_BY_FORMS elvis_real(2)

struct core_octant_place {
    // In reference coordinates; where the mapping and the field are linearized, in the shape; and the way from there to the middle.
    elvis_vec3 middle, xi, shift;
    elvis_real half_side;
    // Around xi; it holds all of the octant.
    elvis_real radius;
};

core_octant_place core_place_of(uint code) {
    core_octant_place place;
    place.middle = elvis_vec3(core_octant_middle(code));
    place.half_side = elvis_real(core_octant_half_side(code));
    place.xi = core_projected(place.middle);
    place.shift = place.middle - place.xi;
    place.radius = place.half_side + core_max_norm(place.shift);
    return place;
}

struct core_octant_mapping {
    core_frame frame;
    elvis_mat3 jacobian;
    // Of the middle, relative to the hierarchies' centre; of the coordinates that rounding is judged by; and half the sides of a box.
    elvis_vec3 position, sizes, half_box;
    // What the linearization leaves out, rounding, and half the octant's side with both.
    elvis_real curvature, bending, rounding, size;
#if CORE_HAS_BEND_FORMS
    core_local_bend bend;
    // From xi, in lengths N.
    elvis_real farthest;
#endif
    bool is_linear;
};

core_octant_mapping core_mapping_in(uint element, uint code, core_octant_place place) {
    core_octant_mapping mapping;
    elvis_vec3 position;
    elvis_mapping_jacobian(element, place.xi, position, mapping.jacobian);
    mapping.frame = core_frame_at(position, mapping.jacobian, elvis_real(0));
    mapping.position = (elvis_origin(element) - elvis_vec3(core_centre[0], core_centre[1], core_centre[2])) +
                       (position + mapping.jacobian * place.shift);
    // Rounding of the inverse shows in its product with the Jacobian; then there is rounding of positions.
    elvis_real defect = elvis_real(0);
    for (int k = 0; k < 3; ++k) {
        elvis_vec3 column = core_to_xi(mapping.frame, mapping.jacobian[k]);
        column[k] -= elvis_real(1);
        defect += core_max_norm(column);
    }
    const core_frame frame = mapping.frame;
    const elvis_vec3 ones = elvis_vec3(1);
    const elvis_real norm = max(max(dot(abs(frame.row0), ones), dot(abs(frame.row1), ones)), dot(abs(frame.row2), ones));
    mapping.sizes = abs(mapping.position) + abs(elvis_origin(element)) + abs(position);
    mapping.rounding = elvis_real(CORE_OCTANT_ROUNDING) * norm * core_max_norm(mapping.sizes) +
                                place.half_side * (elvis_real(2) * defect + elvis_real(1e-4LF)) + core_max_norm(frame.xi_error);
    const elvis_vec3 sides = abs(mapping.jacobian[0]) + abs(mapping.jacobian[1]) + abs(mapping.jacobian[2]);
    mapping.curvature = elvis_fetch_core_curvatures(element, 0u);
    const bool is_proven = elvis_fetch_core_curvatures(element, 1u) > elvis_real(0) && mapping.curvature <= CORE_MOST_PROVEN_CURVATURE;
    elvis_vec3 turn = elvis_real(2) * mapping.curvature * place.radius * sides;
    if (!is_proven) {
        const elvis_real measured =
            core_measured_curvature(element, place.xi, mapping.jacobian, place.middle, place.half_side, 1u, turn);
        const elvis_real local = core_proven_curvature_at(element, frame);
        const bool is_local = mapping.curvature > CORE_MOST_MEASURED_CURVATURE && local < CORE_UNKNOWN_CURVATURE;
        mapping.curvature = is_local                                                                ? local
                            : (code & 7u) != 0u && mapping.curvature > CORE_SMALL_CURVATURE ? measured
                                                                                            : mapping.curvature;
        turn = is_local ? place.radius * core_proven_turn(element) : turn;
    }
    mapping.bending = mapping.curvature * place.radius * place.radius;
    elvis_real most_bending = CORE_MOST_BENDING(code) * place.half_side;
#if CORE_HAS_BEND_FORMS
    mapping.bend = core_local_bend_at(element, frame);
    const elvis_real half_length = place.half_side * core_bend_length_of_cube(mapping.bend);
    mapping.farthest = core_bend_length(mapping.bend, place.shift) + half_length;
    if (mapping.bend.is_known) {
        mapping.bending = min(mapping.bending, core_bend_error(mapping.bend, mapping.farthest));
        most_bending = mapping.bend.curvature * half_length < CORE_MOST_BEND_BY_FORMS ? CORE_MOST_BENDING_BY_FORMS * place.half_side
                                                                                      : most_bending;
    }
#endif
    mapping.size = place.half_side + mapping.bending + mapping.rounding;
    const bool is_finite = core_is_finite(mapping.size + core_max_norm(mapping.position));
    mapping.is_linear = frame.is_sound && is_finite && mapping.bending + mapping.rounding < most_bending;
    // x = x(xi) + J d + e, |e| <= L |d|^2 / 2, with a Jacobian that changes by L |d| at most: twice as much as measured.
    const elvis_vec3 bent_box = place.radius * (sides + turn) + core_max_norm(place.shift) * sides;
    mapping.half_box = (mapping.is_linear ? min(mapping.size * sides, bent_box) : bent_box) +
                       elvis_real(8.0 * CORE_FLOAT_ROUNDOFF) * mapping.sizes;
    return mapping;
}

void core_write_vector(uint at, vec3 v) {
    for (int k = 0; k < 3; ++k) {
        core_words[at + uint(k)] = floatBitsToUint(v[k]);
    }
}

// What the field leaves out with the mapping, by its slope at xi.
elvis_real core_octant_value_off(const core_octant_mapping mapping, elvis_vec3 slope) {
    elvis_real off = core_norm1(slope) * mapping.bending;
#if CORE_HAS_BEND_FORMS
    const elvis_real by_forms = core_bend_value_error(mapping.bend, core_to_world(mapping.frame, slope), mapping.farthest);
    off = mapping.bend.is_known ? min(off, by_forms) : off;
#endif
    return off + core_norm1(slope) * mapping.rounding;
}

// All of the record but the field.
void core_write_mapping(uint at, uint element, uint code, core_octant_mapping mapping) {
    const vec3 middle = vec3(mapping.position);
    const float scale = 1.0 / float(mapping.size);
    core_write_vector(at, scale * vec3(mapping.frame.row0));
    core_write_vector(at + 4u, scale * vec3(mapping.frame.row1));
    core_write_vector(at + 8u, scale * vec3(mapping.frame.row2));
    for (int k = 0; k < 3; ++k) {
        core_words[at + 4u * uint(k) + 3u] = floatBitsToUint(middle[k]);
    }
    core_words[at + 17u] = floatBitsToUint(mapping.is_linear ? float(mapping.size) : 0.0);
    core_words[at + 18u] = element;
    core_words[at + 19u] = code;
    core_words[at + 20u] = floatBitsToUint(float(mapping.curvature));
    core_write_vector(at + 26u, middle - vec3(mapping.half_box));
    core_write_vector(at + 29u, middle + vec3(mapping.half_box));
}
