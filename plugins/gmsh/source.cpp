#include "source.hpp"

#include "msh_file.hpp"

#include <algorithm>
#include <limits>

namespace gmsh {

namespace {

/** Numbers of points, one point a row. */
using Rows = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;
using ConstRows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

} // namespace

std::uint32_t Source::probe(const char* path) { return probe_msh(path); }

Source::Source(const elvis::api::Host& host, const std::vector<std::string>& paths, const std::string& options)
    : ConverterSource(host) {
    if (!options.empty() && options != "{}") {
        throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(), "this format has no options");
    }
    FileMesh mesh;
    std::vector<DataSection> sections;
    std::map<std::string, Scheme> schemes;
    std::string mesh_path = paths.front();
    for (const std::string& path : paths) {
        MshFile file = read_msh(path, host);
        if (mesh.is_empty()) {
            mesh = std::move(file.mesh);
            mesh_path = path;
        } else if (!file.mesh.is_empty() && file.mesh != mesh) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path, "holds another mesh than " + mesh_path);
        }
        std::ranges::move(file.data, std::back_inserter(sections));
        schemes.merge(file.schemes);
    }
    if (mesh.node_tags.empty() || mesh.element_tags.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, mesh_path, "there is no mesh ($Nodes and $Elements)");
    }
    m_mesh = std::make_unique<Mesh>(std::move(mesh), mesh_path, host);
    m_bases = std::make_unique<BasisSet>(*m_mesh);
    m_views = collect_views(*m_mesh, *m_bases, sections, schemes, host);
    m_steps = time_steps(m_views);
    for (const View& view : m_views) {
        m_n_values += view.n_components;
    }
}

void Source::get_info(elvis_source_info& info) {
    info.dimension = static_cast<std::uint32_t>(m_mesh->dimension());
    info.n_elements = m_mesh->n_elements();
    info.n_corner_ids = m_mesh->n_nodes();
    info.n_fields = static_cast<std::uint32_t>(m_views.size());
    info.n_time_steps = static_cast<std::uint32_t>(m_steps.size());
    info.n_boundary_groups = static_cast<std::uint32_t>(m_mesh->groups().size());
    // Text has 16 significant digits.
    info.mantissa_bits = 53;
}

void Source::get_field(std::uint32_t field, elvis_source_field& out) {
    const View& view = m_views.at(field);
    out.n_components = view.n_components;
    out.name = view.name.c_str();
    if (view.kind != DataKind::node) {
        out.continuity = ELVIS_CONTINUITY_DISCONTINUOUS;
    } else {
        // A basis of the file may be anything.
        out.continuity = view.scheme.empty() ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_UNKNOWN;
    }
}

void Source::get_elements(std::uint64_t first, elvis::api::StructArray<elvis_source_element> out) {
    for (std::uint64_t index = 0; index < out.size(); ++index) {
        const std::size_t number = first + index;
        const ElementType& type = m_mesh->type(number);
        elvis_source_element element{};
        element.shape = static_cast<elvis_shape>(shape(type.topology));
        std::ranges::copy(m_bases->lagrange(type).native_order(), element.geometry_order);
        std::size_t corner = 0;
        for (const int source_corner : source_corners(type.topology)) {
            element.corners[corner++] = m_mesh->nodes(number)[static_cast<std::size_t>(source_corner)];
        }
        std::ranges::copy(m_mesh->face_groups(number), element.face_groups);
        out.set(index, element);
    }
}

void Source::get_spaces(std::uint32_t field, std::uint64_t first, elvis::api::StructArray<elvis_source_space> out) {
    const View& view = m_views.at(field);
    for (std::uint64_t index = 0; index < out.size(); ++index) {
        elvis_source_space space{};
        // Every basis of an element is contained in the native space of its orders, pyramids in that of kind `tensor`.
        space.is_contained = 1;
        for (const auto& [step, data] : view.steps) {
            if (const Basis* const basis =
                    view.read(*m_mesh, *m_bases, data, static_cast<std::uint32_t>(first + index), nullptr)) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    space.order[axis] = std::max(space.order[axis], basis->native_order()[axis]);
                }
            }
        }
        out.set(index, space);
    }
}

void Source::evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) {
    const std::span<const std::uint32_t> nodes = m_mesh->nodes(element);
    Eigen::Matrix<double, Eigen::Dynamic, 3> at_nodes(static_cast<Eigen::Index>(nodes.size()), 3);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        at_nodes.row(static_cast<Eigen::Index>(node)) = Eigen::Map<const Eigen::RowVector3d>(m_mesh->position(nodes[node]));
    }
    const Eigen::MatrixXd& weights = m_bases->lagrange(m_mesh->type(element)).weights(xi);
    Rows(positions.data(), weights.rows(), 3, Eigen::OuterStride<>(3)).noalias() = weights * at_nodes;
}

void Source::sample(std::uint32_t time_step, std::uint64_t element, std::span<const double> xi, double* values) {
    thread_local std::vector<double> nodal;
    const auto n_points = static_cast<Eigen::Index>(xi.size() / 3);
    for (const View& view : m_views) {
        const auto n_components = static_cast<Eigen::Index>(view.n_components);
        Rows result(values, n_points, n_components, Eigen::OuterStride<>(m_n_values));
        values += n_components;
        const StepData* const data = data_at(view, m_steps.at(time_step));
        const Basis* const basis =
            data ? view.read(*m_mesh, *m_bases, *data, static_cast<std::uint32_t>(element), &nodal) : nullptr;
        if (!basis) {
            result.setConstant(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        const ConstRows at_nodes(nodal.data(), static_cast<Eigen::Index>(basis->size()), n_components);
        result.noalias() = basis->weights(xi) * at_nodes;
    }
}

double Source::get_time(std::uint32_t time_step) { return m_steps.at(time_step).time; }

elvis_string Source::get_boundary_group(std::uint32_t group) { return m_mesh->groups().at(group).c_str(); }

} // namespace gmsh
