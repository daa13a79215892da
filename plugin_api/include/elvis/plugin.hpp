/**
 * @file plugin.hpp
 * Thin C++20 wrapper around the plugin ABI: derive a class, name it in ELVIS_PLUGIN, done. Header only.
 *
 * What the wrapper does: it builds the C tables, keeps exceptions inside (they become result codes with their text), honours
 * the struct sizes of the caller, and leaves a table entry NULL where the class does not have the optional function. What it
 * does not do: hide the ABI. The structs are those of runtime.h and converter.h; their documentation holds.
 *
 *     class Volume : public elvis::api::RuntimeVolume {
 *     public:
 *         static std::uint32_t probe(const char* path);
 *         Volume(const elvis::api::Host& host, const std::string& path, const std::string& options);
 *         void get_info(elvis_volume_info& info) override;
 *         ...
 *     };
 *     ELVIS_PLUGIN(.id = "org.example.reader", .name = "Example reader", .version = "1.0.0",
 *                  .runtime = elvis::api::runtime_table<Volume>());
 *
 * A complete example is plugins/analytic, installed as share/doc/ElVis/examples/analytic.
 *
 * Since 1.0.
 */
#ifndef ELVIS_PLUGIN_HPP
#define ELVIS_PLUGIN_HPP

#include "apex_bounds.h"
#include "converter.h"
#include "extrema.h"
#include "formats.h"
#include "parts.h"
#include "plugin.h"
#include "runtime.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace elvis::api {

/** A failure with its result code and the file at fault (may be empty). */
class Error : public std::runtime_error {
public:
    Error(elvis_result code, std::string file, const std::string& message)
        : std::runtime_error(message), m_code(code), m_file(std::move(file)) {}

    elvis_result code() const { return m_code; }
    const std::string& file() const { return m_file; }

private:
    elvis_result m_code;
    std::string m_file;
};

/** Thrown by Host::check_cancelled. */
class Cancelled : public Error {
public:
    Cancelled() : Error(ELVIS_ERROR_CANCELLED, {}, "cancelled") {}
};

/** The host's services. A copy is as good as the original; valid as host.h says. */
class Host {
public:
    explicit Host(const elvis_host* table) : m_table(table) {}

    void log(elvis_log_level level, const std::string& message) const { m_table->log(m_table, level, message.c_str()); }
    void report_progress(double fraction, const char* activity = nullptr) const {
        m_table->report_progress(m_table, fraction, activity);
    }
    /** Throws Cancelled if the user has asked to stop. */
    void check_cancelled() const {
        if (m_table->is_cancelled(m_table)) {
            throw Cancelled();
        }
    }
    const elvis_host* table() const { return m_table; }

private:
    const elvis_host* m_table;
};

/** An array of structs of the host, whose entries may be smaller or larger than the struct this plugin knows. */
template <class Struct> class StructArray {
public:
    StructArray(Struct* first, std::uint64_t count) : m_first(first), m_count(count) {}

    std::uint64_t size() const { return m_count; }
    /** Writes an entry; its struct_size is left as the host set it. */
    void set(std::uint64_t index, const Struct& value) const {
        constexpr std::size_t header = sizeof value.struct_size;
        auto* entry = reinterpret_cast<unsigned char*>(m_first) + index * m_first->struct_size;
        std::memcpy(entry + header, reinterpret_cast<const unsigned char*>(&value) + header,
                    std::min<std::size_t>(m_first->struct_size, sizeof value) - header);
    }

private:
    Struct* m_first;
    std::uint64_t m_count;
};

/** Entries of arrays that the plugin owns. */
inline elvis_constant constant(const char* name, std::int64_t value) { return {sizeof(elvis_constant), 0, name, value}; }
inline elvis_text text(const char* name, const char* content) { return {sizeof(elvis_text), 0, name, content}; }

/**
 * Base of a volume for rendering. The derived class has a constructor (const Host&, const std::string& path, const std::string&
 * options), where `options` is empty or JSON, a static `std::uint32_t probe(const char* path)`, and these functions. Those that
 * are optional in the table are given by defining them with the signatures in the comment below.
 */
class RuntimeVolume {
public:
    explicit RuntimeVolume(const Host& host) : m_host(host) {}
    virtual ~RuntimeVolume() = default;
    RuntimeVolume(const RuntimeVolume&) = delete;
    RuntimeVolume& operator=(const RuntimeVolume&) = delete;

    const Host& host() const { return m_host; }

    virtual void get_info(elvis_volume_info& info) = 0;
    virtual void get_class(std::uint32_t element_class, elvis_element_class& out) = 0;
    virtual void get_field(std::uint32_t field, elvis_field& out) = 0;
    virtual void get_class_field(std::uint32_t element_class, std::uint32_t field, elvis_class_field& out) = 0;
    virtual double get_time(std::uint32_t time_step) = 0;
    virtual void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) = 0;
    virtual void get_snippet(std::uint32_t element_class, elvis_snippet& out) = 0;
    /** bounds: six numbers an element. */
    virtual elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) = 0;
    virtual void fill_buffer(const elvis_fill_request& request, void* destination) = 0;

    // Optional, found by name; public members with exactly these signatures:
    //   void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers);
    //   void get_faces(std::uint64_t first, StructArray<elvis_face> faces);
    //   elvis_string get_boundary_group(std::uint32_t group);
    //   elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
    //                                    std::uint64_t count, std::span<double> ranges);
    //   std::pair<elvis_string, elvis_string> get_note(std::uint32_t note);
    //   void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians);
    //   void evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element, std::span<const double> xi,
    //                       double* values, double* gradients);
    //   elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
    //                                               std::uint64_t count, std::span<double> bounds);
    //   elvis_certainty check_jacobians(std::uint64_t first, double tolerance, StructArray<elvis_jacobian_check> checks);
    //
    // For extrema_table (elvis/extrema.h):
    //   elvis_certainty get_field_extrema(std::uint32_t field, std::uint32_t component, std::uint32_t time_step,
    //                                     elvis_extremum& minimum, elvis_extremum& maximum);
    //
    // For apex_bounds_table (elvis/apex_bounds.h):
    //   elvis_certainty get_field_apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
    //                                         std::uint64_t count, std::span<double> bounds);

private:
    Host m_host;
};

/**
 * Base of a source for conversion. The derived class has a constructor (const Host&, const std::vector<std::string>& paths,
 * const std::string& options) and a static `std::uint32_t probe(const char* path)`.
 */
class ConverterSource {
public:
    explicit ConverterSource(const Host& host) : m_host(host) {}
    virtual ~ConverterSource() = default;
    ConverterSource(const ConverterSource&) = delete;
    ConverterSource& operator=(const ConverterSource&) = delete;

    const Host& host() const { return m_host; }

    virtual void get_info(elvis_source_info& info) = 0;
    virtual void get_field(std::uint32_t field, elvis_source_field& out) = 0;
    virtual void get_elements(std::uint64_t first, StructArray<elvis_source_element> elements) = 0;
    virtual void get_spaces(std::uint32_t field, std::uint64_t first, StructArray<elvis_source_space> spaces) = 0;
    /** Three numbers a point in both spans. */
    virtual void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) = 0;
    /** All fields at each point. Need not be overridden by a class that has sample_world. */
    virtual void sample([[maybe_unused]] std::uint32_t time_step, [[maybe_unused]] std::uint64_t element,
                        [[maybe_unused]] std::span<const double> xi, [[maybe_unused]] double* values) {
        throw Error(ELVIS_ERROR_UNSUPPORTED, {}, "this source is sampled at world positions only");
    }

    // Optional, found by name; public members with exactly these signatures:
    //   void sample_world(std::uint32_t time_step, std::uint64_t element, std::span<const double> positions, double* values);
    //   double get_time(std::uint32_t time_step);
    //   elvis_string get_boundary_group(std::uint32_t group);

private:
    Host m_host;
};

namespace detail {

/** Runs a call, and turns what it throws into result code and error text. */
template <class Call> elvis_result guard(const elvis_host* host, Call&& call) noexcept {
    try {
        call();
        return ELVIS_OK;
    } catch (const Error& error) {
        host->set_error(host, error.file().empty() ? nullptr : error.file().c_str(), error.what());
        return error.code();
    } catch (const std::bad_alloc&) {
        host->set_error(host, nullptr, "out of memory");
        return ELVIS_ERROR_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        host->set_error(host, nullptr, error.what());
        return ELVIS_ERROR_FAILED;
    } catch (...) {
        host->set_error(host, nullptr, "an exception of unknown type");
        return ELVIS_ERROR_FAILED;
    }
}

/** A request of the host as the struct known here; members that an older host does not have are zero. */
template <class Struct> Struct read_struct(const Struct* theirs) {
    Struct ours{};
    std::memcpy(&ours, theirs, std::min<std::size_t>(theirs->struct_size, sizeof ours));
    return ours;
}

/**
 * Lets `fill` work on a struct of the size known here, and copies to the caller what fits into theirs. Members that `fill`
 * leaves alone keep what the host put there, zero for those that an older host does not know.
 */
template <class Struct, class Fill> void fill_struct(Struct* theirs, Fill&& fill) {
    const std::uint32_t their_size = theirs->struct_size;
    Struct ours = read_struct<Struct>(theirs);
    ours.struct_size = sizeof ours;
    fill(ours);
    std::memcpy(theirs, &ours, std::min<std::size_t>(their_size, sizeof ours));
    theirs->struct_size = their_size;
}

template <class Volume> Volume& self(elvis_volume* volume) { return *reinterpret_cast<Volume*>(volume); }
template <class Source> Source& self(elvis_source_volume* source) { return *reinterpret_cast<Source*>(source); }

template <class Object, class Call> elvis_result guard_on(Object& object, Call&& call) noexcept {
    return guard(object.host().table(), [&] { call(object); });
}

/** What every volume has. */
template <class Volume> void set_required(elvis_runtime& t) {
    t.probe = [](const elvis_host* host, const char* path, std::uint32_t* confidence) {
        return guard(host, [&] { *confidence = Volume::probe(path); });
    };
    t.open = [](const elvis_host* host, const char* path, const char* options, elvis_volume** volume) {
        return guard(host, [&] {
            *volume =
                reinterpret_cast<elvis_volume*>(new Volume(Host(host), std::string(path), std::string(options ? options : "")));
        });
    };
    t.close = [](elvis_volume* volume) { delete &self<Volume>(volume); };
    t.get_info = [](elvis_volume* volume, elvis_volume_info* out) {
        return guard_on(self<Volume>(volume), [&](Volume& v) { fill_struct(out, [&](auto& s) { v.get_info(s); }); });
    };
    t.get_class = [](elvis_volume* volume, std::uint32_t element_class, elvis_element_class* out) {
        return guard_on(self<Volume>(volume),
                        [&](Volume& v) { fill_struct(out, [&](auto& s) { v.get_class(element_class, s); }); });
    };
    t.get_field = [](elvis_volume* volume, std::uint32_t field, elvis_field* out) {
        return guard_on(self<Volume>(volume), [&](Volume& v) { fill_struct(out, [&](auto& s) { v.get_field(field, s); }); });
    };
    t.get_class_field = [](elvis_volume* volume, std::uint32_t element_class, std::uint32_t field, elvis_class_field* out) {
        return guard_on(self<Volume>(volume),
                        [&](Volume& v) { fill_struct(out, [&](auto& s) { v.get_class_field(element_class, field, s); }); });
    };
    t.get_time = [](elvis_volume* volume, std::uint32_t step, double* time) {
        return guard_on(self<Volume>(volume), [&](Volume& v) { *time = v.get_time(step); });
    };
    t.get_buffer = [](elvis_volume* volume, std::uint32_t buffer, std::uint32_t field, elvis_buffer* out) {
        return guard_on(self<Volume>(volume),
                        [&](Volume& v) { fill_struct(out, [&](auto& s) { v.get_buffer(buffer, field, s); }); });
    };
    t.get_snippet = [](elvis_volume* volume, std::uint32_t element_class, elvis_snippet* out) {
        return guard_on(self<Volume>(volume),
                        [&](Volume& v) { fill_struct(out, [&](auto& s) { v.get_snippet(element_class, s); }); });
    };
    t.get_bounds = [](elvis_volume* volume, std::uint64_t first, std::uint64_t count, double* bounds,
                      elvis_certainty* certainty) {
        return guard_on(self<Volume>(volume),
                        [&](Volume& v) { *certainty = v.get_bounds(first, count, std::span<double>(bounds, 6 * count)); });
    };
    t.fill_buffer = [](elvis_volume* volume, const elvis_fill_request* request, void* destination) {
        return guard_on(self<Volume>(volume), [&](Volume& v) { v.fill_buffer(read_struct(request), destination); });
    };
}

/** What describes elements, faces and the volume, if the class has it. */
template <class Volume> void set_descriptions(elvis_runtime& t) {
    if constexpr (requires { &Volume::get_element_numbers; }) {
        t.get_element_numbers = [](elvis_volume* volume, std::uint64_t first, std::uint64_t count, std::int64_t* numbers) {
            return guard_on(self<Volume>(volume),
                            [&](Volume& v) { v.get_element_numbers(first, std::span<std::int64_t>(numbers, count)); });
        };
    }
    if constexpr (requires { &Volume::get_faces; }) {
        t.get_faces = [](elvis_volume* volume, std::uint64_t first, std::uint64_t count, elvis_face* faces) {
            return guard_on(self<Volume>(volume),
                            [&](Volume& v) { v.get_faces(first, StructArray<elvis_face>(faces, count)); });
        };
    }
    if constexpr (requires { &Volume::get_boundary_group; }) {
        t.get_boundary_group = [](elvis_volume* volume, std::uint32_t group, elvis_string* name) {
            return guard_on(self<Volume>(volume), [&](Volume& v) { *name = v.get_boundary_group(group); });
        };
    }
    if constexpr (requires { &Volume::get_note; }) {
        t.get_note = [](elvis_volume* volume, std::uint32_t note, elvis_string* key, elvis_string* value) {
            return guard_on(self<Volume>(volume), [&](Volume& v) { std::tie(*key, *value) = v.get_note(note); });
        };
    }
}

/** What tells values and bounds, if the class has it. */
template <class Volume> void set_values(elvis_runtime& t) {
    if constexpr (requires { &Volume::get_field_ranges; }) {
        t.get_field_ranges = [](elvis_volume* volume, std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                std::uint64_t count, double* ranges, elvis_certainty* certainty) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                auto info = elvis_field{};
                info.struct_size = sizeof info;
                v.get_field(field, info);
                *certainty = v.get_field_ranges(field, time_step, first, count,
                                                std::span<double>(ranges, 2 * count * info.n_components));
            });
        };
    }
    if constexpr (requires { &Volume::evaluate_mapping; }) {
        t.evaluate_mapping = [](elvis_volume* volume, std::uint64_t element, std::uint64_t n_points, const double* xi,
                                double* positions, double* jacobians) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                v.evaluate_mapping(element, std::span<const double>(xi, 3 * n_points), positions, jacobians);
            });
        };
    }
    if constexpr (requires { &Volume::evaluate_field; }) {
        t.evaluate_field = [](elvis_volume* volume, std::uint32_t field, std::uint32_t time_step, std::uint64_t element,
                              std::uint64_t n_points, const double* xi, double* values, double* gradients) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                v.evaluate_field(field, time_step, element, std::span<const double>(xi, 3 * n_points), values, gradients);
            });
        };
    }
    if constexpr (requires { &Volume::get_field_derivative_bounds; }) {
        t.get_field_derivative_bounds = [](elvis_volume* volume, std::uint32_t field, std::uint32_t time_step,
                                           std::uint64_t first, std::uint64_t count, double* bounds,
                                           elvis_certainty* certainty) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                auto info = elvis_field{};
                info.struct_size = sizeof info;
                v.get_field(field, info);
                *certainty = v.get_field_derivative_bounds(field, time_step, first, count,
                                                           std::span<double>(bounds, 2 * count * info.n_components));
            });
        };
    }
    if constexpr (requires { &Volume::check_jacobians; }) {
        t.check_jacobians = [](elvis_volume* volume, std::uint64_t first, std::uint64_t count, double tolerance,
                               elvis_jacobian_check* checks, elvis_certainty* certainty) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                *certainty = v.check_jacobians(first, tolerance, StructArray<elvis_jacobian_check>(checks, count));
            });
        };
    }
}

} // namespace detail

/** The table of a class derived from RuntimeVolume. */
template <class Volume> const elvis_runtime* runtime_table() {
    static const elvis_runtime table = [] {
        elvis_runtime t{};
        t.struct_size = sizeof t;
        detail::set_required<Volume>(t);
        detail::set_descriptions<Volume>(t);
        detail::set_values<Volume>(t);
        return t;
    }();
    return &table;
}

/** Draft. The table of elvis/extrema.h, of a class derived from RuntimeVolume with get_field_extrema. */
template <class Volume> const elvis_extrema* extrema_table() {
    using namespace detail;
    static const elvis_extrema table = {
        sizeof(elvis_extrema), 0,
        [](elvis_volume* volume, std::uint32_t field, std::uint32_t component, std::uint32_t time_step, elvis_extremum* minimum,
           elvis_extremum* maximum, elvis_certainty* certainty) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                fill_struct(minimum, [&](elvis_extremum& low) {
                    fill_struct(maximum, [&](elvis_extremum& high) {
                        *certainty = v.get_field_extrema(field, component, time_step, low, high);
                    });
                });
            });
        }};
    return &table;
}

/** Draft. The table of elvis/apex_bounds.h, of a class derived from RuntimeVolume with get_field_apex_bounds. */
template <class Volume> const elvis_apex_bounds* apex_bounds_table() {
    using namespace detail;
    static const elvis_apex_bounds table = {
        sizeof(elvis_apex_bounds), 0,
        [](elvis_volume* volume, std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
           double* bounds, elvis_certainty* certainty) {
            return guard_on(self<Volume>(volume), [&](Volume& v) {
                auto info = elvis_field{};
                info.struct_size = sizeof info;
                v.get_field(field, info);
                *certainty = v.get_field_apex_bounds(field, time_step, first, count,
                                                     std::span<double>(bounds, 2 * count * info.n_components));
            });
        }};
    return &table;
}

/** The table of a class derived from ConverterSource. */
template <class Source> const elvis_converter* converter_table() {
    using namespace detail;
    static const elvis_converter table = [] {
        elvis_converter t{};
        t.struct_size = sizeof t;
        t.probe = [](const elvis_host* host, const char* path, std::uint32_t* confidence) {
            return guard(host, [&] { *confidence = Source::probe(path); });
        };
        t.open = [](const elvis_host* host, const char* const* paths, std::uint32_t n_paths, const char* options,
                    elvis_source_volume** source) {
            return guard(host, [&] {
                *source = reinterpret_cast<elvis_source_volume*>(new Source(
                    Host(host), std::vector<std::string>(paths, paths + n_paths), std::string(options ? options : "")));
            });
        };
        t.close = [](elvis_source_volume* source) { delete &self<Source>(source); };
        t.get_info = [](elvis_source_volume* source, elvis_source_info* out) {
            return guard_on(self<Source>(source), [&](Source& s) { fill_struct(out, [&](auto& info) { s.get_info(info); }); });
        };
        t.get_field = [](elvis_source_volume* source, std::uint32_t field, elvis_source_field* out) {
            return guard_on(self<Source>(source),
                            [&](Source& s) { fill_struct(out, [&](auto& info) { s.get_field(field, info); }); });
        };
        t.get_elements = [](elvis_source_volume* source, std::uint64_t first, std::uint64_t count, elvis_source_element* out) {
            return guard_on(self<Source>(source),
                            [&](Source& s) { s.get_elements(first, StructArray<elvis_source_element>(out, count)); });
        };
        t.get_spaces = [](elvis_source_volume* source, std::uint32_t field, std::uint64_t first, std::uint64_t count,
                          elvis_source_space* out) {
            return guard_on(self<Source>(source),
                            [&](Source& s) { s.get_spaces(field, first, StructArray<elvis_source_space>(out, count)); });
        };
        t.evaluate_mapping = [](elvis_source_volume* source, std::uint64_t element, std::uint64_t n_points, const double* xi,
                                double* positions) {
            return guard_on(self<Source>(source), [&](Source& s) {
                s.evaluate_mapping(element, std::span<const double>(xi, 3 * n_points),
                                   std::span<double>(positions, 3 * n_points));
            });
        };
        // The pointer has the base's type where nothing overrides the function.
        constexpr bool samples = !std::is_same_v<decltype(&Source::sample), decltype(&ConverterSource::sample)>;
        constexpr bool samples_world = requires { &Source::sample_world; };
        static_assert(samples || samples_world, "a source needs sample or sample_world");
        if constexpr (samples) {
            t.sample = [](elvis_source_volume* source, std::uint32_t time_step, std::uint64_t element, std::uint64_t n_points,
                          const double* xi, double* values) {
                return guard_on(self<Source>(source), [&](Source& s) {
                    s.sample(time_step, element, std::span<const double>(xi, 3 * n_points), values);
                });
            };
        }
        if constexpr (samples_world) {
            t.sample_world = [](elvis_source_volume* source, std::uint32_t time_step, std::uint64_t element,
                                std::uint64_t n_points, const double* positions, double* values) {
                return guard_on(self<Source>(source), [&](Source& s) {
                    s.sample_world(time_step, element, std::span<const double>(positions, 3 * n_points), values);
                });
            };
        }
        if constexpr (requires { &Source::get_time; }) {
            t.get_time = [](elvis_source_volume* source, std::uint32_t step, double* time) {
                return guard_on(self<Source>(source), [&](Source& s) { *time = s.get_time(step); });
            };
        }
        if constexpr (requires { &Source::get_boundary_group; }) {
            t.get_boundary_group = [](elvis_source_volume* source, std::uint32_t group, elvis_string* name) {
                return guard_on(self<Source>(source), [&](Source& s) { *name = s.get_boundary_group(group); });
            };
        }
        return t;
    }();
    return &table;
}

/** Draft. The table of elvis/parts.h, of a source that has n_parts() and get_parts(first, parts). */
template <class Source> const elvis_parts* parts_table() {
    static const elvis_parts table = [] {
        elvis_parts t{};
        t.struct_size = sizeof t;
        t.get_n_parts = [](elvis_source_volume* source, std::uint32_t* n_parts) {
            return detail::guard_on(detail::self<Source>(source), [&](Source& s) { *n_parts = s.n_parts(); });
        };
        t.get_parts = [](elvis_source_volume* source, std::uint64_t first, std::uint64_t count, std::uint32_t* parts) {
            return detail::guard_on(detail::self<Source>(source),
                                    [&](Source& s) { s.get_parts(first, std::span(parts, static_cast<std::size_t>(count))); });
        };
        return t;
    }();
    return &table;
}

/** Draft. An entry of elvis/formats.h. */
constexpr elvis_file_format file_format(const char* name, const char* endings) {
    return {sizeof(elvis_file_format), 0, name, endings};
}

/** Draft. The table of elvis/formats.h, of a list that lasts as long as the plugin. */
template <std::size_t n> constexpr elvis_formats formats_table(const elvis_file_format (&formats)[n]) {
    return {sizeof(elvis_formats), n, formats};
}

/** What ELVIS_PLUGIN takes; see elvis_plugin_descriptor. */
struct Description {
    const char* id;
    const char* name;
    const char* version;
    const char* vendor = nullptr;
    const char* description = nullptr;
    const elvis_runtime* runtime = nullptr;
    const elvis_converter* converter = nullptr;
    const elvis_extrema* extrema = nullptr;
    const elvis_apex_bounds* apex_bounds = nullptr;
    const elvis_formats* formats = nullptr;
    const elvis_parts* parts = nullptr;
};

} // namespace elvis::api

/** Defines the exported function. Once in a plugin; the arguments initialize an elvis::api::Description. */
#define ELVIS_PLUGIN(...)                                                                                                      \
    extern "C" ELVIS_EXPORT const elvis_plugin_descriptor* elvis_plugin_get_descriptor(void) {                                 \
        static const elvis::api::Description description{__VA_ARGS__};                                                         \
        static const elvis_plugin_descriptor descriptor{sizeof(elvis_plugin_descriptor),                                       \
                                                        ELVIS_ABI_VERSION,                                                     \
                                                        description.id,                                                        \
                                                        description.name,                                                      \
                                                        description.version,                                                   \
                                                        description.vendor,                                                    \
                                                        description.description,                                               \
                                                        [](const char* interface_id) -> const void* {                          \
                                                            const std::string_view wanted(interface_id);                       \
                                                            if (wanted == ELVIS_RUNTIME_INTERFACE) {                           \
                                                                return description.runtime;                                    \
                                                            }                                                                  \
                                                            if (wanted == ELVIS_CONVERTER_INTERFACE) {                         \
                                                                return description.converter;                                  \
                                                            }                                                                  \
                                                            if (wanted == ELVIS_EXTREMA_INTERFACE) {                           \
                                                                return description.extrema;                                    \
                                                            }                                                                  \
                                                            if (wanted == ELVIS_APEX_BOUNDS_INTERFACE) {                       \
                                                                return description.apex_bounds;                                \
                                                            }                                                                  \
                                                            if (wanted == ELVIS_FORMATS_INTERFACE) {                           \
                                                                return description.formats;                                    \
                                                            }                                                                  \
                                                            if (wanted == ELVIS_PARTS_INTERFACE) {                             \
                                                                return description.parts;                                      \
                                                            }                                                                  \
                                                            return nullptr;                                                    \
                                                        }};                                                                    \
        return &descriptor;                                                                                                    \
    }                                                                                                                          \
    static_assert(true)

#endif
