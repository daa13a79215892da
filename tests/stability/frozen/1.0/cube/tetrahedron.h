/*
 * The smallest source for conversion, in C: the reference tetrahedron with the field x.
 */
#ifndef FIXTURE_TETRAHEDRON_H
#define FIXTURE_TETRAHEDRON_H

#include <elvis/converter.h>

#include <stdlib.h>
#include <string.h>

struct elvis_source_volume {
    char options[200];
};

static inline elvis_result tetrahedron_probe(const elvis_host* host, const char* path, uint32_t* confidence) {
    (void)host;
    *confidence = strstr(path, ".tetrahedron") ? 100u : 0u;
    return ELVIS_OK;
}

static inline elvis_result tetrahedron_open(const elvis_host* host, const char* const* paths, uint32_t n_paths,
                                            const char* options, elvis_source_volume** source) {
    (void)host;
    (void)paths;
    (void)n_paths;
    *source = calloc(1, sizeof **source);
    if (!*source) {
        return ELVIS_ERROR_OUT_OF_MEMORY;
    }
    strncpy((*source)->options, options ? options : "", sizeof(*source)->options - 1);
    return ELVIS_OK;
}

static inline void tetrahedron_close(elvis_source_volume* source) { free(source); }

static inline elvis_result tetrahedron_get_info(elvis_source_volume* source, elvis_source_info* info) {
    (void)source;
    info->dimension = 3;
    info->n_elements = 1;
    info->n_corner_ids = 4;
    info->n_fields = 1;
    info->n_time_steps = 1;
    info->mantissa_bits = 53;
    return ELVIS_OK;
}

static inline elvis_result tetrahedron_get_field(elvis_source_volume* source, uint32_t field, elvis_source_field* out) {
    (void)source;
    (void)field;
    out->n_components = 1;
    out->name = "x";
    return ELVIS_OK;
}

static inline elvis_result tetrahedron_get_elements(elvis_source_volume* source, uint64_t first, uint64_t count,
                                                    elvis_source_element* out) {
    (void)source;
    (void)first;
    for (uint64_t i = 0; i < count; ++i) {
        out[i].shape = ELVIS_SHAPE_TETRAHEDRON;
        for (int d = 0; d < 3; ++d) {
            out[i].geometry_order[d] = 1;
        }
        for (int corner = 0; corner < 4; ++corner) {
            out[i].corners[corner] = corner;
            out[i].face_groups[corner] = ELVIS_GROUP_NONE;
        }
    }
    return ELVIS_OK;
}

static inline elvis_result tetrahedron_get_spaces(elvis_source_volume* source, uint32_t field, uint64_t first, uint64_t count,
                                                  elvis_source_space* out) {
    (void)source;
    (void)field;
    (void)first;
    for (uint64_t i = 0; i < count; ++i) {
        out[i].order[0] = out[i].order[1] = out[i].order[2] = 1;
        out[i].is_contained = 1;
    }
    return ELVIS_OK;
}

static inline elvis_result tetrahedron_evaluate_mapping(elvis_source_volume* source, uint64_t element, uint64_t n_points,
                                                        const double* xi, double* positions) {
    (void)source;
    (void)element;
    memcpy(positions, xi, n_points * 3 * sizeof *xi);
    return ELVIS_OK;
}

/** The same at reference points and at positions: the mapping is the identity. */
static inline elvis_result tetrahedron_sample(elvis_source_volume* source, uint32_t time_step, uint64_t element,
                                              uint64_t n_points, const double* x, double* values) {
    (void)source;
    (void)time_step;
    (void)element;
    for (uint64_t i = 0; i < n_points; ++i) {
        values[i] = x[3 * i];
    }
    return ELVIS_OK;
}

/** The table's initializer, without a function to sample. */
#define TETRAHEDRON_CONVERTER(size)                                                                                            \
    .struct_size = (size), .probe = tetrahedron_probe, .open = tetrahedron_open, .close = tetrahedron_close,                   \
    .get_info = tetrahedron_get_info, .get_field = tetrahedron_get_field, .get_elements = tetrahedron_get_elements,            \
    .get_spaces = tetrahedron_get_spaces, .evaluate_mapping = tetrahedron_evaluate_mapping

#endif
