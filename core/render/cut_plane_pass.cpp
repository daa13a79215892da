#include <core/render/cut_plane_pass.hpp>
#include <core/render/real_array.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t tile_height = 16;
/** Nodes of a tile and their number: shaders/library/cut_tiles.glsl. */
constexpr std::uint32_t tile_stride = 32;
constexpr std::uint32_t tiles_group_size = 32;
/**
 * Pixels of one dispatch: bounds its time, so that no driver's time limit is met. Software drivers give each thread one share
 * of consecutive groups: in a dispatch of few rows all shares have about the same to do.
 */
constexpr std::uint32_t pixels_a_dispatch = 1u << 17;

struct TilesParameters {
    std::uint32_t tiles_a_row, n_tiles;
};

struct PixelsParameters {
    std::uint32_t width, height;
    std::uint32_t first_tile_row;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t is_discontinuous;
};

std::uint32_t divided_up(std::uint32_t number, std::uint32_t by) { return (number + by - 1) / by; }

} // namespace

CutPlanePass::CutPlanePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_precision(data.precision()),
      // Whole subgroups, as drivers pack lanes along x, and no wider: a narrow tile has a short list of nodes.
      m_tile_width(std::clamp(device.subgroup_size(), 8u, 64u)),
      m_frame(device, cut_plane_rows * 4 * real_bytes(data.precision()), Buffer::Use::uniform),
      m_counts(device, n_pass_counts * sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.precision = m_precision;
        request.buffers = data.host_buffers(index);
        request.defines = {{"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"},
                           {"CORE_TILE_HEIGHT", std::to_string(tile_height) + "u"}};
        request.name = "cut_tiles";
        request.kernel = "kernels/cut_tiles.comp";
        request.bindings = {{0, BindingType::uniform_buffer}, {1, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(TilesParameters);
        ClassKernels kernels;
        kernels.tiles = std::make_unique<ComposedKernel>(device, request);

        request.name = "cut_plane of element class " + std::to_string(index);
        request.kernel = "kernels/cut_plane.comp";
        request.instances = {data.instance(index)};
        request.bindings = {{0, BindingType::uniform_buffer},
                            {1, BindingType::storage_buffer},
                            {2, BindingType::storage_buffer},
                            {3, BindingType::storage_buffer},
                            {4, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(PixelsParameters);
        kernels.pixels = std::make_unique<ComposedKernel>(device, request);
        m_kernels.push_back(std::move(kernels));
    }
}

void CutPlanePass::draw(const CutPlaneGeometry& geometry, std::uint32_t surface, const ShownComponent& component,
                        const LayerTarget& target, FrameCounts& counts) {
    const std::uint32_t tiles_a_row = divided_up(target.layer.width, m_tile_width);
    const std::uint32_t tile_rows = divided_up(target.layer.height, tile_height);
    const std::uint64_t bytes = std::uint64_t{tiles_a_row} * tile_rows * tile_stride * sizeof(std::uint32_t);
    if (!m_tiles || m_tiles->bytes() != bytes) {
        m_tiles.reset();
        m_tiles.emplace(m_device, bytes);
    }
    write_reals(m_frame, m_precision, std::span<const double>(geometry.rows.front().data(), 4 * geometry.rows.size()));
    m_counts.fill(0);
    const std::uint32_t rows_a_dispatch = std::max(1u, pixels_a_dispatch / (tiles_a_row * m_tile_width * tile_height));
    for (const ClassKernels& kernels : m_kernels) {
        const TilesParameters tiles{tiles_a_row, tiles_a_row * tile_rows};
        const std::array<const Buffer*, 2> tiles_bindings = {&m_frame, &*m_tiles};
        kernels.tiles->dispatch(tiles_bindings, std::as_bytes(std::span(&tiles, 1)),
                                divided_up(tiles.n_tiles, tiles_group_size));
        const std::array<const Buffer*, 5> bindings = {&m_frame, &target.layer.samples, &*m_tiles, &m_counts, &target.layer.marks};
        for (std::uint32_t first_row = 0; first_row < tile_rows; first_row += rows_a_dispatch) {
            const PixelsParameters pixels{target.layer.width,
                                          target.layer.height,
                                          first_row,
                                          surface,
                                          component.first(),
                                          component.end(),
                                          component.is_discontinuous ? 1u : 0u};
            kernels.pixels->dispatch(bindings, std::as_bytes(std::span(&pixels, 1)), tiles_a_row,
                                     std::min(rows_a_dispatch, tile_rows - first_row));
        }
    }
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_pass_counts);
    counts.field_evaluations += found[0];
    counts.newton_iterations += found[1];
    counts.newton_failures += found[2];
}

} // namespace elvis
