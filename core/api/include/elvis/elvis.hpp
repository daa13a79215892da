/**
 * @file elvis.hpp
 * The library libelvis for C++17 and later: handles that release themselves, and exceptions. Header only; what each function
 * does stands in elvis.h.
 *
 *     elvis::context context;
 *     elvis::data ball = context.open("ball.h5");
 *     elvis::scene scene = context.make_scene();
 *     scene.set("/image/size", "[800, 600]");
 *     ball.render(scene).write_png("ball.png");
 */
#ifndef ELVIS_ELVIS_HPP
#define ELVIS_ELVIS_HPP

#include "answers.h"
#include "editing.h"
#include "elvis.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** What elvis_context_error says. */
class error : public std::runtime_error {
public:
    error(elvis_result result, const std::string& text) : std::runtime_error(text), m_result(result) {}
    elvis_result result() const { return m_result; }

private:
    elvis_result m_result;
};

/** The task was asked to stop. */
class cancelled : public error {
public:
    using error::error;
};

/** Callbacks for what takes long; both may be empty. They must not throw. See elvis_task. */
struct task {
    std::function<void(double fraction, const char* activity)> progress;
    std::function<bool()> is_cancelled;
};

namespace detail {

template <class Struct> Struct sized() {
    Struct value{};
    value.struct_size = sizeof value;
    return value;
}

/** A task as the C interface has it; must not outlive `own`. */
inline elvis_task c_task(const task& own) {
    auto result = sized<elvis_task>();
    result.user = const_cast<task*>(&own);
    if (own.progress) {
        result.progress = [](void* user, double fraction, elvis_string activity) {
            static_cast<task*>(user)->progress(fraction, activity);
        };
    }
    if (own.is_cancelled) {
        result.is_cancelled = [](void* user) -> std::int32_t { return static_cast<task*>(user)->is_cancelled() ? 1 : 0; };
    }
    return result;
}

struct release {
    void operator()(elvis_context* handle) const { elvis_context_release(handle); }
    void operator()(elvis_data* handle) const { elvis_data_release(handle); }
    void operator()(elvis_scene* handle) const { elvis_scene_release(handle); }
    void operator()(elvis_picture* handle) const { elvis_picture_release(handle); }
    void operator()(elvis_animation* handle) const { elvis_animation_release(handle); }
    void operator()(elvis_lines* handle) const { elvis_lines_release(handle); }
    void operator()(char* text) const { elvis_text_release(text); }
};

inline void check(elvis_result result, const elvis_context* context) {
    if (result == ELVIS_ERROR_CANCELLED) {
        throw cancelled(result, elvis_context_error(context));
    }
    if (result != ELVIS_OK) {
        throw error(result, elvis_context_error(context));
    }
}

inline std::string taken(char* text) {
    const std::unique_ptr<char, release> own(text);
    return own.get();
}

inline const char* or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

using shared_context = std::shared_ptr<elvis_context>;

/** Of texts that must outlive them. */
inline std::vector<elvis_string> c_strings(const std::vector<std::string>& texts) {
    std::vector<elvis_string> all;
    for (const std::string& text : texts) {
        all.push_back(text.c_str());
    }
    return all;
}

} // namespace detail

class data;

/** What is to be seen. */
class scene {
public:
    scene(detail::shared_context context, elvis_scene* handle) : m_context(std::move(context)), m_handle(handle) {}
    scene(scene&&) = default;
    scene& operator=(scene&&) = default;

    scene copy() const {
        elvis_scene* other = nullptr;
        check(elvis_scene_copy(get(), &other));
        return {m_context, other};
    }
    /** See elvis_scene_complete. */
    inline scene completed(const data& shown) const;
    void set(const std::string& pointer, const std::string& json) {
        check(elvis_scene_set(get(), pointer.c_str(), json.c_str()));
    }
    void remove(const std::string& pointer) { check(elvis_scene_set(get(), pointer.c_str(), nullptr)); }
    std::string json(const std::string& pointer = {}) const {
        char* text = nullptr;
        check(elvis_scene_get(get(), pointer.c_str(), &text));
        return detail::taken(text);
    }
    std::string volume() const {
        char* path = nullptr;
        check(elvis_scene_get_volume(get(), &path));
        return detail::taken(path);
    }
    /** The volume that it names. */
    inline data open_volume(const task& watch = {}) const;
    void write(const std::string& path) const { check(elvis_scene_write(get(), path.c_str())); }
    /** See elvis_scene_write_text. `folder`: empty for the working directory. */
    std::string text(const std::string& folder = {}) const {
        char* written = nullptr;
        check(elvis_scene_write_text(get(), detail::or_null(folder), &written));
        return detail::taken(written);
    }
    /** See elvis_scene_complete_camera and elvis_scene_fit_camera. */
    void complete_camera(const elvis_extent& extent) { check(elvis_scene_complete_camera(get(), &extent)); }
    void fit_camera(const elvis_extent& extent) { check(elvis_scene_fit_camera(get(), &extent)); }
    /** See elvis_scene_write_expression. */
    std::string expression(const std::string& field) const {
        char* written = nullptr;
        check(elvis_scene_write_expression(get(), field.c_str(), &written));
        return detail::taken(written);
    }
    /** JSON: see elvis_scene_get_transfer. */
    std::string transfer(const std::array<double, 2>& range, double diagonal) const {
        char* written = nullptr;
        check(elvis_scene_get_transfer(get(), range.data(), diagonal, &written));
        return detail::taken(written);
    }
    elvis_scene* get() const { return m_handle.get(); }

private:
    void check(elvis_result result) const { detail::check(result, m_context.get()); }

    detail::shared_context m_context;
    std::unique_ptr<elvis_scene, detail::release> m_handle;
};

/** A picture in memory. */
class picture {
public:
    struct remark {
        std::string text;
        bool is_warning;
    };

    picture(detail::shared_context context, elvis_picture* handle) : m_context(std::move(context)), m_handle(handle) {}
    picture(picture&&) = default;
    picture& operator=(picture&&) = default;

    elvis_picture_info info() const {
        auto result = detail::sized<elvis_picture_info>();
        check(elvis_picture_get_info(get(), &result));
        return result;
    }
    std::vector<remark> remarks() const {
        std::vector<remark> all;
        const std::uint32_t n = info().n_remarks;
        for (std::uint32_t index = 0; index < n; ++index) {
            elvis_string text = nullptr;
            std::int32_t is_warning = 0;
            check(elvis_picture_get_remark(get(), index, &text, &is_warning));
            all.push_back({text, is_warning != 0});
        }
        return all;
    }
    std::string stats() const {
        char* text = nullptr;
        check(elvis_picture_get_stats(get(), &text));
        return detail::taken(text);
    }
    std::string color_bars() const {
        char* text = nullptr;
        check(elvis_picture_get_color_bars(get(), &text));
        return detail::taken(text);
    }
    /** The whole channel without gaps; Number is one of those that elvis_picture_read names for it. */
    template <class Number> std::vector<Number> read(elvis_channel channel) const {
        const elvis_picture_info size = info();
        const std::size_t n_numbers = channel == ELVIS_CHANNEL_COLOR ? 4 : channel == ELVIS_CHANNEL_NORMAL ? 3 : 1;
        std::vector<Number> numbers(std::size_t{size.width} * size.height * n_numbers);
        check(elvis_picture_read(get(), channel, kind_of(Number{}), numbers.data(), 0, 0));
        return numbers;
    }
    void write_png(const std::string& path, std::uint32_t bits = 8) const {
        check(elvis_picture_write_png(get(), path.c_str(), bits));
    }
    void write_svg(const std::string& path, std::uint32_t bits = 8) const {
        check(elvis_picture_write_svg(get(), path.c_str(), bits));
    }
    void write_pdf(const std::string& path, std::uint32_t bits = 8) const {
        check(elvis_picture_write_pdf(get(), path.c_str(), bits));
    }
    void write_buffers(const std::string& path) const { check(elvis_picture_write_buffers(get(), path.c_str())); }
    elvis_picture* get() const { return m_handle.get(); }

private:
    static elvis_number kind_of(std::uint8_t) { return ELVIS_NUMBER_UINT8; }
    static elvis_number kind_of(std::uint16_t) { return ELVIS_NUMBER_UINT16; }
    static elvis_number kind_of(std::uint32_t) { return ELVIS_NUMBER_UINT32; }
    static elvis_number kind_of(std::int64_t) { return ELVIS_NUMBER_INT64; }
    static elvis_number kind_of(float) { return ELVIS_NUMBER_FLOAT; }
    static elvis_number kind_of(double) { return ELVIS_NUMBER_DOUBLE; }
    void check(elvis_result result) const { detail::check(result, m_context.get()); }

    detail::shared_context m_context;
    std::unique_ptr<elvis_picture, detail::release> m_handle;
};

/** The pictures of a scene's animation. */
class animation {
public:
    animation(detail::shared_context context, elvis_animation* handle) : m_context(std::move(context)), m_handle(handle) {}
    animation(animation&&) = default;
    animation& operator=(animation&&) = default;

    elvis_animation_info info() const {
        auto result = detail::sized<elvis_animation_info>();
        check(elvis_animation_get_info(get(), &result));
        return result;
    }
    std::uint32_t time_step(std::uint32_t frame) const {
        std::uint32_t result = 0;
        check(elvis_animation_get_time_step(get(), frame, &result));
        return result;
    }
    picture render(std::uint32_t frame, const elvis_render_options& options = detail::sized<elvis_render_options>(),
                   const task& watch = {}) const {
        elvis_picture* drawn = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_animation_render(get(), frame, &options, &c_watch, &drawn));
        return {m_context, drawn};
    }
    /** JSON list of sentences. */
    std::string remarks() const {
        char* text = nullptr;
        check(elvis_animation_get_remarks(get(), &text));
        return detail::taken(text);
    }
    elvis_animation* get() const { return m_handle.get(); }

private:
    void check(elvis_result result) const { detail::check(result, m_context.get()); }

    detail::shared_context m_context;
    std::unique_ptr<elvis_animation, detail::release> m_handle;
};

/** Values at points: see elvis_probe. */
struct probed {
    /** A point's values. */
    std::uint32_t n_values = 0;
    std::vector<std::int64_t> elements;
    std::vector<double> xi, values, gradients;
    std::vector<std::uint8_t> estimated;
};

/** Streamlines or pathlines: see elvis_line_arrays, of which these are the arrays. */
struct traced {
    std::vector<std::uint64_t> first;
    std::vector<elvis_line_end> begins, ends;
    std::vector<double> positions, times, arc_lengths;
    std::vector<std::int64_t> elements;
    std::vector<double> xi, values;
    /** A point's values. */
    std::uint32_t n_values = 0;
    /** See elvis_lines_info. */
    double time_doubt = -1;
};

/** A volume that is open. */
class data {
public:
    data(detail::shared_context context, elvis_data* handle) : m_context(std::move(context)), m_handle(handle) {}
    data(data&&) = default;
    data& operator=(data&&) = default;

    elvis_data_info info() const {
        auto result = detail::sized<elvis_data_info>();
        check(elvis_data_get_info(get(), &result));
        return result;
    }
    elvis_field field(std::uint32_t index) const {
        auto result = detail::sized<elvis_field>();
        check(elvis_data_get_field(get(), index, &result));
        return result;
    }
    double time(std::uint32_t time_step) const {
        double result = 0;
        check(elvis_data_get_time(get(), time_step, &result));
        return result;
    }
    std::string describe(const elvis_describe_options& options = detail::sized<elvis_describe_options>(),
                         const task& watch = {}) const {
        char* text = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_describe(get(), &options, &c_watch, &text));
        return detail::taken(text);
    }
    /** Throws error if the scene does not suit it: see elvis_data_check_scene. */
    void check_scene(const scene& wanted) const { check(elvis_data_check_scene(get(), wanted.get())); }
    /** See elvis_data_free_memory. */
    void free_memory() const { check(elvis_data_free_memory(get())); }
    /** Without what takes long. */
    std::string describe_briefly() const {
        auto options = detail::sized<elvis_describe_options>();
        options.flags = ELVIS_DESCRIBE_BRIEF;
        return describe(options);
    }
    /** Displaced: see elvis_data_warp. */
    data warp(const elvis_warp& how, const task& watch = {}) const {
        elvis_data* displaced = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_warp(get(), &how, &c_watch, &displaced));
        return {m_context, displaced};
    }
    /** With the fields of others beside their own: see elvis_data_join. */
    struct joined {
        std::string name;
        const data* from;
        std::uint32_t time_step = ELVIS_SAME_TIME_STEP;
    };
    data join(const std::vector<joined>& others, const task& watch = {}) const {
        std::vector<elvis_join> joins;
        for (const joined& other : others) {
            joins.push_back(detail::sized<elvis_join>());
            joins.back().time_step = other.time_step;
            joins.back().name = other.name.c_str();
            joins.back().data = other.from->get();
        }
        elvis_data* together = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_join(get(), joins.data(), static_cast<std::uint32_t>(joins.size()), &c_watch, &together));
        return {m_context, together};
    }
    elvis_range range(const std::string& field, std::uint32_t time_step = 0) const {
        auto result = detail::sized<elvis_range>();
        check(elvis_data_get_range(get(), field.c_str(), time_step, &result));
        return result;
    }
    /** See elvis_data_integrate. */
    elvis_integral integrate(const elvis_integration& integration, const task& watch = {}) const {
        auto result = detail::sized<elvis_integral>();
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_integrate(get(), &integration, &c_watch, &result));
        return result;
    }
    /** JSON: see elvis_data_walk_line. */
    std::string walk_line(const std::array<double, 3>& from, const std::array<double, 3>& to,
                          const std::vector<std::string>& fields, std::uint32_t time_step = 0, const task& watch = {}) const {
        const std::vector<elvis_string> names = detail::c_strings(fields);
        char* text = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_walk_line(get(), from.data(), to.data(), names.data(), static_cast<std::uint32_t>(names.size()),
                                   time_step, &c_watch, &text));
        return detail::taken(text);
    }
    /** See elvis_data_trace. */
    traced trace(const elvis_tracing& tracing, const task& watch = {}) const {
        elvis_lines* handle = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_trace(get(), &tracing, &c_watch, &handle));
        return read_lines(handle);
    }
    /** See elvis_data_trace_scene. */
    traced trace(const scene& shown, std::uint32_t surface, const std::vector<std::string>& fields = {},
                 const task& watch = {}) const {
        const std::vector<elvis_string> names = detail::c_strings(fields);
        elvis_lines* handle = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_trace_scene(get(), shown.get(), surface, names.data(), static_cast<std::uint32_t>(names.size()),
                                     &c_watch, &handle));
        return read_lines(handle);
    }
    /** As the struct says. */
    void probe(const elvis_probe& request, const task& watch = {}) const {
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_probe(get(), &request, &c_watch));
    }
    std::uint32_t count_values(const elvis_string* fields, std::uint32_t n_fields) const {
        std::uint32_t n_values = 0;
        check(elvis_data_count_values(get(), fields, n_fields, &n_values));
        return n_values;
    }
    /** `positions`: three numbers a point. */
    probed probe(const std::vector<double>& positions, const std::vector<std::string>& fields, std::uint32_t time_step = 0,
                 const task& watch = {}) const {
        const std::vector<elvis_string> names = detail::c_strings(fields);
        auto request = detail::sized<elvis_probe>();
        request.time_step = time_step;
        request.n_points = positions.size() / 3;
        request.positions = positions.data();
        request.n_fields = static_cast<std::uint32_t>(names.size());
        request.fields = names.data();
        probed result;
        result.n_values = count_values(request.fields, request.n_fields);
        const std::size_t n_numbers = request.n_points * result.n_values;
        result.elements.resize(request.n_points);
        result.xi.resize(3 * request.n_points);
        result.values.resize(n_numbers);
        result.gradients.resize(3 * n_numbers);
        result.estimated.resize(n_numbers);
        request.elements = result.elements.data();
        request.xi = result.xi.data();
        request.values = result.values.data();
        request.gradients = result.gradients.data();
        request.estimated = result.estimated.data();
        probe(request, watch);
        return result;
    }
    picture render(const scene& shown, const elvis_render_options& options = detail::sized<elvis_render_options>(),
                   const task& watch = {}) const {
        elvis_picture* drawn = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_render(get(), shown.get(), &options, &c_watch, &drawn));
        return {m_context, drawn};
    }
    /** See elvis_data_prepare. */
    void prepare(const scene& shown, const task& watch = {}) const {
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_prepare(get(), shown.get(), &c_watch));
    }
    picture render_for_screen(const scene& shown, const elvis_screen_options& options = detail::sized<elvis_screen_options>(),
                              const task& watch = {}) const {
        elvis_picture* drawn = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_render_for_screen(get(), shown.get(), &options, &c_watch, &drawn));
        return {m_context, drawn};
    }
    /** Of a scene with the key "animation". */
    animation animate(const scene& shown) const {
        elvis_animation* made = nullptr;
        check(elvis_animation_create(get(), shown.get(), &made));
        return {m_context, made};
    }
    /** JSON: see elvis_data_pick. */
    std::string pick(const scene& shown, double column, double row, const task& watch = {}) const {
        char* text = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_pick(get(), shown.get(), column, row, &c_watch, &text));
        return detail::taken(text);
    }
    /** Values of the field, or of the scene's if it is empty, in one of ELVIS_SAMPLE_PIECES. */
    std::vector<double> sample(const scene& shown, const std::string& field, std::uint32_t piece) const {
        std::vector<double> values(ELVIS_SAMPLES_A_PIECE);
        std::uint32_t n_values = 0;
        check(elvis_data_sample(get(), shown.get(), detail::or_null(field), piece, values.data(), &n_values));
        values.resize(n_values);
        return values;
    }
    std::vector<double> percentiles(const scene& shown, const std::vector<double>& parts, const task& watch = {}) const {
        std::vector<double> values(parts.size());
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_get_percentiles(get(), shown.get(), static_cast<std::uint32_t>(parts.size()), parts.data(),
                                         values.data(), &c_watch));
        return values;
    }
    /** See elvis_data_update_field. */
    void update_field(std::uint32_t field, std::uint32_t time_step, std::uint32_t element_class, const double* values) {
        check(elvis_data_update_field(get(), field, time_step, element_class, values));
    }
    /** See elvis_data_fields_changed. */
    void fields_changed(std::uint32_t field = ELVIS_ALL_FIELDS) { check(elvis_data_fields_changed(get(), field)); }
    elvis_data* get() const { return m_handle.get(); }

private:
    void check(elvis_result result) const { detail::check(result, m_context.get()); }
    /** Releases the handle. */
    traced read_lines(elvis_lines* handle) const {
        const std::unique_ptr<elvis_lines, detail::release> lines(handle);
        auto info = detail::sized<elvis_lines_info>();
        check(elvis_lines_get_info(handle, &info));
        traced all;
        all.n_values = info.n_values;
        all.time_doubt = info.time_doubt;
        all.first.resize(info.n_lines + 1);
        all.begins.resize(info.n_lines);
        all.ends.resize(info.n_lines);
        all.positions.resize(3 * info.n_points);
        all.times.resize(info.n_points);
        all.arc_lengths.resize(info.n_points);
        all.elements.resize(info.n_points);
        all.xi.resize(3 * info.n_points);
        all.values.resize(info.n_points * info.n_values);
        auto arrays = detail::sized<elvis_line_arrays>();
        arrays.first = all.first.data();
        arrays.begins = all.begins.data();
        arrays.ends = all.ends.data();
        arrays.positions = all.positions.data();
        arrays.times = all.times.data();
        arrays.arc_lengths = all.arc_lengths.data();
        arrays.elements = all.elements.data();
        arrays.xi = all.xi.data();
        arrays.values = all.values.data();
        check(elvis_lines_read(handle, &arrays));
        return all;
    }

    detail::shared_context m_context;
    std::unique_ptr<elvis_data, detail::release> m_handle;
};

inline data scene::open_volume(const task& watch) const {
    elvis_data* opened = nullptr;
    const elvis_task c_watch = detail::c_task(watch);
    check(elvis_scene_open_volume(get(), &c_watch, &opened));
    return {m_context, opened};
}

inline scene scene::completed(const data& shown) const {
    elvis_scene* complete = nullptr;
    check(elvis_scene_complete(get(), shown.get(), &complete));
    return {m_context, complete};
}

/** A device with plugins and a cache. Copies are the same context. */
class context {
public:
    explicit context(const elvis_context_options& options = detail::sized<elvis_context_options>()) {
        elvis_context* handle = nullptr;
        detail::check(elvis_context_create(&options, &handle), nullptr);
        m_handle = {handle, detail::release()};
    }

    data open(const std::string& path, const std::string& plugin = {}, const std::string& options = {},
              const task& watch = {}) const {
        elvis_data* opened = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_open(get(), path.c_str(), detail::or_null(plugin), detail::or_null(options), &c_watch, &opened));
        return {m_handle, opened};
    }
    /** A foreign data set of several files. */
    data open(const std::vector<std::string>& paths, const std::string& plugin = {}, const std::string& options = {},
              const task& watch = {}) const {
        std::vector<elvis_string> texts;
        for (const std::string& path : paths) {
            texts.push_back(path.c_str());
        }
        elvis_data* opened = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_open_files(get(), texts.data(), static_cast<std::uint32_t>(texts.size()), detail::or_null(plugin),
                                    detail::or_null(options), &c_watch, &opened));
        return {m_handle, opened};
    }
    data from_runtime(const elvis_runtime& runtime, elvis_volume* volume, const std::string& name = "volume") const {
        elvis_data* opened = nullptr;
        check(elvis_data_from_runtime(get(), &runtime, volume, name.c_str(), &opened));
        return {m_handle, opened};
    }
    data from_arrays(const elvis_arrays& arrays, const std::string& name = "volume", const task& watch = {}) const {
        elvis_data* made = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_data_from_arrays(get(), &arrays, name.c_str(), &c_watch, &made));
        return {m_handle, made};
    }
    scene make_scene() const {
        elvis_scene* made = nullptr;
        check(elvis_scene_create(get(), &made));
        return {m_handle, made};
    }
    scene read_scene(const std::string& path) const {
        elvis_scene* read = nullptr;
        check(elvis_scene_read(get(), path.c_str(), &read));
        return {m_handle, read};
    }
    /** Files that the text names are seen from `folder`, empty: from the working directory. */
    scene parse_scene(const std::string& text, const std::string& folder = {}) const {
        elvis_scene* parsed = nullptr;
        check(elvis_scene_parse(get(), text.c_str(), detail::or_null(folder), &parsed));
        return {m_handle, parsed};
    }
    /** Returns the report, JSON. */
    std::string convert(const elvis_conversion& conversion, const task& watch = {}) const {
        char* report = nullptr;
        const elvis_task c_watch = detail::c_task(watch);
        check(elvis_convert(get(), &conversion, &c_watch, &report));
        return detail::taken(report);
    }
    std::string list_devices() const {
        char* text = nullptr;
        check(elvis_context_list_devices(get(), &text));
        return detail::taken(text);
    }
    /** JSON of the device that draws. */
    std::string describe_device() const {
        char* text = nullptr;
        check(elvis_context_describe_device(get(), &text));
        return detail::taken(text);
    }
    /** See elvis_context_limit_memory and elvis_context_free_memory. */
    void limit_memory(std::uint64_t bytes) const { check(elvis_context_limit_memory(get(), bytes)); }
    void free_memory() const { check(elvis_context_free_memory(get())); }
    /** JSON: see elvis_context_describe_file. */
    std::string describe_file(const std::string& path) const {
        char* text = nullptr;
        check(elvis_context_describe_file(get(), path.c_str(), &text));
        return detail::taken(text);
    }
    std::string list_plugins() const {
        char* text = nullptr;
        check(elvis_context_list_plugins(get(), &text));
        return detail::taken(text);
    }
    elvis_context* get() const { return m_handle.get(); }

private:
    void check(elvis_result result) const { detail::check(result, m_handle.get()); }

    detail::shared_context m_handle;
};

} // namespace elvis

#endif
