// What one evaluation of mapping and field at a point xi of an element tells about a piece of a ray.
//
// The mapping is linearized at xi. The piece's point at parameter s (from the piece's middle) that lies in the element has the offset
// q + s w from xi but for `beyond`, the error of a Newton step (element/prediction.glsl) and rounding. So the faces, which are linear
// in reference coordinates, cut off the ends that surely lie outside, and the field's Taylor model over what is left
// (arithmetic/model.glsl) bounds the field along the ray by a line and an error:
//
//     f(s) = value + slope s + e,   |e| <= error,   wherever the piece lies in the element.
//
// The kernel brings isosurface/isovalues.glsl, element/element_frame.glsl and field/shown_model.glsl.

#include "element/inside.glsl"
#include "arithmetic/model.glsl"
#include "element/prediction.glsl"
#include "element/shape_region.glsl"

struct core_piece {
    // Offset of the middle, and its change along the ray, in reference coordinates.
    elvis_vec3 q, w;
    // What is left of the piece; low > high: nothing.
    elvis_real low, high;
    // By how much at least all of the piece violates one face, as predicted; negative if it does not.
    elvis_real clearance;
    // Largest offset from xi of what is left, in the maximum norm, and what the linearization leaves out there.
    elvis_real radius, beyond;
    elvis_real value, slope, error;
    bool is_known;
};

elvis_real core_piece_radius(core_piece piece) {
    return max(core_max_norm(piece.q + piece.low * piece.w), core_max_norm(piece.q + piece.high * piece.w));
}

// The piece from -half_width to half_width, cut by the faces. `offset`: of the middle from the image of xi.
core_piece core_piece_in_element(elvis_vec3 xi, core_frame frame, elvis_vec3 offset, elvis_vec3 direction, elvis_real half_width,
                                 elvis_real curvature) {
    core_piece piece;
    piece.q = core_to_xi(frame, offset);
    piece.w = core_to_xi(frame, direction);
    piece.low = -half_width;
    piece.high = half_width;
    const elvis_real rounding = core_max_norm(frame.xi_error);
    piece.clearance = -CORE_UNKNOWN;
    for (int face = 0; face < CORE_N_FACES; ++face) {
        const elvis_vec4 constraint = core_face_constraint(face);
        piece.clearance = max(piece.clearance, dot(constraint.xyz, xi + piece.q) + constraint.w -
                                                   half_width * abs(dot(constraint.xyz, piece.w)));
    }
    // What is left is nearer, and so better known: a second time.
    for (int turn = 0; turn < 2; ++turn) {
        const elvis_real step = core_piece_radius(piece);
        piece.beyond = core_prediction_error(curvature, step) + rounding;
        piece.radius = step + piece.beyond;
        elvis_real low = piece.low, high = piece.high;
        for (int face = 0; face < CORE_N_FACES; ++face) {
            const elvis_vec4 constraint = core_face_constraint(face);
            const elvis_real slack = core_model_norm1(constraint.xyz) * (piece.beyond + elvis_real(8) * CORE_ROUNDOFF);
            const elvis_real excess = dot(constraint.xyz, xi + piece.q) + constraint.w - slack;
            const elvis_real slope = dot(constraint.xyz, piece.w);
            const elvis_real root = -excess / slope;
            high = slope > elvis_real(0) ? min(high, root) : high;
            low = slope < elvis_real(0) ? max(low, root) : low;
            // Along the face, and beyond it.
            high = slope == elvis_real(0) && excess > elvis_real(0) ? low - half_width : high;
        }
        piece.low = low;
        piece.high = high;
    }
    return piece;
}

#if ELVIS_HAS_INSIDE
// Cuts the piece, which the faces have cut, by the element's own boundary, too.
void core_cut_piece_inside(core_inside g, inout core_piece piece) {
    const elvis_real slack = core_model_norm1(g.slope) * (piece.beyond + elvis_real(8) * CORE_ROUNDOFF) + g.rounding +
                             core_inside_bend(g, piece.radius);
    const elvis_real excess = g.value + dot(g.slope, piece.q) - slack, slope = dot(g.slope, piece.w);
    const elvis_real root = -excess / slope;
    const bool is_beyond = slope == elvis_real(0) && excess > elvis_real(0);
    piece.high = is_beyond ? piece.low - elvis_real(1) : slope > elvis_real(0) ? min(piece.high, root) : piece.high;
    piece.low = slope < elvis_real(0) ? max(piece.low, root) : piece.low;
}
#endif

void core_piece_take_field(inout core_piece piece, uint element, elvis_vec3 xi, out core_model model, out elvis_real value) {
    core_patch region;
    region.corner0 = piece.q + piece.low * piece.w;
    region.corner1 = piece.q + piece.high * piece.w;
    // Two would do, but estimates look at all four (field/estimated_model.glsl).
    region.corner2 = piece.q + elvis_real(0.5LF) * piece.low * piece.w;
    region.corner3 = piece.q + elvis_real(0.5LF) * piece.high * piece.w;
    region.beyond = piece.beyond;
    region.radius = piece.radius;
    model = core_shown_model(element, xi, region, value);
    piece.value = model.value + dot(model.slope, piece.q);
    piece.slope = dot(model.slope, piece.w);
    piece.error = CORE_MODEL_UP * (model.remainder + core_model_norm1(model.slope) *
                                                         (piece.beyond + elvis_real(4) * CORE_ROUNDOFF * piece.radius)) +
                  elvis_real(4) * CORE_ROUNDOFF * abs(model.value) + CORE_MODEL_TINY;
    piece.is_known = core_model_is_known(model);
}

// The first isovalue that the field may take along the piece, and where.
struct core_crossing {
    // None is taken for certain.
    bool is_excluded;
    // No other one can be taken.
    bool is_only;
    elvis_real isovalue;
    // It is taken within half_width of s, if at all in the element; nothing is taken before.
    elvis_real s, half_width;
};

core_crossing core_first_crossing(core_piece piece) {
    const elvis_real a = piece.value + piece.low * piece.slope, b = piece.value + piece.high * piece.slope;
    const elvis_real least = min(a, b) - piece.error, most = max(a, b) + piece.error;
    const uint first = core_isovalue_from(least);
    const uint last = core_isovalues_end(first, most);
    const uint next = piece.slope > elvis_real(0) ? first : max(last, 1u) - 1u;
    core_crossing crossing;
    crossing.is_excluded = piece.is_known && first == last;
    crossing.is_only = piece.is_known && last == first + 1u;
    crossing.isovalue = core_isovalue_at(min(next, CORE_N_ISOVALUES - 1u));
    const elvis_real inverse = elvis_real(1) / piece.slope;
    crossing.s = (crossing.isovalue - piece.value) * inverse;
    crossing.half_width = piece.error * abs(inverse);
    return crossing;
}
