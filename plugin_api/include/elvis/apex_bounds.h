/**
 * @file apex_bounds.h
 * Draft: may change with any release, not to be shipped. Bounds of derivatives in pyramids that hold up to the apex.
 *
 * Spaces of pyramids are rational, and second derivatives may grow like 1/t towards the apex, t = (1 - xi_3) / 2, so that
 * elvis_runtime.get_field_derivative_bounds has nothing to tell of them. But t times these is bounded.
 *
 * The host asks a plugin that has elvis_runtime for this interface, too, and hands it that interface's volumes. With it, the
 * host asks get_field_derivative_bounds nothing about pyramids. Without it, that function serves pyramids as it does others.
 */
#ifndef ELVIS_APEX_BOUNDS_H
#define ELVIS_APEX_BOUNDS_H

#include "runtime.h"

#define ELVIS_APEX_BOUNDS_INTERFACE "elvis.apex_bounds/0"

/** The table of the interface. */
typedef struct elvis_apex_bounds {
    uint32_t struct_size;
    uint32_t reserved;

    /**
     * As elvis_runtime.get_field_derivative_bounds, of elements that are all pyramids, with B in place of H:
     *
     *   L >= sum over i    of |d f / d xi_i|
     *   B >= t times the sum over i, j of |d^2 f / d xi_i d xi_j|    (all nine terms, so mixed ones twice)
     */
    elvis_result (*get_field_apex_bounds)(elvis_volume* volume, uint32_t field, uint32_t time_step, uint64_t first,
                                          uint64_t count, double* bounds, elvis_certainty* certainty);
} elvis_apex_bounds;

#endif
