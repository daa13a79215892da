// The reference shape as a region: how far a point violates its faces, and the way back in. Included once for each snippet
// instance. CORE_CONSTRAINT_NORM: by how much a face constraint changes at most when every coordinate changes by 1. CORE_EXTENT: the
// distance of the farthest point from the centroid, in the maximum norm.

#ifndef CORE_SHAPE_REGION
#define CORE_SHAPE_REGION

#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
#define CORE_CENTROID elvis_vec3(0, 0, 0)
#define CORE_CONSTRAINT_NORM elvis_real(1)
#define CORE_EXTENT elvis_real(1)
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
#define CORE_CENTROID elvis_vec3(elvis_real(-1) / elvis_real(3), 0, elvis_real(-1) / elvis_real(3))
#define CORE_CONSTRAINT_NORM elvis_real(2)
#define CORE_EXTENT (elvis_real(4) / elvis_real(3))
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
#define CORE_CENTROID elvis_vec3(-0.25, -0.25, -0.5)
#define CORE_CONSTRAINT_NORM elvis_real(2)
#define CORE_EXTENT elvis_real(1.5LF)
#elif ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
#define CORE_CENTROID elvis_vec3(0, 0, 0)
#define CORE_CONSTRAINT_NORM elvis_real(1)
#define CORE_EXTENT elvis_real(1)
#elif ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
#define CORE_CENTROID elvis_vec3(elvis_real(-1) / elvis_real(3), elvis_real(-1) / elvis_real(3), 0)
#define CORE_CONSTRAINT_NORM elvis_real(2)
#define CORE_EXTENT (elvis_real(4) / elvis_real(3))
#else
#define CORE_CENTROID elvis_vec3(-0.5, -0.5, -0.5)
#define CORE_CONSTRAINT_NORM elvis_real(3)
#define CORE_EXTENT elvis_real(1.5LF)
#endif

// Largest violation of a face constraint; <= 0 inside.
elvis_real core_excess(elvis_real x, elvis_real y, elvis_real z) {
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
    return max(max(abs(x), abs(y)), abs(z)) - elvis_real(1);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
    return max(max(abs(y) - elvis_real(1), x + z), max(-x, -z) - elvis_real(1));
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    return max(max(max(-x, -y), -z) - elvis_real(1), max(x, y) + z);
#elif ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
    return max(abs(x), abs(y)) - elvis_real(1);
#elif ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    return max(max(-x, -y) - elvis_real(1), x + y);
#else
    return max(max(max(-x, -y), -z) - elvis_real(1), x + y + z + elvis_real(1));
#endif
}

// All vertices are among the corners of the cube around the shape, 8 of them.
elvis_vec3 core_cube_corner(uint corner) {
    return elvis_vec3((corner & 1u) == 0u ? -1 : 1, (corner & 2u) == 0u ? -1 : 1, (corner & 4u) == 0u ? -1 : 1);
}
bool core_is_vertex(elvis_vec3 corner) { return core_excess(corner.x, corner.y, corner.z) <= elvis_real(0); }

// A point of the shape near (x, y, z), the point itself if it lies in the shape: where the mapping is evaluated in place of a
// point outside, because only inside is it known to be one to one.
void core_project(inout elvis_real x, inout elvis_real y, inout elvis_real z) {
    const elvis_real one = elvis_real(1);
#if ELVIS_SHAPE == ELVIS_SHAPE_HEXAHEDRON
    x = clamp(x, -one, one);
    y = clamp(y, -one, one);
    z = clamp(z, -one, one);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PRISM
    y = clamp(y, -one, one);
    const elvis_real slant = max(x + z, elvis_real(0)) / elvis_real(2);
    x = clamp(x - slant, -one, one);
    z = clamp(z - slant, -one, -x);
#elif ELVIS_SHAPE == ELVIS_SHAPE_PYRAMID
    const elvis_real slant = max(max(x, y) + z, elvis_real(0)) / elvis_real(2);
    z = clamp(z - slant, -one, one);
    x = clamp(x, -one, -z);
    y = clamp(y, -one, -z);
#elif ELVIS_SHAPE == ELVIS_SHAPE_QUADRILATERAL
    x = clamp(x, -one, one);
    y = clamp(y, -one, one);
#elif ELVIS_SHAPE == ELVIS_SHAPE_TRIANGLE
    const elvis_real slant = max(x + y, elvis_real(0)) / elvis_real(2);
    x = clamp(x - slant, -one, one);
    y = clamp(y - slant, -one, -x);
#else
    const elvis_real slant = max(x + y + z + one, elvis_real(0)) / elvis_real(3);
    x = clamp(x - slant, -one, one);
    y = clamp(y - slant, -one, -x);
    z = clamp(z - slant, -one, -one - x - y);
#endif
}

elvis_vec3 core_projected(elvis_vec3 point) {
    elvis_real x = point.x, y = point.y, z = point.z;
    core_project(x, y, z);
    return elvis_vec3(x, y, z);
}

#endif
