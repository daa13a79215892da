/*
 * A plugin that keeps the whole contract, but for the one defect that $ELVIS_DEFECT names: what `elvis check-plugin` must
 * catch. It is written against the C interface, because the C++ wrapper makes many of these mistakes impossible.
 *
 * Its file is "defective 1" and a line with a number s > 0. As a runtime plugin it is two hexahedra with everything optional
 * (defective.glsl); as a converter the same.
 */
#include "defective_snippet.hpp"

#include <elvis/converter.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>

namespace {

/** Whether this is the defect to have. */
bool has(std::string_view defect) {
    static const char* const wanted = std::getenv("ELVIS_DEFECT");
    return wanted && defect == wanted;
}

/** Those of the snippet, by number from 1. */
constexpr const char* glsl_defects[] = {
    "glsl-syntax",       "glsl-name",          "glsl-float-only", "glsl-single",       "glsl-shift",
    "glsl-transposed",   "glsl-pair",          "glsl-gradient",   "glsl-hessian",      "glsl-mapping-hessian",
    "glsl-inverse",      "glsl-inverse-false", "glsl-newton",     "glsl-cancellation", "glsl-nan-outside",
    "glsl-jump-outside", "glsl-endless",       "glsl-unset",      "glsl-no-offset",    "glsl-index",
    "glsl-record",       "glsl-own-gradient",  "glsl-own-bound",  "glsl-own-side",     "glsl-own-nowhere",
    "glsl-own-unset"};

std::int64_t glsl_defect() {
    for (std::size_t i = 0; i < std::size(glsl_defects); ++i) {
        if (has(glsl_defects[i])) {
            return static_cast<std::int64_t>(i) + 1;
        }
    }
    return 0;
}

std::atomic<int> n_opened{0}; ///< ever
std::atomic<int> n_open{0};   ///< now
std::atomic<int> n_inside{0}; ///< calls of evaluate at this moment

/** What both interfaces open. */
struct Data {
    const elvis_host* host = nullptr;
    double scale = 1;
    std::string name = "bend";
    char* lost = nullptr; ///< never released
};

elvis_result fail(const elvis_host* host, elvis_result code, const char* file, const char* message) {
    if (!has("open-silent")) {
        host->set_error(host, file, message);
    }
    return has("open-wrong-code") ? 42 : code;
}

bool is_ours(const char* path) {
    char head[11] = {};
    std::FILE* file = std::fopen(path, "rb");
    const bool is_whole = file && std::fread(head, 1, 10, file) == 10;
    if (file) {
        std::fclose(file);
    }
    if (has("probe-crash") && !is_whole) {
        std::abort();
    }
    if (has("probe-slow")) {
        ::usleep(600000);
    }
    return (is_whole && std::strcmp(head, "defective ") == 0 && !has("probe-none")) || has("probe-all");
}

elvis_result read(const elvis_host* host, const char* path, Data& data) {
    std::FILE* file = std::fopen(path, "rb");
    if (!file) {
        return has("open-anything") ? ELVIS_OK : fail(host, ELVIS_ERROR_FILE, path, "cannot be read");
    }
    char text[100] = {};
    const std::size_t size = std::fread(text, 1, sizeof text - 1, file);
    if (!has("leak-file")) {
        std::fclose(file);
    }
    if (has("open-anything")) {
        return ELVIS_OK;
    }
    if (std::strncmp(text, "defective 1\n", 12) != 0) {
        return fail(host, ELVIS_ERROR_FORMAT, path, "line 1: 'defective 1' is expected");
    }
    char* end = nullptr;
    data.scale = std::strtod(text + 12, &end);
    const bool is_sound = end != text + 12 && end == text + size - 1 && *end == '\n' && data.scale > 0 && data.scale < 1e6;
    if (!is_sound && has("damage-crash")) {
        std::abort();
    }
    if (!is_sound && !has("damage-nonsense")) {
        return fail(host, ELVIS_ERROR_FORMAT, path, "line 2: a positive number is expected, and nothing behind it");
    }
    return ELVIS_OK;
}

/** The part of open that both interfaces have. */
elvis_result open_data(const elvis_host* host, const char* path, const char* options, Data& data) {
    if (has("options-crash") && options && options[0] != '{') {
        std::abort();
    }
    if (has("cancel-uncalled")) {
        return ELVIS_ERROR_CANCELLED;
    }
    for (int i = 0; i < 10; ++i) {
        if (host->is_cancelled(host) && !has("cancel-ignored")) {
            host->set_error(host, nullptr, "stopped");
            return has("cancel-code") ? ELVIS_ERROR_FAILED : ELVIS_ERROR_CANCELLED;
        }
    }
    data.host = host;
    const elvis_result result = read(host, path, data);
    if (result != ELVIS_OK) {
        return result;
    }
    const int number = n_opened++;
    if (n_open++ > 0 && has("open-race")) {
        data.scale *= 2;
    }
    if (has("open-race")) {
        ::usleep(1000); // so that two meet
    }
    if (has("leak")) {
        data.lost = new char[10000];
    }
    if (has("changing")) {
        data.name += std::to_string(number);
    }
    if (has("source-changing")) {
        data.scale *= 1 + number;
    }
    return ELVIS_OK;
}

/** Another thread inside at the same time is a mistake only for the defects that say so. */
class Inside {
public:
    explicit Inside(bool is_defective) : m_is_defective(is_defective) {
        if (m_is_defective) {
            m_others = n_inside++;
            ::usleep(100);
        }
    }
    ~Inside() {
        if (m_is_defective) {
            --n_inside;
        }
    }
    bool is_disturbed() const { return m_is_defective && m_others > 0; }

private:
    bool m_is_defective;
    int m_others = 0;
};

void position(std::uint64_t element, const double* xi, double* x) {
    x[0] = 2 * static_cast<double>(element) + xi[0];
    x[1] = xi[1] + 0.2 * xi[0] * xi[0];
    x[2] = xi[2] + 0.1 * xi[0] * xi[0] * xi[1];
}

double value(const Data& data, const double* xi) { return data.scale * (xi[0] * xi[0] + xi[1] * xi[2]); }

} // namespace

struct elvis_volume {
    Data data;
};
struct elvis_source_volume {
    Data data;
};

namespace {

elvis_result probe(const elvis_host*, const char* path, std::uint32_t* confidence) {
    *confidence = is_ours(path) ? 100 : 0;
    return ELVIS_OK;
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
    out->n_faces = has("face-missing") ? 10 : 11;
    out->n_classes = 1;
    out->n_fields = 1;
    out->n_time_steps = has("time-backwards") || has("buffer-time") ? 2 : 1;
    out->n_buffers = 2;
    return ELVIS_OK;
}

elvis_result get_class(elvis_volume*, std::uint32_t, elvis_element_class* out) {
    out->shape = ELVIS_SHAPE_HEXAHEDRON;
    out->n_elements = 2;
    std::fill_n(out->geometry_order, 3, 2u);
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
    std::fill_n(out->order, 3, 2);
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
            const double* origin = request->origins + 3 * element;
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
                        ELVIS_SNIPPET_MAPPING_HESSIAN | ELVIS_SNIPPET_INSIDE;
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

elvis_result open_source(const elvis_host* host, const char* const* paths, std::uint32_t, const char* options,
                         elvis_source_volume** source) {
    Data data;
    const elvis_result result = open_data(host, paths[0], options, data);
    if (result == ELVIS_OK) {
        *source = new elvis_source_volume{data};
    }
    return result;
}

void close_source(elvis_source_volume* source) {
    --n_open;
    delete source;
}

elvis_result get_source_info(elvis_source_volume*, elvis_source_info* out) {
    out->dimension = 3;
    out->n_elements = 2;
    out->n_corner_ids = 12;
    out->n_fields = 1;
    out->n_time_steps = 1;
    out->mantissa_bits = has("source-bits") ? 99 : 53;
    return ELVIS_OK;
}

elvis_result get_source_field(elvis_source_volume* source, std::uint32_t, elvis_source_field* out) {
    out->n_components = 1;
    out->name = source->data.name.c_str();
    out->continuity = ELVIS_CONTINUITY_CONTINUOUS;
    return ELVIS_OK;
}

elvis_result get_elements(elvis_source_volume*, std::uint64_t first, std::uint64_t count, elvis_source_element* elements) {
    // Four corners at each of x = -1, 1, 3, counted round the face.
    constexpr std::int64_t of_corner[] = {0, 4, 5, 1, 3, 7, 6, 2};
    auto* entry = reinterpret_cast<unsigned char*>(elements);
    const std::size_t stride = has("source-stride") ? sizeof(elvis_source_element) : elements->struct_size;
    for (std::uint64_t i = 0; i < count; ++i, entry += stride) {
        elvis_source_element out{};
        out.struct_size = elements->struct_size;
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        std::fill_n(out.geometry_order, 3, has("source-geometry") ? 1u : 2u);
        const auto element = static_cast<std::int64_t>(has("source-piece") ? i : first + i);
        for (std::size_t corner = 0; corner < 8; ++corner) {
            out.corners[corner] = of_corner[corner] + 4 * element;
        }
        if (has("source-corner")) {
            std::swap(out.corners[2], out.corners[3]);
        }
        std::fill_n(out.face_groups, 6, ELVIS_GROUP_NONE);
        std::memcpy(entry, &out, sizeof out);
    }
    return ELVIS_OK;
}

elvis_result get_spaces(elvis_source_volume*, std::uint32_t, std::uint64_t, std::uint64_t count, elvis_source_space* spaces) {
    auto* entry = reinterpret_cast<unsigned char*>(spaces);
    for (std::uint64_t i = 0; i < count; ++i, entry += spaces->struct_size) {
        elvis_source_space out{};
        out.struct_size = spaces->struct_size;
        std::fill_n(out.order, 3, has("source-claims") ? 1u : 2u);
        out.is_contained = 1;
        std::memcpy(entry, &out, sizeof out);
    }
    return ELVIS_OK;
}

elvis_result map_source(elvis_source_volume*, std::uint64_t element, std::uint64_t n_points, const double* xi,
                        double* positions) {
    for (std::uint64_t i = 0; i < n_points; ++i) {
        position(element, xi + 3 * i, positions + 3 * i);
    }
    return ELVIS_OK;
}

elvis_result sample(elvis_source_volume* source, std::uint32_t, std::uint64_t, std::uint64_t n_points, const double* xi,
                    double* values) {
    const Inside inside(has("source-threads"));
    for (std::uint64_t i = 0; i < n_points; ++i) {
        if (has("source-unwritten") && i + 1 == n_points && n_points > 1) {
            continue;
        }
        const bool is_wrong = inside.is_disturbed() || (has("source-batch") && n_points == 1);
        values[i] = value(source->data, xi + 3 * i) + (is_wrong ? 1 : 0);
    }
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
    static const elvis_converter converter = {sizeof(elvis_converter),
                                              0,
                                              probe,
                                              open_source,
                                              close_source,
                                              get_source_info,
                                              get_source_field,
                                              get_elements,
                                              get_spaces,
                                              map_source,
                                              sample,
                                              nullptr,
                                              nullptr,
                                              nullptr};
    if (std::strcmp(id, ELVIS_CONVERTER_INTERFACE) == 0) {
        return &converter;
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
