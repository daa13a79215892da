/**
 * @file elvis.h
 * The library libelvis: pictures and values of high-order volumes inside other programs.
 *
 * Four things. A *context* has a device, plugins and a cache. *Data* is a volume, from a file, from a program's own table of
 * functions (runtime.h), or from arrays. A *scene* says what is to be seen; it is what a scene file holds. A *picture* is what
 * came of rendering a scene of data: colours, values, depths, normals, elements and flags of its pixels.
 *
 *     elvis_context* context;
 *     elvis_context_create(NULL, &context);
 *     elvis_data_open(context, "ball.h5", NULL, NULL, NULL, &data);
 *     elvis_scene_create(context, &scene);
 *     elvis_scene_set(scene, "/image/size", "[800, 600]");
 *     elvis_render(data, scene, NULL, NULL, &picture);
 *     elvis_picture_write_png(picture, "ball.png", 8);
 *
 * Rules beyond those of abi.h (C99, struct_size first in every struct, members added at the end, texts in UTF-8):
 *  - Every function that can fail returns an elvis_result. On anything but ELVIS_OK the outputs are NULL or untouched, and
 *    elvis_context_error has the text. No exception, signal or message comes out of the library otherwise.
 *  - A handle, an array or a text that the caller passes has to be valid; NULL is refused with ELVIS_ERROR_INVALID_ARGUMENT
 *    unless it is said to mean something.
 *  - Handles are released by the function that is named with what makes them; NULL is released without effect. Data, scenes and
 *    pictures keep what they need of their context and data: they may be released in any order.
 *  - A text that a function gives through `char** text` is the caller's, who gives it to elvis_text_release.
 *  - A struct that may be NULL and is NULL has the values that are said for each member.
 *
 * Threads. Different contexts share nothing: their functions may be called at the same time. Functions of one context, or of
 * data, scenes and pictures made with it, may be called from several threads at the same time, too. Those that need data
 * (probing, rendering, describing) take turns for each data; the device of a context is one for all its data. A scene or a
 * picture must not be changed or released while another thread uses it. Callbacks must not call functions that need the data of
 * the call that runs.
 *
 * Since 0.2. Until version 1 of the library functions may change; soname and elvis_library_version tell.
 */
#ifndef ELVIS_ELVIS_H
#define ELVIS_ELVIS_H

#include <elvis/abi.h>
#include <elvis/arrays.h>
#include <elvis/host.h>
#include <elvis/runtime.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Of this header. Programs and library fit if the major numbers and, before 1.0, the minor numbers are equal. */
#define ELVIS_LIBRARY_VERSION_MAJOR 0u
#define ELVIS_LIBRARY_VERSION_MINOR 2u
#define ELVIS_LIBRARY_VERSION ((ELVIS_LIBRARY_VERSION_MAJOR << 16) | ELVIS_LIBRARY_VERSION_MINOR)

/** ELVIS_LIBRARY_VERSION of the library that is loaded. */
ELVIS_EXPORT uint32_t elvis_library_version(void);

/** Releases a text that a function gave. */
ELVIS_EXPORT void elvis_text_release(char* text);

/* ---- Tasks: what takes long -------------------------------------------------------------------------------------------- */

/** How a long call is watched and stopped. NULL in its place: it is neither. */
typedef struct elvis_task {
    uint32_t struct_size;
    uint32_t reserved;
    void* user;
    /**
     * May be NULL. Told how far the call has come: `fraction` in [0, 1], negative if unknown; `activity` is a short phrase, not
     * NULL. From any thread, from one at a time.
     */
    void (*progress)(void* user, double fraction, elvis_string activity);
    /**
     * May be NULL. Non-zero once the call is to stop: it then returns ELVIS_ERROR_CANCELLED within about 0.1 s, except while a
     * driver compiles a kernel. Asked often, from any thread, also from several at once.
     */
    int32_t (*is_cancelled)(void* user);
} elvis_task;

/* ---- Context ----------------------------------------------------------------------------------------------------------- */

/** A device with plugins and a cache. Nothing of it is shared with another context of the process. */
typedef struct elvis_context elvis_context;

typedef uint32_t elvis_context_flags;
/** Variables of the environment ($ELVIS_..., $XDG_..., $HOME) are not read. */
#define ELVIS_CONTEXT_NO_ENVIRONMENT 1u
/** Runs with Vulkan's validation layer, whose messages go to the log. Slow. */
#define ELVIS_CONTEXT_VALIDATION 2u
/**
 * `device` names several, separated by ',', or is "all": all of the best device's type. Each draws some rows of every still
 * picture and of every picture of an animation. On devices of one kind pictures are to the bit those of one of them. Data must
 * be from files: each device opens them.
 */
#define ELVIS_CONTEXT_SEVERAL_DEVICES 4u

typedef struct elvis_context_options {
    uint32_t struct_size;
    elvis_context_flags flags;
    /** Index, or part of the name, of a Vulkan device. NULL: $ELVIS_DEVICE, else the best. */
    elvis_string device;
    /**
     * Folders of plugins, separated by ':'. NULL: $ELVIS_PLUGIN_PATH, the user's folder (~/.local/share/elvis/plugins) and
     * elvis/plugins beside the library. "": none.
     */
    elvis_string plugin_path;
    /** Where compiled kernels and converted volumes are kept. NULL: $ELVIS_CACHE_PATH, else ~/.cache/elvis. "": nowhere. */
    elvis_string cache_folder;
    /** May be NULL: then no one is told. Called with each line of the log, from any thread, also from several at once. */
    void (*log)(void* user, elvis_log_level level, elvis_string line);
    void* user;
} elvis_context_options;

/**
 * Loads plugins. The device is opened when it is first needed, so that values of files can be had on machines without one.
 * On failure *context is NULL, and elvis_context_error(NULL) has the text. `options` may be NULL. Released by
 * elvis_context_release.
 */
ELVIS_EXPORT elvis_result elvis_context_create(const elvis_context_options* options, elvis_context** context);
ELVIS_EXPORT void elvis_context_release(elvis_context* context);

/**
 * Why the last call of this thread that failed did so, of those with this context (or what was made with it); "" if none did.
 * Names file, place and cause. Valid until this thread's next call with the context. NULL: of elvis_context_create.
 */
ELVIS_EXPORT elvis_string elvis_context_error(const elvis_context* context);

/** JSON list of this machine's devices: index, name, type, driver, memory, and why one cannot be used. */
ELVIS_EXPORT elvis_result elvis_context_list_devices(elvis_context* context, char** text);

/**
 * JSON object about the device that the context draws with, which is opened if it is not: name, type, driver, allocated_bytes,
 * n_buffers, n_kernels, with ELVIS_CONTEXT_VALIDATION the layer's messages in validation_messages, and the names of `others`.
 */
ELVIS_EXPORT elvis_result elvis_context_describe_device(elvis_context* context, char** text);

/**
 * What a file is: JSON object with `kind` ("scene"; "volume", which a runtime plugin opens; "foreign", which a conversion
 * plugin reads) and `plugin`, its id, or "" of a scene. A file that is none of these is an error that says why.
 */
ELVIS_EXPORT elvis_result elvis_context_describe_file(elvis_context* context, elvis_string path, char** text);

/**
 * JSON object with `plugins` (id, name, version, library, kinds, and `formats`: of each name and endings of the files it reads)
 * and `refused` (library, reason).
 */
ELVIS_EXPORT elvis_result elvis_context_list_plugins(elvis_context* context, char** text);

/* ---- Data -------------------------------------------------------------------------------------------------------------- */

/** A volume that is open. */
typedef struct elvis_data elvis_data;

/**
 * Opens a volume file with the plugin of id `plugin`, or with the one surest of the file if NULL. `options` is a JSON object
 * for the plugin, or NULL. Released by elvis_data_release.
 *
 * A foreign file, which no runtime plugin opens, is converted; the native volume is kept in the cache and taken from there
 * until a file of the data set changes. A line of the log says so when it is made, and each time how large the residual is if
 * the conversion is not exact. Without a cache the volume lies in a temporary folder that goes with the data.
 */
ELVIS_EXPORT elvis_result elvis_data_open(elvis_context* context, elvis_string path, elvis_string plugin, elvis_string options,
                                          const elvis_task* task, elvis_data** data);

/**
 * The same of a foreign data set of several files, as elvis_convert takes them: geometry first, then fields, then time steps.
 * One file: elvis_data_open.
 */
ELVIS_EXPORT elvis_result elvis_data_open_files(elvis_context* context, const elvis_string* paths, uint32_t n_paths,
                                                elvis_string plugin, elvis_string options, const elvis_task* task,
                                                elvis_data** data);

/**
 * A volume that the program itself serves: nothing is copied but what fill_buffer gives. `runtime` is a table as a plugin has
 * it, whose probe, open and close are not called and may be NULL; `volume` is what its functions get. Both must stay valid
 * until the data is released, and functions are called as runtime.h says, from threads of the library, too. `name` stands for
 * the file in messages; NULL: "volume".
 */
ELVIS_EXPORT elvis_result elvis_data_from_runtime(elvis_context* context, const elvis_runtime* runtime, elvis_volume* volume,
                                                  elvis_string name, elvis_data** data);

/** Modes of a space: numbers an element and component. ELVIS_ERROR_INVALID_ARGUMENT if there is no such space. */
ELVIS_EXPORT elvis_result elvis_space_count_modes(elvis_context* context, elvis_shape shape, const elvis_space* space,
                                                  uint64_t* n_modes);

/**
 * A volume from arrays in the native spaces, which are copied. Elements are numbered class by class; which faces they share
 * follows from corners and positions. `name` as for elvis_data_from_runtime. Structs of lists have the size of the first.
 */
ELVIS_EXPORT elvis_result elvis_data_from_arrays(elvis_context* context, const elvis_arrays* arrays, elvis_string name,
                                                 const elvis_task* task, elvis_data** data);

/**
 * Replaces a field's values in one class at one time step: laid out as elvis_array_field.values. The next picture shows them;
 * nothing but that field is sent to the device again. Only of data from arrays.
 */
ELVIS_EXPORT elvis_result elvis_data_update_field(elvis_data* data, uint32_t field, uint32_t time_step, uint32_t element_class,
                                                  const double* values);

/** Every field of the data. */
#define ELVIS_ALL_FIELDS 0xffffffffu

/**
 * Values of a field, or of ELVIS_ALL_FIELDS, have changed, at any time step: what rests on them is asked again; other fields
 * and the mesh stay on the device. Number, names and orders of fields stay. For data of elvis_data_from_runtime, whose
 * functions give the new values from now on.
 */
ELVIS_EXPORT elvis_result elvis_data_fields_changed(elvis_data* data, uint32_t field);

/** How a geometry is displaced: each point x moves to x + factor * Re((u(x) + i v(x)) e^(i phase)). */
typedef struct elvis_warp {
    uint32_t struct_size;
    /** Of the displacement. */
    uint32_t time_step;
    /** u: a field with as many components as dimensions; in two dimensions also with three, or with one, which is a height. */
    elvis_string field;
    /** v, of a complex displacement; or NULL: 0. */
    elvis_string imaginary;
    double factor;
    /** Degrees. */
    double phase;
} elvis_warp;

/**
 * Displaced data, as new data that do not change with these. The mapping of each element is the sum of two polynomials, and
 * exact; fields go along with the points, and derivatives are those in the displaced coordinates. Only of native volumes, of
 * what is converted to them, and of arrays; without fields that are mapped by the geometry (H(curl), H(div)).
 */
ELVIS_EXPORT elvis_result elvis_data_warp(elvis_data* data, const elvis_warp* warp, const elvis_task* task,
                                          elvis_data** warped);

/** The time step that is shown, or the only one there is. */
#define ELVIS_SAME_TIME_STEP 0xffffffffu

/** Data whose fields are joined. */
typedef struct elvis_join {
    uint32_t struct_size;
    /** At each time step this one is shown; or ELVIS_SAME_TIME_STEP. */
    uint32_t time_step;
    /** Their field p is NAME.p: letters, digits and _, no digit first. */
    elvis_string name;
    /** May be the data that they are joined to: at another time step. */
    elvis_data* data;
} elvis_join;

/**
 * Data with the fields of others beside their own, as new data that do not change with these. Where the elements are the same,
 * in the same order (each mapping may differ by 1e-10 of the largest coordinate), expressions such as p - b.p are exact, and so
 * are their integrals, extrema and isosurfaces: of native volumes, of what is converted to them, and of arrays. All geometries
 * are read for that. Fields of others are found by place, point by point in double precision on the processor, and are NaN
 * where their volume is not: they can be drawn on surfaces, probed, traced and integrated; contours, isosurfaces and what else
 * needs them between points fails with ELVIS_ERROR_INPUT when it is asked for. Both volumes must be evaluated on the processor.
 * `joins`: structs that follow each other.
 */
ELVIS_EXPORT elvis_result elvis_data_join(elvis_data* data, const elvis_join* joins, uint32_t n_joins, const elvis_task* task,
                                          elvis_data** joined);

ELVIS_EXPORT void elvis_data_release(elvis_data* data);

typedef struct elvis_data_info {
    uint32_t struct_size;
    /** 3, or 2 for surfaces. */
    uint32_t dimension;
    uint64_t n_elements;
    uint32_t n_classes;
    uint32_t n_fields;
    uint32_t n_time_steps;
    uint32_t n_boundary_groups;
    /** min x y z, max x y z. */
    double bounds[6];
} elvis_data_info;

/** `info->struct_size` is set by the caller. */
ELVIS_EXPORT elvis_result elvis_data_get_info(elvis_data* data, elvis_data_info* info);
/** `field->struct_size` is set by the caller; its texts live as long as the data. */
ELVIS_EXPORT elvis_result elvis_data_get_field(elvis_data* data, uint32_t field, elvis_field* out);
ELVIS_EXPORT elvis_result elvis_data_get_time(elvis_data* data, uint32_t time_step, double* time);

typedef uint32_t elvis_describe_flags;
/** Without what takes long: ranges of fields, Jacobians, overlaps. */
#define ELVIS_DESCRIBE_BRIEF 1u
/** All elements of the lists, not the first twenty. */
#define ELVIS_DESCRIBE_ALL 2u
/** The options' jacobian_tolerance counts; else it is 1e-9. */
#define ELVIS_DESCRIBE_JACOBIAN_TOLERANCE 4u
/** With `outline`: points far out in directions all around; what shows them shows the volume. */
#define ELVIS_DESCRIBE_OUTLINE 8u

typedef struct elvis_describe_options {
    uint32_t struct_size;
    elvis_describe_flags flags;
    /** Whose ranges are told. */
    uint32_t time_step;
    uint32_t reserved;
    /**
     * Elements whose smallest Jacobian determinant is closer to zero than this times its largest may stay undecided.
     */
    double jacobian_tolerance;
} elvis_describe_options;

/**
 * What `elvis info --json` prints, as JSON: classes, bounds, fields with ranges and orders, times, groups, Jacobians, overlaps.
 * `options` may be NULL.
 */
ELVIS_EXPORT elvis_result elvis_data_describe(elvis_data* data, const elvis_describe_options* options, const elvis_task* task,
                                              char** text);

/** A field's or expression's smallest and largest value over the volume. */
typedef struct elvis_range {
    uint32_t struct_size;
    /** ELVIS_CERTIFIED: no value lies outside of lower and upper bound. ELVIS_ESTIMATED: from samples. */
    elvis_certainty certainty;
    double minimum, maximum;
    double lower_bound, upper_bound; /**< infinite where an expression grows without limit, as far as its samples tell */
    /** Elements, as people know them, and places in them. */
    int64_t minimum_element, maximum_element;
    double minimum_xi[3], maximum_xi[3];
    /** In the world; NaN if the plugin does not evaluate on the CPU. */
    double minimum_position[3], maximum_position[3];
} elvis_range;

/**
 * `field`: as the key "field" of scenes: a name, a component, or an expression. Those of expressions are sampled on the device,
 * in the precision of the last picture, if there was one.
 */
ELVIS_EXPORT elvis_result elvis_data_get_range(elvis_data* data, elvis_string field, uint32_t time_step, elvis_range* range);

typedef uint32_t elvis_evaluation;
/** By the plugin's functions on the processor where it has them, else by its snippet on the device. */
#define ELVIS_EVALUATION_AUTOMATIC 0u
#define ELVIS_EVALUATION_CPU 1u
#define ELVIS_EVALUATION_DEVICE 2u

/** Bits of elvis_probe.estimated. */
#define ELVIS_ESTIMATED_VALUE 1u
#define ELVIS_ESTIMATED_GRADIENT 2u

/**
 * Values at points, in double precision. Arrays are the caller's, and each but `positions` may be NULL if it is not wanted.
 * A point that lies in no element has element -1 and NaN everywhere else.
 */
typedef struct elvis_probe {
    uint32_t struct_size;
    uint32_t time_step;
    uint64_t n_points;
    /** 3 a point. */
    const double* positions;
    uint32_t n_fields;
    uint32_t reserved;
    /**
     * Names of fields, or expressions. A field's name gives all its components; anything else one number
     * (elvis_data_count_values).
     */
    const elvis_string* fields;
    /** Element as people know it; -1: none; -2: not known, since the inverse mapping failed. 1 a point. */
    int64_t* elements;
    /** Reference coordinates, 3 a point. */
    double* xi;
    /** Of each point the values of the first field, then of the second, and so on. */
    double* values;
    /** World gradients of each of these: 3 a value. */
    double* gradients;
    /** Of each point and value, which of both rests on differences, since the plugin gives no derivatives: ELVIS_ESTIMATED_...
     */
    uint8_t* estimated;
    /**
     * Numbers of other elements that contain the point, ascending: on shared faces, or where elements overlap. `most_also` a
     * point, -1 where there are no more.
     */
    int64_t* also;
    uint32_t most_also;
    elvis_evaluation evaluation;
    /** Elements of which it is not known whether they contain the point. 1 a point. */
    uint32_t* n_failures;
} elvis_probe;

/** Numbers a point that elvis_data_probe writes for these fields. */
ELVIS_EXPORT elvis_result elvis_data_count_values(elvis_data* data, const elvis_string* fields, uint32_t n_fields,
                                                  uint32_t* n_values);
ELVIS_EXPORT elvis_result elvis_data_probe(elvis_data* data, const elvis_probe* probe, const elvis_task* task);

/* ---- Scene ------------------------------------------------------------------------------------------------------------- */

/** What is to be seen: the same keys as a scene file's (scenes.md, scene.schema.json). A value: no data is needed for it. */
typedef struct elvis_scene elvis_scene;

/** A scene that says nothing: data is shown as `elvis render FILE` does. Released by elvis_scene_release. */
ELVIS_EXPORT elvis_result elvis_scene_create(elvis_context* context, elvis_scene** scene);
/** Reads a scene file. Its volume is not opened: see elvis_scene_open_volume. */
ELVIS_EXPORT elvis_result elvis_scene_read(elvis_context* context, elvis_string path, elvis_scene** scene);
/** The same of a text; files that it names are seen from `folder`, NULL: from the working directory. */
ELVIS_EXPORT elvis_result elvis_scene_parse(elvis_context* context, elvis_string text, elvis_string folder,
                                            elvis_scene** scene);
ELVIS_EXPORT elvis_result elvis_scene_copy(const elvis_scene* scene, elvis_scene** copy);
ELVIS_EXPORT void elvis_scene_release(elvis_scene* scene);

/**
 * Sets one key. `pointer` is a JSON Pointer (RFC 6901): "/camera/eye", "/surfaces/0/field", or "/surfaces/-", which appends;
 * objects and lists on the way are made. `value` is JSON; NULL removes the key. What the schema does not allow is refused, and
 * the scene is as before.
 */
ELVIS_EXPORT elvis_result elvis_scene_set(elvis_scene* scene, elvis_string pointer, elvis_string value);
/** JSON of the value there; "" is the whole scene. ELVIS_ERROR_INVALID_ARGUMENT if there is none. */
ELVIS_EXPORT elvis_result elvis_scene_get(const elvis_scene* scene, elvis_string pointer, char** text);
/** A scene file, which appears whole or not at all. Paths in it become relative to its folder. */
ELVIS_EXPORT elvis_result elvis_scene_write(const elvis_scene* scene, elvis_string path);
/** Path of the scene's volume as seen from the working directory; "" if it names none. */
ELVIS_EXPORT elvis_result elvis_scene_get_volume(const elvis_scene* scene, char** path);
/** Opens what the scene's `volume` says, as elvis_data_open_files does. ELVIS_ERROR_INVALID_ARGUMENT if it names none. */
ELVIS_EXPORT elvis_result elvis_scene_open_volume(const elvis_scene* scene, const elvis_task* task, elvis_data** data);
/**
 * Another scene, in which what this one leaves open is said: the camera, and the surfaces if it shows nothing; as it is drawn
 * of the data. Released by elvis_scene_release.
 */
ELVIS_EXPORT elvis_result elvis_scene_complete(const elvis_scene* scene, elvis_data* data, elvis_scene** complete);
/** The JSON Schema of scenes. */
ELVIS_EXPORT elvis_string elvis_scene_schema(void);

/* ---- Picture ----------------------------------------------------------------------------------------------------------- */

/** A picture in memory. Rows go from the top. */
typedef struct elvis_picture elvis_picture;

typedef uint32_t elvis_render_flags;
/** Colours alone: value, depth, normal, element and flags are not read from the device, which saves time. */
#define ELVIS_RENDER_COLOR_ONLY 1u
/** To compare times: what opaque surfaces hide is not evaluated. Changes crossings with isosurfaces by rounding. */
#define ELVIS_RENDER_SHARE_DEPTHS 2u
/** To compare times: all rows are drawn in each round, not only those that still want more. The same picture. */
#define ELVIS_RENDER_ALL_ROWS 4u

typedef struct elvis_render_options {
    uint32_t struct_size;
    elvis_render_flags flags;
    /** 0: the scene's ("image" "size"). */
    uint32_t width, height;
    /**
     * NULL, or of scenes with volume rendering and without surfaces, whose "image" "samples" is 1: how far along each pixel's
     * ray (ELVIS_CHANNEL_DEPTH) an opaque thing of the program lies, rows from the top without gaps; INFINITY where there is
     * none. Light of the volume in front of it is drawn, over the scene's background.
     */
    const double* hidden_from;
} elvis_render_options;

/**
 * Draws the scene's still picture of the data; its "animation" and "volume" are not looked at. Kernels and buffers stay with
 * the data: the next picture of the kind costs the device's work alone. `options` may be NULL. Released by
 * elvis_picture_release.
 *
 * Of a scene with "memory", only elements that the picture needs are read and uploaded, and nothing of them stays; what does
 * not fit is an error (budgets.md). So it is with the pictures of its animation. The device's memory is that of all data of the
 * context. Pictures for screens and picked points are as if the scene did not say it.
 */
ELVIS_EXPORT elvis_result elvis_render(elvis_data* data, const elvis_scene* scene, const elvis_render_options* options,
                                       const elvis_task* task, elvis_picture** picture);
ELVIS_EXPORT void elvis_picture_release(elvis_picture* picture);

/**
 * Brings the data to the device in the scene's precision, which the first picture would do else. Not needed before anything;
 * for programs that want to know early whether it goes well.
 */
ELVIS_EXPORT elvis_result elvis_data_prepare(elvis_data* data, const elvis_scene* scene, const elvis_task* task);

typedef uint32_t elvis_screen_flags;
/** Volume rendering to a hundredth of a channel, and lines that are looked for in few subpixels. */
#define ELVIS_SCREEN_COARSE 1u
/** Without contours and mesh lines; of coarse pictures only. */
#define ELVIS_SCREEN_NO_LINES 2u

typedef struct elvis_screen_options {
    uint32_t struct_size;
    elvis_screen_flags flags;
    /** So many pixels across and down are drawn as one, of coarse pictures only; 0 or 1: each. At most 256. */
    uint32_t divisor;
    uint32_t reserved;
} elvis_screen_options;

/**
 * Draws the scene for a screen, also while things move: colours alone, in ELVIS_NUMBER_UINT8, over grey where the background is
 * not opaque. The picture has the scene's size, and annotation of that size, whatever the divisor. Several samples a pixel, if
 * the scene has them, are drawn in pictures that are not coarse. Of several volumes, annotation gets coarser with the picture.
 * `options` may be NULL.
 */
ELVIS_EXPORT elvis_result elvis_render_for_screen(elvis_data* data, const elvis_scene* scene,
                                                  const elvis_screen_options* options, const elvis_task* task,
                                                  elvis_picture** picture);

typedef struct elvis_picture_info {
    uint32_t struct_size;
    uint32_t width, height;
    /** Sentences about the picture: see elvis_picture_get_remark. */
    uint32_t n_remarks;
    /** Pixels that show a surface; pixels of which it is undecided what they show (flag 256, see buffers.md). */
    uint64_t n_hit_pixels, n_undecided_pixels;
    /** Time of this frame, without upload and compilation; and what the device would need with nothing else to do. */
    double render_milliseconds, device_milliseconds;
    /** Of pictures for a screen: not 0 if a coarse one of the scene differs from one that is not. */
    uint32_t is_refinable;
    uint32_t reserved;
} elvis_picture_info;

ELVIS_EXPORT elvis_result elvis_picture_get_info(const elvis_picture* picture, elvis_picture_info* info);
/** Not 0 in *is_warning: something may be wrong with the picture or the data. The text lives as long as the picture. */
ELVIS_EXPORT elvis_result elvis_picture_get_remark(const elvis_picture* picture, uint32_t remark, elvis_string* text,
                                                   int32_t* is_warning);
/** Counts of the frame, times and kernels, as JSON: what `elvis render --stats` writes. */
ELVIS_EXPORT elvis_result elvis_picture_get_stats(const elvis_picture* picture, char** text);

/**
 * What its colours mean, as a JSON list, one object for each field that is coloured by its own map: name, unit, points (value,
 * red, green, blue, ascending; two equal values make a step), below, above, nan (red, green, blue), logarithmic.
 */
ELVIS_EXPORT elvis_result elvis_picture_get_color_bars(const elvis_picture* picture, char** text);

typedef uint32_t elvis_channel;
/** Red, green, blue, alpha: 4 numbers. In integers 0 to 255 or 65535, rounded as in PNG files; in reals 0 to 1. */
#define ELVIS_CHANNEL_COLOR 0u
/** Field value; NaN where nothing was met. */
#define ELVIS_CHANNEL_VALUE 1u
/** Distance from the ray's origin; NaN where nothing was met. */
#define ELVIS_CHANNEL_DEPTH 2u
/** Unit vector towards the viewer, 3 numbers; NaN where nothing was met. */
#define ELVIS_CHANNEL_NORMAL 3u
/** Element as people know it; -1 where nothing was met. Integers only. */
#define ELVIS_CHANNEL_ELEMENT 4u
/** Bits of buffers.md. Integers only. */
#define ELVIS_CHANNEL_FLAGS 5u

typedef uint32_t elvis_number;
#define ELVIS_NUMBER_UINT8 0u
#define ELVIS_NUMBER_UINT16 1u
#define ELVIS_NUMBER_UINT32 2u
#define ELVIS_NUMBER_INT64 3u
#define ELVIS_NUMBER_FLOAT 4u
#define ELVIS_NUMBER_DOUBLE 5u

/**
 * Writes a channel into the caller's array: pixel (row, column) begins at row * row_stride + column * pixel_stride bytes, its
 * numbers follow each other. Strides may be negative (rows from below); 0: the array has no gaps. Numbers: colours in UINT8,
 * UINT16, FLOAT, DOUBLE; value, depth, normal in FLOAT, DOUBLE; elements in INT64; flags in UINT32. Others are refused, as is
 * what the picture was not asked for.
 */
ELVIS_EXPORT elvis_result elvis_picture_read(const elvis_picture* picture, elvis_channel channel, elvis_number number,
                                             void* destination, ptrdiff_t row_stride, ptrdiff_t pixel_stride);
/** The bytes of `elvis render`: `bits` is 8 or 16. The file appears whole or not at all. */
ELVIS_EXPORT elvis_result elvis_picture_write_png(const elvis_picture* picture, elvis_string path, uint32_t bits);
/**
 * The picture as SVG: its pixels as a PNG that is written without annotation, `bits` a channel, and the annotation as shapes
 * and text. The file appears whole or not at all. Since 0.2.
 */
ELVIS_EXPORT elvis_result elvis_picture_write_svg(const elvis_picture* picture, elvis_string path, uint32_t bits);
/**
 * The picture as PDF, a page of 96 pixels an inch: its pixels, `bits` a channel, and the annotation as shapes and text. The
 * file appears whole or not at all. Since 0.2.
 */
ELVIS_EXPORT elvis_result elvis_picture_write_pdf(const elvis_picture* picture, elvis_string path, uint32_t bits);
/** The file of `elvis render --buffers` (HDF5). */
ELVIS_EXPORT elvis_result elvis_picture_write_buffers(const elvis_picture* picture, elvis_string path);

/* ---- Animations -------------------------------------------------------------------------------------------------------- */

/** The pictures of a scene's animation, whose colours mean the same in all of them. For one thread at a time. */
typedef struct elvis_animation elvis_animation;

/** Of a scene with the key "animation", which is copied. Released by elvis_animation_release. */
ELVIS_EXPORT elvis_result elvis_animation_create(elvis_data* data, const elvis_scene* scene, elvis_animation** animation);
ELVIS_EXPORT void elvis_animation_release(elvis_animation* animation);

typedef struct elvis_animation_info {
    uint32_t struct_size;
    uint32_t n_frames;
    double frames_a_second;
} elvis_animation_info;

ELVIS_EXPORT elvis_result elvis_animation_get_info(elvis_animation* animation, elvis_animation_info* info);
/** Which time step the frame shows. */
ELVIS_EXPORT elvis_result elvis_animation_get_time_step(elvis_animation* animation, uint32_t frame, uint32_t* time_step);
/**
 * Draws one frame, in any order, as elvis_render; the options' size is not for animations. What is to be known of a time step
 * is among the remarks on the first picture of it.
 */
ELVIS_EXPORT elvis_result elvis_animation_render(elvis_animation* animation, uint32_t frame,
                                                 const elvis_render_options* options, const elvis_task* task,
                                                 elvis_picture** picture);
/** JSON list of sentences: which surfaces none of the pictures drawn so far shows. */
ELVIS_EXPORT elvis_result elvis_animation_get_remarks(elvis_animation* animation, char** text);

/* ---- Looking closer ---------------------------------------------------------------------------------------------------- */

/**
 * What is known of the point that a place of the scene's picture shows: `column` and `row` in pixels from its upper left
 * corner, middles of pixels end in a half. JSON object: hit, position, depth, normal, value (as drawn), element, also (other
 * elements that contain it), xi, jacobian, scaled_jacobian, order, fields (name, unit, values, gradients: three numbers a
 * value, gradient_is_estimated), remark (why something is missing). In double precision, but for depth, normal and value.
 */
ELVIS_EXPORT elvis_result elvis_data_pick(elvis_data* data, const elvis_scene* scene, double column, double row,
                                          const elvis_task* task, char** text);

#define ELVIS_SAMPLES_A_PIECE 500u
#define ELVIS_SAMPLE_PIECES 24u

/**
 * Finite values of a field or expression (NULL: the scene's field) at the scene's time step, at points spread evenly over the
 * volume, so that each counts by the space it takes. `piece` is one of ELVIS_SAMPLE_PIECES, so that long work can be cut;
 * `values` has room for ELVIS_SAMPLES_A_PIECE, of which *n_values are written. Only of volumes of three dimensions.
 */
ELVIS_EXPORT elvis_result elvis_data_sample(elvis_data* data, const elvis_scene* scene, elvis_string field, uint32_t piece,
                                            double* values, uint32_t* n_values);

/**
 * Values of the scene's field below which these parts of the volume lie (in [0, 1]), from all samples, over the time steps of
 * the scene's animation if it has some.
 */
ELVIS_EXPORT elvis_result elvis_data_get_percentiles(elvis_data* data, const elvis_scene* scene, uint32_t n_parts,
                                                     const double* parts, double* values, const elvis_task* task);

/* ---- Conversion -------------------------------------------------------------------------------------------------------- */

typedef struct elvis_conversion {
    uint32_t struct_size;
    uint32_t n_inputs;
    /** Geometry first, then field files. */
    const elvis_string* inputs;
    /** The native volume to write; it appears whole or not at all. */
    elvis_string output;
    /** Id of the conversion plugin; NULL: the one surest of the first input. */
    elvis_string plugin;
    /** JSON object for the plugin, or NULL. */
    elvis_string options;
    /** Names of the fields to convert, in this order; none: all. */
    const elvis_string* fields;
    uint32_t n_fields;
    /** ELVIS_CONTINUITY_UNKNOWN: what the source says. */
    elvis_continuity continuity;
    /** Order of every field; negative: what contains the source. */
    int32_t order;
} elvis_conversion;

/** Converts in this process. *report is what `elvis convert --json` prints: how exact each field is, and times. */
ELVIS_EXPORT elvis_result elvis_convert(elvis_context* context, const elvis_conversion* conversion, const elvis_task* task,
                                        char** report);

#ifdef __cplusplus
}
#endif

#endif
