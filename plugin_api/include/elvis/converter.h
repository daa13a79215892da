/**
 * @file converter.h
 * Interface "elvis.converter/1": a plugin that reads a foreign data set, which the host projects onto the native volume.
 *
 * The plugin says which elements there are and evaluates mapping and fields where the host asks; the host chooses the points,
 * projects, measures the projection error at other points, and writes. No GPU code is needed.
 *
 * Elements are numbered 0 .. n_elements-1 in the order of the source file, whatever their shape. Their geometry is the same at
 * every time step.
 *
 * Threads: `probe` and `open` as in runtime.h. On one source, get_elements, evaluate_mapping and sample may run at the same
 * time on several threads; every other call is made alone.
 *
 * A function pointer marked optional may be NULL.
 *
 * Since 1.0.
 */
#ifndef ELVIS_CONVERTER_H
#define ELVIS_CONVERTER_H

#include "element.h"
#include "host.h"

#define ELVIS_CONVERTER_INTERFACE "elvis.converter/1"

/** An open data set; the plugin's own type. */
typedef struct elvis_source_volume elvis_source_volume;

typedef struct elvis_source_info {
    uint32_t struct_size;
    /** 3, or 2 for quadrilaterals and triangles. */
    uint32_t dimension;
    /** At least 1, below 2^32 - 1. */
    uint64_t n_elements;
    /** Distinct corner ids are below this; 0 if corners have no ids and are to be matched by position. */
    uint64_t n_corner_ids;
    uint32_t n_fields;
    /** At least 1. */
    uint32_t n_time_steps;
    uint32_t n_boundary_groups;
    /** Significant bits of the numbers in the source: 53 for doubles, 24 for floats, about 27 for 8 decimal digits. */
    uint32_t mantissa_bits;
    /** Distance below which corners without ids are the same point, in world units; 0 lets the host choose. */
    double corner_tolerance;
} elvis_source_info;

/** One element of the source. */
typedef struct elvis_source_element {
    uint32_t struct_size;
    elvis_shape shape;
    /** Order of a polynomial mapping that contains the element's, per direction; from 1 to 30. */
    uint32_t geometry_order[3];
    /** Ids of the corners in the order of element.h; meaningful if n_corner_ids > 0. */
    int64_t corners[8];
    /** Boundary group of each local face, or ELVIS_GROUP_NONE. */
    int32_t face_groups[6];
} elvis_source_element;

typedef struct elvis_source_field {
    uint32_t struct_size;
    /** From 1 to 1024. */
    uint32_t n_components;
    /** Unique in the source. */
    elvis_string name;
    /** May be NULL. */
    elvis_string unit;
    /** What the target should be; the user can override it. */
    elvis_continuity continuity;
    /** Values from `sample` are uhat of this transform (see element.h). */
    elvis_transform transform;
} elvis_source_field;

/** The space of a field in an element. */
typedef struct elvis_source_space {
    uint32_t struct_size;
    /**
     * Smallest polynomial order per direction whose native space contains the source's; if there is none, the order that the
     * plugin advises; at most 30. 0 0 0 is a constant.
     */
    uint32_t order[3];
    /** Non-zero if the source's space is contained in the native space of that order: conversion is exact but for round-off. */
    uint32_t is_contained;
} elvis_source_space;

typedef struct elvis_converter {
    uint32_t struct_size;
    uint32_t reserved;

    /** As elvis_runtime.probe, for the first of the user's files. */
    elvis_result (*probe)(const elvis_host* host, const char* path, uint32_t* confidence);

    /**
     * Opens a data set made of n_paths files: geometry first, then fields, then time steps, as the user gave them. `options` is
     * a JSON object as text, or NULL.
     */
    elvis_result (*open)(const elvis_host* host, const char* const* paths, uint32_t n_paths, const char* options,
                         elvis_source_volume** source);

    /** Releases the source and all that it returned. Must not fail. */
    void (*close)(elvis_source_volume* source);

    elvis_result (*get_info)(elvis_source_volume* source, elvis_source_info* info);
    elvis_result (*get_field)(elvis_source_volume* source, uint32_t field, elvis_source_field* out);

    /** Describes elements first .. first+count-1. */
    elvis_result (*get_elements)(elvis_source_volume* source, uint64_t first, uint64_t count, elvis_source_element* out);

    /** The space of a field in elements first .. first+count-1. */
    elvis_result (*get_spaces)(elvis_source_volume* source, uint32_t field, uint64_t first, uint64_t count,
                               elvis_source_space* out);

    /** Positions (3 numbers a point) of n_points points, given in native reference coordinates (3 numbers a point). */
    elvis_result (*evaluate_mapping)(elvis_source_volume* source, uint64_t element, uint64_t n_points, const double* xi,
                                     double* positions);

    /**
     * Values of *all* fields at n_points reference points of one element: for each point, the components of field 0, then of
     * field 1, and so on. Points lie inside the closed reference shape.
     */
    elvis_result (*sample)(elvis_source_volume* source, uint32_t time_step, uint64_t element, uint64_t n_points,
                           const double* xi, double* values);

    /** Optional; needed if n_time_steps > 1. */
    elvis_result (*get_time)(elvis_source_volume* source, uint32_t time_step, double* time);
    /** Optional; needed if n_boundary_groups > 0. */
    elvis_result (*get_boundary_group)(elvis_source_volume* source, uint32_t group, elvis_string* name);

    /**
     * Optional. Values of all fields at world positions, for sources that can only be asked there: layout as in `sample`.
     * Used when `sample` is NULL; one of the two is required. The element says where the point is to be looked up, so that
     * a point on a face of a discontinuous field is answered from the right side.
     */
    elvis_result (*sample_world)(elvis_source_volume* source, uint32_t time_step, uint64_t element, uint64_t n_points,
                                 const double* positions, double* values);
} elvis_converter;

#endif
