/**
 * @file element.h
 * Reference shapes, their corners, faces and coordinates.
 *
 * Reference coordinates xi = (xi1, xi2, xi3) follow Karniadakis & Sherwin, "Spectral/hp Element Methods", and Nektar++.
 * All shapes lie in [-1,1]^3:
 *
 *   shape          region                                     corners (xi), in order
 *   hexahedron     the cube                                   (-,-,-)(+,-,-)(+,+,-)(-,+,-)(-,-,+)(+,-,+)(+,+,+)(-,+,+)
 *   prism          xi1 + xi3 <= 0                             (-,-,-)(+,-,-)(+,+,-)(-,+,-)(-,-,+)(-,+,+)
 *   pyramid        xi1 + xi3 <= 0, xi2 + xi3 <= 0             (-,-,-)(+,-,-)(+,+,-)(-,+,-)(-,-,+)
 *   tetrahedron    xi1 + xi2 + xi3 <= -1                      (-,-,-)(+,-,-)(-,+,-)(-,-,+)
 *   quadrilateral  the square in (xi1, xi2)                   (-,-)(+,-)(+,+)(-,+)
 *   triangle       xi1 + xi2 <= 0                             (-,-)(+,-)(-,+)
 *
 * Local faces, by corners:
 *   hexahedron   0123 0154 1265 3267 0374 4567
 *   prism        0123 014 1254 325 0354
 *   pyramid      0123 014 124 324 034
 *   tetrahedron  012 013 123 023
 * In two dimensions these are the edges:
 *   quadrilateral  01 12 32 03
 *   triangle       01 12 02
 *
 * Since 1.0.
 */
#ifndef ELVIS_ELEMENT_H
#define ELVIS_ELEMENT_H

#include "abi.h"

typedef uint32_t elvis_shape;
#define ELVIS_SHAPE_HEXAHEDRON 0u
#define ELVIS_SHAPE_PRISM 1u
#define ELVIS_SHAPE_PYRAMID 2u
#define ELVIS_SHAPE_TETRAHEDRON 3u
#define ELVIS_SHAPE_QUADRILATERAL 4u
#define ELVIS_SHAPE_TRIANGLE 5u

/** How a field behaves across shared faces, as its source declares it. */
typedef uint32_t elvis_continuity;
#define ELVIS_CONTINUITY_UNKNOWN 0u
#define ELVIS_CONTINUITY_CONTINUOUS 1u
#define ELVIS_CONTINUITY_DISCONTINUOUS 2u

/** How a vector field is stored: u = t(uhat), where uhat is polynomial in xi. */
typedef uint32_t elvis_transform;
/** u = uhat. */
#define ELVIS_TRANSFORM_NONE 0u
/** u = J^-T uhat (H(curl) spaces). */
#define ELVIS_TRANSFORM_COVARIANT 1u
/** u = J uhat / det J (H(div) spaces). */
#define ELVIS_TRANSFORM_CONTRAVARIANT 2u

/** Neighbour of a face that lies on the boundary of the domain (periodic faces included). */
#define ELVIS_NEIGHBOUR_NONE (-1)
/** Neighbour of a face that is not known, or that is several elements (hanging nodes). */
#define ELVIS_NEIGHBOUR_UNKNOWN (-2)
/** Boundary group of a face that belongs to none. */
#define ELVIS_GROUP_NONE (-1)

/** One face of the mesh. Elements are counted as the function that returns it says. */
typedef struct elvis_face {
    uint32_t struct_size;
    /** Index of the boundary group, or ELVIS_GROUP_NONE. */
    int32_t group;
    /** The element whose local face this is. */
    int64_t element;
    /** The element on the other side, ELVIS_NEIGHBOUR_NONE or ELVIS_NEIGHBOUR_UNKNOWN. */
    int64_t neighbour;
    /** Local face number in `element`. */
    int32_t local_face;
    /** Local face number in `neighbour`, or -1. */
    int32_t neighbour_local_face;
} elvis_face;

#endif
