// What is known of the field along a segment without evaluating it: bounds, from the element's linear model
// (field/linear_model.glsl) and the line that the ray is in reference coordinates but for the mapping's curvature.
//
// The kernel brings segments/segment.glsl and volume/volume_light.glsl.

#include "field/linear_model.glsl"

// Least and greatest value from `from` to `until`; the least above the greatest if nothing is known. `segment`: as it is when
// the ray's end in it has been found.
elvis_vec2 core_range_along(const core_segment segment, elvis_real from, elvis_real until) {
    const core_linear_model model = core_fetch_linear_model(segment.element);
    const elvis_vec3 anchor = core_xi_of(segment.anchor) - CORE_CENTROID, slope = core_slope_of(segment.anchor);
    const elvis_vec3 model_slope = elvis_vec3(model.slope);
    const elvis_real first = from - segment.anchor.t, last = until - segment.anchor.t;
    const elvis_real reach = max(abs(first), abs(last)) * core_max_norm(slope);
    // Points of the shape are predicted with this error at most.
    const elvis_real beyond = segment.curvature * reach * reach + elvis_real(1e-4LF);
    const elvis_real at_anchor = elvis_real(model.value) + dot(model_slope, anchor), rate = dot(model_slope, slope);
    const elvis_real a = at_anchor + first * rate, b = at_anchor + last * rate;
    const elvis_vec3 sizes = abs(model_slope);
    const elvis_real error = elvis_real(model.remainder) + beyond * (sizes.x + sizes.y + sizes.z) +
                             elvis_real(16.0 * CORE_FLOAT_ROUNDOFF) * (abs(a) + abs(b));
    const bool is_known = model.remainder < CORE_VALUE_UNKNOWN && core_is_finite(error);
    return is_known ? elvis_vec2(min(a, b) - error, max(a, b) + error) : elvis_vec2(1, -1);
}

// Whether one piece of the transfer function holds all of the range, and nothing changes in it, as in empty space; that is then held.
bool core_is_constant(elvis_vec2 range, inout core_held_piece held) {
    const bool is_known = range.x <= range.y;
    core_held_piece other = held;
    core_hold_value(other, is_known ? range.x : held.lower);
    const elvis_real change = abs(other.red_slope) + abs(other.green_slope) + abs(other.blue_slope);
    const bool is_constant = is_known && range.y < other.upper && other.density_slope == elvis_real(0) &&
                          (other.density == elvis_real(0) || change == elvis_real(0));
    if (is_constant) {
        held = other;
    }
    return is_constant;
}

void core_add_constant(inout core_light light, core_transfer_piece piece, elvis_real length) {
    const elvis_real transmittance = elvis_exp(-piece.density * length);
    core_add_light(light, (elvis_real(1) - transmittance) * piece.color, transmittance);
}
