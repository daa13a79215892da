/**
 * @file extract.h
 * Meshes of isosurfaces, cut planes and boundaries, and contours on them. Rules and threads are those of elvis.h. Everything is
 * evaluated in double precision, in the true basis on the true geometry.
 *
 *     elvis_extraction wanted = {.struct_size = sizeof wanted, .domain = ELVIS_DOMAIN_ISOSURFACE, .level_field = "p",
 *                                .isovalue = 0.5};
 *     elvis_mesh* mesh;
 *     elvis_data_extract(data, &wanted, NULL, &mesh);
 *     elvis_mesh_info info = {.struct_size = sizeof info};
 *     elvis_mesh_get_info(mesh, &info);
 *     ... arrays of that size, elvis_mesh_read, elvis_mesh_release
 *
 * Since 0.2.
 */
#ifndef ELVIS_EXTRACT_H
#define ELVIS_EXTRACT_H

#include <elvis/answers.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A surface as triangles, or contours as lines. Released by elvis_mesh_release. */
typedef struct elvis_mesh elvis_mesh;

/** What is extracted. */
typedef struct elvis_extraction {
    uint32_t struct_size;
    /**
     * BOUNDARY, PLANE or ISOSURFACE. Of data of two dimensions BOUNDARY is the elements themselves; planes and isosurfaces are
     * lines on them.
     */
    elvis_domain domain;
    /** BOUNDARY: names of groups; none: the whole boundary. Not of data of two dimensions. */
    const elvis_string* groups;
    uint32_t n_groups;
    uint32_t time_step;
    /** PLANE: a, b, c, d of a x + b y + c z + d = 0. */
    double plane[4];
    /** ISOSURFACE: of this field or expression, at this value. */
    elvis_string level_field;
    double isovalue;
    /** Lines on the surface in place of it, where this field or expression has one of these values; n_contours 0: the surface.
     */
    elvis_string contour_field;
    const double* contours;
    uint32_t n_contours;
    /** Fields and expressions whose values at the vertices are wanted. */
    uint32_t n_fields;
    const elvis_string* fields;
    /** How far mesh and surface may be from each other, as a share of the diagonal of the bounds; 0: 1e-3. */
    double tolerance;
} elvis_extraction;

typedef struct elvis_mesh_info {
    uint32_t struct_size;
    /** Numbers a vertex of the values asked for. */
    uint32_t n_values;
    uint64_t n_vertices, n_triangles, n_lines;
    /** Of all lines. */
    uint64_t n_line_vertices;
    /** Area, or length of lines. */
    double measure;
    /** What a mesh without open edges encloses. */
    double volume;
    /** Largest distances seen from the mesh to the surface and back, and what was asked for, in world units. */
    double mesh_to_surface, surface_to_mesh, tolerance;
    /** Vertices - edges + triangles. */
    int64_t euler_number;
    /** Sides of one triangle alone: where the surface ends; and inside, where the field jumps or elements do not meet. */
    uint64_t n_rim_edges, n_inner_edges;
    /** Sides of more than two triangles; ends of lines that are not where the surface ends. */
    uint64_t n_branching_edges, n_open_ends;
    /**
     * Not 0: bounds prove that no part of the surface is missing, unless the extreme value that it encloses lies within the
     * tolerance of it.
     */
    uint32_t is_certified;
    uint32_t reserved;
    /** Elements for which samples had to stand for bounds; places as small as the tolerance that stay undecided. */
    uint64_t n_sampled_elements, n_undecided;
    /** Elements that were divided, and points at which fields or positions were evaluated. */
    uint64_t n_elements, n_evaluations;
} elvis_mesh_info;

/** Arrays of the caller's; those that are NULL are not wanted. */
typedef struct elvis_mesh_arrays {
    uint32_t struct_size;
    uint32_t reserved;
    /**
     * 3 numbers a vertex: positions; normals of length 1, to where the isosurface's field is larger, along (a, b, c), or out of
     * the volume; reference coordinates.
     */
    double *positions, *normals, *xi;
    /** An element that the vertex lies in. */
    int64_t* elements;
    /** n_values numbers a vertex, as seen from that element. */
    double* values;
    /** 3 vertices a triangle, anticlockwise from where normals point; and the element it lies in. */
    uint32_t* triangles;
    int64_t* triangle_elements;
    /** n_lines + 1: line i has the vertices line_vertices[line_first[i]] to before those of line i + 1. */
    uint64_t* line_first;
    /** A closed line has its first vertex again as its last. */
    uint32_t* line_vertices;
    /** n_lines: which of the values the line is of. */
    double* line_values;
} elvis_mesh_arrays;

/**
 * Divides elements until the mesh is as near to the surface as is wanted. Vertices lie on the surface; where the field is
 * continuous, neighbours share them. Only of data whose plugin evaluates on the CPU, and whose elements are not cut.
 */
ELVIS_EXPORT elvis_result elvis_data_extract(elvis_data* data, const elvis_extraction* extraction, const elvis_task* task,
                                             elvis_mesh** mesh);
/** `info->struct_size` is set by the caller. */
ELVIS_EXPORT elvis_result elvis_mesh_get_info(const elvis_mesh* mesh, elvis_mesh_info* info);
ELVIS_EXPORT elvis_result elvis_mesh_read(const elvis_mesh* mesh, const elvis_mesh_arrays* arrays);
ELVIS_EXPORT void elvis_mesh_release(elvis_mesh* mesh);

#ifdef __cplusplus
}
#endif

#endif
