// Field values of two snippet instances at the origin of the reference shape: what the composition is checked with.

layout(local_size_x = 8) in;
layout(set = 0, binding = 0, std430) writeonly buffer core_output { float result[]; };

void main() {
    uint element = gl_GlobalInvocationID.x;
    elvis_real shift = elvis_real(elvis_fetch_counts(element, 0u));
    result[2u * element] = float(elvis_field_value(element, elvis_vec3(0), 0u) + shift);
    result[2u * element + 1u] = float(elvis_field_value_1(element, elvis_vec3(0), 0u) + shift);
}
