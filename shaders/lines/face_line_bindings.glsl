// Bindings of the kernels that look for lines on faces in listed pixels.

layout(set = 0, binding = 1, std430) readonly buffer core_samples_block { core_sample core_samples[]; };
layout(set = 0, binding = 2, std430) readonly buffer core_normals_block { elvis_real core_normals[]; };
// [0]: evaluations; [core_open_count]: pixels that stay open.
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
layout(set = 0, binding = 5, std430) readonly buffer core_isovalues_block { elvis_real core_isovalues[]; };
layout(set = 0, binding = 6, std430) readonly buffer core_places_block { core_place core_places[]; };
// element/place.glsl
layout(set = 0, binding = 7, std430) readonly buffer core_list_block { uint core_list[]; };
layout(set = 0, binding = 8, std430) writeonly buffer core_open_block { uint core_open[]; };
layout(push_constant) uniform core_parameters {
    uvec2 core_size;
    uint core_first;
    uint core_n_listed;
    uint core_class;
    uint core_first_component;
    uint core_end_component;
    uint core_n_isovalues;
    uint core_with_mesh_lines;
    uint core_subdivisions;
    // Which of the counts is that of core_open; 0 in the last round.
    uint core_open_count;
    // The faces are all of the boundary, and all rays start on the same side of it.
    uint core_is_closed;
};

