/*
 * Cells of a Cartesian grid, cut by a level set that is a polynomial in each, with fields of a discontinuous Galerkin code.
 */
#include "cut_snippet.hpp"
#include "file.hpp"

#include <elvis/demand.h>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace elvis::cut_cells {
namespace {

enum : std::uint32_t { whole_class, cut_class, n_classes };
enum : std::uint32_t { whole_place, whole_modes, cut_place, cut_modes, cut_level, n_buffers };

/** Local faces of a hexahedron: axis and side (elvis/element.h). */
struct Side {
    std::size_t axis;
    int step;
};
constexpr Side sides[6] = {{2, -1}, {1, -1}, {0, 1}, {1, 1}, {0, -1}, {2, 1}};
constexpr int opposite[6] = {5, 3, 4, 1, 2, 0};
/** By local face. */
constexpr const char* group_names[6] = {"bottom", "south", "east", "north", "west", "top"};

/** A polynomial as the snippet reads it: rows of four. Returns the place behind it. */
double* write_rows(std::size_t order, const double* modes, double* numbers) {
    for (std::size_t row = 0; row < (order + 1) * (order + 1); ++row, modes += order + 1) {
        numbers = std::copy_n(modes, order + 1, numbers);
        numbers = std::fill_n(numbers, max_order - order, 0.0);
    }
    return numbers;
}

std::uint32_t row_numbers(std::size_t order) { return static_cast<std::uint32_t>(4 * (order + 1) * (order + 1)); }

class Volume : public api::RuntimeVolume {
public:
    static std::uint32_t probe(const char* path) { return has_our_header(path) ? 100 : 0; }

    /** There are no options. */
    Volume(const api::Host& host, const std::string& path, const std::string&) : RuntimeVolume(host), m_file(read_file(path)) {
        add_level_set();
        order_cells();
        find_faces();
        for (std::size_t order = 0; order <= max_order; ++order) {
            m_constants[order] = {api::constant("CUTCELLS_ORDER", static_cast<std::int64_t>(order)),
                                  api::constant("CUTCELLS_LEVEL_ORDER", static_cast<std::int64_t>(m_file.level_order))};
        }
    }

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = m_file.cells.size();
        info.n_faces = m_faces.size();
        info.n_classes = n_classes;
        info.n_boundary_groups = 6;
        info.n_fields = static_cast<std::uint32_t>(m_file.fields.size());
        info.n_time_steps = 1;
        info.n_buffers = n_buffers;
    }

    void get_class(std::uint32_t element_class, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = element_class == whole_class ? m_n_whole : m_file.cells.size() - m_n_whole;
        std::fill_n(out.geometry_order, 3, 1u);
        out.is_affine = 1;
    }

    void get_field(std::uint32_t field, elvis_field& out) override {
        const Field& from = m_file.fields.at(field);
        out.n_components = from.n_components;
        out.name = from.name.c_str();
        out.unit = from.unit.empty() ? nullptr : from.unit.c_str();
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
        out.max_jump = std::nan("");
    }

    void get_class_field(std::uint32_t, std::uint32_t field, elvis_class_field& out) override {
        const std::size_t order = m_file.fields.at(field).order;
        out.n_constants = static_cast<std::uint32_t>(m_constants[order].size());
        out.constants = m_constants[order].data();
        std::fill_n(out.order, 3, static_cast<std::int32_t>(order));
    }

    double get_time(std::uint32_t) override { return 0; }

    void get_buffer(std::uint32_t buffer, std::uint32_t field, elvis_buffer& out) override {
        const bool is_whole = buffer <= whole_modes;
        out.kind = ELVIS_BUFFER_REAL;
        out.element_class = is_whole ? whole_class : cut_class;
        out.n_records = is_whole ? m_n_whole : m_file.cells.size() - m_n_whole;
        if (buffer == whole_place || buffer == cut_place) {
            out.name = "place";
            out.record_size = 8;
        } else if (buffer == cut_level) {
            out.name = "level";
            out.record_size = row_numbers(m_file.level_order) + 4;
        } else {
            out.name = "modes";
            out.depends = ELVIS_DEPENDS_ON_FIELD;
            out.record_size = m_file.fields.at(field).n_components * row_numbers(m_file.fields[field].order);
        }
    }

    void fill_buffer(const elvis_fill_request& request, void* destination) override {
        const std::uint64_t first = request.first + (request.buffer <= whole_modes ? 0 : m_n_whole);
        auto* numbers = static_cast<double*>(destination);
        for (std::uint64_t element = first; element < first + request.count; ++element) {
            if (request.buffer == whole_place || request.buffer == cut_place) {
                numbers = write_place(element, request.origins, numbers);
            } else if (request.buffer == cut_level) {
                numbers = write_level(m_file.cells.at(element).level, numbers);
            } else {
                numbers = write_modes(element, request, numbers);
            }
        }
    }

    /** Cells that are not cut have no elvis_inside, and cost what hexahedra cost. */
    void get_snippet(std::uint32_t element_class, elvis_snippet& out) override {
        static const elvis_text sources[2] = {api::text(snippet::files[1].name, snippet::files[1].text),
                                              api::text(snippet::files[0].name, snippet::files[0].text)};
        out.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_INVERSE_MAPPING |
                           ELVIS_SNIPPET_FIELD_OFFSET | ELVIS_SNIPPET_LOCAL_ORIGIN | ELVIS_SNIPPET_ELEMENT_RECORDS |
                           (element_class == cut_class ? ELVIS_SNIPPET_INSIDE : 0u);
        out.prefix = "cutcells";
        out.n_sources = element_class == cut_class ? 2 : 1;
        out.sources = element_class == cut_class ? sources : sources + 1;
    }

    /** Of the whole cell, of which a part is there. */
    elvis_certainty get_bounds(std::uint64_t first, std::uint64_t count, std::span<double> bounds) override {
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double middle = centre(first + i, axis), reach = half_side(axis);
                // Sums of numbers of this size, rounded in single precision in the snippet.
                const double rounding = 1e-6 * (std::abs(middle) + reach);
                bounds[6 * i + axis] = middle - reach - rounding;
                bounds[6 * i + 3 + axis] = middle + reach + rounding;
            }
        }
        return ELVIS_CERTIFIED;
    }

    /** People count cells as the file does. */
    void get_element_numbers(std::uint64_t first, std::span<std::int64_t> numbers) {
        std::copy_n(m_number_of.begin() + static_cast<std::ptrdiff_t>(first), numbers.size(), numbers.begin());
    }

    void get_faces(std::uint64_t first, api::StructArray<elvis_face> faces) {
        for (std::uint64_t i = 0; i < faces.size(); ++i) {
            faces.set(i, m_faces.at(first + i));
        }
    }

    elvis_string get_boundary_group(std::uint32_t group) { return group_names[group]; }

    elvis_certainty get_field_ranges(std::uint32_t field, std::uint32_t, std::uint64_t first, std::uint64_t count,
                                     std::span<double> ranges) {
        for_each_component(field, first, count, [&](std::size_t index, const PolynomialBounds& bounds) {
            ranges[2 * index] = bounds.lower;
            ranges[2 * index + 1] = bounds.upper;
        });
        return ELVIS_CERTIFIED;
    }

    elvis_certainty get_field_derivative_bounds(std::uint32_t field, std::uint32_t, std::uint64_t first, std::uint64_t count,
                                                std::span<double> numbers) {
        for_each_component(field, first, count, [&](std::size_t index, const PolynomialBounds& bounds) {
            numbers[2 * index] = bounds.slope;
            numbers[2 * index + 1] = bounds.bend;
        });
        return ELVIS_CERTIFIED;
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, double* positions, double* jacobians) {
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (positions) {
                    positions[3 * point + axis] = centre(element, axis) + half_side(axis) * xi[3 * point + axis];
                }
                for (std::size_t j = 0; jacobians && j < 3; ++j) {
                    jacobians[9 * point + 3 * axis + j] = j == axis ? half_side(axis) : 0;
                }
            }
        }
    }

    void evaluate_field(std::uint32_t field, std::uint32_t, std::uint64_t element, std::span<const double> xi, double* values,
                        double* gradients) {
        const Field& of = m_file.fields.at(field);
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            for (std::size_t component = 0; component < of.n_components; ++component) {
                const PolynomialValue f = evaluate(of.order, modes(element, field, component), &xi[3 * point]);
                if (values) {
                    values[point * of.n_components + component] = f.value;
                }
                if (gradients) {
                    std::copy(f.gradient.begin(), f.gradient.end(), gradients + 3 * (point * of.n_components + component));
                }
            }
        }
    }

private:
    /** The level set is a field, too: its isosurface 0 is what cuts. In whole cells it is -1. */
    void add_level_set() {
        m_file.level_order = std::max<std::size_t>(m_file.level_order, 1);
        m_file.fields.push_back({"level_set", 1, m_file.level_order, ""});
        for (Cell& cell : m_file.cells) {
            cell.modes.push_back(cell.level);
            if (!cell.is_cut()) {
                cell.modes.back().assign(n_modes(m_file.level_order), 0.0);
                cell.modes.back().front() = -1;
            }
        }
    }

    /** Elements are counted class by class. */
    void order_cells() {
        m_number_of.resize(m_file.cells.size());
        for (std::size_t number = 0; number < m_number_of.size(); ++number) {
            m_number_of[number] = static_cast<std::int64_t>(number);
        }
        std::stable_partition(m_number_of.begin(), m_number_of.end(),
                              [&](std::int64_t number) { return !m_file.cells[static_cast<std::size_t>(number)].is_cut(); });
        std::vector<Cell> ordered;
        for (const std::int64_t number : m_number_of) {
            Cell& cell = m_file.cells[static_cast<std::size_t>(number)];
            m_n_whole += cell.is_cut() ? 0 : 1;
            ordered.push_back(std::move(cell));
        }
        m_file.cells = std::move(ordered);
    }

    /** Cells with a side in common are neighbours there: on it, both have the same part, if the level set is continuous. */
    void find_faces() {
        std::map<std::array<std::size_t, 3>, std::size_t> at;
        for (std::size_t element = 0; element < m_file.cells.size(); ++element) {
            at[m_file.cells[element].place] = element;
        }
        for (std::size_t element = 0; element < m_file.cells.size(); ++element) {
            for (int local_face = 0; local_face < 6; ++local_face) {
                const Side side = sides[local_face];
                std::array<std::size_t, 3> place = m_file.cells[element].place;
                const bool is_at_end = place[side.axis] == (side.step < 0 ? 0 : m_file.n_cells[side.axis] - 1);
                place[side.axis] += static_cast<std::size_t>(side.step);
                const auto neighbour = is_at_end ? at.end() : at.find(place);
                if (neighbour != at.end() && neighbour->second < element) {
                    continue;
                }
                elvis_face face{};
                face.element = static_cast<std::int64_t>(element);
                face.local_face = local_face;
                face.group = is_at_end ? local_face : ELVIS_GROUP_NONE;
                face.neighbour = ELVIS_NEIGHBOUR_NONE;
                face.neighbour_local_face = -1;
                if (neighbour != at.end()) {
                    face.neighbour = static_cast<std::int64_t>(neighbour->second);
                    face.neighbour_local_face = opposite[local_face];
                }
                m_faces.push_back(face);
            }
        }
    }

    double half_side(std::size_t axis) const {
        return 0.5 * (m_file.upper[axis] - m_file.lower[axis]) / static_cast<double>(m_file.n_cells[axis]);
    }
    double centre(std::uint64_t element, std::size_t axis) const {
        return m_file.lower[axis] + half_side(axis) * static_cast<double>(2 * m_file.cells.at(element).place[axis] + 1);
    }
    std::span<const double> modes(std::uint64_t element, std::uint32_t field, std::size_t component) const {
        const std::size_t count = n_modes(m_file.fields[field].order);
        return std::span(m_file.cells.at(element).modes[field]).subspan(component * count, count);
    }

    /** Calls action with numbers 0, 1, .. and the bounds of each component in each element. */
    template <class Action>
    void for_each_component(std::uint32_t field, std::uint64_t first, std::uint64_t count, const Action& action) const {
        const Field& of = m_file.fields.at(field);
        for (std::size_t index = 0; index < count * of.n_components; ++index) {
            action(index, bounds_of(of.order, modes(first + index / of.n_components, field, index % of.n_components)));
        }
    }

    double* write_place(std::uint64_t element, const double* origins, double* numbers) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            numbers[axis] = centre(element, axis) - (origins ? origins[3 * element + axis] : 0);
            numbers[4 + axis] = half_side(axis);
        }
        numbers[3] = numbers[7] = 0;
        return numbers + 8;
    }

    double* write_level(const std::vector<double>& level, double* numbers) const {
        numbers = write_rows(m_file.level_order, level.data(), numbers);
        const PolynomialBounds bounds = bounds_of(m_file.level_order, level);
        for (const double number : {bounds.slope, bounds.bend, 0.0, 0.0}) {
            *numbers++ = number;
        }
        return numbers;
    }

    double* write_modes(std::uint64_t element, const elvis_fill_request& request, double* numbers) const {
        const Field& of = m_file.fields.at(request.field);
        for (std::size_t component = 0; component < of.n_components; ++component) {
            double* const first = numbers;
            numbers = write_rows(of.order, modes(element, request.field, component).data(), numbers);
            // Mode 0 is 1.
            *first -= request.field_offset ? request.field_offset[component] : 0;
        }
        return numbers;
    }

    File m_file;
    /** First among the cells, which are in the order of elements. */
    std::uint64_t m_n_whole = 0;
    /** The file's numbers by element. */
    std::vector<std::int64_t> m_number_of;
    std::vector<elvis_face> m_faces;
    /** By the order of the field. */
    std::array<std::array<elvis_constant, 2>, max_order + 1> m_constants{};
};

} // namespace
} // namespace elvis::cut_cells

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Cut cells", ".cut")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.cut-cells", .name = "Cut cells", .version = "1.0.0", .vendor = "ElVis",
             .description = "Draws cells of Cartesian grids that a level set cuts, with discontinuous fields, from text",
             .runtime = elvis::api::runtime_table<elvis::cut_cells::Volume>(), .formats = &formats_table);
