/**
 * @file plugin.cpp
 * Conversion plugin for meshes and solutions of PyFR.
 */
#include "input.hpp"
#include "linear_elements.hpp"
#include "series.hpp"

#include <elvis/plugin.hpp>
#include <plugins/nodal/element_blocks.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

namespace {

using namespace elvis_pyfr;
using elvis::nodal::ElementNumbers;
using elvis::nodal::ElementsKey;

class Source : public elvis::api::ConverterSource {
public:
    static std::uint32_t probe(const char* path) { return elvis_pyfr::probe(path); }

    Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
        : Source(host, read(paths, options)) {}

    void get_info(elvis_source_info& info) override {
        info.dimension = m_mesh->dimension();
        info.n_elements = m_mesh->n_elements();
        info.n_corner_ids = m_mesh->n_corner_ids();
        info.n_fields = static_cast<std::uint32_t>(n_fields());
        info.n_time_steps = static_cast<std::uint32_t>(std::max<std::size_t>(1, m_series.n_steps()));
        info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh->groups().size());
        info.mantissa_bits = m_series.mantissa_bits();
    }

    void get_field(std::uint32_t field, elvis_source_field& out) override {
        out.name = is_bare() ? "curved" : m_series.names()[field].c_str();
        out.n_components = 1;
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
    }

    void get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) override {
        for_each_set(first, out.size(),
                     [&](const ElementSet& set, std::uint64_t from, std::uint64_t count, std::uint64_t offset) {
                         const Topology topology = m_mesh->read_topology(set, from, count);
                         for (std::uint64_t index = 0; index < count; ++index) {
                             out.set(offset + index, describe(set, topology, from, index));
                         }
                     });
    }

    void get_spaces(std::uint32_t, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) override {
        for_each_set(first, out.size(), [&](const ElementSet& set, std::uint64_t, std::uint64_t count, std::uint64_t offset) {
            elvis_source_space space{};
            // Where there are no values, a constant does.
            std::ranges::copy(target_order(set.kind->shape, m_series.order(*set.kind).value_or(0)), space.order);
            space.is_contained = 1;
            for (std::uint64_t index = 0; index < count; ++index) {
                out.set(offset + index, space);
            }
        });
    }

    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) override {
        const ElementSet& set = set_of(element);
        const std::size_t n_numbers = 3 * set.nodes->size();
        const ElementNumbers nodes =
            m_blocks.get({ElementsKey::What::geometry, 0, set_index(set), set.count, n_numbers}, element - set.first,
                         [&](std::uint64_t first, std::uint64_t count) { return m_mesh->read_nodes(set, first, count); });
        const auto functions = set.nodes->at(xi);
        Eigen::Map<elvis::nodal::Matrix>(positions.data(), functions->rows(), 3).noalias() =
            *functions * Eigen::Map<const elvis::nodal::Matrix>(nodes.data(), functions->cols(), 3);
    }

    void sample(std::uint32_t step, std::uint64_t element, std::span<const double> xi, double* values) override {
        const ElementSet& set = set_of(element);
        const auto n_points = static_cast<Eigen::Index>(xi.size() / 3), n_values = static_cast<Eigen::Index>(n_fields());
        Eigen::Map<elvis::nodal::Matrix> out(values, n_points, n_values);
        if (is_bare()) {
            out.setConstant(m_linear[element] ? 0 : 1);
            return;
        }
        const std::shared_ptr<const Solution> solution = m_series.step(step);
        const auto space = solution->space(*set.kind);
        if (!space) {
            out.setConstant(std::numeric_limits<double>::quiet_NaN());
            return;
        }
        const ElementNumbers numbers = m_blocks.get(
            {ElementsKey::What::values, step, set_index(set), set.count, space->size() * n_fields()}, element - set.first,
            [&](std::uint64_t first, std::uint64_t count) { return solution->read(set, first, count); });
        out.noalias() = *space->at(xi) *
                        Eigen::Map<const Eigen::MatrixXd>(numbers.data(), static_cast<Eigen::Index>(space->size()), n_values);
    }

    double get_time(std::uint32_t step) { return is_bare() ? 0 : m_series.time(step); }

    std::uint32_t n_parts() const {
        const std::size_t n = partitions().size();
        return n > 1 ? static_cast<std::uint32_t>(n) : 0;
    }

    void get_parts(std::uint64_t first, std::span<std::uint32_t> parts) const {
        const std::vector<std::int64_t> all = partitions();
        for (std::uint64_t index = 0; index < parts.size(); ++index) {
            const ElementSet& set = set_of(first + index);
            std::uint64_t end = set.first;
            const auto is_beyond = [&](const PartSize& part) { return first + index < (end += part.count); };
            const std::int64_t partition = std::ranges::find_if(set.parts, is_beyond)->partition;
            parts[index] = static_cast<std::uint32_t>(std::ranges::lower_bound(all, partition) - all.begin());
        }
    }

    elvis_string get_boundary_group(std::uint32_t group) { return m_mesh->groups()[group].c_str(); }

private:
    /** Numbers of partitions, ascending: gaps have none. */
    std::vector<std::int64_t> partitions() const {
        std::set<std::int64_t> numbers;
        for (const ElementSet& set : m_mesh->sets()) {
            std::ranges::transform(set.parts, std::inserter(numbers, numbers.end()), &PartSize::partition);
        }
        return {numbers.begin(), numbers.end()};
    }

    Source(const elvis::api::Host& host, const Input& input)
        : ConverterSource(host), m_mesh(open_mesh(elvis::hdf5::File(input.mesh))), m_series(input.solutions, *m_mesh),
          m_linear(find_linear_elements(*m_mesh, host)) {}

    static Input read(const std::vector<std::string>& paths, const std::string& options) {
        if (!options.empty() && options != "{}") {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
        }
        return find_input(paths);
    }

    /** A mesh alone says which elements are curved. */
    bool is_bare() const { return m_series.n_steps() == 0; }
    std::size_t n_fields() const { return is_bare() ? 1 : m_series.names().size(); }

    /** Native orders that contain a nodal space: pyramids of order n have degree n in xi1 and xi2, and 2n along xi3. */
    static std::array<std::uint32_t, 3> target_order(elvis::native::Shape shape, std::uint32_t order) {
        const bool is_pyramid = shape == elvis::native::Shape::pyramid, is_flat = elvis::native::dimension(shape) == 2;
        return {order, order, is_flat ? 0 : is_pyramid ? 2 * order : order};
    }

    elvis_source_element describe(const ElementSet& set, const Topology& topology, std::uint64_t first,
                                  std::uint64_t index) const {
        elvis_source_element element{};
        element.shape = static_cast<elvis_shape>(set.kind->shape);
        // Linear pyramids have parallelograms as bases: they are affine.
        const bool is_linear = m_linear[set.first + first + index];
        std::ranges::copy(is_linear ? std::array<std::uint32_t, 3>{1, 1, 1} : target_order(set.kind->shape, set.nodes->order()),
                          element.geometry_order);
        const std::size_t n_corners = set.corners.size();
        for (std::size_t corner = 0; corner < n_corners && !topology.corners.empty(); ++corner) {
            element.corners[corner] = topology.corners[index * n_corners + corner];
        }
        std::fill_n(element.face_groups, 6, ELVIS_GROUP_NONE);
        const auto n_faces = static_cast<std::size_t>(set.kind->n_faces);
        for (std::size_t face = 0; face < n_faces; ++face) {
            element.face_groups[set.kind->faces[face]] = topology.groups[index * n_faces + face];
        }
        return element;
    }

    const ElementSet& set_of(std::uint64_t element) const {
        const auto after = std::ranges::upper_bound(m_mesh->sets(), element, {}, &ElementSet::first);
        return *std::prev(after);
    }
    std::size_t set_index(const ElementSet& set) const { return static_cast<std::size_t>(&set - m_mesh->sets().data()); }

    /** Calls visit(set, first, count, offset) for what of a range of elements lies in each set. */
    template <class Visit> void for_each_set(std::uint64_t first, std::uint64_t count, Visit visit) const {
        for (const ElementSet& set : m_mesh->sets()) {
            const std::uint64_t from = std::max(first, set.first), to = std::min(first + count, set.first + set.count);
            if (from < to) {
                visit(set, from - set.first, to - from, from - first);
            }
        }
    }

    std::unique_ptr<const Mesh> m_mesh;
    Series m_series;
    std::vector<bool> m_linear;
    elvis::nodal::ElementBlocks m_blocks;
};

constexpr elvis_file_format formats[] = {elvis::api::file_format("PyFR solution", ".pyfrs"),
                                         elvis::api::file_format("PyFR mesh", ".pyfrm")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.pyfr", .name = "PyFR reader", .version = "1.1.0", .vendor = "ElVis",
             .description = "Converts meshes and solutions of PyFR (.pyfrm, .pyfrs).",
             .converter = elvis::api::converter_table<Source>(), .formats = &formats_table,
             .parts = elvis::api::parts_table<Source>());
