/*
 * The tables of the C interface. Every function checks its arguments, calls Volume, and turns exceptions into result codes.
 */
#include "error.hpp"
#include "native_snippet.hpp"
#include "volume.hpp"

#include <elvis/plugin.h>

#include <cstring>
#include <new>

struct elvis_volume {
    const elvis_host* host;
    elvis::native_plugin::Volume volume;
};

namespace elvis::native_plugin {
namespace {

elvis_result report(const elvis_host* host, const char* file, elvis_result code, const char* message) {
    host->set_error(host, file, message);
    return code;
}

/** Calls `body` and describes what it throws; `path` is the file at fault. */
template <class Body> elvis_result guard(const elvis_host* host, const char* path, Body body) {
    try {
        body();
        return ELVIS_OK;
    } catch (const PluginError& error) {
        return report(host, path, error.code(), error.what());
    } catch (const native::FileError& error) {
        return report(host, error.file().c_str(), ELVIS_ERROR_FORMAT, error.what());
    } catch (const std::bad_alloc&) {
        return report(host, path, ELVIS_ERROR_OUT_OF_MEMORY, "not enough memory");
    } catch (const std::exception& error) {
        return report(host, path, ELVIS_ERROR_FAILED, error.what());
    } catch (...) {
        return report(host, path, ELVIS_ERROR_FAILED, "unknown exception");
    }
}

template <class Body> elvis_result guard(elvis_volume* volume, Body body) {
    return guard(volume->host, volume->volume.path().c_str(), [&] { body(volume->volume); });
}

elvis_string text_or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

void check_field(const Volume& volume, std::uint32_t field) {
    require(field < volume.description().fields.size(), "field index out of range");
}

void check_time_step(const Volume& volume, std::uint32_t time_step) {
    require(time_step < volume.description().times.size(), "time step out of range");
}

void check_class(const Volume& volume, std::uint32_t element_class) {
    require(element_class < volume.description().classes.size(), "element class out of range");
}

void check_elements(const Volume& volume, std::uint64_t first, std::uint64_t count) {
    require(first <= volume.n_elements() && count <= volume.n_elements() - first, "elements out of range");
}

elvis_result probe(const elvis_host* host, const char* path, std::uint32_t* confidence) {
    return guard(host, path, [&] { *confidence = static_cast<std::uint32_t>(native::Reader::probe(path)); });
}

elvis_result open(const elvis_host* host, const char* path, const char*, elvis_volume** volume) {
    return guard(host, path, [&] { *volume = new elvis_volume{host, Volume(host, path)}; });
}

void close(elvis_volume* volume) { delete volume; }

/** Two buffers a class: geometry, then field. */
constexpr std::uint32_t n_buffers_per_class = 2;

elvis_result get_info(elvis_volume* handle, elvis_volume_info* info) {
    return guard(handle, [&](const Volume& volume) {
        const native::Description& description = volume.description();
        const std::uint32_t size = info->struct_size;
        const auto count = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
        *info = {size,
                 static_cast<std::uint32_t>(description.dimension),
                 volume.n_elements(),
                 description.n_faces,
                 count(description.classes.size()),
                 count(description.boundary_groups.size()),
                 count(description.fields.size()),
                 count(description.times.size()),
                 count(description.classes.size() * n_buffers_per_class),
                 count(description.notes.size())};
    });
}

elvis_result get_class(elvis_volume* handle, std::uint32_t element_class, elvis_element_class* out) {
    return guard(handle, [&](const Volume& volume) {
        check_class(volume, element_class);
        const native::Space& geometry = volume.geometry_space(element_class);
        *out = {out->struct_size,
                static_cast<elvis_shape>(geometry.shape),
                volume.description().classes[element_class].n_elements,
                {geometry.order[0], geometry.order[1], geometry.order[2]},
                // Straight elements of the other shapes may be affine too, but only their coefficients would tell.
                geometry.shape == native::Shape::tetrahedron && geometry.order[2] <= 1 ? 1u : 0u};
    });
}

elvis_result get_field(elvis_volume* handle, std::uint32_t field, elvis_field* out) {
    return guard(handle, [&](const Volume& volume) {
        check_field(volume, field);
        const native::Field& from = volume.description().fields[field];
        *out = {out->struct_size,
                from.n_components,
                from.name.c_str(),
                text_or_null(from.unit),
                static_cast<elvis_continuity>(from.continuity),
                static_cast<elvis_transform>(from.transform),
                from.max_jump};
    });
}

elvis_result get_class_field(elvis_volume* handle, std::uint32_t element_class, std::uint32_t field, elvis_class_field* out) {
    return guard(handle, [&](const Volume& volume) {
        check_class(volume, element_class);
        check_field(volume, field);
        const std::span<const elvis_constant> constants = volume.constants(element_class, field);
        const std::array<std::uint32_t, 3>& order = volume.field_space(element_class, field).order;
        // With a transform the field is rational in xi.
        const bool polynomial = volume.description().fields[field].transform == native::Transform::none;
        const auto number = [&](std::size_t i) { return polynomial ? static_cast<std::int32_t>(order[i]) : -1; };
        *out = {out->struct_size,
                static_cast<std::uint32_t>(constants.size()),
                constants.data(),
                {number(0), number(1), number(2)},
                0};
    });
}

elvis_result get_time(elvis_volume* handle, std::uint32_t time_step, double* time) {
    return guard(handle, [&](const Volume& volume) {
        check_time_step(volume, time_step);
        *time = volume.description().times[time_step];
    });
}

elvis_result get_buffer(elvis_volume* handle, std::uint32_t buffer, std::uint32_t field, elvis_buffer* out) {
    return guard(handle, [&](const Volume& volume) {
        const std::uint32_t element_class = buffer / n_buffers_per_class;
        check_class(volume, element_class);
        const bool geometry = buffer % n_buffers_per_class == 0;
        if (!geometry)
            check_field(volume, field);
        const std::size_t size =
            geometry ? volume.geometry_record_size(element_class) : volume.field_record_size(element_class, field);
        *out = {out->struct_size,
                ELVIS_BUFFER_REAL,
                geometry ? "geometry" : "field",
                element_class,
                geometry ? 0u : ELVIS_DEPENDS_ON_FIELD | ELVIS_DEPENDS_ON_TIME,
                volume.description().classes[element_class].n_elements,
                static_cast<std::uint32_t>(size),
                0};
    });
}

elvis_result get_snippet(elvis_volume* handle, std::uint32_t element_class, elvis_snippet* out) {
    return guard(handle, [&](const Volume& volume) {
        check_class(volume, element_class);
        static const std::vector<elvis_text> sources = [] {
            std::vector<elvis_text> texts;
            for (const auto& file : snippet::files) {
                // Known to the shader and to messages by its name alone.
                const char* slash = std::strrchr(file.name, '/');
                texts.push_back({sizeof(elvis_text), 0, slash == nullptr ? file.name : slash + 1, file.text});
            }
            return texts;
        }();
        *out = {out->struct_size,
                ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_OFFSET |
                    ELVIS_SNIPPET_LOCAL_ORIGIN,
                "native",
                static_cast<std::uint32_t>(sources.size()),
                0,
                sources.data()};
    });
}

elvis_result get_bounds(elvis_volume* handle, std::uint64_t first, std::uint64_t count, double* bounds,
                        elvis_certainty* certainty) {
    return guard(handle, [&](const Volume& volume) {
        check_elements(volume, first, count);
        volume.bounds(first, count, std::span(bounds, count * 6));
        *certainty = ELVIS_CERTIFIED;
    });
}

elvis_result fill_buffer(elvis_volume* handle, const elvis_fill_request* request, void* destination) {
    return guard(handle, [&](const Volume& volume) {
        const std::uint32_t element_class = request->buffer / n_buffers_per_class;
        check_class(volume, element_class);
        const std::uint64_t n_elements = volume.description().classes[element_class].n_elements;
        require(request->first <= n_elements && request->count <= n_elements - request->first, "records out of range");
        auto* numbers = static_cast<double*>(destination);
        if (request->buffer % n_buffers_per_class == 0) {
            const double* origins = request->origins == nullptr
                                        ? nullptr
                                        : request->origins + 3 * (volume.first_element(element_class) + request->first);
            volume.fill_geometry(element_class, request->first, request->count, origins,
                                 std::span(numbers, request->count * volume.geometry_record_size(element_class)));
            return;
        }
        check_field(volume, request->field);
        check_time_step(volume, request->time_step);
        std::span<const double> offset;
        if (request->field_offset != nullptr)
            offset = {request->field_offset, volume.description().fields[request->field].n_components};
        volume.fill_field(element_class, request->field, request->time_step, request->first, request->count, offset,
                          std::span(numbers, request->count * volume.field_record_size(element_class, request->field)));
    });
}

elvis_result get_element_numbers(elvis_volume* handle, std::uint64_t first, std::uint64_t count, std::int64_t* numbers) {
    return guard(handle, [&](const Volume& volume) {
        check_elements(volume, first, count);
        volume.element_numbers(first, std::span(numbers, count));
    });
}

elvis_result get_faces(elvis_volume* handle, std::uint64_t first, std::uint64_t count, elvis_face* faces) {
    return guard(handle, [&](const Volume& volume) {
        const std::uint64_t n_faces = volume.description().n_faces;
        require(first <= n_faces && count <= n_faces - first, "faces out of range");
        volume.faces(first, std::span(faces, count));
    });
}

elvis_result get_boundary_group(elvis_volume* handle, std::uint32_t group, elvis_string* name) {
    return guard(handle, [&](const Volume& volume) {
        require(group < volume.description().boundary_groups.size(), "boundary group out of range");
        *name = volume.description().boundary_groups[group].c_str();
    });
}

elvis_result get_field_ranges(elvis_volume* handle, std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                              std::uint64_t count, double* ranges, elvis_certainty* certainty) {
    return guard(handle, [&](const Volume& volume) {
        check_field(volume, field);
        check_time_step(volume, time_step);
        check_elements(volume, first, count);
        const std::size_t n_components = volume.description().fields[field].n_components;
        *certainty = volume.field_ranges(field, time_step, first, count, std::span(ranges, count * n_components * 2));
    });
}

elvis_result get_note(elvis_volume* handle, std::uint32_t note, elvis_string* key, elvis_string* value) {
    return guard(handle, [&](const Volume& volume) {
        require(note < volume.description().notes.size(), "note out of range");
        *key = volume.description().notes[note].first.c_str();
        *value = volume.description().notes[note].second.c_str();
    });
}

/** An output array that may be missing. */
std::span<double> optional(double* numbers, std::size_t size) {
    return numbers == nullptr ? std::span<double>() : std::span(numbers, size);
}

elvis_result evaluate_mapping(elvis_volume* handle, std::uint64_t element, std::uint64_t n_points, const double* xi,
                              double* positions, double* jacobians) {
    return guard(handle, [&](const Volume& volume) {
        volume.evaluate_mapping(element, std::span(xi, 3 * n_points), optional(positions, 3 * n_points),
                                optional(jacobians, 9 * n_points));
    });
}

elvis_result evaluate_field(elvis_volume* handle, std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                            std::uint64_t n_points, const double* xi, double* values, double* gradients) {
    return guard(handle, [&](const Volume& volume) {
        check_field(volume, field);
        check_time_step(volume, time_step);
        const std::size_t n_components = volume.description().fields[field].n_components;
        volume.evaluate_field(field, time_step, element, std::span(xi, 3 * n_points), optional(values, n_components * n_points),
                              optional(gradients, 3 * n_components * n_points));
    });
}

const void* get_interface(const char* id) {
    static const elvis_runtime runtime = {sizeof(elvis_runtime),
                                          0,
                                          probe,
                                          open,
                                          close,
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
                                          get_boundary_group,
                                          get_field_ranges,
                                          get_note,
                                          evaluate_mapping,
                                          evaluate_field};
    return std::strcmp(id, ELVIS_RUNTIME_INTERFACE) == 0 ? &runtime : nullptr;
}

} // namespace
} // namespace elvis::native_plugin

const elvis_plugin_descriptor* elvis_plugin_get_descriptor(void) {
    static const elvis_plugin_descriptor descriptor = {sizeof(elvis_plugin_descriptor),
                                                       ELVIS_ABI_VERSION,
                                                       "org.elvis.native",
                                                       "Native volume",
                                                       "0.1.0",
                                                       "ElVis",
                                                       "Serves ElVis's own HDF5 volumes for rendering.",
                                                       elvis::native_plugin::get_interface};
    return &descriptor;
}
