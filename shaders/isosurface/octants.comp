// The linear models of octants (isosurface/octant.glsl), the range of the field in each, and a box.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "arithmetic/finite.glsl"
#include "element/element_frame.glsl"
#include "isosurface/octant.glsl"
#include "element/face_frame.glsl"
#include "element/measured_curvature.glsl"

// Two words an octant: element and code.
layout(set = 0, binding = 0, std430) readonly buffer core_input { uint core_wanted[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_output { uint core_words[]; };
// Of the hierarchies.
layout(set = 0, binding = 2, std430) readonly buffer core_centre_block { elvis_real core_centre[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_octants;
    uint core_first_component;
    uint core_end_component;
};

#include "element/shape_region.glsl"
#include "field/shown_model.glsl"

#define CORE_WORDS 32u
// Of elements that are nearly linear it is not measured for each octant.
#define CORE_SMALL_CURVATURE elvis_real(0.05LF)
// A linearization that leaves out more than this much of the reference shape is of no use.
#define CORE_MOST_BENDING elvis_real(2)

elvis_vec3 core_projected(elvis_vec3 point) {
    elvis_real x = point.x, y = point.y, z = point.z;
    core_project(x, y, z);
    return elvis_vec3(x, y, z);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_octants) {
        return;
    }
    const uint element = core_wanted[2u * i], code = core_wanted[2u * i + 1u];
    const elvis_real half_side = elvis_real(core_octant_half_side(code));
    const elvis_vec3 middle = elvis_vec3(core_octant_middle(code));
    // Where the mapping and the field are linearized: in the shape.
    const elvis_vec3 xi = core_projected(middle);
    const elvis_vec3 shift = middle - xi;
    const elvis_real radius = half_side + core_max_norm(shift);

    elvis_vec3 position;
    elvis_mat3 jacobian;
    elvis_mapping_jacobian(element, xi, position, jacobian);
    const core_frame frame = core_frame_at(position, jacobian, elvis_real(0));
    const elvis_vec3 middle_position = (elvis_origin(element) - elvis_vec3(core_centre[0], core_centre[1], core_centre[2])) +
                                       (position + jacobian * shift);
    const vec3 rounded_middle = vec3(middle_position);
    // Rounding: of the inverse, which is told by its product with the Jacobian, and of positions.
    elvis_real defect = elvis_real(0);
    for (int k = 0; k < 3; ++k) {
        elvis_vec3 column = core_to_xi(frame, jacobian[k]);
        column[k] -= elvis_real(1);
        defect += core_max_norm(column);
    }
    const elvis_real norm = max(max(core_model_norm1(frame.row0), core_model_norm1(frame.row1)), core_model_norm1(frame.row2));
    const elvis_vec3 sizes = abs(middle_position) + abs(elvis_origin(element)) + abs(position);
    const elvis_real rounding = elvis_real(CORE_OCTANT_ROUNDING) * norm * core_max_norm(sizes) +
                                half_side * (elvis_real(2) * defect + elvis_real(1e-4LF)) + core_max_norm(frame.xi_error);
    const elvis_real of_element = elvis_fetch_core_curvatures(element, 0u);
    const bool is_measured = (code & 7u) != 0u && of_element > CORE_SMALL_CURVATURE;
    const elvis_real measured = core_measured_curvature(element, xi, jacobian, middle, half_side, 1u);
    const elvis_real curvature = is_measured ? measured : of_element;
    const elvis_real bending = curvature * radius * radius + rounding;
    const elvis_real size = half_side + bending;
    const bool is_linear = frame.is_sound && core_is_finite(size + core_max_norm(middle_position)) && bending < CORE_MOST_BENDING;

    // Patches have four corners: of the octant below and above, and the middles of four faces, which estimates look at, too. Where
    // the octant is cut by the shape, all of it lies within its radius.
    core_model model;
    elvis_real remainder = elvis_real(0), value;
    for (int level = -1; level <= 1; ++level) {
        const elvis_real side = level == 0 ? elvis_real(0) : half_side, up = elvis_real(level) * half_side;
        core_region region;
        region.corner0 = core_projected(middle + elvis_vec3(-half_side, -side, up)) - xi;
        region.corner1 = core_projected(middle + elvis_vec3(half_side, side, up)) - xi;
        region.corner2 = core_projected(middle + elvis_vec3(-side, half_side, up)) - xi;
        region.corner3 = core_projected(middle + elvis_vec3(side, -half_side, up)) - xi;
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
        region.beyond = elvis_real(0);
#else
        region.beyond = radius;
#endif
        region.radius = radius;
        model = core_shown_model(element, xi, region, value);
        remainder = max(remainder, model.remainder);
    }
    const elvis_real steepness = core_model_norm1(model.slope);
    const elvis_real at_middle = model.value + dot(model.slope, shift);
    // Single precision, whatever the kernel's.
    const elvis_real lost = elvis_real(16.0 * CORE_FLOAT_ROUNDOFF) * (abs(model.value) + elvis_real(4) * steepness + remainder) + elvis_real(1e-36LF);
    const bool is_known = remainder <= CORE_LARGEST_REMAINDER;
    const float error = is_known && is_linear ? float(remainder + steepness * bending + lost) : CORE_VALUE_UNKNOWN;
    const elvis_real reach = remainder + steepness * half_side + lost;
    const vec3 slope = is_known ? vec3(size * model.slope) : vec3(0);
    const float scale = 1.0 / float(size);
    const elvis_vec3 half_box = size * (abs(jacobian[0]) + abs(jacobian[1]) + abs(jacobian[2])) +
                                elvis_real(8.0 * CORE_FLOAT_ROUNDOFF) * sizes;

    const uint at = CORE_WORDS * i;
    const vec3 rows[3] = vec3[3](scale * vec3(frame.row0), scale * vec3(frame.row1), scale * vec3(frame.row2));
    for (int k = 0; k < 3; ++k) {
        core_words[at + 4u * uint(k)] = floatBitsToUint(rows[k].x);
        core_words[at + 4u * uint(k) + 1u] = floatBitsToUint(rows[k].y);
        core_words[at + 4u * uint(k) + 2u] = floatBitsToUint(rows[k].z);
        core_words[at + 4u * uint(k) + 3u] = floatBitsToUint(rounded_middle[k]);
        core_words[at + 12u + uint(k)] = floatBitsToUint(slope[k]);
        core_words[at + 26u + uint(k)] = floatBitsToUint(rounded_middle[k] - float(half_box[k]));
        core_words[at + 29u + uint(k)] = floatBitsToUint(rounded_middle[k] + float(half_box[k]));
    }
    core_words[at + 15u] = floatBitsToUint(is_known ? float(at_middle) : 0.0);
    core_words[at + 16u] = floatBitsToUint(error);
    core_words[at + 17u] = floatBitsToUint(is_linear ? float(size) : 0.0);
    core_words[at + 18u] = element;
    core_words[at + 19u] = code;
    core_words[at + 20u] = floatBitsToUint(float(curvature));
    core_words[at + 24u] = floatBitsToUint(is_known ? float(at_middle - reach) : -CORE_VALUE_UNKNOWN);
    core_words[at + 25u] = floatBitsToUint(is_known ? float(at_middle + reach) : CORE_VALUE_UNKNOWN);
}
