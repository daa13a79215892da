/**
 * @file demand.h
 * Draft: may change with any release, not to be shipped. Volumes of which only some elements are read.
 *
 * A cut plane meets few of a large volume's elements. Where the snippet's records belong to elements, the host asks for bounds
 * of all elements, for the records of those that the picture needs, and for nothing else.
 */
#ifndef ELVIS_DEMAND_H
#define ELVIS_DEMAND_H

#include "runtime.h"

/**
 * Bit of elvis_snippet.capabilities; a host that does not know it uploads all elements. Of all classes, if of any:
 *
 *  - each buffer of the class has a record for each of its elements, in their order;
 *  - what the snippet says of an element rests on that element's records and on buffers for all classes (ELVIS_ALL_CLASSES),
 * and on nothing else: not on the element's number, but for finding its records and elvis_origin(element);
 *  - buffers for all classes hold nothing of single elements: for them elvis_fill_request.origins is NULL.
 *
 * So the host may leave elements out and number those that are left anew, in their order. elvis_fill_request.origins then holds
 * those of elements whose records are asked for, each at its place, and no others may be read.
 */
#define ELVIS_SNIPPET_ELEMENT_RECORDS 256u

#endif
