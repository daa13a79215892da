// Cells: the octants of elements, or of octants, that can hold an isovalue (core/volume/level_set.hpp), each with linear models of the
// inverse mapping and of the field in single precision: what can be told of both along a ray before anything is evaluated.
//
// A point x of the cell, relative to the hierarchies' centre, has the local coordinates
//
//     y = R (x - middle),   |y| <= 1 in every coordinate,   xi = m + size y + e,   |e| <= size - h,
//
// with m the middle of the octant in reference coordinates and h half its side: so size = h plus what the linearization leaves out.
// And for the field
//
//     f = value + slope . y + d,   |d| <= error.
//
// The curvature is that of element/prediction.glsl in the cell. Where there is no linearization, y is of the element's box, size is zero, and the error CORE_LEVEL_UNKNOWN.

#ifndef CORE_LEVEL_CELL
#define CORE_LEVEL_CELL

#define CORE_LEVEL_UNKNOWN 3e38
// Of single precision, in x and in all that is computed of y.
#define CORE_CELL_ROUNDING (32.0 * CORE_FLOAT_ROUNDOFF)

struct core_level_cell {
    vec3 row0, row1, row2;
    vec3 middle;
    vec3 slope;
    float value, error;
    float size;
    uint element;
    uint code;
    float curvature;
};

// Level, then the octant's place along each side, then a bit for cells whose models are estimates.
#define CORE_CELL_PLACE_BITS 6
#define CORE_CELL_ESTIMATED 0x80000000u

float core_cell_half_side(uint code) { return exp2(-float(code & 7u)); }

vec3 core_cell_middle(uint code) {
    const uint mask = (1u << CORE_CELL_PLACE_BITS) - 1u;
    const vec3 place = vec3((code >> 3) & mask, (code >> (3 + CORE_CELL_PLACE_BITS)) & mask, (code >> (3 + 2 * CORE_CELL_PLACE_BITS)) & mask);
    return (2.0 * place + 1.0) * core_cell_half_side(code) - 1.0;
}

#ifdef elvis_fetch4_core_cells

core_level_cell core_fetch_level_cell(uint index) {
    const uvec4 a = elvis_fetch4_core_cells(index, 0u), b = elvis_fetch4_core_cells(index, 1u), c = elvis_fetch4_core_cells(index, 2u);
    const uvec4 d = elvis_fetch4_core_cells(index, 3u), e = elvis_fetch4_core_cells(index, 4u);
    core_level_cell cell;
    cell.row0 = uintBitsToFloat(a.xyz);
    cell.row1 = uintBitsToFloat(b.xyz);
    cell.row2 = uintBitsToFloat(c.xyz);
    cell.middle = vec3(uintBitsToFloat(a.w), uintBitsToFloat(b.w), uintBitsToFloat(c.w));
    cell.slope = uintBitsToFloat(d.xyz);
    cell.value = uintBitsToFloat(d.w);
    cell.error = uintBitsToFloat(e.x);
    cell.size = uintBitsToFloat(e.y);
    cell.element = e.z;
    cell.code = e.w;
    cell.curvature = uintBitsToFloat(elvis_fetch4_core_cells(index, 5u).x);
    return cell;
}

vec3 core_cell_turn(core_level_cell cell, vec3 v) { return vec3(dot(cell.row0, v), dot(cell.row1, v), dot(cell.row2, v)); }

// How wrong y is for points given by coordinates of this size, beyond what the cell itself allows for.
float core_cell_tolerance(core_level_cell cell, float far) {
    const vec3 ones = vec3(1);
    const float norm = max(max(dot(abs(cell.row0), ones), dot(abs(cell.row1), ones)), dot(abs(cell.row2), ones));
    return CORE_CELL_ROUNDING * far * norm;
}

float core_cell_error(core_level_cell cell, float tolerance) {
    return cell.error + tolerance * dot(abs(cell.slope), vec3(1));
}

#endif

#endif
