/**
 * @file answers.h
 * What is asked of data without a picture: integrals, what a straight line meets, streamlines and pathlines. Rules and
 * threads are those of elvis.h. Everything is evaluated in double precision, in the true basis on the true geometry.
 *
 *     elvis_integration wanted = {.struct_size = sizeof wanted, .domain = ELVIS_DOMAIN_BOUNDARY, .field = "u", .is_flux = 1};
 *     elvis_integral flux = {.struct_size = sizeof flux};
 *     elvis_data_integrate(data, &wanted, NULL, &flux);
 *
 * Since 0.2.
 */
#ifndef ELVIS_ANSWERS_H
#define ELVIS_ANSWERS_H

#include <elvis/elvis.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Integrals --------------------------------------------------------------------------------------------------------- */

typedef uint32_t elvis_domain;
/** All elements; of data of two dimensions their area. */
#define ELVIS_DOMAIN_VOLUME 0u
/** Faces without a neighbour; of data of two dimensions edges. */
#define ELVIS_DOMAIN_BOUNDARY 1u
/** Where a x + b y + c z + d = 0. In a face between elements it counts once; in an outer face, if the elements are behind it.
 */
#define ELVIS_DOMAIN_PLANE 2u
/** Where a field or expression has a value. In discontinuous fields each element has its own. */
#define ELVIS_DOMAIN_ISOSURFACE 3u

/** What is integrated. */
typedef struct elvis_integration {
    uint32_t struct_size;
    elvis_domain domain;
    /** A field, a component or an expression: a number, or a vector if `is_flux`. NULL: the number 1. */
    elvis_string field;
    /** BOUNDARY: names of groups; none: the whole boundary. */
    const elvis_string* groups;
    uint32_t n_groups;
    uint32_t time_step;
    /**
     * Not 0: the vector's component along the normal is integrated, which points out of the volume, along (a, b, c), or to
     * where the isosurface's field is larger. Not of VOLUME.
     */
    uint32_t is_flux;
    uint32_t reserved;
    /** PLANE: a, b, c, d. */
    double plane[4];
    /** ISOSURFACE: of this field or expression, at this value. */
    elvis_string level_field;
    double isovalue;
    /** Of the error, relative to the integral of the integrand's magnitude, at least 1e-14; 0: 1e-9. */
    double tolerance;
} elvis_integration;

typedef struct elvis_integral {
    uint32_t struct_size;
    /** Not 0: the errors are within the tolerance. */
    uint32_t is_converged;
    /** Not 0: integrand and geometry are polynomials, which are integrated exactly; the error is that of rounding. */
    uint32_t is_exact;
    uint32_t reserved;
    /** The value is off by about `error`, an estimate from two rules of different order. */
    double value, error;
    /** Volume, area or length, and its error. */
    double measure, measure_error;
    /** Elements or faces that take part; points at which fields or positions were evaluated. */
    uint64_t n_parts, n_evaluations;
    /** Parts of elements whose Jacobian determinant is negative somewhere; they count as positive. */
    uint64_t n_inverted;
    /** Places on planes and isosurfaces that stay undecided; what they may add is in the errors. */
    uint64_t n_unresolved;
} elvis_integral;

/**
 * Integrates. `integral->struct_size` is set by the caller. An integral that does not converge is no error: `is_converged`
 * tells. The plugin has to evaluate on the CPU, and elements must not be cut.
 */
ELVIS_EXPORT elvis_result elvis_data_integrate(elvis_data* data, const elvis_integration* integration, const elvis_task* task,
                                               elvis_integral* integral);

/* ---- Lines -------------------------------------------------------------------------------------------------------------- */

/**
 * Where the straight line between two points enters and leaves elements, in order, as a JSON list. Each place is an object:
 * `parameter` (share of the line, 0 to 1), `distance`, `position`, and `before` and `after`: null outside of the volume, else
 * an object with `element`, `xi` and `values`, which are those of the fields there, seen from that side: as many numbers as
 * elvis_data_count_values tells. Between two places the line is in one element. Elements in which it is for less than a
 * millionth of their size may be missing.
 *
 * Only of data whose plugin evaluates on the CPU, and whose elements are not cut. Data of two dimensions have to lie in a plane
 * of constant z, and the line in it.
 */
ELVIS_EXPORT elvis_result elvis_data_walk_line(elvis_data* data, const double from[3], const double to[3],
                                               const elvis_string* fields, uint32_t n_fields, uint32_t time_step,
                                               const elvis_task* task, char** text);

/* ---- Streamlines and pathlines ------------------------------------------------------------------------------------------ */

/**
 * Streamlines: curves that are everywhere tangent to a vector field at one time step. Or pathlines: the ways of points that
 * move with a field that changes in time. Released by elvis_lines_release. */
typedef struct elvis_lines elvis_lines;

typedef uint32_t elvis_line_direction;
#define ELVIS_LINE_BOTH 0u
#define ELVIS_LINE_FORWARD 1u
#define ELVIS_LINE_BACKWARD 2u

typedef uint32_t elvis_line_end;
/** No element goes on. */
#define ELVIS_LINE_LEFT_VOLUME 0u
/** The field is zero, but for rounding. */
#define ELVIS_LINE_STAGNATION 1u
/** As long as was wanted; the seed, where one direction alone was wanted. */
#define ELVIS_LINE_LENGTH 2u
/** As many steps as are allowed, a hundred thousand. */
#define ELVIS_LINE_STEPS 3u
/** The field jumps at a face, and leads back from both sides. */
#define ELVIS_LINE_JUMP 4u
/** The seed lies in no element: the line has no points. */
#define ELVIS_LINE_NO_ELEMENT 5u
/** Of a pathline: the end time, or the seed's; or no time step goes on. */
#define ELVIS_LINE_TIME 6u

typedef uint32_t elvis_time_interpolation;
/** At a point of an element, the polynomial of degree 3 in time through the four nearest time steps, or all of less. */
#define ELVIS_TIME_CUBIC 0u
#define ELVIS_TIME_LINEAR 1u

/** Bits of elvis_tracing.flags. */
/** Pathlines: the field goes on from time step to time step; `time_step` is not used. */
#define ELVIS_TRACE_PATHLINES 1u
/** `start_time` is set, `end_time` is. */
#define ELVIS_TRACE_START_TIME 2u
#define ELVIS_TRACE_END_TIME 4u

typedef struct elvis_tracing {
    uint32_t struct_size;
    uint32_t time_step;
    /** A vector field or expression. */
    elvis_string field;
    /** Points that lines go through, 3 numbers each: one line a seed. More may come from `seed_surface`. */
    const double* seeds;
    uint64_t n_seeds;
    elvis_line_direction direction;
    /** Fields and expressions whose values at the lines' points are wanted. */
    uint32_t n_fields;
    const elvis_string* fields;
    /** Of a step's error, as a share of the diagonal of the bounds; 0: 1e-9. */
    double tolerance;
    /** Of a line in each direction; 0: of streamlines ten times the diagonal, of pathlines no limit. */
    double length;
    /** ELVIS_TRACE_.. */
    uint32_t flags;
    elvis_time_interpolation interpolation;
    /** When points are at their seeds; if it is not set: the first time step's time, the last one's if they go backward. */
    double start_time;
    /** Of one direction: till when, or backward since when, lines go; if it is not set: as far as time steps do. */
    double end_time;
    /**
     * Further seeds, evenly spaced on a surface: JSON as in a scene's `surfaces`, such as
     * {"type": "boundary", "groups": ["inflow"]}; NULL: none. On levels, those of the data's time step `time_step`.
     */
    elvis_string seed_surface;
    /** Distance between these, in the world; 0: 0.05 of the diagonal of the bounds. */
    double seed_spacing;
} elvis_tracing;

typedef struct elvis_lines_info {
    uint32_t struct_size;
    /** Numbers a point of the values asked for. */
    uint32_t n_values;
    uint64_t n_lines;
    /** Of all lines. */
    uint64_t n_points;
    /**
     * Of pathlines: how far linear and cubic interpolation in time are apart at most, as a share of a line's largest speed;
     * negative where that is not known (two time steps only, streamlines).
     */
    double time_doubt;
} elvis_lines_info;

/** Arrays of the caller's; those that are NULL are not wanted. */
typedef struct elvis_line_arrays {
    uint32_t struct_size;
    uint32_t reserved;
    /** n_lines + 1: points first[i] to first[i+1] - 1 are those of line i, in the order of time. */
    uint64_t* first;
    /** n_lines each: why lines begin and end where they do. */
    elvis_line_end *begins, *ends;
    /**
     * n_points each, positions and xi 3 numbers a point. Lengths are from the seed on, negative upstream; so are times of
     * streamlines, while those of pathlines are as time steps have them.
     */
    double *positions, *times, *arc_lengths;
    /** Numbers of elements, and reference coordinates in them. */
    int64_t* elements;
    double* xi;
    /** n_values numbers a point. */
    double* values;
} elvis_line_arrays;

/**
 * Streamlines or pathlines, integrated in the reference coordinates of each element (Dormand and Prince, order 5) and handed
 * over at faces. Only of data whose plugin evaluates on the CPU, and whose elements are not cut. Values at points of pathlines
 * are those at the points' times, interpolated in the same way.
 */
ELVIS_EXPORT elvis_result elvis_data_trace(elvis_data* data, const elvis_tracing* tracing, const elvis_task* task,
                                           elvis_lines** lines);
/**
 * The lines of a scene's item of streamlines or pathlines, as a picture of the scene shows them, with the displacement that the
 * scene has. `surface`: its index in the scene's `surfaces`. `fields`: n_fields names and expressions whose values at the
 * lines' points are wanted. Not of scenes of several volumes.
 */
ELVIS_EXPORT elvis_result elvis_data_trace_scene(elvis_data* data, const elvis_scene* scene, uint32_t surface,
                                                 const elvis_string* fields, uint32_t n_fields, const elvis_task* task,
                                                 elvis_lines** lines);
ELVIS_EXPORT elvis_result elvis_lines_get_info(const elvis_lines* lines, elvis_lines_info* info);
ELVIS_EXPORT elvis_result elvis_lines_read(const elvis_lines* lines, const elvis_line_arrays* arrays);
ELVIS_EXPORT void elvis_lines_release(elvis_lines* lines);

#ifdef __cplusplus
}
#endif

#endif
