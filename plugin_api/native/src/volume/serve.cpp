/*
 * The runtime interface of native volumes: checks arguments and hands on to Volume.
 */
#include "native_snippet.hpp"
#include "volume.hpp"

#include <elvis/demand.h>
#include <elvis/native/serve.hpp>
#include <elvis/native/volume_file.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>

namespace elvis::native_plugin {
namespace {

/** For mistakes of the caller. */
void require(bool condition, const char* what) {
    if (!condition)
        throw api::Error(ELVIS_ERROR_INVALID_ARGUMENT, {}, what);
}

elvis_string text_or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

std::uint32_t count(std::size_t n) { return static_cast<std::uint32_t>(n); }

/** An output array that may be missing. */
std::span<double> optional(double* numbers, std::size_t size) {
    return numbers == nullptr ? std::span<double>() : std::span(numbers, size);
}

/** The snippet's texts, that of the field's second derivatives left empty if they are not given. */
std::vector<elvis_text> make_sources(bool with_hessian) {
    std::vector<elvis_text> texts;
    for (const auto& file : snippet::files) {
        // Known to #include and to messages by its name alone.
        const char* slash = std::strrchr(file.name, '/');
        const char* name = slash == nullptr ? file.name : slash + 1;
        const bool is_left_out = !with_hessian && std::strcmp(name, "field_hessian.glsl") == 0;
        texts.push_back(api::text(name, is_left_out ? "// Not with fields that have a transform.\n" : file.text));
    }
    return texts;
}

std::shared_ptr<const native::VolumeSource> open_file(const std::string& path) {
    // A missing file deserves a plainer word than HDF5's.
    if (!std::ifstream(path, std::ios::binary))
        throw api::Error(ELVIS_ERROR_FILE, path, "the file does not exist or cannot be read");
    try {
        return std::make_shared<const native::Reader>(path);
    } catch (const native::FileError& error) {
        throw without_name(error);
    }
}

/** Two buffers a class: geometry, then field. */
constexpr std::uint32_t n_buffers_per_class = 2;

class NativeVolume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return static_cast<std::uint32_t>(native::Reader::probe(path)); }

    /** There are no options. */
    NativeVolume(const api::Host& host, const std::string& path, const std::string&)
        : NativeVolume(host, path, open_file(path)) {}
    NativeVolume(const api::Host& host, const std::string& path, std::shared_ptr<const native::VolumeSource> source)
        : RuntimeVolume(host), m_volume(host, path, std::move(source)), m_description(m_volume.description()) {}

    void forget_fields() { m_volume.forget_fields(); }

    void get_info(elvis_volume_info& info) override {
        info.dimension = static_cast<std::uint32_t>(m_description.dimension);
        info.n_elements = m_volume.n_elements();
        info.n_faces = m_description.n_faces;
        info.n_classes = count(m_description.classes.size());
        info.n_boundary_groups = count(m_description.boundary_groups.size());
        info.n_fields = count(m_description.fields.size());
        info.n_time_steps = count(m_description.times.size());
        info.n_buffers = count(m_description.classes.size() * n_buffers_per_class);
        info.n_notes = count(m_description.notes.size());
    }

    void get_class(std::uint32_t element_class, elvis_element_class& out) override {
        check_class(element_class);
        const native::Space& geometry = m_volume.geometry_space(element_class);
        out.shape = static_cast<elvis_shape>(geometry.shape);
        out.n_elements = m_description.classes[element_class].n_elements;
        std::copy(geometry.order.begin(), geometry.order.end(), out.geometry_order);
        // Straight elements of the other shapes may be affine too, but only their coefficients would tell.
        out.is_affine = geometry.shape == native::Shape::tetrahedron && geometry.order[2] <= 1 ? 1 : 0;
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        check_field(field);
        const native::Field& from = m_description.fields[field];
        out.n_components = from.n_components;
        out.name = from.name.c_str();
        out.unit = text_or_null(from.unit);
        out.continuity = static_cast<elvis_continuity>(from.continuity);
        out.transform = static_cast<elvis_transform>(from.transform);
        out.max_jump = from.max_jump;
    }

    void get_class_field(std::uint32_t element_class, std::uint32_t field, elvis_class_field& out) override {
        check_class(element_class);
        check_field(field);
        const std::span<const elvis_constant> constants = m_volume.constants(element_class, field);
        out.n_constants = count(constants.size());
        out.constants = constants.data();
        // With a transform the field is rational in xi.
        const bool polynomial = m_description.fields[field].transform == native::Transform::none;
        for (std::size_t i = 0; i < 3; ++i)
            out.order[i] = polynomial ? static_cast<std::int32_t>(m_volume.field_space(element_class, field).order[i]) : -1;
    }

    double get_time(std::uint32_t time_step) override {
        check_time_step(time_step);
        return m_description.times[time_step];
    }

    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override {
        const std::uint32_t element_class = buffer / n_buffers_per_class;
        check_class(element_class);
        out.kind = ELVIS_BUFFER_REAL;
        out.element_class = element_class;
        out.n_records = m_description.classes[element_class].n_elements;
        if (buffer % n_buffers_per_class == 0) {
            out.name = "geometry";
            out.depends = 0;
            out.record_size = count(m_volume.geometry_record_size(element_class));
        } else {
            check_field(field);
            out.name = "field";
            out.depends = ELVIS_DEPENDS_ON_FIELD | ELVIS_DEPENDS_ON_TIME;
            out.record_size = count(m_volume.field_record_size(element_class, field));
        }
    }

    void get_snippet(std::uint32_t element_class, elvis_snippet& out) override {
        check_class(element_class);
        const bool has_hessians =
            std::all_of(m_description.fields.begin(), m_description.fields.end(),
                        [](const native::Field& field) { return field.transform == native::Transform::none; });
        static const std::vector<elvis_text> all = make_sources(true), without_hessian = make_sources(false);
        const std::vector<elvis_text>& sources = has_hessians ? all : without_hessian;
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_OFFSET |
                           ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_MAPPING_HESSIAN | ELVIS_SNIPPET_ELEMENT_RECORDS |
                           (has_hessians ? ELVIS_SNIPPET_FIELD_HESSIAN : 0u);
        out.prefix = "native";
        out.n_sources = count(sources.size());
        out.sources = sources.data();
    }

    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t n, std::span<double> bounds) override {
        check_elements(first, n);
        m_volume.bounds(first, n, bounds);
        return ELVIS_CERTIFIED;
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        const std::uint32_t element_class = request.buffer / n_buffers_per_class;
        check_class(element_class);
        const std::uint64_t n_elements = m_description.classes[element_class].n_elements;
        require(request.first <= n_elements && request.count <= n_elements - request.first, "records out of range");
        auto* numbers = static_cast<double*>(destination);
        if (request.buffer % n_buffers_per_class == 0) {
            const double* origins = request.origins;
            if (origins != nullptr)
                origins += 3 * (m_volume.first_element(element_class) + request.first);
            m_volume.fill_geometry(element_class, request.first, request.count, origins,
                                   std::span(numbers, request.count * m_volume.geometry_record_size(element_class)));
            return;
        }
        check_field(request.field);
        check_time_step(request.time_step);
        std::span<const double> offset;
        if (request.field_offset != nullptr)
            offset = {request.field_offset, m_description.fields[request.field].n_components};
        m_volume.fill_field(element_class, request.field, request.time_step, request.first, request.count, offset,
                            std::span(numbers, request.count * m_volume.field_record_size(element_class, request.field)));
    }

    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
        check_elements(first, numbers.size());
        m_volume.element_numbers(first, numbers);
    }

    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        require(first <= m_description.n_faces && faces.size() <= m_description.n_faces - first, "faces out of range");
        std::vector<elvis_face> own(faces.size());
        m_volume.faces(first, own);
        for (std::size_t i = 0; i < own.size(); ++i)
            faces.set(i, own[i]);
    }

    elvis_string get_boundary_group(std::uint32_t group) {
        require(group < m_description.boundary_groups.size(), "boundary group out of range");
        return m_description.boundary_groups[group].c_str();
    }

    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t n,
                                     std::span<double> ranges) {
        check_field(field);
        check_time_step(time_step);
        check_elements(first, n);
        return m_volume.field_ranges(field, time_step, first, n, ranges);
    }

    elvis_certainty get_field_extrema(std::uint32_t field, std::uint32_t component, std::uint32_t time_step,
                                      elvis_extremum& minimum, elvis_extremum& maximum) {
        check_field(field);
        check_time_step(time_step);
        const std::uint32_t n_components = m_description.fields[field].n_components;
        require(component < n_components || (component == ELVIS_MAGNITUDE && n_components > 1), "component out of range");
        const std::vector<native::Extrema> extrema = m_volume.extrema(field, time_step);
        if (extrema.empty())
            return ELVIS_ESTIMATED;
        const native::Extrema& found = extrema[component == ELVIS_MAGNITUDE ? n_components : component];
        const auto put = [&](const native::Extremum& from, elvis_extremum& to) {
            to.value = from.value;
            to.bound = from.bound;
            to.element = m_volume.first_element(from.element_class) + from.element;
            std::copy(from.xi.begin(), from.xi.end(), to.xi);
        };
        put(found.minimum, minimum);
        put(found.maximum, maximum);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                std::uint64_t n, std::span<double> bounds) {
        check_field(field);
        check_time_step(time_step);
        check_elements(first, n);
        m_volume.derivative_bounds(field, time_step, native::SecondDerivatives::plain, first, n, bounds);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_apex_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t n,
                                          std::span<double> bounds) {
        check_field(field);
        check_time_step(time_step);
        check_elements(first, n);
        m_volume.derivative_bounds(field, time_step, native::SecondDerivatives::apex_weighted, first, n, bounds);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty check_jacobians(std::uint64_t first, double tolerance, api::StructArray<elvis_jacobian_check> checks) {
        check_elements(first, checks.size());
        if (m_description.dimension != 3)
            throw api::Error(ELVIS_ERROR_UNSUPPORTED, m_volume.path(), "the Jacobian of a surface has no sign");
        require(tolerance >= 0, "the tolerance is negative or NaN");
        std::vector<native::JacobianCheck> own(checks.size());
        m_volume.check_jacobians(first, tolerance, own);
        for (std::size_t i = 0; i < own.size(); ++i) {
            const native::JacobianCheck& from = own[i];
            checks.set(i, {sizeof(elvis_jacobian_check),
                           static_cast<elvis_jacobian_sign>(from.sign),
                           {from.xi[0], from.xi[1], from.xi[2]},
                           from.determinant,
                           from.lower});
        }
        return ELVIS_CERTIFIED;
    }

    std::pair<elvis_string, elvis_string> get_note(std::uint32_t note) {
        require(note < m_description.notes.size(), "note out of range");
        return {m_description.notes[note].first.c_str(), m_description.notes[note].second.c_str()};
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
        check_elements(element, 1);
        m_volume.evaluate_mapping(element, xi, optional(positions, xi.size()), optional(jacobians, 3 * xi.size()));
    }

    void evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element, std::span<const double> xi,
                        double* values, double* gradients) {
        check_field(field);
        check_time_step(time_step);
        check_elements(element, 1);
        const std::size_t n_values = m_description.fields[field].n_components * xi.size() / 3;
        m_volume.evaluate_field(field, time_step, element, xi, optional(values, n_values), optional(gradients, 3 * n_values));
    }

private:
    void check_class(std::uint32_t element_class) const {
        require(element_class < m_description.classes.size(), "element class or buffer out of range");
    }
    void check_field(std::uint32_t field) const { require(field < m_description.fields.size(), "field out of range"); }
    void check_time_step(std::uint32_t step) const { require(step < m_description.times.size(), "time step out of range"); }
    void check_elements(std::uint64_t first, std::uint64_t n) const {
        require(first <= m_volume.n_elements() && n <= m_volume.n_elements() - first, "elements out of range");
    }

    Volume m_volume;
    const native::Description& m_description;
};

} // namespace
} // namespace elvis::native_plugin

namespace elvis::native {

using native_plugin::NativeVolume;

const elvis_runtime* runtime_table() { return api::runtime_table<NativeVolume>(); }
const elvis_extrema* extrema_table() { return api::extrema_table<NativeVolume>(); }
const elvis_apex_bounds* apex_bounds_table() { return api::apex_bounds_table<NativeVolume>(); }

elvis_volume* serve(const elvis_host* host, const std::string& name, std::shared_ptr<const VolumeSource> source) {
    return reinterpret_cast<elvis_volume*>(new NativeVolume(api::Host(host), name, std::move(source)));
}

void forget_fields(elvis_volume* volume) { api::detail::self<NativeVolume>(volume).forget_fields(); }

} // namespace elvis::native
