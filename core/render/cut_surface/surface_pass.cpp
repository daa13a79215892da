#include <core/base/bounds.hpp>
#include <core/render/cut_surface/surface_pass.hpp>
#include <core/render/device/in_parts.hpp>
#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/device/real_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

/** Nodes of a tile and their number: shaders/tiles/cut_tiles.glsl. */
constexpr std::uint32_t tile_stride = 32;
constexpr std::uint32_t tiles_group_size = 32;
/** Pixels of one dispatch: bounds its time, and the share of each thread of a software driver. */
constexpr std::uint32_t pixels_a_dispatch = 1u << 17;
/** Crossings that a ray is followed through. A formula has few; triangle meshes may have many, one behind the other. */
constexpr std::uint32_t most_rounds = 256;
/**
 * Error of a crossing along the ray, relative to the volume's diagonal, from which on its pixel is undecided: across a field
 * that varies by ten times its range over the volume it is what colours may be off.
 */
constexpr double most_error_along_ray = 3e-5;

struct TilesParameters {
    std::uint32_t tiles_a_row, n_tiles, first_tile, end_tile, n_parts;
};

struct PixelsParameters {
    std::uint32_t width, height;
    std::uint32_t first_listed;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t is_discontinuous;
    float most_error;
    std::uint32_t wants_places;
};

std::uint32_t divided_up(std::uint32_t number, std::uint32_t by) { return (number + by - 1) / by; }

/** Where a shape is looked for if what lies outside of the volume is shown, too. */
std::array<double, 6> box_of(const CutShape& shape, const std::array<double, 6>& volume) {
    std::array<double, 6> box = shape_bounds(shape);
    const std::array<double, 6> around = box_around(volume);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_finite = std::isfinite(box[axis]) && std::isfinite(box[axis + 3]);
        box[axis] = is_finite ? std::min(box[axis], volume[axis]) : around[axis];
        box[axis + 3] = is_finite ? std::max(box[axis + 3], volume[axis + 3]) : around[axis + 3];
    }
    return box;
}

} // namespace

SurfacePass::SurfacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_data(data), m_precision(data.precision()), m_listed(device),
      m_frame(device, cut_plane_rows * 4 * real_bytes(data.precision()), Buffer::Use::uniform),
      m_hit_counts(device, sizeof(std::uint32_t)), m_counts(device, (n_pass_counts + 1) * sizeof(std::uint32_t)),
      m_nothing(device, 4 * sizeof(double)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.precision = m_precision;
        request.buffers = data.host_buffers(index);
        request.defines = {{"CORE_TILE_WIDTH", std::to_string(surface_tile_width(device)) + "u"},
                           {"CORE_TILE_HEIGHT", std::to_string(surface_tile_height) + "u"}};
        request.name = "surface_tiles";
        request.kernel = "cut_surface/surface_tiles.comp";
        request.bindings = {
            {0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}, {2, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(TilesParameters);
        ClassKernels kernels;
        kernels.tiles = std::make_unique<ComposedKernel>(device, request);

        request.name = "surface_pixels of element class " + std::to_string(index);
        request.kernel = "cut_surface/surface_pixels.comp";
        data.add_field(request, index);
        request.defines.emplace_back("CORE_CLASS", std::to_string(index) + "u");
        request.bindings = {{0, BindingType::uniform_buffer}};
        for (std::uint32_t binding = 1; binding <= 8; ++binding) {
            request.bindings.push_back({binding, BindingType::storage_buffer});
        }
        request.push_constant_bytes = sizeof(PixelsParameters);
        kernels.pixels = std::make_unique<ComposedKernel>(device, request);
        m_kernels.push_back(std::move(kernels));
    }
}

void SurfacePass::provide_buffers(std::uint64_t n_pixels, std::uint64_t n_tiles, std::uint32_t n_parts) {
    provide_buffer(m_hits, m_device, 2 * n_pixels * real_bytes(m_precision));
    provide_buffer(m_bending, m_device, n_pixels * real_bytes(m_precision));
    provide_buffer(m_boxes, m_device, n_tiles * n_parts * 6 * sizeof(float));
    provide_buffer(m_tiles, m_device, n_tiles * tile_stride * sizeof(std::uint32_t));
}

void SurfacePass::draw(const CutPlaneGeometry& view, const SurfaceSolver& solver, const CutShape& shape, std::uint32_t surface,
                       const ShownComponent& component, bool shows_outside, const LayerTarget& target, FrameCounts& counts) {
    const std::uint32_t width = target.layer.width, height = target.layer.height;
    const std::uint32_t tile_width = surface_tile_width(m_device);
    const std::uint32_t tiles_a_row = divided_up(width, tile_width);
    const std::uint32_t tile_rows = divided_up(height, surface_tile_height);
    const TileRows wanted = target.tile_rows(surface_tile_height);
    provide_buffers(std::uint64_t{width} * height, std::uint64_t{tiles_a_row} * tile_rows, solver.n_parts());
    write_reals(m_frame, m_precision, std::span<const double>(view.rows.front().data(), 4 * view.rows.size()));
    const double most_error = most_error_along_ray * diagonal_of(m_data.bounds());
    solver.begin(shape, view, shows_outside ? box_of(shape, m_data.bounds()) : m_data.bounds(), most_error);
    m_counts.fill(0);

    const std::uint32_t rows_a_dispatch = std::max(1u, pixels_a_dispatch / (tiles_a_row * tile_width * surface_tile_height));
    const std::array<const Buffer*, 7> hits_bindings = {&*m_hits,
                                                        &target.layer.normals,
                                                        &*m_bending,
                                                        &*m_boxes,
                                                        &target.layer.marks,
                                                        &m_hit_counts,
                                                        target.beyond != nullptr ? target.beyond : &m_nothing};
    const std::uint32_t tiles_a_dispatch = pixels_a_dispatch / (tile_width * surface_tile_height);
    std::uint32_t n_found_before = 0;
    for (std::uint32_t round = 0; round < most_rounds; ++round) {
        m_hit_counts.fill(0);
        for (std::uint32_t first_row = wanted.first; first_row < wanted.end; first_row += rows_a_dispatch) {
            const HitsParameters hits{width, height, first_row, surface, round, target.beyond != nullptr ? 1u : 0u};
            solver.find(m_frame, hits_bindings, std::as_bytes(std::span(&hits, 1)), tiles_a_row,
                        std::min(rows_a_dispatch, wanted.end - first_row));
        }
        const std::uint32_t n_hits = m_hit_counts.read_items<std::uint32_t>(1)[0];
        if (n_hits == 0) {
            break;
        }
        for (const ClassKernels& kernels : m_kernels) {
            const TilesParameters tiles{tiles_a_row, tiles_a_row * tile_rows, wanted.first * tiles_a_row,
                                        wanted.end * tiles_a_row, solver.n_parts()};
            const Buffer& listed = m_listed.begin(tiles.n_tiles);
            const std::array<const Buffer*, 3> tiles_bindings = {&*m_boxes, &*m_tiles, &listed};
            kernels.tiles->dispatch(tiles_bindings, std::as_bytes(std::span(&tiles, 1)),
                                    divided_up(tiles.end_tile - tiles.first_tile, tiles_group_size));
            const std::array<const Buffer*, 9> pixels_bindings = {&m_frame,
                                                                  &target.layer.samples,
                                                                  &*m_tiles,
                                                                  &m_counts,
                                                                  &target.layer.marks,
                                                                  &*m_hits,
                                                                  &target.layer.normals,
                                                                  target.places != nullptr ? target.places
                                                                                           : &target.layer.normals,
                                                                  &listed};
            const TileList::Part part = m_listed.read().shallow;
            in_parts(part.count, tiles_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
                const PixelsParameters pixels{width,
                                              height,
                                              part.first + first,
                                              surface,
                                              component.first(),
                                              component.end(),
                                              component.is_discontinuous ? 1u : 0u,
                                              static_cast<float>(most_error),
                                              target.places != nullptr ? 1u : 0u};
                kernels.pixels->dispatch(pixels_bindings, std::as_bytes(std::span(&pixels, 1)), count);
            });
        }
        if (shows_outside) {
            if (!m_outside) {
                m_outside = std::make_unique<OutsidePass>(m_device, m_precision, false);
            }
            m_outside->draw(m_frame, &*m_hits, surface, target);
            break;
        }
        const std::uint32_t n_found = m_counts.read_items<std::uint32_t>(1, n_pass_counts)[0];
        const std::uint32_t n_open = n_hits - (n_found - n_found_before);
        if (n_open == 0) {
            break;
        }
        n_found_before = n_found;
        // Rays that meet more crossings outside of elements than are followed.
        counts.work_limit_pixels += round + 1 == most_rounds ? n_open : 0;
    }
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_pass_counts);
    counts.field_evaluations += found[0];
    counts.newton_iterations += found[1];
    counts.newton_failures += found[2];
}

} // namespace elvis
