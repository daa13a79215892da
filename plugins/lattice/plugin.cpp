/*
 * A volume of any size, of which each element is computed when it is asked for: nothing is read, and nothing is kept.
 */
#include "file.hpp"
#include "lattice.hpp"
#include "lattice_snippet.hpp"

#include <elvis/demand.h>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::lattice {
namespace {

enum : std::uint32_t { geometry_buffer, field_buffer, n_buffers };

/** Local faces of a hexahedron: axis, and whether it lies at the upper end (elvis/element.h). */
constexpr std::int32_t local_face[3][2] = {{4, 2}, {1, 3}, {0, 5}};
/** By axis and end. */
constexpr const char* group_names[6] = {"x-", "x+", "y-", "y+", "z-", "z+"};

/** Of each power up to the `n`-th, and of its derivative. */
struct Powers {
    double of[3], slope[3];
    explicit Powers(double t) : of{1, t, t * t}, slope{0, 1, 2 * t} {}
};

class Volume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return has_our_header(path) ? 100 : 0; }

    /** There are no options. */
    Volume(const api::Host& host, const std::string& path, const std::string&)
        : RuntimeVolume(host), m_description(read_file(path)), m_lattice(m_description) {}

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_lattice.n_elements();
        info.n_faces = first_face(3);
        info.n_classes = 1;
        info.n_boundary_groups = 6;
        info.n_fields = static_cast<std::uint32_t>(m_description.fields.size());
        info.n_time_steps = 1;
        info.n_buffers = n_buffers;
    }

    void get_class(std::uint32_t, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = m_lattice.n_elements();
        std::fill_n(out.geometry_order, 3, 1u);
        out.is_affine = m_description.moved == 0 ? 1 : 0;
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        const Wave& from = m_description.fields.at(field);
        out.n_components = 1;
        out.name = from.name.c_str();
        out.unit = from.unit.empty() ? nullptr : from.unit.c_str();
        out.continuity = ELVIS_CONTINUITY_CONTINUOUS;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t, std::uint32_t, elvis_class_field& out) override { std::fill_n(out.order, 3, 2); }

    double get_time(std::uint32_t) override { return 0; }

    void get_buffer(std::uint32_t buffer, std::uint32_t, elvis_buffer& out) override {
        out.kind = ELVIS_BUFFER_REAL;
        out.n_records = m_lattice.n_elements();
        out.name = buffer == geometry_buffer ? "geometry" : "field";
        out.depends = buffer == geometry_buffer ? 0u : ELVIS_DEPENDS_ON_FIELD;
        out.record_size = buffer == geometry_buffer ? 24 : 36;
    }

    /** The records of an element are all that the snippet knows of it. */
    void get_snippet(std::uint32_t, elvis_snippet& out) override {
        static const elvis_text source = api::text(snippet::files[0].name, snippet::files[0].text);
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_OFFSET |
                           ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_ELEMENT_RECORDS;
        out.prefix = "lattice";
        out.n_sources = 1;
        out.sources = &source;
    }

    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            const Box box = m_lattice.bounds(first + i);
            std::copy(box.begin(), box.end(), bounds.begin() + static_cast<std::ptrdiff_t>(6 * i));
        }
        return ELVIS_CERTIFIED;
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        auto* numbers = static_cast<double*>(destination);
        for (std::uint64_t element = request.first; element < request.first + request.count; ++element) {
            if (request.buffer == geometry_buffer) {
                for (std::size_t d = 0; d < 3; ++d) {
                    std::array<double, 8> x = m_lattice.mapping(element)[d];
                    x[0] -= request.origins != nullptr ? request.origins[3 * element + d] : 0;
                    numbers = std::copy(x.begin(), x.end(), numbers);
                }
                continue;
            }
            Quadratic f = m_lattice.field(request.field, element);
            f[0] -= request.field_offset[0];
            for (std::size_t row = 0; row < 9; ++row) {
                numbers = std::copy_n(&f[3 * row], 3, numbers);
                *numbers++ = 0;
            }
        }
    }

    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        for (std::uint64_t i = 0; i < faces.size(); ++i) {
            faces.set(i, face(first + i));
        }
    }

    elvis_string get_boundary_group(std::uint32_t group) { return group_names[group]; }

    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges) {
        for (std::uint64_t i = 0; i < count; ++i) {
            const QuadraticBounds bounds = bounds_of(m_lattice.field(field, first + i));
            ranges[2 * i] = bounds.lower;
            ranges[2 * i + 1] = bounds.upper;
        }
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t, std::uint64_t first, std::uint64_t count,
                                                std::span<double> numbers) {
        for (std::uint64_t i = 0; i < count; ++i) {
            const QuadraticBounds bounds = bounds_of(m_lattice.field(field, first + i));
            numbers[2 * i] = bounds.slope;
            numbers[2 * i + 1] = bounds.bend;
        }
        return ELVIS_CERTIFIED;
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
        const Mapping mapping = m_lattice.mapping(element);
        for (std::size_t at = 0; at < xi.size(); at += 3) {
            const Powers x(xi[at]), y(xi[at + 1]), z(xi[at + 2]);
            for (std::size_t d = 0; d < 3; ++d) {
                double value = 0, gradient[3] = {};
                for (std::size_t i = 0; i < 8; ++i) {
                    add_term(mapping[d][i], x, y, z, {i & 1u, i >> 1u & 1u, i >> 2u}, value, gradient);
                }
                if (positions != nullptr) {
                    positions[at + d] = value;
                }
                if (jacobians != nullptr) {
                    std::copy_n(gradient, 3, jacobians + 3 * (at + d));
                }
            }
        }
    }

    void evaluate_field(std::uint32_t field, std::uint32_t, std::uint64_t element, std::span<const double> xi, double* values,
                        double* gradients) {
        const Quadratic f = m_lattice.field(field, element);
        for (std::size_t at = 0; at < xi.size(); at += 3) {
            const Powers x(xi[at]), y(xi[at + 1]), z(xi[at + 2]);
            double value = 0, gradient[3] = {};
            for (std::size_t i = 0; i < f.size(); ++i) {
                add_term(f[i], x, y, z, {i % 3, i / 3 % 3, i / 9}, value, gradient);
            }
            if (values != nullptr) {
                values[at / 3] = value;
            }
            if (gradients != nullptr) {
                std::copy_n(gradient, 3, gradients + at);
            }
        }
    }

private:
    static void add_term(double coefficient, const Powers& x, const Powers& y, const Powers& z,
                         const std::array<std::size_t, 3>& power, double& value, double* gradient) {
        const auto [a, b, c] = power;
        value += coefficient * x.of[a] * y.of[b] * z.of[c];
        gradient[0] += coefficient * x.slope[a] * y.of[b] * z.of[c];
        gradient[1] += coefficient * x.of[a] * y.slope[b] * z.of[c];
        gradient[2] += coefficient * x.of[a] * y.of[b] * z.slope[c];
    }

    /** Faces across the first axis come first, then those across the second. */
    std::uint64_t first_face(std::size_t axis) const {
        std::uint64_t first = 0;
        for (std::size_t d = 0; d < axis; ++d) {
            first += m_lattice.n_elements() / m_lattice.counts()[d] * (m_lattice.counts()[d] + 1);
        }
        return first;
    }

    elvis_face face(std::uint64_t index) const {
        const std::size_t axis = index < first_face(1) ? 0 : index < first_face(2) ? 1 : 2;
        std::uint64_t rest = index - first_face(axis), at[3] = {};
        std::uint64_t element = 0, step = 1, across = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            const std::uint64_t n = m_lattice.counts()[d] + (d == axis ? 1 : 0);
            at[d] = rest % n;
            rest /= n;
            element += step * at[d];
            across = d == axis ? step : across;
            step *= m_lattice.counts()[d];
        }
        const bool is_first = at[axis] == 0, is_last = at[axis] == m_lattice.counts()[axis];
        const std::int32_t below = local_face[axis][1], above = local_face[axis][0];
        const auto here = static_cast<std::int64_t>(element), before = static_cast<std::int64_t>(element - across);
        const auto group = static_cast<std::int32_t>(2 * axis + (is_last ? 1 : 0));
        if (is_first || is_last) {
            return {sizeof(elvis_face), group, is_first ? here : before, ELVIS_NEIGHBOUR_NONE, is_first ? above : below, -1};
        }
        return {sizeof(elvis_face), ELVIS_GROUP_NONE, before, here, below, above};
    }

    Description m_description;
    Lattice m_lattice;
};

} // namespace
} // namespace elvis::lattice

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Lattice of hexahedra", ".txt")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.lattice", .name = "Lattice of hexahedra", .version = "1.0.0", .vendor = "ElVis",
             .description = "Draws fields on any number of hexahedra that are computed when they are asked for",
             .runtime = elvis::api::runtime_table<elvis::lattice::Volume>(), .formats = &formats_table);
