/*
 * A discontinuous Galerkin code's curved tetrahedra with modes of their own order, drawn in the code's own basis.
 */
#include "basis.hpp"
#include "bernstein.hpp"
#include "dubiner_snippet.hpp"
#include "faces.hpp"
#include "file.hpp"
#include "snippet.hpp"

#include <elvis/demand.h>
#include <elvis/plugin.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>

namespace elvis::dubiner {
namespace {

/** Buffers of each class. */
enum : std::uint32_t { geometry_buffer, modes_buffer, n_buffers_a_class };

/** Elements with one order of fields and one of geometry. */
struct Class {
    std::size_t order = 0, geometry_order = 1;
    std::uint64_t first = 0, n_elements = 0;
    /** In rows of four, for each component. */
    std::size_t n_rows = 0;
    std::string modes_text;
    std::array<elvis_constant, 1> constants{};
    std::array<elvis_text, 2> sources{};
};

class Volume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return has_our_header(path) ? 100 : 0; }

    /** There are no options. */
    Volume(const api::Host& host, const std::string& path, const std::string&)
        : RuntimeVolume(host), m_file(read_file(path)), m_faces(find_faces(m_file, path)) {
        order_elements();
        for (const Element& element : m_file.elements) {
            for (const std::size_t order : {element.order, element.geometry_order}) {
                std::unique_ptr<Tables>& tables = m_tables[order];
                if (!tables) {
                    tables = std::make_unique<Tables>(order);
                }
            }
        }
        for (const std::size_t number : m_number_of) {
            m_geometry.push_back(geometry_modes(m_file.elements[number]));
        }
    }

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.elements.size();
        info.n_faces = m_faces.size();
        info.n_classes = static_cast<std::uint32_t>(m_classes.size());
        info.n_boundary_groups = static_cast<std::uint32_t>(m_file.groups.size());
        info.n_fields = static_cast<std::uint32_t>(m_file.fields.size());
        info.n_time_steps = static_cast<std::uint32_t>(m_file.times.size());
        info.n_buffers = n_buffers_a_class * info.n_classes;
    }

    void get_class(std::uint32_t element_class, elvis_element_class& out) override {
        const Class& of = m_classes.at(element_class);
        out.shape = ELVIS_SHAPE_TETRAHEDRON;
        out.n_elements = of.n_elements;
        std::fill_n(out.geometry_order, 3, static_cast<std::uint32_t>(of.geometry_order));
        out.is_affine = of.geometry_order == 1;
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        const Field& from = m_file.fields.at(field);
        out.n_components = from.n_components;
        out.name = from.name.c_str();
        out.unit = from.unit.empty() ? nullptr : from.unit.c_str();
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t element_class, std::uint32_t, elvis_class_field& out) override {
        out.n_constants = 1;
        out.constants = m_classes.at(element_class).constants.data();
        std::fill_n(out.order, 3, static_cast<std::int32_t>(m_classes[element_class].order));
    }

    double get_time(std::uint32_t time_step) override { return m_file.times.at(time_step); }

    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override {
        const Class& of = m_classes.at(buffer / n_buffers_a_class);
        out.kind = ELVIS_BUFFER_REAL;
        out.element_class = buffer / n_buffers_a_class;
        out.n_records = of.n_elements;
        if (buffer % n_buffers_a_class == geometry_buffer) {
            out.name = "geometry";
            out.record_size = static_cast<std::uint32_t>(4 * n_modes(of.geometry_order));
        } else {
            out.name = "modes";
            out.depends = ELVIS_DEPENDS_ON_FIELD | ELVIS_DEPENDS_ON_TIME;
            out.record_size = static_cast<std::uint32_t>(m_file.fields.at(field).n_components * 4 * of.n_rows);
        }
    }

    void get_snippet(std::uint32_t element_class, elvis_snippet& out) override {
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_OFFSET |
                           ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_FIELD_HESSIAN | ELVIS_SNIPPET_MAPPING_HESSIAN |
                           ELVIS_SNIPPET_ELEMENT_RECORDS;
        out.prefix = "dubiner";
        out.n_sources = static_cast<std::uint32_t>(m_classes.at(element_class).sources.size());
        out.sources = m_classes[element_class].sources.data();
    }

    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            const BernsteinBounds& bernstein = tables(element(first + i).geometry_order).bounds;
            for (std::size_t d = 0; d < 3; ++d) {
                const Range range = bernstein.range(m_geometry[first + i][d]);
                bounds[6 * i + d] = range.lower;
                bounds[6 * i + 3 + d] = range.upper;
            }
        }
        return ELVIS_CERTIFIED;
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        const Class& of = m_classes.at(request.buffer / n_buffers_a_class);
        auto* numbers = static_cast<double*>(destination);
        for (std::uint64_t i = of.first + request.first; i < of.first + request.first + request.count; ++i) {
            numbers = request.buffer % n_buffers_a_class == geometry_buffer ? write_geometry(i, request, numbers)
                                                                            : write_modes(i, request, numbers);
        }
    }

    /** People count elements as the file does. */
    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
        std::copy_n(m_number_of.begin() + static_cast<std::ptrdiff_t>(first), numbers.size(), numbers.begin());
    }

    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        for (std::uint64_t i = 0; i < faces.size(); ++i) {
            elvis_face face = m_faces.at(first + i);
            face.element = static_cast<std::int64_t>(m_position_of[static_cast<std::size_t>(face.element)]);
            if (face.neighbour >= 0) {
                face.neighbour = static_cast<std::int64_t>(m_position_of[static_cast<std::size_t>(face.neighbour)]);
            }
            faces.set(i, face);
        }
    }

    elvis_string get_boundary_group(std::uint32_t group) { return m_file.groups.at(group).c_str(); }

    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges) {
        const std::size_t n_components = m_file.fields.at(field).n_components;
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t component = 0; component < n_components; ++component) {
                const Range range =
                    tables(element(first + i).order).bounds.range(field_modes(field, time_step, first + i, component));
                ranges[2 * (i * n_components + component)] = range.lower;
                ranges[2 * (i * n_components + component) + 1] = range.upper;
            }
        }
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t time_step, std::uint64_t first,
                                                std::uint64_t count, std::span<double> bounds) {
        const std::size_t n_components = m_file.fields.at(field).n_components;
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t component = 0; component < n_components; ++component) {
                const Steepness steepness =
                    tables(element(first + i).order).bounds.steepness(field_modes(field, time_step, first + i, component));
                bounds[2 * (i * n_components + component)] = steepness.first;
                bounds[2 * (i * n_components + component) + 1] = steepness.second;
            }
        }
        return ELVIS_CERTIFIED;
    }

    void evaluate_mapping(std::uint64_t element_position, std::span<const double> xi, double* positions, double* jacobians) {
        for (std::size_t d = 0; d < 3; ++d) {
            evaluate(element(element_position).geometry_order, m_geometry.at(element_position)[d], xi, positions, jacobians, d,
                     3);
        }
    }

    void evaluate_field(std::uint32_t field, std::uint32_t time_step, std::uint64_t element_position,
                        std::span<const double> xi, double* values, double* gradients) {
        const std::size_t n_components = m_file.fields.at(field).n_components;
        for (std::size_t component = 0; component < n_components; ++component) {
            evaluate(element(element_position).order, field_modes(field, time_step, element_position, component), xi, values,
                     gradients, component, n_components);
        }
    }

private:
    /** What all elements of an order share. */
    struct Tables {
        explicit Tables(std::size_t order)
            : bounds(order), to_modes(modes_at_lattice(order).inverse()), factors(n_modes(order)) {
            normalisation(order, factors);
        }

        BernsteinBounds bounds;
        /** From values at the lattice to modes that are not normalised. */
        Eigen::MatrixXd to_modes;
        std::vector<double> factors;
    };

    using Coordinates = std::array<std::vector<double>, 3>;

    /** Positions are counted class by class, numbers as in the file. */
    void order_elements() {
        m_number_of.resize(m_file.elements.size());
        std::iota(m_number_of.begin(), m_number_of.end(), std::size_t{0});
        const auto orders = [&](std::size_t number) {
            return std::pair(m_file.elements[number].order, m_file.elements[number].geometry_order);
        };
        std::stable_sort(m_number_of.begin(), m_number_of.end(),
                         [&](std::size_t a, std::size_t b) { return orders(a) < orders(b); });
        m_position_of.resize(m_number_of.size());
        for (std::size_t position = 0; position < m_number_of.size(); ++position) {
            m_position_of[m_number_of[position]] = position;
            const auto [order, geometry_order] = orders(m_number_of[position]);
            if (m_classes.empty() || m_classes.back().order != order || m_classes.back().geometry_order != geometry_order) {
                m_classes.push_back({order, geometry_order, position, 0, (n_modes(order) + 3) / 4,
                                     dubiner::write_modes(order, geometry_order)});
            }
            ++m_classes.back().n_elements;
        }
        // Now that no class moves any more.
        for (Class& of : m_classes) {
            of.constants[0] = api::constant("DUBINER_N_ROWS", static_cast<std::int64_t>(of.n_rows));
            of.sources = {api::text(snippet::files[0].name, snippet::files[0].text),
                          api::text("dubiner_modes.glsl", of.modes_text.c_str())};
        }
    }

    const Element& element(std::uint64_t position) const { return m_file.elements[m_number_of.at(position)]; }
    const Tables& tables(std::size_t order) const { return *m_tables.at(order); }

    Coordinates geometry_modes(const Element& element) const {
        const auto n = static_cast<Eigen::Index>(element.nodes.size());
        Coordinates modes;
        for (std::size_t d = 0; d < 3; ++d) {
            Eigen::VectorXd at_nodes(n);
            for (Eigen::Index i = 0; i < n; ++i) {
                at_nodes[i] = element.nodes[static_cast<std::size_t>(i)][d];
            }
            const Eigen::VectorXd of_modes = tables(element.geometry_order).to_modes * at_nodes;
            modes[d].assign(of_modes.begin(), of_modes.end());
        }
        return modes;
    }

    /** Coefficients of modes that are not normalised. */
    std::vector<double> field_modes(std::uint32_t field, std::uint32_t time_step, std::uint64_t position,
                                    std::size_t component) const {
        const std::vector<double>& factors = tables(element(position).order).factors;
        const std::vector<double>& all = m_file.coefficients.at(time_step).at(field)[m_number_of.at(position)];
        std::vector<double> modes(factors.size());
        for (std::size_t mode = 0; mode < modes.size(); ++mode) {
            modes[mode] = factors[mode] * all[component * modes.size() + mode];
        }
        return modes;
    }

    double* write_geometry(std::uint64_t position, const elvis_fill_request& request, double* numbers) const {
        for (std::size_t mode = 0; mode < m_geometry[position][0].size(); ++mode) {
            for (std::size_t d = 0; d < 3; ++d) {
                const double origin = mode == 0 && request.origins ? request.origins[3 * position + d] : 0;
                *numbers++ = m_geometry[position][d][mode] - origin;
            }
            *numbers++ = 0;
        }
        return numbers;
    }

    double* write_modes(std::uint64_t position, const elvis_fill_request& request, double* numbers) const {
        for (std::size_t component = 0; component < m_file.fields.at(request.field).n_components; ++component) {
            const std::vector<double> modes = field_modes(request.field, request.time_step, position, component);
            // Mode 0 is 1.
            *numbers++ = modes[0] - (request.field_offset ? request.field_offset[component] : 0);
            numbers = std::copy(modes.begin() + 1, modes.end(), numbers);
            numbers = std::fill_n(numbers, (4 - modes.size() % 4) % 4, 0.0);
        }
        return numbers;
    }

    /** Quantity `of` of `n`: values and gradients at each point, either may be null. */
    static void evaluate(std::size_t order, std::span<const double> coefficients, std::span<const double> xi, double* values,
                         double* gradients, std::size_t of, std::size_t n) {
        std::vector<Mode> modes(coefficients.size());
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            evaluate_modes(order, {xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]}, modes);
            Mode sum;
            for (std::size_t mode = 0; mode < modes.size(); ++mode) {
                sum.value += coefficients[mode] * modes[mode].value;
                for (std::size_t d = 0; d < 3; ++d) {
                    sum.gradient[d] += coefficients[mode] * modes[mode].gradient[d];
                }
            }
            if (values) {
                values[n * point + of] = sum.value;
            }
            if (gradients) {
                std::copy(sum.gradient.begin(), sum.gradient.end(), gradients + 3 * (n * point + of));
            }
        }
    }

    File m_file;
    /** Of elements by their numbers. */
    std::vector<elvis_face> m_faces;
    std::vector<std::size_t> m_number_of, m_position_of;
    std::vector<Class> m_classes;
    std::map<std::size_t, std::unique_ptr<Tables>> m_tables;
    /** By position: modes of x, y and z. */
    std::vector<Coordinates> m_geometry;
};

} // namespace
} // namespace elvis::dubiner

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Dubiner DG", ".ddg")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.dubiner-dg", .name = "Dubiner DG", .version = "1.0.0", .vendor = "ElVis",
             .description = "Draws modal discontinuous Galerkin solutions on curved tetrahedra in Dubiner's basis",
             .runtime = elvis::api::runtime_table<elvis::dubiner::Volume>(), .formats = &formats_table);
