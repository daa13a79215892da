/**
 * @file module.cpp
 * elvis._elvis: the library for Python, as it is. The package around it makes it pleasant (elvis/__init__.py).
 */
#include "arrays.hpp"
#include "running.hpp"

#include <elvis/extract.hpp>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace py = pybind11;

namespace elvis::python {

namespace {

/** What one channel is in an array: numbers a pixel, and their kind. */
struct ChannelKind {
    const char* name;
    elvis_channel channel;
    elvis_number number;
    const char* type;
    py::ssize_t n_numbers;
};
constexpr ChannelKind channel_kinds[] = {{"color", ELVIS_CHANNEL_COLOR, ELVIS_NUMBER_UINT8, "uint8", 4},
                                         {"color16", ELVIS_CHANNEL_COLOR, ELVIS_NUMBER_UINT16, "uint16", 4},
                                         {"color_float", ELVIS_CHANNEL_COLOR, ELVIS_NUMBER_DOUBLE, "float64", 4},
                                         {"value", ELVIS_CHANNEL_VALUE, ELVIS_NUMBER_DOUBLE, "float64", 1},
                                         {"depth", ELVIS_CHANNEL_DEPTH, ELVIS_NUMBER_DOUBLE, "float64", 1},
                                         {"normal", ELVIS_CHANNEL_NORMAL, ELVIS_NUMBER_DOUBLE, "float64", 3},
                                         {"element", ELVIS_CHANNEL_ELEMENT, ELVIS_NUMBER_INT64, "int64", 1},
                                         {"flags", ELVIS_CHANNEL_FLAGS, ELVIS_NUMBER_UINT32, "uint32", 1}};

class Picture {
public:
    Picture(context with, picture drawn) : m_context(std::move(with)), m_picture(std::move(drawn)), m_info(m_picture.info()) {}

    py::array read(const std::string& name) const {
        for (const ChannelKind& kind : channel_kinds) {
            if (name == kind.name) {
                std::vector<py::ssize_t> shape{m_info.height, m_info.width};
                if (kind.n_numbers > 1) {
                    shape.push_back(kind.n_numbers);
                }
                py::array array(py::dtype(kind.type), shape);
                void* const to = array.mutable_data();
                const py::gil_scoped_release unlocked;
                const elvis_result result = elvis_picture_read(m_picture.get(), kind.channel, kind.number, to, 0, 0);
                if (result != ELVIS_OK) {
                    throw error(result, elvis_context_error(m_context.get()));
                }
                return array;
            }
        }
        throw error(ELVIS_ERROR_INVALID_ARGUMENT, "there is no channel '" + name + "'");
    }
    std::vector<std::pair<std::string, bool>> remarks() const {
        std::vector<std::pair<std::string, bool>> all;
        for (const picture::remark& remark : m_picture.remarks()) {
            all.emplace_back(remark.text, remark.is_warning);
        }
        return all;
    }
    const picture& get() const { return m_picture; }
    const elvis_picture_info& info() const { return m_info; }

private:
    context m_context;
    picture m_picture;
    elvis_picture_info m_info;
};

class Animation {
public:
    Animation(context with, animation made)
        : m_context(std::move(with)), m_animation(std::move(made)), m_info(m_animation.info()) {}

    std::unique_ptr<Picture> render(std::uint32_t frame, bool color_only, const py::object& progress) const {
        std::optional<picture> drawn;
        run(progress, [&](const task& watch) {
            auto options = detail::sized<elvis_render_options>();
            options.flags = color_only ? ELVIS_RENDER_COLOR_ONLY : 0;
            drawn.emplace(m_animation.render(frame, options, watch));
        });
        return std::make_unique<Picture>(m_context, std::move(*drawn));
    }
    std::string remarks() const {
        const py::gil_scoped_release unlocked;
        return m_animation.remarks();
    }
    std::uint32_t time_step(std::uint32_t frame) const { return m_animation.time_step(frame); }
    const elvis_animation_info& info() const { return m_info; }

private:
    context m_context;
    animation m_animation;
    elvis_animation_info m_info;
};

/** What elvis_lines_read gives. */
py::dict lines_as_arrays(const traced& found) {
    const auto n = static_cast<py::ssize_t>(found.times.size());
    py::dict result;
    result["first"] = py::array_t<std::uint64_t>(static_cast<py::ssize_t>(found.first.size()), found.first.data());
    result["begins"] = found.begins;
    result["ends"] = found.ends;
    result["positions"] = py::array_t<double>({n, py::ssize_t{3}}, found.positions.data());
    result["times"] = py::array_t<double>(n, found.times.data());
    result["arc_lengths"] = py::array_t<double>(n, found.arc_lengths.data());
    result["elements"] = py::array_t<std::int64_t>(n, found.elements.data());
    result["xi"] = py::array_t<double>({n, py::ssize_t{3}}, found.xi.data());
    result["values"] = py::array_t<double>({n, static_cast<py::ssize_t>(found.n_values)}, found.values.data());
    return result;
}

class Volume {
public:
    Volume(context with, data opened) : m_context(std::move(with)), m_data(std::move(opened)) {}

    std::string describe(std::uint32_t time_step, bool brief) const {
        const py::gil_scoped_release unlocked;
        auto options = detail::sized<elvis_describe_options>();
        options.time_step = time_step;
        options.flags = brief ? ELVIS_DESCRIBE_BRIEF : 0;
        return m_data.describe(options);
    }
    py::dict range(const std::string& field, std::uint32_t time_step) const {
        elvis_range found{};
        {
            const py::gil_scoped_release unlocked;
            found = m_data.range(field, time_step);
        }
        py::dict result;
        result["minimum"] = found.minimum;
        result["maximum"] = found.maximum;
        result["lower_bound"] = found.lower_bound;
        result["upper_bound"] = found.upper_bound;
        result["certified"] = found.certainty == ELVIS_CERTIFIED;
        result["minimum_element"] = found.minimum_element;
        result["maximum_element"] = found.maximum_element;
        result["minimum_position"] =
            std::array{found.minimum_position[0], found.minimum_position[1], found.minimum_position[2]};
        result["maximum_position"] =
            std::array{found.maximum_position[0], found.maximum_position[1], found.maximum_position[2]};
        return result;
    }
    /** Elements, xi, values, gradients, whether estimated: what elvis_data_probe writes. */
    py::tuple probe(const Doubles& points, const std::vector<std::string>& fields, std::uint32_t time_step,
                    const py::object& progress) const {
        if (points.ndim() != 2 || points.shape(1) != 3) {
            throw error(ELVIS_ERROR_INVALID_ARGUMENT, "points: an array of the shape (n, 3) is wanted");
        }
        const std::vector<elvis_string> names = detail::c_strings(fields);
        std::uint32_t n_values = 0;
        check(elvis_data_count_values(m_data.get(), names.data(), static_cast<std::uint32_t>(names.size()), &n_values));
        const py::ssize_t n_points = points.shape(0);
        py::array_t<std::int64_t> elements(n_points);
        py::array_t<double> xi({n_points, py::ssize_t{3}});
        py::array_t<double> values({n_points, py::ssize_t{n_values}});
        py::array_t<double> gradients({n_points, py::ssize_t{n_values}, py::ssize_t{3}});
        py::array_t<std::uint8_t> estimated({n_points, py::ssize_t{n_values}});
        auto request = detail::sized<elvis_probe>();
        request.time_step = time_step;
        request.n_points = static_cast<std::uint64_t>(n_points);
        request.positions = points.data();
        request.n_fields = static_cast<std::uint32_t>(names.size());
        request.fields = names.data();
        request.elements = elements.mutable_data();
        request.xi = xi.mutable_data();
        request.values = values.mutable_data();
        request.gradients = gradients.mutable_data();
        request.estimated = estimated.mutable_data();
        run(progress, [&](const task& watch) {
            const elvis_task c_watch = detail::c_task(watch);
            check(elvis_data_probe(m_data.get(), &request, &c_watch));
        });
        return py::make_tuple(elements, xi, values, gradients, estimated);
    }
    /** What elvis_data_integrate finds; the domain is one of its numbers. */
    py::dict integrate(std::uint32_t domain, const std::optional<std::string>& field, const std::vector<std::string>& groups,
                       const std::array<double, 4>& plane, const std::optional<std::string>& level_field, double isovalue,
                       bool flux, std::uint32_t time_step, double tolerance, const py::object& progress) const {
        const std::vector<elvis_string> names = detail::c_strings(groups);
        auto wanted = detail::sized<elvis_integration>();
        wanted.domain = domain;
        wanted.field = field ? field->c_str() : nullptr;
        wanted.groups = names.data();
        wanted.n_groups = static_cast<std::uint32_t>(names.size());
        wanted.time_step = time_step;
        wanted.is_flux = flux ? 1 : 0;
        std::copy(plane.begin(), plane.end(), wanted.plane);
        wanted.level_field = level_field ? level_field->c_str() : nullptr;
        wanted.isovalue = isovalue;
        wanted.tolerance = tolerance;
        elvis_integral found{};
        run(progress, [&](const task& watch) { found = m_data.integrate(wanted, watch); });
        py::dict result;
        result["value"] = found.value;
        result["error"] = found.error;
        result["measure"] = found.measure;
        result["measure_error"] = found.measure_error;
        result["converged"] = found.is_converged != 0;
        result["exact"] = found.is_exact != 0;
        result["parts"] = found.n_parts;
        result["evaluations"] = found.n_evaluations;
        result["inverted"] = found.n_inverted;
        result["unresolved"] = found.n_unresolved;
        return result;
    }
    std::unique_ptr<Volume> warp(const std::string& field, double factor, const std::optional<std::string>& imaginary,
                                 double phase, std::uint32_t time_step, const py::object& progress) const {
        auto wanted = detail::sized<elvis_warp>();
        wanted.time_step = time_step;
        wanted.field = field.c_str();
        wanted.imaginary = imaginary ? imaginary->c_str() : nullptr;
        wanted.factor = factor;
        wanted.phase = phase;
        std::optional<data> displaced;
        run(progress, [&](const task& watch) { displaced.emplace(m_data.warp(wanted, watch)); });
        return std::make_unique<Volume>(m_context, std::move(*displaced));
    }
    std::unique_ptr<Volume>
    join(const std::vector<std::tuple<std::string, const Volume*, std::optional<std::uint32_t>>>& others,
         const py::object& progress) const {
        std::vector<data::joined> wanted;
        for (const auto& [name, volume, time_step] : others) {
            wanted.push_back({name, &volume->m_data, time_step.value_or(ELVIS_SAME_TIME_STEP)});
        }
        std::optional<data> together;
        run(progress, [&](const task& watch) { together.emplace(m_data.join(wanted, watch)); });
        return std::make_unique<Volume>(m_context, std::move(*together));
    }
    /** What elvis_data_extract finds, by the names of the package's Mesh. */
    py::dict extract(elvis_domain domain, const std::vector<std::string>& groups, const std::array<double, 4>& plane,
                     const std::optional<std::string>& level_field, double isovalue,
                     const std::optional<std::string>& contour_field, const std::vector<double>& contours,
                     const std::vector<std::string>& fields, double tolerance, std::uint32_t time_step,
                     const py::object& progress) const {
        const std::vector<elvis_string> group_names = detail::c_strings(groups), names = detail::c_strings(fields);
        auto wanted = detail::sized<elvis_extraction>();
        wanted.domain = domain;
        wanted.groups = group_names.data();
        wanted.n_groups = static_cast<std::uint32_t>(group_names.size());
        wanted.time_step = time_step;
        std::copy(plane.begin(), plane.end(), wanted.plane);
        wanted.level_field = level_field ? level_field->c_str() : nullptr;
        wanted.isovalue = isovalue;
        wanted.contour_field = contour_field ? contour_field->c_str() : nullptr;
        wanted.contours = contours.data();
        wanted.n_contours = static_cast<std::uint32_t>(contours.size());
        wanted.fields = names.data();
        wanted.n_fields = static_cast<std::uint32_t>(names.size());
        wanted.tolerance = tolerance;
        extracted found;
        run(progress, [&](const task& watch) { found = elvis::extract(m_context, m_data, wanted, watch); });
        const elvis_mesh_info& info = found.info;
        const auto n = static_cast<py::ssize_t>(info.n_vertices), m = static_cast<py::ssize_t>(info.n_triangles);
        const auto list = [](const auto& numbers) {
            using Number = typename std::decay_t<decltype(numbers)>::value_type;
            return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
        };
        py::dict result;
        result["positions"] = py::array_t<double>({n, py::ssize_t{3}}, found.positions.data());
        result["normals"] = py::array_t<double>({n, py::ssize_t{3}}, found.normals.data());
        result["elements"] = list(found.elements);
        result["xi"] = py::array_t<double>({n, py::ssize_t{3}}, found.xi.data());
        result["values"] = py::array_t<double>({n, static_cast<py::ssize_t>(info.n_values)}, found.values.data());
        result["triangles"] = py::array_t<std::uint32_t>({m, py::ssize_t{3}}, found.triangles.data());
        result["triangle_elements"] = list(found.triangle_elements);
        result["line_first"] = list(found.line_first);
        result["line_vertices"] = list(found.line_vertices);
        result["line_values"] = list(found.line_values);
        result["measure"] = info.measure;
        result["volume"] = info.volume;
        result["mesh_to_surface"] = info.mesh_to_surface;
        result["surface_to_mesh"] = info.surface_to_mesh;
        result["tolerance"] = info.tolerance;
        result["euler_number"] = info.euler_number;
        result["rim_edges"] = info.n_rim_edges;
        result["inner_edges"] = info.n_inner_edges;
        result["branching_edges"] = info.n_branching_edges;
        result["open_ends"] = info.n_open_ends;
        result["certified"] = info.is_certified != 0;
        result["sampled_elements"] = info.n_sampled_elements;
        result["undecided"] = info.n_undecided;
        return result;
    }
    /** Of each line begin, end, and dictionaries' arrays of its points: what elvis_data_trace finds. */
    py::dict trace(const std::string& field, const Doubles& seeds, std::uint32_t direction,
                   const std::vector<std::string>& fields, double tolerance, double length, std::uint32_t time_step,
                   bool is_unsteady, bool is_linear, std::optional<double> start_time, std::optional<double> end_time,
                   const std::string& seed_surface, double seed_spacing, const py::object& progress) const {
        if (seeds.ndim() != 2 || seeds.shape(1) != 3) {
            throw error(ELVIS_ERROR_INVALID_ARGUMENT, "seeds: an array of the shape (n, 3) is wanted");
        }
        const std::vector<elvis_string> names = detail::c_strings(fields);
        auto wanted = detail::sized<elvis_tracing>();
        wanted.time_step = time_step;
        wanted.field = field.c_str();
        wanted.seeds = seeds.data();
        wanted.n_seeds = static_cast<std::uint64_t>(seeds.shape(0));
        wanted.direction = direction;
        wanted.n_fields = static_cast<std::uint32_t>(names.size());
        wanted.fields = names.data();
        wanted.tolerance = tolerance;
        wanted.length = length;
        wanted.flags = (is_unsteady ? ELVIS_TRACE_PATHLINES : 0u) | (start_time ? ELVIS_TRACE_START_TIME : 0u) |
                       (end_time ? ELVIS_TRACE_END_TIME : 0u);
        wanted.interpolation = is_linear ? ELVIS_TIME_LINEAR : ELVIS_TIME_CUBIC;
        wanted.start_time = start_time.value_or(0);
        wanted.end_time = end_time.value_or(0);
        wanted.seed_surface = seed_surface.empty() ? nullptr : seed_surface.c_str();
        wanted.seed_spacing = seed_spacing;
        traced found;
        run(progress, [&](const task& watch) { found = m_data.trace(wanted, watch); });
        return lines_as_arrays(found);
    }
    /** The same of streamlines or pathlines of a scene. */
    py::dict trace_scene(const std::string& scene_text, const std::string& folder, std::uint32_t surface,
                         const std::vector<std::string>& fields, const py::object& progress) const {
        const scene shown = m_context.parse_scene(scene_text, folder);
        traced found;
        run(progress, [&](const task& watch) { found = m_data.trace(shown, surface, fields, watch); });
        return lines_as_arrays(found);
    }
    /** JSON: see elvis_data_walk_line. */
    std::string walk_line(const std::array<double, 3>& from, const std::array<double, 3>& to,
                          const std::vector<std::string>& fields, std::uint32_t time_step, const py::object& progress) const {
        std::string places;
        run(progress, [&](const task& watch) { places = m_data.walk_line(from, to, fields, time_step, watch); });
        return places;
    }
    std::uint32_t count_values(const std::string& field) const {
        const elvis_string name = field.c_str();
        std::uint32_t n_values = 0;
        check(elvis_data_count_values(m_data.get(), &name, 1, &n_values));
        return n_values;
    }
    std::unique_ptr<Picture> render(const std::string& scene_text, const std::string& folder, std::uint32_t width,
                                    std::uint32_t height, bool color_only, const py::object& progress) const {
        std::optional<picture> drawn;
        run(progress, [&](const task& watch) {
            const scene shown = m_context.parse_scene(scene_text, folder);
            auto options = detail::sized<elvis_render_options>();
            options.width = width;
            options.height = height;
            options.flags = color_only ? ELVIS_RENDER_COLOR_ONLY : 0;
            drawn.emplace(m_data.render(shown, options, watch));
        });
        return std::make_unique<Picture>(m_context, std::move(*drawn));
    }

    std::unique_ptr<Animation> animate(const std::string& scene_text, const std::string& folder,
                                       const py::object& progress) const {
        std::optional<animation> made;
        run(progress, [&](const task&) { made.emplace(m_data.animate(m_context.parse_scene(scene_text, folder))); });
        return std::make_unique<Animation>(m_context, std::move(*made));
    }
    std::vector<double> percentiles(const std::string& scene_text, const std::string& folder, const std::vector<double>& parts,
                                    const py::object& progress) const {
        std::vector<double> values;
        run(progress,
            [&](const task& watch) { values = m_data.percentiles(m_context.parse_scene(scene_text, folder), parts, watch); });
        return values;
    }
    std::string pick(const std::string& scene_text, const std::string& folder, double column, double row,
                     const py::object& progress) const {
        std::string picked;
        run(progress,
            [&](const task& watch) { picked = m_data.pick(m_context.parse_scene(scene_text, folder), column, row, watch); });
        return picked;
    }
    std::string complete(const std::string& scene_text, const std::string& folder) const {
        const py::gil_scoped_release unlocked;
        return m_context.parse_scene(scene_text, folder).completed(m_data).json();
    }

    void update_field(std::uint32_t field, std::uint32_t time_step, std::uint32_t element_class, const Doubles& values) {
        const double* const numbers = values.data();
        const py::gil_scoped_release unlocked;
        m_data.update_field(field, time_step, element_class, numbers);
    }

private:
    void check(elvis_result result) const { detail::check(result, m_context.get()); }

    context m_context;
    data m_data;
};

class Context {
public:
    Context(const std::string& device, const std::optional<std::string>& plugin_path,
            const std::optional<std::string>& cache_folder)
        : m_context(options(device, plugin_path, cache_folder)) {}

    std::unique_ptr<Volume> open(const std::vector<std::string>& paths, const std::string& plugin,
                                 const std::string& plugin_options, const py::object& progress) const {
        std::optional<data> opened;
        run(progress, [&](const task& watch) { opened.emplace(m_context.open(paths, plugin, plugin_options, watch)); });
        return std::make_unique<Volume>(m_context, std::move(*opened));
    }
    std::unique_ptr<Volume> from_arrays(const std::string& name, std::uint32_t dimension, const py::list& classes,
                                        const py::list& fields, const std::vector<double>& times,
                                        const std::vector<std::string>& groups, const py::object& progress) const {
        const ArrayVolume volume(dimension, classes, fields, times, groups);
        std::optional<data> made;
        run(progress, [&](const task& watch) { made.emplace(m_context.from_arrays(volume.arrays(), name, watch)); });
        return std::make_unique<Volume>(m_context, std::move(*made));
    }
    std::uint64_t count_modes(elvis_shape shape, elvis_basis basis, const std::array<std::uint32_t, 3>& order) const {
        auto space = detail::sized<elvis_space>();
        space.basis = basis;
        std::copy(order.begin(), order.end(), space.order);
        std::uint64_t n_modes = 0;
        detail::check(elvis_space_count_modes(m_context.get(), shape, &space, &n_modes), m_context.get());
        return n_modes;
    }
    /** The scene as the library understands it: JSON. Throws for what the schema does not allow. */
    std::string check_scene(const std::string& text, const std::string& folder) const {
        return m_context.parse_scene(text, folder).json();
    }
    std::string read_scene(const std::string& path) const { return m_context.read_scene(path).json(); }
    void write_scene(const std::string& text, const std::string& folder, const std::string& path) const {
        m_context.parse_scene(text, folder).write(path);
    }
    /** What the scene's `volume` says. */
    std::unique_ptr<Volume> open_scene_volume(const std::string& text, const std::string& folder,
                                              const py::object& progress) const {
        std::optional<data> opened;
        run(progress, [&](const task& watch) { opened.emplace(m_context.parse_scene(text, folder).open_volume(watch)); });
        return std::make_unique<Volume>(m_context, std::move(*opened));
    }
    std::string scene_volume(const std::string& text, const std::string& folder) const {
        return m_context.parse_scene(text, folder).volume();
    }
    std::string convert(const std::vector<std::string>& inputs, const std::string& output, const std::string& plugin,
                        const std::string& plugin_options, const std::vector<std::string>& fields, int order,
                        elvis_continuity continuity, const py::object& progress) const {
        const std::vector<elvis_string> input_names = detail::c_strings(inputs), field_names = detail::c_strings(fields);
        auto conversion = detail::sized<elvis_conversion>();
        conversion.n_inputs = static_cast<std::uint32_t>(input_names.size());
        conversion.inputs = input_names.data();
        conversion.output = output.c_str();
        conversion.plugin = detail::or_null(plugin);
        conversion.options = detail::or_null(plugin_options);
        conversion.n_fields = static_cast<std::uint32_t>(field_names.size());
        conversion.fields = field_names.data();
        conversion.order = order;
        conversion.continuity = continuity;
        std::string report;
        run(progress, [&](const task& watch) { report = m_context.convert(conversion, watch); });
        return report;
    }
    std::string devices() const { return m_context.list_devices(); }
    std::string plugins() const { return m_context.list_plugins(); }

private:
    static elvis_context_options options(const std::string& device, const std::optional<std::string>& plugin_path,
                                         const std::optional<std::string>& cache_folder) {
        auto result = detail::sized<elvis_context_options>();
        result.device = detail::or_null(device);
        result.plugin_path = plugin_path ? plugin_path->c_str() : nullptr;
        result.cache_folder = cache_folder ? cache_folder->c_str() : nullptr;
        result.log = [](void*, elvis_log_level level, elvis_string line) {
            if (level < ELVIS_LOG_INFO) {
                return;
            }
            // The logging module decides who hears of it. Lines may come while the interpreter ends.
            if (Py_IsInitialized() == 0) {
                return;
            }
            const py::gil_scoped_acquire locked;
            try {
                py::module_::import("logging").attr("getLogger")("elvis").attr(level < ELVIS_LOG_WARNING ? "info" : "warning")(
                    "%s", line);
            } catch (py::error_already_set& failure) {
                failure.discard_as_unraisable("a log line of elvis");
            }
        };
        return result;
    }

    context m_context;
};

} // namespace

} // namespace elvis::python

PYBIND11_MODULE(_elvis, module) {
    using namespace elvis::python;
    module.doc() = "The library libelvis. Use the package elvis.";

    static py::exception<elvis::error> error_type(module, "Error", PyExc_RuntimeError);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) {
                std::rethrow_exception(thrown);
            }
        } catch (const elvis::cancelled&) {
            PyErr_SetNone(PyExc_KeyboardInterrupt);
        } catch (const elvis::error& failure) {
            error_type(failure.what());
        }
    });

    py::class_<Picture>(module, "Picture")
        .def("read", &Picture::read, py::arg("channel"))
        .def("remarks", &Picture::remarks)
        .def("stats", [](const Picture& picture) { return picture.get().stats(); })
        .def("color_bars", [](const Picture& picture) { return picture.get().color_bars(); })
        .def(
            "write_png",
            [](const Picture& picture, const std::string& path, std::uint32_t bits) { picture.get().write_png(path, bits); },
            py::arg("path"), py::arg("bits"))
        .def(
            "write_svg",
            [](const Picture& picture, const std::string& path, std::uint32_t bits) { picture.get().write_svg(path, bits); },
            py::arg("path"), py::arg("bits"))
        .def(
            "write_pdf",
            [](const Picture& picture, const std::string& path, std::uint32_t bits) { picture.get().write_pdf(path, bits); },
            py::arg("path"), py::arg("bits"))
        .def(
            "write_buffers", [](const Picture& picture, const std::string& path) { picture.get().write_buffers(path); },
            py::arg("path"))
        .def_property_readonly("width", [](const Picture& picture) { return picture.info().width; })
        .def_property_readonly("height", [](const Picture& picture) { return picture.info().height; });

    py::class_<Volume>(module, "Volume")
        .def("describe", &Volume::describe, py::arg("time_step"), py::arg("brief"))
        .def("range", &Volume::range, py::arg("field"), py::arg("time_step"))
        .def("integrate", &Volume::integrate, py::arg("domain"), py::arg("field"), py::arg("groups"), py::arg("plane"),
             py::arg("level_field"), py::arg("isovalue"), py::arg("flux"), py::arg("time_step"), py::arg("tolerance"),
             py::arg("progress"))
        .def("warp", &Volume::warp, py::arg("field"), py::arg("factor"), py::arg("imaginary"), py::arg("phase"),
             py::arg("time_step"), py::arg("progress"))
        .def("join", &Volume::join, py::arg("others"), py::arg("progress"))
        .def("extract", &Volume::extract, py::arg("domain"), py::arg("groups"), py::arg("plane"), py::arg("level_field"),
             py::arg("isovalue"), py::arg("contour_field"), py::arg("contours"), py::arg("fields"), py::arg("tolerance"),
             py::arg("time_step"), py::arg("progress"))
        .def("trace_scene", &Volume::trace_scene, py::arg("scene"), py::arg("folder"), py::arg("surface"), py::arg("fields"),
             py::arg("progress"))
        .def("trace", &Volume::trace, py::arg("field"), py::arg("seeds"), py::arg("direction"), py::arg("fields"),
             py::arg("tolerance"), py::arg("length"), py::arg("time_step"), py::arg("is_unsteady"), py::arg("is_linear"),
             py::arg("start_time"), py::arg("end_time"), py::arg("seed_surface"), py::arg("seed_spacing"), py::arg("progress"))
        .def("walk_line", &Volume::walk_line, py::arg("start"), py::arg("end"), py::arg("fields"), py::arg("time_step"),
             py::arg("progress"))
        .def("update_field", &Volume::update_field, py::arg("field"), py::arg("time_step"), py::arg("element_class"),
             py::arg("values"))
        .def("count_values", &Volume::count_values, py::arg("field"))
        .def("probe", &Volume::probe, py::arg("points"), py::arg("fields"), py::arg("time_step"), py::arg("progress"))
        .def("render", &Volume::render, py::arg("scene"), py::arg("folder"), py::arg("width"), py::arg("height"),
             py::arg("color_only"), py::arg("progress"))
        .def("animate", &Volume::animate, py::arg("scene"), py::arg("folder"), py::arg("progress"))
        .def("percentiles", &Volume::percentiles, py::arg("scene"), py::arg("folder"), py::arg("parts"), py::arg("progress"))
        .def("pick", &Volume::pick, py::arg("scene"), py::arg("folder"), py::arg("column"), py::arg("row"), py::arg("progress"))
        .def("complete", &Volume::complete, py::arg("scene"), py::arg("folder"));

    py::class_<Animation>(module, "Animation")
        .def("render", &Animation::render, py::arg("frame"), py::arg("color_only"), py::arg("progress"))
        .def("remarks", &Animation::remarks)
        .def("time_step", &Animation::time_step, py::arg("frame"))
        .def_property_readonly("n_frames", [](const Animation& all) { return all.info().n_frames; })
        .def_property_readonly("frames_a_second", [](const Animation& all) { return all.info().frames_a_second; });

    py::class_<Context>(module, "Context")
        .def(py::init<const std::string&, const std::optional<std::string>&, const std::optional<std::string>&>(),
             py::arg("device"), py::arg("plugin_path"), py::arg("cache_folder"))
        .def("open", &Context::open, py::arg("paths"), py::arg("plugin"), py::arg("options"), py::arg("progress"))
        .def("from_arrays", &Context::from_arrays, py::arg("name"), py::arg("dimension"), py::arg("classes"), py::arg("fields"),
             py::arg("times"), py::arg("groups"), py::arg("progress"))
        .def("count_modes", &Context::count_modes, py::arg("shape"), py::arg("basis"), py::arg("order"))
        .def("check_scene", &Context::check_scene, py::arg("text"), py::arg("folder"))
        .def("read_scene", &Context::read_scene, py::arg("path"))
        .def("write_scene", &Context::write_scene, py::arg("text"), py::arg("folder"), py::arg("path"))
        .def("open_scene_volume", &Context::open_scene_volume, py::arg("text"), py::arg("folder"), py::arg("progress"))
        .def("scene_volume", &Context::scene_volume, py::arg("text"), py::arg("folder"))
        .def("convert", &Context::convert, py::arg("inputs"), py::arg("output"), py::arg("plugin"), py::arg("options"),
             py::arg("fields"), py::arg("order"), py::arg("continuity"), py::arg("progress"))
        .def("devices", &Context::devices)
        .def("plugins", &Context::plugins);

    module.def("scene_schema", [] { return std::string(elvis_scene_schema()); });
}
