/*
 * The smallest runtime volume, in C: one cube of two units with the field x. Fixtures are variations of it.
 */
#ifndef FIXTURE_CUBE_H
#define FIXTURE_CUBE_H

#include <elvis/runtime.h>

#include <stdlib.h>
#include <string.h>

struct elvis_volume {
    const elvis_host* host;
    char options[200];
};

static inline elvis_result cube_probe(const elvis_host* host, const char* path, uint32_t* confidence) {
    (void)host;
    *confidence = strstr(path, ".cube") ? 100u : 0u;
    return ELVIS_OK;
}

static inline elvis_result cube_open(const elvis_host* host, const char* path, const char* options, elvis_volume** volume) {
    (void)path;
    host->log(host, ELVIS_LOG_WARNING, "a cube is opened");
    host->report_progress(host, 0.5, "opening");
    if (host->is_cancelled(host)) {
        return ELVIS_ERROR_CANCELLED;
    }
    *volume = calloc(1, sizeof **volume);
    if (!*volume) {
        return ELVIS_ERROR_OUT_OF_MEMORY;
    }
    (*volume)->host = host;
    strncpy((*volume)->options, options ? options : "", sizeof(*volume)->options - 1);
    return ELVIS_OK;
}

static inline void cube_close(elvis_volume* volume) { free(volume); }

static inline elvis_result cube_get_info(elvis_volume* volume, elvis_volume_info* info) {
    (void)volume;
    info->dimension = 3;
    info->n_elements = 1;
    info->n_classes = 1;
    info->n_fields = 1;
    info->n_time_steps = 1;
    info->n_buffers = 1;
    return ELVIS_OK;
}

static inline elvis_result cube_get_class(elvis_volume* volume, uint32_t element_class, elvis_element_class* out) {
    (void)volume;
    (void)element_class;
    out->shape = ELVIS_SHAPE_HEXAHEDRON;
    out->n_elements = 1;
    out->geometry_order[0] = out->geometry_order[1] = out->geometry_order[2] = 1;
    return ELVIS_OK;
}

static inline elvis_result cube_get_field(elvis_volume* volume, uint32_t field, elvis_field* out) {
    (void)volume;
    (void)field;
    out->n_components = 1;
    out->name = "x";
    return ELVIS_OK;
}

static inline elvis_result cube_get_class_field(elvis_volume* volume, uint32_t element_class, uint32_t field,
                                                elvis_class_field* out) {
    (void)volume;
    (void)element_class;
    (void)field;
    out->order[0] = out->order[1] = out->order[2] = 1;
    return ELVIS_OK;
}

static inline elvis_result cube_get_time(elvis_volume* volume, uint32_t time_step, double* time) {
    (void)volume;
    (void)time_step;
    *time = 0;
    return ELVIS_OK;
}

static inline elvis_result cube_get_buffer(elvis_volume* volume, uint32_t buffer, uint32_t field, elvis_buffer* out) {
    (void)volume;
    (void)buffer;
    (void)field;
    out->kind = ELVIS_BUFFER_REAL;
    out->name = "scale";
    out->n_records = 1;
    out->record_size = 1;
    return ELVIS_OK;
}

static inline elvis_result cube_get_snippet(elvis_volume* volume, uint32_t element_class, elvis_snippet* out) {
    static const elvis_text sources[] = {
        {sizeof(elvis_text), 0, "cube.glsl",
         "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return xi; }\n"
         "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) { return elvis_mat3(elvis_real(1)); }\n"
         "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {\n"
         "    return elvis_fetch_scale(element, 0u) * xi.x;\n"
         "}\n"}};
    (void)volume;
    (void)element_class;
    out->prefix = "cube";
    out->n_sources = 1;
    out->sources = sources;
    return ELVIS_OK;
}

static inline elvis_result cube_get_bounds(elvis_volume* volume, uint64_t first, uint64_t count, double* bounds,
                                           elvis_certainty* certainty) {
    (void)volume;
    (void)first;
    for (uint64_t i = 0; i < count; ++i) {
        for (int d = 0; d < 3; ++d) {
            bounds[6 * i + (uint64_t)d] = -1;
            bounds[6 * i + (uint64_t)d + 3] = 1;
        }
    }
    *certainty = ELVIS_CERTIFIED;
    return ELVIS_OK;
}

static inline elvis_result cube_fill_buffer(elvis_volume* volume, const elvis_fill_request* request, void* destination) {
    (void)volume;
    for (uint64_t i = 0; i < request->count; ++i) {
        ((double*)destination)[i] = 1;
    }
    return ELVIS_OK;
}

/** The table's initializer, up to the last required function. */
#define CUBE_RUNTIME(size)                                                                                                     \
    .struct_size = (size), .probe = cube_probe, .open = cube_open, .close = cube_close, .get_info = cube_get_info,             \
    .get_class = cube_get_class, .get_field = cube_get_field, .get_class_field = cube_get_class_field,                         \
    .get_time = cube_get_time, .get_buffer = cube_get_buffer, .get_snippet = cube_get_snippet, .get_bounds = cube_get_bounds,  \
    .fill_buffer = cube_fill_buffer

#endif
