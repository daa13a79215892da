// Where a linear model of a field along a ray leaves room for an isovalue: within `span`, value + t slope is the field but for `error`.
// If there is only one isovalue, what is around it; all of the span if there are several.

#ifndef CORE_VALUE_INTERVAL
#define CORE_VALUE_INTERVAL

vec2 core_value_interval(float value, float slope, float error, vec2 span) {
    const float a = value + span.x * slope, b = value + span.y * slope;
    error += 16.0 * CORE_FLOAT_ROUNDOFF * (abs(value) + abs(span.x * slope) + abs(span.y * slope));
    const float least = min(a, b) - error, most = max(a, b) + error;
    const uint first = core_isovalue_from(elvis_real(least));
    const bool has_one = first < CORE_N_ISOVALUES && float(core_isovalue_at(min(first, CORE_N_ISOVALUES - 1u))) <= most;
    const bool has_more = first + 1u < CORE_N_ISOVALUES && float(core_isovalue_at(min(first + 1u, CORE_N_ISOVALUES - 1u))) <= most;
    const float isovalue = float(core_isovalue_at(min(first, CORE_N_ISOVALUES - 1u)));
    const float inverse = 1.0 / slope;
    const float middle = (isovalue - value) * inverse, half_width = (error + CORE_FLOAT_ROUNDOFF * abs(isovalue)) * abs(inverse);
    const bool is_cut = has_one && !has_more && abs(slope) > 0.0 && error < CORE_VALUE_UNKNOWN;
    const vec2 around = vec2(max(span.x, middle - half_width), min(span.y, middle + half_width));
    const bool is_none = !has_one && error < CORE_VALUE_UNKNOWN;
    return is_none ? vec2(1.0, 0.0) : is_cut ? around : span;
}

#endif
