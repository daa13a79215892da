#include <core/hierarchy/hierarchy.hpp>
#include <core/render/real_array.hpp>
#include <core/render/surface_solver.hpp>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <sstream>

namespace elvis {

namespace {

/** What a solver needs besides its library file. */
struct SolverKind {
    std::string file;
    std::vector<std::pair<std::string, std::string>> defines;
    /** Pixels of a column that one invocation looks for: few where each may take many turns of loops. */
    std::uint32_t hit_rows = surface_tile_height;
};

SolverKind kind_of(const std::string& solver) {
    if (solver == "round") {
        return {"quadric", {{"CORE_HAS_ENDS", "1"}}};
    }
    if (solver == "mesh") {
        return {solver, {}, 4};
    }
    return {solver, {{"CORE_HAS_ENDS", "0"}}};
}

} // namespace

std::uint32_t surface_tile_width(const Device& device) { return std::clamp(device.subgroup_size(), 8u, 64u); }

std::string solver_key(const CutShape& shape) {
    std::ostringstream key;
    key << shape_solver(shape);
    if (const auto* surface = std::get_if<MeshSurface>(&shape)) {
        key << ' ' << static_cast<const void*>(surface->mesh.get());
    }
    return key.str();
}

SurfaceSolver::SurfaceSolver(const Device& device, Precision precision, const CutShape& shape)
    : m_device(device), m_precision(precision) {
    const ShapeFrame frame = shape_frame(shape, {});
    m_n_rows = 2 + static_cast<std::uint32_t>(frame.rows.size());
    m_rows.emplace(device, m_n_rows * 4 * real_bytes(precision), Buffer::Use::uniform);
    const SolverKind kind = kind_of(frame.solver);
    m_hit_rows = kind.hit_rows;
    KernelRequest request;
    request.name = "surface_hits of " + frame.solver;
    request.kernel = request.name;
    request.kernel_text = "#include \"library/surface_" + kind.file + ".glsl\"\n#include \"kernels/surface_hits.comp\"\n";
    request.precision = precision;
    request.defines = kind.defines;
    request.defines.insert(request.defines.end(), {{"CORE_TILE_WIDTH", std::to_string(surface_tile_width(device)) + "u"},
                                                   {"CORE_TILE_HEIGHT", std::to_string(surface_tile_height) + "u"},
                                                   {"CORE_HIT_ROWS", std::to_string(m_hit_rows) + "u"},
                                                   {"CORE_SHAPE_ROWS", std::to_string(m_n_rows)}});
    if (const auto* surface = std::get_if<MeshSurface>(&shape)) {
        m_mesh = surface->mesh;
        upload(*m_mesh, shape_middle(shape));
        request.buffers = {{"core_triangles", m_triangles.get()}, {"core_nodes", m_nodes.get()}};
    }
    request.bindings = {{0, BindingType::uniform_buffer}, {1, BindingType::uniform_buffer}};
    for (std::uint32_t binding = 2; binding <= 8; ++binding) {
        request.bindings.push_back({binding, BindingType::storage_buffer});
    }
    request.push_constant_bytes = sizeof(HitsParameters);
    m_kernel = std::make_unique<ComposedKernel>(device, request);
}

/** Corners, and a hierarchy over the triangles. */
void SurfaceSolver::upload(const TriangleMesh& mesh, const Vector3& middle) {
    std::vector<double> corners, boxes;
    corners.reserve(9 * mesh.triangles.size());
    boxes.reserve(6 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        Vector3 lower = mesh.points[triangle[0]], upper = lower;
        for (const std::uint32_t corner : triangle) {
            for (std::size_t i = 0; i < 3; ++i) {
                const double coordinate = mesh.points[corner][i];
                lower[i] = std::min(lower[i], coordinate);
                upper[i] = std::max(upper[i], coordinate);
                corners.push_back(coordinate - middle[i]);
            }
        }
        // What single precision makes of the corners may lie outside by their rounding.
        for (std::size_t i = 0; i < 3; ++i) {
            const double rounding = 1.2e-7 * std::max(std::abs(lower[i] - middle[i]), std::abs(upper[i] - middle[i]));
            lower[i] -= rounding;
            upper[i] += rounding;
        }
        boxes.insert(boxes.end(), lower.begin(), lower.end());
        boxes.insert(boxes.end(), upper.begin(), upper.end());
    }
    const Hierarchy hierarchy(boxes, middle);
    const std::span<const HierarchyNode> nodes = hierarchy.nodes();
    std::vector<std::uint32_t> words(8 * nodes.size());
    std::memcpy(words.data(), nodes.data(), nodes.size_bytes());
    m_nodes = std::make_unique<RecordBuffer>(m_device, RecordKind::uint, m_precision, nodes.size(), 8);
    m_nodes->write_uints(0, words);
    m_triangles = std::make_unique<RecordBuffer>(m_device, RecordKind::real, m_precision, mesh.triangles.size(), 9);
    m_triangles->write_reals(0, corners);
}

void SurfaceSolver::begin(const CutShape& shape, const CutPlaneGeometry& view, const std::array<double, 6>& bounds,
                          double most_error) const {
    const std::array<double, 4>& at = view.rows[6];
    const Vector3 reference = {at[0], at[1], at[2]};
    const ShapeFrame frame = shape_frame(shape, reference);
    std::vector<std::array<double, 4>> rows = {
        {bounds[0] - reference[0], bounds[1] - reference[1], bounds[2] - reference[2], most_error},
        {bounds[3] - reference[0], bounds[4] - reference[1], bounds[5] - reference[2], 0}};
    rows.insert(rows.end(), frame.rows.begin(), frame.rows.end());
    assert(rows.size() == m_n_rows);
    write_reals(*m_rows, m_precision, std::span<const double>(rows.front().data(), 4 * rows.size()));
}

void SurfaceSolver::find(const Buffer& frame, std::span<const Buffer* const> buffers, std::span<const std::byte> parameters,
                         std::uint32_t tiles_a_row, std::uint32_t tile_rows) const {
    std::vector<const Buffer*> bindings = {&frame, &*m_rows};
    bindings.insert(bindings.end(), buffers.begin(), buffers.end());
    m_kernel->dispatch(bindings, parameters, tiles_a_row, tile_rows * n_parts());
}

} // namespace elvis
