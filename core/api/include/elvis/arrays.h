/**
 * @file arrays.h
 * A volume in a program's arrays, for elvis_data_from_arrays (elvis.h). The rules of elvis.h hold.
 */
#ifndef ELVIS_ARRAYS_H
#define ELVIS_ARRAYS_H

#include <elvis/abi.h>
#include <elvis/element.h>

typedef uint32_t elvis_basis;
/** Vertex, edge, face and interior modes of Karniadakis and Sherwin: Modified_A, _B, _C of Nektar++. */
#define ELVIS_BASIS_MODIFIED 0u
/** Ortho_A, _B, _C of Nektar++. */
#define ELVIS_BASIS_ORTHOGONAL 1u
/** Lagrange polynomials on Gauss-Lobatto-Legendre points; hexahedra and quadrilaterals. */
#define ELVIS_BASIS_GLL_LAGRANGE 2u
/** Lagrange polynomials on Gauss-Legendre points; hexahedra and quadrilaterals. */
#define ELVIS_BASIS_GAUSS_LAGRANGE 3u
/** Products of Modified_A; pyramids. */
#define ELVIS_BASIS_TENSOR 4u

/** A space of functions on a reference shape; format.md of the native volume has bases, orders and the order of modes. */
typedef struct elvis_space {
    uint32_t struct_size;
    elvis_basis basis;
    /** In each direction, up to 16; order[2] is 0 in two dimensions; 0 0 0 is a constant. */
    uint32_t order[3];
    uint32_t reserved;
    /**
     * NULL: arrays hold coefficients of the modes. Else reference coordinates (element.h) of as many nodes as there are modes,
     * 3 each: arrays hold values at these, in this order. They must determine the functions of the space.
     */
    const double* nodes;
} elvis_space;

/** Elements with the same shape and spaces. */
typedef struct elvis_array_class {
    uint32_t struct_size;
    elvis_shape shape;
    uint64_t n_elements;
    const elvis_space* geometry_space;
    /** Positions or coefficients: n_elements, 3, modes. */
    const double* geometry;
    /** Corner ids, as many an element as its shape has corners: equal ids are one corner. NULL: corners at one place are. All
     * classes have them or none. */
    const int64_t* corners;
    /** Boundary group of each local face, or ELVIS_GROUP_NONE: n_elements, faces of the shape. May be NULL. */
    const int32_t* face_groups;
} elvis_array_class;

typedef struct elvis_array_field {
    uint32_t struct_size;
    uint32_t n_components;
    elvis_string name;
    /** May be NULL. */
    elvis_string unit;
    elvis_continuity continuity;
    uint32_t reserved;
    /** One for each class. */
    const elvis_space* spaces;
    /** By time step, then class: an array of n_elements, n_components, modes. */
    const double* const* values;
} elvis_array_field;

/** A volume in arrays. */
typedef struct elvis_arrays {
    uint32_t struct_size;
    /** 3, or 2 for surfaces in space. */
    uint32_t dimension;
    uint32_t n_classes;
    uint32_t n_fields;
    /** 0 is 1. */
    uint32_t n_time_steps;
    uint32_t n_boundary_groups;
    const elvis_array_class* classes;
    const elvis_array_field* fields;
    /** Of the steps; may be NULL if there is one. */
    const double* times;
    /** Their names. */
    const elvis_string* boundary_groups;
} elvis_arrays;

#endif
