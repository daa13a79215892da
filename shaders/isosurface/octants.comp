// The linear models of octants (isosurface/octant.glsl), the range of the field in each, and a box.

layout(local_size_x = 32) in;

#include "arithmetic/precision.glsl"
#include "arithmetic/finite.glsl"

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

#include "field/cube_model.glsl"
#include "isosurface/octant_mapping.glsl"

void core_write_field(uint at, core_model model, core_octant_place place, core_octant_mapping mapping) {
    const elvis_real steepness = core_model_norm1(model.slope);
    const elvis_real at_middle = model.value + dot(model.slope, place.shift);
    // Single precision, whatever the kernel's.
    const elvis_real lost = elvis_real(16.0 * CORE_FLOAT_ROUNDOFF) * (abs(model.value) + elvis_real(4) * steepness + model.remainder) +
                            elvis_real(1e-36LF);
    const bool is_known = model.remainder <= CORE_LARGEST_REMAINDER;
    const elvis_real error = model.remainder + core_octant_value_off(mapping, model.slope) + lost;
    const elvis_real reach = model.remainder + steepness * place.half_side + lost;
    core_write_vector(at + 12u, is_known ? vec3(mapping.size * model.slope) : vec3(0));
    core_words[at + 15u] = floatBitsToUint(is_known ? float(at_middle) : 0.0);
    core_words[at + 16u] = floatBitsToUint(is_known ? float(mapping.is_linear ? error : reach) : CORE_VALUE_UNKNOWN);
    core_words[at + 24u] = floatBitsToUint(is_known ? float(at_middle - reach) : -CORE_VALUE_UNKNOWN);
    core_words[at + 25u] = floatBitsToUint(is_known ? float(at_middle + reach) : CORE_VALUE_UNKNOWN);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_octants) {
        return;
    }
    const uint element = core_wanted[2u * i], code = core_wanted[2u * i + 1u];
    const core_octant_place place = core_place_of(code);
    const core_octant_mapping mapping = core_mapping_in(element, code, place);
    // Where the shape cuts the octant, all of it lies within the radius.
    const elvis_real beyond = ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON ? elvis_real(0) : place.radius;
    elvis_real reach;
    const core_model model = core_model_in_cube(element, place.xi, place.middle, place.half_side, beyond, place.radius, reach);
    const uint at = CORE_WORDS * i;
    core_write_mapping(at, element, code, mapping);
    core_write_field(at, model, place, mapping);
}
