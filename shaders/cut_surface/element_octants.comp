// The linear models of the mapping in octants of strongly bent elements, for cut_surface/open_points.comp.

layout(local_size_x = CORE_GROUP_SIZE) in;

#include "arithmetic/precision.glsl"

// Two words an octant: element and code.
layout(set = 0, binding = 0, std430) readonly buffer core_input { uint core_wanted[]; };
// Records and boxes, as of isosurface/octants.comp, without a field.
layout(set = 0, binding = 1, std430) writeonly buffer core_output { uint core_words[]; };
// Of the hierarchies.
layout(set = 0, binding = 2, std430) readonly buffer core_centre_block { elvis_real core_centre[]; };
layout(push_constant) uniform core_parameters { uint core_n_octants; };

#include "isosurface/octant_mapping.glsl"

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= core_n_octants) {
        return;
    }
    const uint element = core_wanted[2u * i], code = core_wanted[2u * i + 1u];
    const core_octant_mapping mapping = core_mapping_in(element, code, core_place_of(code));
    core_write_mapping(CORE_WORDS * i, element, code, mapping);
}
