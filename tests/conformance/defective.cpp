/*
 * A plugin that keeps the whole contract, but for the one defect that $ELVIS_DEFECT names: what `elvis check-plugin` must
 * catch. It is written against the C interface, because the C++ wrapper makes many of these mistakes impossible.
 *
 * Its file is "defective 1" and a line with a number s > 0. As a runtime plugin it is two hexahedra with everything optional
 * (defective.glsl); as a converter the same.
 */
#include "defective_data.hpp"
#include "defective_snippet.hpp"

#include <elvis/demand.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>

using namespace defective;

struct elvis_volume {
    Data data;
};

namespace {

/** Those of the snippet, by number from 1. */
constexpr const char* glsl_defects[] = {
    "glsl-syntax",      "glsl-name",         "glsl-float-only",  "glsl-single",          "glsl-shift",     "glsl-transposed",
    "glsl-pair",        "glsl-gradient",     "glsl-hessian",     "glsl-mapping-hessian", "glsl-inverse",   "glsl-inverse-false",
    "glsl-newton",      "glsl-cancellation", "glsl-nan-outside", "glsl-jump-outside",    "glsl-endless",   "glsl-unset",
    "glsl-no-offset",   "glsl-index",        "glsl-record",      "glsl-own-gradient",    "glsl-own-bound", "glsl-own-side",
    "glsl-own-nowhere", "glsl-own-unset",    "glsl-counts"};

std::int64_t glsl_defect() {
    for (std::size_t i = 0; i < std::size(glsl_defects); ++i) {
        if (has(glsl_defects[i])) {
            return static_cast<std::int64_t>(i) + 1;
        }
    }
    return 0;
}

elvis_result open_volume(const elvis_host* host, const char* path, const char* options, elvis_volume** volume) {
    Data data;
    const elvis_result result = open_data(host, path, options, data);
    if (result == ELVIS_OK) {
        *volume = new elvis_volume{data};
    }
    return result;
}

void close_volume(elvis_volume* volume) {
    --n_open;
    delete volume;
}

elvis_result get_info(elvis_volume* volume, elvis_volume_info* out) {
    if (has("hang")) {
        ::sleep(1000);
    }
    if (has("crash")) {
        volume = nullptr;
        const_cast<volatile Data&>(volume->data).scale = 0;
    }
    if (has("overwrite-size")) {
        *out = {};
        out->struct_size = sizeof *out;
    }
    out->dimension = 3;
    out->n_elements = has("nonsense-count") ? 0x123456789 : 2;
    out->n_faces = has("face-missing") ? 10 : has("face-crack") ? 12 : 11;
    out->n_classes = 1;
    out->n_fields = 1;
    out->n_time_steps = has("time-backwards") || has("buffer-time") ? 2 : 1;
    out->n_buffers = 2;
    return ELVIS_OK;
}

elvis_result get_class(elvis_volume*, std::uint32_t, elvis_element_class* out) {
    out->shape = ELVIS_SHAPE_HEXAHEDRON;
    out->n_elements = 2;
    std::fill_n(out->geometry_order, 3, has("low-geometry-order") ? 1u : 2u);
    out->is_affine = has("affine") ? 1 : 0;
    return ELVIS_OK;
}

elvis_result get_field(elvis_volume* volume, std::uint32_t, elvis_field* out) {
    out->n_components = 1;
    out->name = volume->data.name.c_str();
    out->continuity = ELVIS_CONTINUITY_CONTINUOUS;
    return ELVIS_OK;
}

elvis_result get_class_field(elvis_volume*, std::uint32_t, std::uint32_t, elvis_class_field* out) {
    static const elvis_constant constants[] = {{sizeof(elvis_constant), 0, "DEFECTIVE_DEFECT", glsl_defect()},
                                               {sizeof(elvis_constant), 0, "DEFECTIVE_DEFECT", glsl_defect()}};
    out->n_constants = has("twice-constant") ? 2 : 1;
    out->constants = constants;
    std::fill_n(out->order, 3, has("low-field-order") ? 1 : 2);
    return ELVIS_OK;
}

elvis_result get_time(elvis_volume*, std::uint32_t step, double* time) {
    *time = has("time-backwards") ? -static_cast<double>(step) : static_cast<double>(step);
    return ELVIS_OK;
}

elvis_result get_buffer(elvis_volume*, std::uint32_t buffer, std::uint32_t, elvis_buffer* out) {
    out->kind = ELVIS_BUFFER_REAL;
    out->name = buffer == 0 || has("buffer-name") ? "place" : "scale";
    out->element_class = 0;
    out->depends = buffer == 0 ? 0 : ELVIS_DEPENDS_ON_FIELD;
    out->n_records = 2;
    out->record_size = 4;
    return ELVIS_OK;
}

elvis_result fill_buffer(elvis_volume* volume, const elvis_fill_request* request, void* destination) {
    auto* number = static_cast<double*>(destination);
    static std::atomic<int> n_calls{0};
    const double disturbance = has("buffer-changes") ? n_calls++ : has("buffer-time") ? request->time_step : 0;
    for (std::uint64_t i = 0; i < request->count; ++i) {
        const std::uint64_t element = request->first + i;
        if (request->buffer == 0) {
            static constexpr double none[6] = {};
            const double* origin = has("no-origin") ? none : request->origins + 3 * element;
            const double numbers[] = {2 * static_cast<double>(element) - origin[0], -origin[1], -origin[2], disturbance};
            number = std::copy(std::begin(numbers), std::end(numbers), number);
        } else {
            const double numbers[] = {volume->data.scale, request->field_offset[0], 0, disturbance};
            number = std::copy(std::begin(numbers), std::end(numbers), number);
        }
    }
    if (has("buffer-overrun")) {
        *number = 0;
    }
    return ELVIS_OK;
}

elvis_result get_snippet(elvis_volume*, std::uint32_t, elvis_snippet* out) {
    // Names are found in both branches of an #if, so this one cannot stand in the file.
    static const std::string text = std::string(defective_snippet::files[0].text) +
                                    (has("glsl-name") ? "elvis_real helper(elvis_real x) { return x; }\n" : "");
    static const elvis_text source{sizeof(elvis_text), 0, "defective.glsl", text.c_str()};
    out->capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_INVERSE_MAPPING |
                        ELVIS_SNIPPET_FIELD_OFFSET | ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_FIELD_HESSIAN |
                        ELVIS_SNIPPET_MAPPING_HESSIAN | ELVIS_SNIPPET_INSIDE | ELVIS_SNIPPET_ELEMENT_RECORDS;
    out->prefix = "defective";
    out->n_sources = 1;
    out->sources = &source;
    return ELVIS_OK;
}

elvis_result get_bounds(elvis_volume* volume, std::uint64_t first, std::uint64_t count, double* bounds,
                        elvis_certainty* certainty) {
    const double nonsense = volume->data.scale > 0 && volume->data.scale < 1e6 ? 0 : std::nan("");
    for (std::uint64_t i = 0; i < count; ++i) {
        const double x = 2 * static_cast<double>(has("piece-first") ? i : first + i) + nonsense;
        const double top = has("small-bounds") ? 1.15 : 1.201;
        const double box[] = {x - 1.001, -1.001, -1.101, x + 1.001, top, 1.101};
        std::copy(std::begin(box), std::end(box), bounds + 6 * i);
    }
    *certainty = ELVIS_CERTIFIED;
    return ELVIS_OK;
}

elvis_result get_element_numbers(elvis_volume*, std::uint64_t first, std::uint64_t count, std::int64_t* numbers) {
    for (std::uint64_t i = 0; i < count; ++i) {
        numbers[i] = has("same-number") ? 7 : static_cast<std::int64_t>(10 + first + i);
    }
    return ELVIS_OK;
}

elvis_result get_faces(elvis_volume*, std::uint64_t first, std::uint64_t count, elvis_face* faces) {
    auto* entry = reinterpret_cast<unsigned char*>(faces);
    const std::size_t stride = has("stride") ? sizeof(elvis_face) : faces->struct_size;
    for (std::uint64_t i = 0; i < count; ++i, entry += stride) {
        // Face 0 is the shared one: +xi1 of element 0 and -xi1 of element 1.
        const std::uint64_t face = first + i;
        const std::uint64_t number = face == 0 ? 2 : face <= 5 ? (face <= 2 ? face - 1 : face) : (face - 6 <= 3 ? face - 6 : 5);
        elvis_face out{};
        out.struct_size = faces->struct_size;
        out.group = ELVIS_GROUP_NONE;
        out.element = face <= 5 ? 0 : 1;
        out.local_face = static_cast<std::int32_t>(has("face-twice") && face == 3 ? 2 : number);
        out.neighbour = face == 0 ? 1 : ELVIS_NEIGHBOUR_NONE;
        out.neighbour_local_face = face != 0 ? -1 : has("face-neighbour") ? 2 : 4;
        if (has("face-neighbour") && face == 8) {
            out.local_face = 4;
        }
        if (has("face-crack") && (face == 0 || face == 11)) {
            out.neighbour = ELVIS_NEIGHBOUR_NONE;
            out.neighbour_local_face = -1;
            out.local_face = face == 0 ? 2 : 4;
        }
        std::memcpy(entry, &out, sizeof out);
    }
    return ELVIS_OK;
}

elvis_result get_field_ranges(elvis_volume* volume, std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t count,
                              double* ranges, elvis_certainty* certainty) {
    for (std::uint64_t i = 0; i < count; ++i) {
        ranges[2 * i] = -1.001 * volume->data.scale;
        ranges[2 * i + 1] = (has("small-range") ? 1.9 : 2.001) * volume->data.scale;
    }
    *certainty = ELVIS_CERTIFIED;
    return ELVIS_OK;
}

elvis_result get_derivative_bounds(elvis_volume* volume, std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t count,
                                   double* bounds, elvis_certainty* certainty) {
    for (std::uint64_t i = 0; i < count; ++i) {
        bounds[2 * i] = (has("small-slope") ? 1 : 4.001) * volume->data.scale;
        bounds[2 * i + 1] = (has("small-bend") ? 2 : 4.001) * volume->data.scale;
    }
    *certainty = ELVIS_CERTIFIED;
    return ELVIS_OK;
}

elvis_result evaluate_mapping(elvis_volume*, std::uint64_t element, std::uint64_t n_points, const double* xi, double* positions,
                              double* jacobians) {
    for (std::uint64_t i = 0; i < n_points; ++i, xi += 3) {
        if (positions) {
            position(element, xi, positions + 3 * i);
        }
        if (jacobians) {
            double* j = jacobians + 9 * i;
            const double entries[] = {1, 0, 0, 0.4 * xi[0], 1, 0, 0.2 * xi[0] * xi[1], 0.1 * xi[0] * xi[0], 1};
            std::copy(std::begin(entries), std::end(entries), j);
            if (has("cpu-jacobian")) {
                std::swap(j[1], j[3]);
            }
        }
    }
    return ELVIS_OK;
}

elvis_result evaluate_field(elvis_volume* volume, std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t n_points,
                            const double* xi, double* values, double* gradients) {
    const Inside inside(has("threads"));
    const double s = volume->data.scale;
    for (std::uint64_t i = 0; i < n_points; ++i, xi += 3) {
        if (values) {
            values[i] = value(volume->data, xi) + (inside.is_disturbed() ? 1 : 0);
        }
        if (gradients) {
            const double entries[] = {(has("cpu-gradient") ? 1 : 2) * s * xi[0], s * xi[2], s * xi[1]};
            std::copy(std::begin(entries), std::end(entries), gradients + 3 * i);
        }
    }
    return ELVIS_OK;
}

elvis_result check_jacobians(elvis_volume*, std::uint64_t, std::uint64_t count, double, elvis_jacobian_check* checks,
                             elvis_certainty* certainty) {
    auto* entry = reinterpret_cast<unsigned char*>(checks);
    for (std::uint64_t i = 0; i < count; ++i, entry += checks->struct_size) {
        elvis_jacobian_check out{};
        out.struct_size = checks->struct_size;
        out.sign = has("jacobian-negative") ? ELVIS_JACOBIAN_NEGATIVE : ELVIS_JACOBIAN_POSITIVE;
        out.determinant = -1;
        out.lower = has("jacobian-lower") ? 2 : 0.999;
        std::memcpy(entry, &out, sizeof out);
    }
    *certainty = ELVIS_CERTIFIED;
    return ELVIS_OK;
}

const void* get_interface(const char* id) {
    static const elvis_runtime runtime = {has("table-size") ? 1000001u : static_cast<std::uint32_t>(sizeof(elvis_runtime)),
                                          0,
                                          probe,
                                          open_volume,
                                          close_volume,
                                          get_info,
                                          get_class,
                                          get_field,
                                          get_class_field,
                                          get_time,
                                          get_buffer,
                                          get_snippet,
                                          get_bounds,
                                          fill_buffer,
                                          get_element_numbers,
                                          get_faces,
                                          nullptr,
                                          get_field_ranges,
                                          nullptr,
                                          evaluate_mapping,
                                          evaluate_field,
                                          get_derivative_bounds,
                                          check_jacobians};
    if (std::strcmp(id, ELVIS_CONVERTER_INTERFACE) == 0) {
        return converter();
    }
    return std::strcmp(id, ELVIS_RUNTIME_INTERFACE) == 0 || has("every-interface") ? &runtime : nullptr;
}

} // namespace

const elvis_plugin_descriptor* elvis_plugin_get_descriptor(void) {
    if (has("crash-on-load")) {
        std::abort();
    }
    static elvis_plugin_descriptor descriptors[16];
    static int next = 0;
    elvis_plugin_descriptor& descriptor = descriptors[has("fresh-descriptor") ? next++ % 16 : 0];
    descriptor = {sizeof descriptor,
                  ELVIS_ABI_VERSION,
                  "org.elvis.test.defective",
                  has("nameless") ? nullptr : "Defective",
                  "1.0.0",
                  nullptr,
                  nullptr,
                  get_interface};
    return &descriptor;
}
