/**
 * @file parts.h
 * Draft: may change with any release, not to be shipped. Which part of a data set each element comes from, of a conversion
 * plugin whose solver writes its data in parts: one for each of its processes.
 *
 * The host asks a plugin that has elvis_converter for this interface, too, and hands it that interface's sources. It keeps the
 * parts in the native volume, so that pictures can be drawn by the solver's own parts.
 */
#ifndef ELVIS_PARTS_H
#define ELVIS_PARTS_H

#include "converter.h"

#define ELVIS_PARTS_INTERFACE "elvis.parts/0"

/** The table of the interface. */
typedef struct elvis_parts {
    uint32_t struct_size;
    uint32_t reserved;

    /** How many parts there are, at most 1000000; 0 if the data are in one piece. Parts may be without elements. */
    elvis_result (*get_n_parts)(elvis_source_volume* source, uint32_t* n_parts);

    /**
     * The parts of elements first .. first+count-1, each below n_parts. Only asked if there are parts. Same threads as
     * elvis_converter.get_elements.
     */
    elvis_result (*get_parts)(elvis_source_volume* source, uint64_t first, uint64_t count, uint32_t* parts);
} elvis_parts;

#endif
