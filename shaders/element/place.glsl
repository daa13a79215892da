// Where in an element the surface lies that a pixel shows. Written along with samples, if it is wanted.

#ifndef CORE_PLACE
#define CORE_PLACE

struct core_place {
    elvis_real x, y, z;
    uint element;
    // One more than the face in which the surface lies, 0 if it is no face of the element; the element's class; and the bits below.
    uint class_and_face;
};

#define CORE_PLACE_FACE_BITS 4
// Known after lines/settle_lines.comp: the ray enters the element; the element's part of the surface fills the pixel.
#define CORE_PLACE_ENTERS (1u << 31)
#define CORE_PLACE_FILLED (1u << 30)

uint core_class_of(core_place place) { return (place.class_and_face & (CORE_PLACE_FILLED - 1u)) >> CORE_PLACE_FACE_BITS; }
int core_face_of(core_place place) { return int(place.class_and_face & ((1u << CORE_PLACE_FACE_BITS) - 1u)) - 1; }

// In lists of pixels that need a closer look: at which lines.
#define CORE_LIST_CONTOUR (1u << 31)
#define CORE_LIST_MESH_LINE (1u << 30)
#define CORE_LIST_PIXEL (CORE_LIST_MESH_LINE - 1u)

#endif
