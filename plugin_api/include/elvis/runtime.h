/**
 * @file runtime.h
 * Interface "elvis.runtime/1": a plugin that serves a volume for rendering, in the basis of its own solver.
 *
 * A runtime plugin has three parts: this table (the volume's representation), and a GLSL snippet with the volume's evaluation
 * and, optionally, its ray tracing (see glsl_interface.md). The host knows no basis function.
 *
 * Elements and classes. Elements with the same shape, orders and data layout form an *element class*. Elements are numbered
 * class by class, 0 .. n_elements-1: first all of class 0, then all of class 1. "Element" below means this number, "local
 * element" its position in its class. The snippet is compiled once per class, with the class's constants as #defines.
 *
 * Time. Fields change from one time step to another, geometry does not: mapping, elvis_inside, bounds, faces and signs of
 * Jacobians are the same at every step. A moving mesh is a volume for each of its positions.
 *
 * Life of a volume: probe -> open -> any number of other calls -> close. The host closes every volume it has opened.
 *
 * Threads: `probe` and `open` may be called from any thread, also at the same time for different files. On one volume, the host
 * makes one call at a time, from any thread, except that fill_buffer, get_bounds, get_field_ranges, evaluate_mapping,
 * evaluate_field, get_field_derivative_bounds and check_jacobians may run at the same time as each other.
 *
 * A function pointer marked optional may be NULL.
 *
 * Since 1.0.
 */
#ifndef ELVIS_RUNTIME_H
#define ELVIS_RUNTIME_H

#include "element.h"
#include "host.h"

#define ELVIS_RUNTIME_INTERFACE "elvis.runtime/1"

/** An open volume; the plugin's own type. */
typedef struct elvis_volume elvis_volume;

/** Counts of a volume, fixed from open to close. */
typedef struct elvis_volume_info {
    uint32_t struct_size;
    /** 3 for volumes; 2 for surfaces made of quadrilaterals and triangles. */
    uint32_t dimension;
    /** At least 1, below 2^32 - 1. */
    uint64_t n_elements;
    /** 0 if the plugin does not know the faces. */
    uint64_t n_faces;
    uint32_t n_classes;
    uint32_t n_boundary_groups;
    uint32_t n_fields;
    /** At least 1. */
    uint32_t n_time_steps;
    uint32_t n_buffers;
    /** Number of (key, value) texts that describe the volume, for `elvis info`. */
    uint32_t n_notes;
} elvis_volume_info;

typedef struct elvis_element_class {
    uint32_t struct_size;
    elvis_shape shape;
    /** May be 0. */
    uint64_t n_elements;
    /**
     * Polynomial order of the mapping in each direction, at least 1; 0 0 0 if the mapping is not polynomial. For simplices, and
     * for the triangles of prisms, the largest is the total degree. Never below the true order: `elvis export` writes cells of
     * it, and mesh lines and bent faces are fitted with it.
     */
    uint32_t geometry_order[3];
    /**
     * Non-zero if the mapping is affine in xi (a parallelepiped or straight simplex) for every element of the class. Then mesh
     * lines are straight, and coordinates in expressions have certified bounds; in doubt leave it 0.
     */
    uint32_t is_affine;
} elvis_element_class;

/**
 * A named integer that the snippet sees as a #define. Names match [A-Z][A-Z0-9_]* and start with the snippet's prefix. Values
 * fit into GLSL's 32 bits, with sign or without: -2^31 .. 2^32 - 1.
 */
typedef struct elvis_constant {
    uint32_t struct_size;
    uint32_t reserved;
    elvis_string name;
    int64_t value;
} elvis_constant;

/** How one field looks on one element class. */
typedef struct elvis_class_field {
    uint32_t struct_size;
    uint32_t n_constants;
    /** Constants of this class and field, orders among them; n_constants entries. */
    const elvis_constant* constants;
    /**
     * Polynomial order of the field in each direction, as for geometry_order, or -1 -1 -1 if it is not polynomial in xi. Never
     * below the true order: `elvis export` writes cells of it. It is also what `order` is in expressions, and what elements are
     * chosen by; pictures do not rest on it.
     */
    int32_t order[3];
    uint32_t reserved;
} elvis_class_field;

typedef struct elvis_field {
    uint32_t struct_size;
    /** 1 for a scalar, 3 for a vector in space; other numbers, up to 1024, are numbers that belong together. */
    uint32_t n_components;
    /** Unique in the volume. */
    elvis_string name;
    /** Unit as text for people, or NULL. */
    elvis_string unit;
    elvis_continuity continuity;
    /** For information: values that the snippet returns are always in world components. */
    elvis_transform transform;
    /** Largest jump across shared faces that the plugin or the conversion has measured; NaN if unknown. */
    double max_jump;
} elvis_field;

typedef uint32_t elvis_buffer_kind;
/** Filled by the plugin in double, converted by the host to the precision in use. */
#define ELVIS_BUFFER_REAL 0u
#define ELVIS_BUFFER_UINT 1u

/** Buffer that serves every class rather than one. */
#define ELVIS_ALL_CLASSES 0xffffffffu

/** Bits of elvis_buffer.depends: the host fills the buffer anew when that changes. One that it does not know it refuses. */
#define ELVIS_DEPENDS_ON_FIELD 1u
#define ELVIS_DEPENDS_ON_TIME 2u

/**
 * A buffer on the device that the snippet reads. It is an array of records of equal size; the host never splits a record.
 * The snippet fetches with elvis_fetch_NAME(record, index) and elvis_fetch4_NAME(record, row). What the records mean is the
 * plugin's own affair; usually record = local element.
 */
typedef struct elvis_buffer {
    uint32_t struct_size;
    elvis_buffer_kind kind;
    /** Lower-case identifier, unique in its class. */
    elvis_string name;
    /** The class whose snippet reads it, or ELVIS_ALL_CLASSES. */
    uint32_t element_class;
    /** ELVIS_DEPENDS_... */
    uint32_t depends;
    /** Below 2^32 - 1. */
    uint64_t n_records;
    /**
     * Numbers in a record of this field (record sizes may differ between fields). At most 2^24. The host pads a record to a
     * multiple of four numbers with zeros; fetch4 reads numbers 4*row .. 4*row+3.
     */
    uint32_t record_size;
    uint32_t reserved;
} elvis_buffer;

/** What fill_buffer is asked for. */
typedef struct elvis_fill_request {
    uint32_t struct_size;
    uint32_t buffer;
    /** Meaningful if the buffer depends on it. */
    uint32_t field;
    uint32_t time_step;
    /** Records first .. first+count-1 are wanted. */
    uint64_t first;
    uint64_t count;
    /**
     * One number per component, to be subtracted from the field, so that a small variation on a large value survives single
     * precision. All zero unless the snippet has the capability ELVIS_SNIPPET_FIELD_OFFSET.
     */
    const double* field_offset;
    /**
     * Origin of each element whose geometry the records hold, three numbers an element in the order of the whole volume's
     * elements (element e at 3e). Only with ELVIS_SNIPPET_LOCAL_ORIGIN, else NULL; see glsl_interface.md. Each origin is exact
     * in single precision.
     */
    const double* origins;
} elvis_fill_request;

/**
 * Bits of elvis_snippet.capabilities: what the snippet gives beyond mapping, Jacobian and field value. See glsl_interface.md.
 *
 * Bits of the lower half may be passed over by a host that does not know them: what they give is not used. Bits of the upper
 * half, ELVIS_SNIPPET_REQUIRED, say what has to be known for a right picture: a host that does not know one refuses the volume.
 */
#define ELVIS_SNIPPET_REQUIRED 0xffff0000u
/** elvis_field_gradient: value and gradient in xi at once. */
#define ELVIS_SNIPPET_FIELD_GRADIENT 1u
/** elvis_mapping_jacobian: mapping and Jacobian at once. */
#define ELVIS_SNIPPET_MAPPING_JACOBIAN 2u
/**
 * elvis_inverse_mapping: from position to reference coordinates. Draft: checked by `elvis check-plugin`, and not used for
 * pictures, whose error bounds rest on Newton's method.
 */
#define ELVIS_SNIPPET_INVERSE_MAPPING 4u
/** The field that the snippet returns lacks elvis_fill_request.field_offset. */
#define ELVIS_SNIPPET_FIELD_OFFSET 8u
/** Positions that the snippet returns are relative to elvis_origin(element). */
#define ELVIS_SNIPPET_LOCAL_ORIGIN 16u
/** elvis_field_hessian: value, gradient and second derivatives of the field in xi. Since 1.0. */
#define ELVIS_SNIPPET_FIELD_HESSIAN 32u
/** elvis_mapping_hessian: mapping, Jacobian and second derivatives of the mapping. Since 1.0. */
#define ELVIS_SNIPPET_MAPPING_HESSIAN 64u
/**
 * elvis_inside, elvis_inside_bounds: the class has a reference shape of its own, the part of `shape` in which a function is not
 * positive (cut cells). Mapping and fields are defined on all of `shape`; bounds, ranges and checks of the Jacobian may be of
 * all of it, too. See "Shapes of one's own" in glsl_interface.md. Since 1.0.
 */
#define ELVIS_SNIPPET_INSIDE 128u

/** One GLSL text. */
typedef struct elvis_text {
    uint32_t struct_size;
    uint32_t reserved;
    /** Name used in messages and by #include, e.g. "hexahedron.glsl". */
    elvis_string name;
    elvis_string text;
} elvis_text;

typedef struct elvis_snippet {
    uint32_t struct_size;
    /** ELVIS_SNIPPET_... */
    uint32_t capabilities;
    /**
     * Every function, struct and global constant that the snippet defines, beyond those of the interface, starts with this
     * prefix followed by '_' (macros: in upper case), so that several snippets can share one kernel. Lower case identifier.
     */
    elvis_string prefix;
    /** The first source is compiled; the others can be reached by #include "name". At least one. */
    uint32_t n_sources;
    uint32_t reserved;
    const elvis_text* sources;
} elvis_snippet;

/**
 * How much a bound or range can be trusted. Where it is an output, the host has set it to ELVIS_ESTIMATED before the call.
 *
 * What has to lie inside, and whose rounding is meant: bounds and ranges are those of the mapping and the field that the data
 * in double precision stand for, and of these as evaluate_mapping and evaluate_field compute them, whose sums are rounded in
 * double precision. A sum of n terms c_i phi_i, each phi_i good to a few units in the last place, is off by no more than about
 *
 *   n 2^-52 sum over i of |c_i| max |phi_i|
 *
 * so a bound that is exact on paper is widened by that, and by the rounding of its own computation. What single precision adds
 * (data rounded to float in buffers, the snippet's sums), with or without ELVIS_SNIPPET_LOCAL_ORIGIN and
 * ELVIS_SNIPPET_FIELD_OFFSET, is the host's affair: it looks into every element whose box lies within a few roundings of the
 * point, where rounding is relative to the size of the element with a local origin and to its coordinates without one. Widening
 * by single precision, too, does no harm but costs time. get_field_derivative_bounds says by itself what its bounds are to hold
 * for.
 */
typedef uint32_t elvis_certainty;
/** The plugin proves that nothing lies outside, rounding as above included. */
#define ELVIS_CERTIFIED 0u
/** From samples: what is drawn with it is labelled "estimated". */
#define ELVIS_ESTIMATED 1u

/** What is known of the Jacobian determinant det(dx/dxi) of an element. */
typedef uint32_t elvis_jacobian_sign;
/** Greater than zero at every point of the closed reference shape. */
#define ELVIS_JACOBIAN_POSITIVE 0u
/** Less than zero at elvis_jacobian_check.xi. */
#define ELVIS_JACOBIAN_NEGATIVE 1u
/** Neither is known: the smallest determinant lies closer to zero than tolerance or rounding allow to tell. */
#define ELVIS_JACOBIAN_UNDECIDED 2u

/**
 * The determinant is that with respect to reference coordinates xi, in collapsed shapes too: where det(dx/dxi) is continuous at
 * the collapsed edge or vertex, that is a place like any other. Where it is not (the apex of pyramids whose mapping is
 * rational) every limit counts, and a witness is a point where the determinant is defined.
 */
typedef struct elvis_jacobian_check {
    uint32_t struct_size;
    elvis_jacobian_sign sign;
    /** NEGATIVE: a point of the shape where it is negative. UNDECIDED: where the smallest was seen. POSITIVE: not used. */
    double xi[3];
    /** The determinant at xi, rounded. Not used if POSITIVE. */
    double determinant;
    /** POSITIVE, UNDECIDED: no determinant in the element is smaller; -infinity if unknown. Not used if NEGATIVE. */
    double lower;
} elvis_jacobian_check;

/** The table of the interface. */
typedef struct elvis_runtime {
    uint32_t struct_size;
    uint32_t reserved;

    /**
     * How sure the plugin is that it can open `path`: 0 no, 100 certain (own magic number found). Looks at the file's name and
     * its first bytes only, and takes no more than milliseconds. A file that cannot be read is ELVIS_OK with confidence 0;
     * an error result means that probing itself broke.
     */
    elvis_result (*probe)(const elvis_host* host, const char* path, uint32_t* confidence);

    /**
     * Opens a volume. `options` is a JSON object as text with the plugin options of the scene, or NULL. Should read the
     * structure now and coefficients when asked. On success *volume is to be given back to `close`.
     */
    elvis_result (*open)(const elvis_host* host, const char* path, const char* options, elvis_volume** volume);

    /** Releases the volume and all that it returned. Must not fail. */
    void (*close)(elvis_volume* volume);

    elvis_result (*get_info)(elvis_volume* volume, elvis_volume_info* info);
    elvis_result (*get_class)(elvis_volume* volume, uint32_t element_class, elvis_element_class* out);
    elvis_result (*get_field)(elvis_volume* volume, uint32_t field, elvis_field* out);
    elvis_result (*get_class_field)(elvis_volume* volume, uint32_t element_class, uint32_t field, elvis_class_field* out);
    /** Physical time of a step. */
    elvis_result (*get_time)(elvis_volume* volume, uint32_t time_step, double* time);
    elvis_result (*get_buffer)(elvis_volume* volume, uint32_t buffer, uint32_t field, elvis_buffer* out);
    elvis_result (*get_snippet)(elvis_volume* volume, uint32_t element_class, elvis_snippet* out);

    /**
     * Axis-aligned bounds of elements first .. first+count-1: six numbers each, min x y z then max x y z. The whole curved
     * element must lie inside. *certainty tells whether that is proven, for all of them.
     */
    elvis_result (*get_bounds)(elvis_volume* volume, uint64_t first, uint64_t count, double* bounds,
                               elvis_certainty* certainty);

    /**
     * Fills records of a buffer: count * record_size numbers, without padding, double for REAL and uint32_t for UINT.
     */
    elvis_result (*fill_buffer)(elvis_volume* volume, const elvis_fill_request* request, void* destination);

    /**
     * Optional. The number under which people know an element, if not its position: that of the source file. Written for
     * elements first .. first+count-1. All numbers are distinct, >= 0 and below 2^32 - 1.
     */
    elvis_result (*get_element_numbers)(elvis_volume* volume, uint64_t first, uint64_t count, int64_t* numbers);

    /** Optional; needed if n_faces > 0. Faces first .. first+count-1, each once; `element` counts as in this interface. */
    elvis_result (*get_faces)(elvis_volume* volume, uint64_t first, uint64_t count, elvis_face* faces);
    /** Optional; needed if n_boundary_groups > 0. */
    elvis_result (*get_boundary_group)(elvis_volume* volume, uint32_t group, elvis_string* name);

    /**
     * Optional. Range of each component of a field in each of the elements first .. first+count-1: n_components pairs
     * (min, max) an element, without any offset. Without it, the host samples and says so.
     */
    elvis_result (*get_field_ranges)(elvis_volume* volume, uint32_t field, uint32_t time_step, uint64_t first, uint64_t count,
                                     double* ranges, elvis_certainty* certainty);

    /** Optional; needed if n_notes > 0. A (key, value) pair, e.g. ("source file", "bullet.dat"). */
    elvis_result (*get_note)(elvis_volume* volume, uint32_t note, elvis_string* key, elvis_string* value);

    /**
     * Optional. Evaluation in double precision on the CPU: for n_points reference points (3 numbers each) of one element, the
     * position (3 numbers a point) and the Jacobian (9 numbers a point, entry 3*i+j = dx_i/dxi_j). Either output may be NULL.
     * Points outside the reference shape are legal.
     */
    elvis_result (*evaluate_mapping)(elvis_volume* volume, uint64_t element, uint64_t n_points, const double* xi,
                                     double* positions, double* jacobians);

    /**
     * Optional. Field values (n_components a point) and gradients with respect to xi (3 numbers a component and point), both
     * without offset; either may be NULL. For fields with a transform, world components and their derivatives in xi.
     */
    elvis_result (*evaluate_field)(elvis_volume* volume, uint32_t field, uint32_t time_step, uint64_t element,
                                   uint64_t n_points, const double* xi, double* values, double* gradients);

    /**
     * Optional. How steep and how bent each component of a field is in each of the elements first .. first+count-1. Two numbers
     * (L, H) a component, so 2 n_components an element: over the whole reference shape, boundary included,
     *
     *   L >= sum over i    of |d f / d xi_i|
     *   H >= sum over i, j of |d^2 f / d xi_i d xi_j|    (all nine terms, so mixed ones twice)
     *
     * Each is finite and >= 0, or NaN where the plugin cannot tell: for that element and component, the host samples and says
     * so. They hold for the field as the snippet evaluates it from coefficients that were rounded to single precision, too; the
     * rounding of the evaluation itself is the host's affair. *certainty is about all numbers that are not NaN. Certified
     * contours rest on them: the smaller H, the fewer pixels are subdivided.
     */
    elvis_result (*get_field_derivative_bounds)(elvis_volume* volume, uint32_t field, uint32_t time_step, uint64_t first,
                                                uint64_t count, double* bounds, elvis_certainty* certainty);

    /**
     * Optional. Sign of the Jacobian determinant in elements first .. first+count-1, one check each; entries left alone are
     * UNDECIDED. An element whose smallest determinant lies within `tolerance` (>= 0) times its largest magnitude of zero may
     * be left undecided; a larger tolerance may take less time. ELVIS_CERTIFIED if every POSITIVE, NEGATIVE and `lower` is
     * proven, rounding included. Without it, the host samples evaluate_mapping and says so. Only for volumes of dimension 3.
     *
     * The whole question, and not bounds over boxes, so that a plugin may divide its own polynomials, which is faster.
     */
    elvis_result (*check_jacobians)(elvis_volume* volume, uint64_t first, uint64_t count, double tolerance,
                                    elvis_jacobian_check* checks, elvis_certainty* certainty);
} elvis_runtime;

#endif
