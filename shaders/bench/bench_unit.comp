// The unit of times: field values, one after the other, the lanes of a group in one element.

layout(local_size_x = 8) in;
layout(set = 0, binding = 0, std430) writeonly buffer core_output_block { elvis_real core_output[]; };
layout(push_constant) uniform core_parameters {
    uint core_n_elements;
    uint core_n_values;
};

void main() {
    const uint element = gl_WorkGroupID.x % core_n_elements;
    elvis_real sum = elvis_real(0);
    const elvis_real x = elvis_real(0.125LF) * (elvis_real(gl_LocalInvocationID.x) - elvis_real(3.5LF));
    for (uint i = 0u; i < core_n_values; ++i) {
        // All coordinates, and the element as far as a compiler can tell, rest on the value before, so that no part of the work can
        // be left out or done once for all.
        const elvis_real shift = elvis_real(1e-3LF) * clamp(sum, elvis_real(-1), elvis_real(1));
        const uint same = sum > elvis_real(1e30LF) ? 0u : element;
        sum += elvis_field_value(same, elvis_vec3(x + shift, elvis_real(0.01LF) * elvis_real(i) - shift, shift), 0u);
    }
    core_output[gl_GlobalInvocationID.x] = sum;
}
