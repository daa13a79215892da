/**
 * @file extrema.h
 * Draft: may change with any release, not to be shipped. The smallest and largest values of fields over the whole volume, of a
 * plugin that knows them or finds them better than the host.
 *
 * The host asks a plugin that has elvis_runtime for this interface, too, and hands it that interface's volumes. Without it, the
 * host searches by itself: with get_field_ranges, get_field_derivative_bounds and evaluate_field by branch and bound, else with
 * samples. Default colours, contours and densities rest on the answer; what pictures leave out does not.
 */
#ifndef ELVIS_EXTREMA_H
#define ELVIS_EXTREMA_H

#include "runtime.h"

#define ELVIS_EXTREMA_INTERFACE "elvis.extrema/0"

/** Instead of a component: the Euclidean length of all components together. */
#define ELVIS_MAGNITUDE 0xffffffffu

/** A smallest or largest value, and where it is taken. */
typedef struct elvis_extremum {
    uint32_t struct_size;
    uint32_t reserved;
    /** The field's value at `xi` of `element`, without any offset. NaN if no element has finite values. */
    double value;
    /**
     * CERTIFIED: the field takes no value beyond: none smaller than that of a minimum, none larger than that of a maximum,
     * rounding as for elvis_certainty included.
     */
    double bound;
    /** Counts as in runtime.h. */
    uint64_t element;
    /** In the closed reference shape. */
    double xi[3];
} elvis_extremum;

/** The table of the interface. */
typedef struct elvis_extrema {
    uint32_t struct_size;
    uint32_t reserved;

    /**
     * Extrema over all elements of a component of a field, or of its magnitude (ELVIS_MAGNITUDE, only of fields with several
     * components). Values that are not finite do not count. The bounds lie within a thousandth of the distance of both extrema
     * from the values, unless rounding forbids it.
     *
     * *certainty has been set to ELVIS_ESTIMATED; a plugin that leaves it so has no answer for this field: the host looks at
     * nothing else and searches by itself. Same threads as elvis_runtime.get_field_ranges.
     */
    elvis_result (*get_field_extrema)(elvis_volume* volume, uint32_t field, uint32_t component, uint32_t time_step,
                                      elvis_extremum* minimum, elvis_extremum* maximum, elvis_certainty* certainty);
} elvis_extrema;

#endif
