/**
 * @file editing.h
 * What programs need in which people change scenes: cameras, colours and texts of a scene while its data is busy. Nothing here
 * waits for data. Rules and threads are those of elvis.h.
 *
 *     elvis_scene_set(scene, "/camera", "{\"eye\": [1, 0, 0], \"look_at\": [0, 0, 0]}");
 *     elvis_scene_fit_camera(scene, &extent);
 *     elvis_scene_write_text(scene, NULL, &text);
 *
 * Since 0.2.
 */
#ifndef ELVIS_EDITING_H
#define ELVIS_EDITING_H

#include <elvis/elvis.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * The text of the file that elvis_scene_write would make in `folder`; NULL: in the working directory. Each part is in its full
 * form, lists and objects where there are short forms, and paths are seen from the folder.
 */
ELVIS_EXPORT elvis_result elvis_scene_write_text(const elvis_scene* scene, elvis_string folder, char** text);

/** What a camera is to show, as elvis_data_describe tells it. */
typedef struct elvis_extent {
    uint32_t struct_size;
    uint32_t reserved;
    /** min x y z, max x y z. */
    double bounds[6];
    /** Points far out (ELVIS_DESCRIBE_OUTLINE), 3 numbers each; none: the corners of the bounds. */
    const double* outline;
    uint64_t n_outline;
} elvis_extent;

/**
 * Says what the scene's camera leaves open, as elvis_scene_complete does: a camera of which nothing is said shows the whole
 * volume in the room that annotation leaves.
 */
ELVIS_EXPORT elvis_result elvis_scene_complete_camera(elvis_scene* scene, const elvis_extent* extent);

/** The camera keeps its direction, and looks at the middle of the volume, which fills the room that annotation leaves. */
ELVIS_EXPORT elvis_result elvis_scene_fit_camera(elvis_scene* scene, const elvis_extent* extent);

/**
 * A field or expression of the scene as functions take it that do not know the scene: distances to its surfaces, by name, are
 * written out. Other texts stay as they are.
 */
ELVIS_EXPORT elvis_result elvis_scene_write_expression(const elvis_scene* scene, elvis_string text, char** expression);

/**
 * Whether the scene suits the data: fails as a picture would, with the same text, for fields and expressions that the data has
 * not or that are none, and for conditions, flows and choices of elements that do not suit it. Hidden items count, too; scenes
 * with several volumes are looked at with this one alone.
 */
ELVIS_EXPORT elvis_result elvis_data_check_scene(const elvis_data* data, const elvis_scene* scene);

/**
 * From now on, kernels and, on a processor, buffers are ELVIS_ERROR_OUT_OF_MEMORY that would make the process hold more main
 * memory than so many bytes; 0: no limit. What the program itself takes is held, too, but is not limited. Kernels are counted
 * before they are made, as large as any: with less than 96 MiB left none is made.
 */
ELVIS_EXPORT elvis_result elvis_context_limit_memory(elvis_context* context, uint64_t bytes);

/**
 * Gives back memory that the context keeps for pictures to come: kernels that nobody draws with, and what the C library holds.
 * Pictures stay the same; those that need such kernels again take longer.
 */
ELVIS_EXPORT elvis_result elvis_context_free_memory(elvis_context* context);

/**
 * Gives back, besides, all that is kept of the data for pictures to come: buffers on devices, kernels, curves. The next picture
 * makes them anew. Waits for calls that are under way.
 */
ELVIS_EXPORT elvis_result elvis_data_free_memory(elvis_data* data);

/**
 * The transfer function of the scene's "volume_rendering", of an empty one if it has none. JSON object: `color` (value, red,
 * green, blue) and `density` (value, 1 / length), both linear between values, which ascend; colours are within 1e-4 of those
 * of the colour map. The ends of a colour map without a range are `range`; `diagonal`, of the volume's bounds, is for a density
 * of which nothing is said.
 */
ELVIS_EXPORT elvis_result elvis_scene_get_transfer(const elvis_scene* scene, const double range[2], double diagonal,
                                                   char** text);

typedef uint32_t elvis_pixel_flags;
/* Bits of ELVIS_CHANNEL_FLAGS; buffers.md says what each means. */
#define ELVIS_PIXEL_CONTOUR 1u
#define ELVIS_PIXEL_CONTOUR_UNDECIDED 2u
#define ELVIS_PIXEL_MESH_LINE 4u
#define ELVIS_PIXEL_NEWTON_FAILURE 8u
#define ELVIS_PIXEL_NAN 16u
#define ELVIS_PIXEL_ISOSURFACE 32u
#define ELVIS_PIXEL_ISOSURFACE_UNDECIDED 64u
#define ELVIS_PIXEL_VOLUME_TOLERANCE 128u
#define ELVIS_PIXEL_UNDECIDED 256u
#define ELVIS_PIXEL_MESH_LINE_UNDECIDED 512u
#define ELVIS_PIXEL_WORK_LIMIT 1024u
#define ELVIS_PIXEL_ESTIMATED 2048u
#define ELVIS_PIXEL_RANGE_TOO_FINE 4096u
#define ELVIS_PIXEL_OVERLAP 8192u
/** All by which a picture says of a pixel that it may be wrong. */
#define ELVIS_PIXEL_DOUBTS                                                                                                     \
    (ELVIS_PIXEL_CONTOUR_UNDECIDED | ELVIS_PIXEL_NEWTON_FAILURE | ELVIS_PIXEL_ISOSURFACE_UNDECIDED |                           \
     ELVIS_PIXEL_VOLUME_TOLERANCE | ELVIS_PIXEL_UNDECIDED | ELVIS_PIXEL_MESH_LINE_UNDECIDED | ELVIS_PIXEL_WORK_LIMIT |         \
     ELVIS_PIXEL_RANGE_TOO_FINE | ELVIS_PIXEL_OVERLAP)

#ifdef __cplusplus
}
#endif

#endif
