// Buffers of the kernels that draw isosurfaces, and how what they have found gets into the picture.
//
// The kernel brings CORE_LAST_BINDING.

layout(set = 0, binding = 1, std430) buffer core_samples_block { core_sample core_samples[]; };
// Three numbers a pixel.
layout(set = 0, binding = 2, std430) writeonly buffer core_normals_block { elvis_real core_normals[]; };
layout(set = 0, binding = 3, std430) buffer core_counts_block { uint core_counts[]; };
layout(set = 0, binding = 4, std430) buffer core_marks_block { core_mark core_marks[]; };
// Behind the isovalues four numbers for each clipping plane: normal and height, above zero where the surface is kept.
layout(set = 0, binding = 6) CORE_READ_REALS(core_isovalues);
layout(set = 0, binding = 7) CORE_READ_REALS(core_beyond);
layout(set = 0, binding = 8, std430) writeonly buffer core_places_block { core_place core_places[]; };
// An upper bound of the surface's normal curvatures, without sign.
layout(set = 0, binding = 9, std430) writeonly buffer core_bending_block { elvis_real core_bending[]; };

// What the next round, which looks behind a crossing, has to know of it beside its depth.
struct core_crossing_record {
    elvis_real isovalue;
    // Along the ray.
    elvis_real slack;
    // CORE_CROSSING_..., and above these bits the element's number, counted from 1.
    uint bits;
};
#define CORE_CROSSING_RISES 1u
#define CORE_CROSSING_CERTAIN 2u
#define CORE_CROSSING_BITS 2
// Two a pixel: of odd and of even rounds, so that classes of elements do not find each other's.
layout(set = 0, binding = CORE_LAST_BINDING, std430) buffer core_last_block { core_crossing_record core_last[]; };

// `rises`: the field does, along the ray. `depth`: from the ray's origin. `normal`: of any length and on any side. `bend`: as in
// core_bending, or not finite.
void core_store_crossing(uint pixel, uint surface, bool rises, elvis_real isovalue, elvis_real depth, uint number, elvis_vec3 normal,
                         elvis_vec3 direction, core_place place, elvis_real bend) {
    core_marks[pixel].owner = surface << CORE_OWNER_BITS | (rises ? CORE_OWNER_RISES : 0u);
    core_samples[pixel].value = isovalue;
    core_samples[pixel].depth = depth;
    core_samples[pixel].number = number;
    const elvis_real scale = (dot(normal, direction) > elvis_real(0) ? elvis_real(-1) : elvis_real(1)) / length(normal);
    core_normals[3u * pixel] = scale * normal.x;
    core_normals[3u * pixel + 1u] = scale * normal.y;
    core_normals[3u * pixel + 2u] = scale * normal.z;
    core_places[pixel] = place;
    core_bending[pixel] = core_is_finite(bend) ? min(bend, CORE_FAR) : CORE_FAR;
}
