/*
 * Nektar++ meshes and fields for rendering, without conversion: checks arguments and hands on to Volume.
 */
#include "direct_volume.hpp"

#include "partner_files.hpp"
#include "volume.hpp"

#include <algorithm>
#include <cmath>

namespace nektarpp {

namespace {

namespace api = elvis::api;
namespace native = elvis::native;

void require(bool condition, const char* what) {
    if (!condition) {
        throw api::Error(ELVIS_ERROR_INVALID_ARGUMENT, {}, what);
    }
}

std::uint32_t count(std::size_t n) { return static_cast<std::uint32_t>(n); }

/** Two buffers a class: geometry, then field. */
constexpr std::uint32_t n_buffers_per_class = 2;

class DirectVolume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return is_nektar(path) ? 100 : 0; }

    DirectVolume(const api::Host& table, const std::string& path, const std::string& options)
        : DirectVolume(table, find_files(path, options)) {}

    void get_info(elvis_volume_info& info) override {
        info.dimension = static_cast<std::uint32_t>(m_volume.mesh().dimension());
        info.n_elements = m_volume.numbers().size();
        info.n_faces = m_volume.faces().size();
        info.n_classes = count(m_volume.classes().size());
        info.n_boundary_groups = count(m_volume.mesh().groups().size());
        info.n_fields = count(m_volume.series().fields().size());
        info.n_time_steps = count(n_steps());
        info.n_buffers = info.n_classes * n_buffers_per_class;
        info.n_notes = count(m_notes.size());
    }

    void get_class(std::uint32_t element_class, elvis_element_class& out) override {
        const ElementClass& of = class_of(element_class);
        out.shape = static_cast<elvis_shape>(of.geometry.shape);
        out.n_elements = of.n_elements;
        std::ranges::copy(of.geometry.order, out.geometry_order);
        out.is_affine = of.geometry.shape == Shape::tetrahedron && of.geometry.order[2] == 1 ? 1 : 0;
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        require_field(field);
        out.n_components = 1;
        out.name = m_volume.series().fields()[field].c_str();
        // The file does not say whether the solver was continuous.
        out.continuity = ELVIS_CONTINUITY_UNKNOWN;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t element_class, std::uint32_t field, elvis_class_field& out) override {
        require_field(field);
        const ElementClass& of = class_of(element_class);
        out.n_constants = count(of.constants[field].size());
        out.constants = of.constants[field].data();
        std::ranges::transform(of.fields[field].order, out.order, [](std::uint32_t n) { return static_cast<std::int32_t>(n); });
    }

    double get_time(std::uint32_t step) override {
        require(step < n_steps(), "time step out of range");
        return m_volume.series().n_steps() == 0 ? 0 : m_volume.series().time(step);
    }

    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override {
        const ElementClass& of = class_of(buffer / n_buffers_per_class);
        out.kind = ELVIS_BUFFER_REAL;
        out.element_class = buffer / n_buffers_per_class;
        out.n_records = of.n_elements;
        if (is_geometry(buffer)) {
            out.name = "geometry";
            out.record_size = count(Record(of.geometry, 3).size());
        } else {
            require_field(field);
            out.name = "field";
            out.depends = ELVIS_DEPENDS_ON_FIELD | ELVIS_DEPENDS_ON_TIME;
            out.record_size = count(Record(of.fields[field], 1).size());
        }
    }

    void get_snippet(std::uint32_t element_class, elvis_snippet& out) override {
        const ElementClass& of = class_of(element_class);
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_OFFSET |
                           ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN;
        out.prefix = "nektar";
        out.n_sources = count(of.sources.size());
        out.sources = of.sources.data();
    }

    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t n, std::span<double> bounds) override {
        require_elements(first, n);
        m_volume.bounds(first, n, bounds);
        return ELVIS_CERTIFIED;
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        const ElementClass& of = class_of(request.buffer / n_buffers_per_class);
        require(request.first <= of.n_elements && request.count <= of.n_elements - request.first, "records out of range");
        auto* numbers = static_cast<double*>(destination);
        if (is_geometry(request.buffer)) {
            m_volume.fill_geometry(of.first + request.first, request.count, request.origins, numbers);
            return;
        }
        require_field(request.field, request.time_step);
        m_volume.fill_field(request.field, request.time_step, of.first + request.first, request.count,
                            request.field_offset ? *request.field_offset : 0, numbers);
    }

    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
        require_elements(first, numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            numbers[i] = static_cast<std::int64_t>(m_volume.numbers()[first + i]);
        }
    }

    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        const std::vector<elvis_face>& all = m_volume.faces();
        require(first <= all.size() && faces.size() <= all.size() - first, "faces out of range");
        for (std::size_t i = 0; i < faces.size(); ++i) {
            faces.set(i, all[first + i]);
        }
    }

    elvis_string get_boundary_group(std::uint32_t group) {
        require(group < m_volume.mesh().groups().size(), "boundary group out of range");
        return m_volume.mesh().groups()[group].c_str();
    }

    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t step, std::uint64_t first, std::uint64_t n,
                                     std::span<double> ranges) {
        require_field(field, step);
        require_elements(first, n);
        m_volume.field_ranges(field, step, first, n, ranges);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_extrema(std::uint32_t field, std::uint32_t component, std::uint32_t step, elvis_extremum& minimum,
                                      elvis_extremum& maximum) {
        require_field(field, step);
        require(component == 0, "component out of range");
        const native::Extrema extrema = m_volume.extrema(field, step);
        const auto put = [&](const native::Extremum& from, elvis_extremum& to) {
            to.value = from.value;
            to.bound = from.bound;
            to.element = m_volume.classes()[from.element_class].first + from.element;
            std::copy(from.xi.begin(), from.xi.end(), to.xi);
        };
        put(extrema.minimum, minimum);
        put(extrema.maximum, maximum);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t step, std::uint64_t first, std::uint64_t n,
                                                std::span<double> bounds) {
        require_field(field, step);
        require_elements(first, n);
        m_volume.derivative_bounds(field, step, native::SecondDerivatives::plain, first, n, bounds);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_apex_bounds(std::uint32_t field, std::uint32_t step, std::uint64_t first, std::uint64_t n,
                                          std::span<double> bounds) {
        require_field(field, step);
        require_elements(first, n);
        m_volume.derivative_bounds(field, step, native::SecondDerivatives::apex_weighted, first, n, bounds);
        return ELVIS_CERTIFIED;
    }

    elvis_certainty check_jacobians(std::uint64_t first, double tolerance, api::StructArray<elvis_jacobian_check> checks) {
        require_elements(first, checks.size());
        if (m_volume.mesh().dimension() != 3) {
            throw api::Error(ELVIS_ERROR_UNSUPPORTED, m_volume.mesh().path(), "the Jacobian of a surface has no sign");
        }
        require(tolerance >= 0, "the tolerance is negative or NaN");
        std::vector<native::JacobianCheck> own(checks.size());
        m_volume.check_jacobians(first, tolerance, own);
        for (std::size_t i = 0; i < own.size(); ++i) {
            checks.set(i, {sizeof(elvis_jacobian_check),
                           static_cast<elvis_jacobian_sign>(own[i].sign),
                           {own[i].xi[0], own[i].xi[1], own[i].xi[2]},
                           own[i].determinant,
                           own[i].lower});
        }
        return ELVIS_CERTIFIED;
    }

    std::pair<elvis_string, elvis_string> get_note(std::uint32_t note) {
        require(note < m_notes.size(), "note out of range");
        return {m_notes[note].first, m_notes[note].second.c_str()};
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
        require_elements(element, 1);
        m_volume.evaluate_mapping(element, xi, positions, jacobians);
    }

    void evaluate_field(std::uint32_t field, std::uint32_t step, std::uint64_t element, std::span<const double> xi,
                        double* values, double* gradients) {
        require_field(field, step);
        require_elements(element, 1);
        m_volume.evaluate_field(field, step, element, xi, values, gradients);
    }

private:
    DirectVolume(const api::Host& table, const std::vector<std::string>& files)
        : RuntimeVolume(table), m_volume(host(), read_input(files)) {
        m_notes.emplace_back("mesh", m_volume.mesh().path());
        for (std::size_t step = 0; step < m_volume.series().n_steps(); ++step) {
            m_notes.emplace_back("fields", m_volume.series().paths(step).path);
        }
    }

    static bool is_geometry(std::uint32_t buffer) { return buffer % n_buffers_per_class == 0; }
    std::size_t n_steps() const { return std::max<std::size_t>(1, m_volume.series().n_steps()); }

    const ElementClass& class_of(std::uint32_t element_class) const {
        require(element_class < m_volume.classes().size(), "element class or buffer out of range");
        return m_volume.classes()[element_class];
    }
    void require_field(std::uint32_t field, std::uint32_t step = 0) const {
        require(field < m_volume.series().fields().size(), "field out of range");
        require(step < n_steps(), "time step out of range");
    }
    void require_elements(std::uint64_t first, std::uint64_t n) const {
        require(first <= m_volume.numbers().size() && n <= m_volume.numbers().size() - first, "elements out of range");
    }

    Volume m_volume;
    std::vector<std::pair<const char*, std::string>> m_notes;
};

} // namespace

const elvis_runtime* runtime_interface() { return api::runtime_table<DirectVolume>(); }
const elvis_extrema* extrema_interface() { return api::extrema_table<DirectVolume>(); }
const elvis_apex_bounds* apex_bounds_interface() { return api::apex_bounds_table<DirectVolume>(); }

} // namespace nektarpp
