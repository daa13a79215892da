#include <core/base/bounds.hpp>
#include <core/render/cut_surface/point_parameters.hpp>
#include <core/render/cut_surface/surface_pass.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace elvis {

namespace {

/** Nodes of a tile and their number: shaders/tiles/node_tiles.glsl. */
constexpr std::uint32_t surface_tile_stride = 32;
constexpr std::uint32_t surface_tiles_group_size = 32;
/** Pixels of one dispatch: bounds its time, and the share of each thread of a software driver. */
constexpr std::uint32_t surface_pixels_a_dispatch = 1u << 17;
/** Crossings that a ray is followed through. A formula has few; triangle meshes may have many, one behind the other. */
constexpr std::uint32_t most_surface_rounds = 256;

struct SurfaceTilesParameters {
    std::uint32_t tiles_a_row, n_tiles, first_tile, end_tile, boxes_a_tile;
};

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

bool is_endless(const CutShape& shape) {
    return !std::ranges::all_of(shape_bounds(shape), [](double end) { return std::isfinite(end); });
}

} // namespace

SurfacePass::SurfacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_volume(volume), m_data(data), m_precision(data.precision()), m_listed(device),
      m_frame(view_buffer(device, data.precision())), m_hit_counts(device, sizeof(std::uint32_t)),
      m_counts(device, (n_pass_counts + 1) * sizeof(std::uint32_t)), m_nothing(device, 4 * sizeof(double)),
      m_others(device, data), m_open(device, volume, data, false) {}

void SurfacePass::provide_elements() {
    if (!m_kernels.empty()) {
        return;
    }
    for (std::uint32_t index = 0; index < m_volume.classes().size(); ++index) {
        if (m_volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.precision = m_precision;
        request.buffers = m_data.host_buffers(index);
        request.defines = {{"CORE_TILE_WIDTH", std::to_string(tile_width_on(m_device)) + "u"},
                           {"CORE_TILE_HEIGHT", std::to_string(surface_tile_height) + "u"}};
        request.name = "surface_tiles";
        request.kernel = "cut_surface/surface_tiles.comp";
        request.bindings = buffer_bindings({.storage = 3});
        request.push_constant_bytes = sizeof(SurfaceTilesParameters);
        ClassKernels kernels;
        kernels.element_class = index;
        kernels.tiles = std::make_unique<ComposedKernel>(m_device, request);
        std::ranges::copy(m_open.buffers(index), std::back_inserter(request.buffers));

        request.name = "surface_pixels of element class " + std::to_string(index);
        request.kernel = "cut_surface/surface_pixels.comp";
        m_data.add_field(request, index);
        request.defines.emplace_back("CORE_OVERLAPS", m_data.has_overlaps() ? "1" : "0");
        request.defines.emplace_back("CORE_CLASS", std::to_string(index) + "u");
        request.bindings = buffer_bindings({.uniform = 1, .storage = 10});
        request.push_constant_bytes = sizeof(PointParameters);
        kernels.pixels = std::make_unique<ComposedKernel>(m_device, request);
        m_kernels.push_back(std::move(kernels));
    }
}

void SurfacePass::provide_buffers(std::uint64_t n_pixels, std::uint64_t n_tiles, std::uint32_t boxes_a_tile) {
    provide_buffer(m_hits, m_device, 2 * n_pixels * real_bytes(m_precision));
    provide_buffer(m_bending, m_device, n_pixels * real_bytes(m_precision));
    provide_buffer(m_boxes, m_device, n_tiles * boxes_a_tile * 6 * sizeof(float));
    provide_buffer(m_tiles, m_device, n_tiles * surface_tile_stride * sizeof(std::uint32_t));
}

struct SurfacePass::Picture {
    const SurfaceSolver& solver;
    std::uint32_t surface;
    const ShownComponent& component;
    const LayerTarget& target;
    double most_error;
    std::uint32_t tiles_a_row, tile_rows;
    TileRows wanted;
};

/** The next crossing of each ray that is still open. Returns how many rays have one. */
std::uint32_t SurfacePass::find_hits(const Picture& picture, std::uint32_t round) const {
    const Layer& layer = picture.target.layer;
    const Buffer* const beyond = picture.target.beyond;
    std::vector<const Buffer*> bindings = {
        &*m_hits, &layer.normals, &*m_bending, &*m_boxes, &layer.marks, &m_hit_counts, beyond != nullptr ? beyond : &m_nothing};
    if (picture.solver.has_own_values()) {
        bindings.push_back(&layer.samples);
    }
    const std::uint32_t tile_pixels = tile_width_on(m_device) * surface_tile_height;
    const std::uint32_t rows_a_dispatch =
        items_a_dispatch(m_device, std::max(1u, surface_pixels_a_dispatch / (picture.tiles_a_row * tile_pixels)));
    m_hit_counts.fill(0);
    for (std::uint32_t first_row = picture.wanted.first; first_row < picture.wanted.end; first_row += rows_a_dispatch) {
        const HitsParameters hits{layer.width,
                                  layer.height,
                                  first_row,
                                  picture.surface,
                                  round,
                                  beyond != nullptr ? 1u : 0u,
                                  picture.target.places != nullptr ? 1u : 0u};
        picture.solver.find(m_frame, bindings, std::as_bytes(std::span(&hits, 1)), picture.tiles_a_row,
                            std::min(rows_a_dispatch, picture.wanted.end - first_row));
    }
    return m_hit_counts.read_items<std::uint32_t>(1)[0];
}

/** The elements of one class that hold crossings, and the field there. */
void SurfacePass::draw_pixels(const ClassKernels& kernels, const Picture& picture, FrameCounts& counts) {
    const Layer& layer = picture.target.layer;
    const std::uint32_t tiles_a_row = picture.tiles_a_row;
    const SurfaceTilesParameters tiles{tiles_a_row, tiles_a_row * picture.tile_rows, picture.wanted.first * tiles_a_row,
                                       picture.wanted.end * tiles_a_row, picture.solver.boxes_a_tile()};
    const Buffer& listed = m_listed.begin(tiles.n_tiles);
    const std::array<const Buffer*, 3> tiles_bindings = {&*m_boxes, &*m_tiles, &listed};
    kernels.tiles->dispatch(tiles_bindings, std::as_bytes(std::span(&tiles, 1)),
                            divided_up(tiles.end_tile - tiles.first_tile, surface_tiles_group_size));
    // Places are not written if they are not wanted: anything of reals.
    const Buffer& places = picture.target.places != nullptr ? *picture.target.places : layer.normals;
    const Buffer& others = m_others.begin(layer.n_pixels(), picture.component);
    const auto [open, wanted_reaches] = m_open.begin(kernels.element_class, layer.n_pixels());
    const std::array<const Buffer*, 11> bindings = {&m_frame, &layer.samples, &*m_tiles, &m_counts, &layer.marks,  &*m_hits,
                                                    &others,  &places,        &listed,   open,      wanted_reaches};
    const std::uint32_t tiles_a_dispatch =
        items_a_dispatch(m_device, surface_pixels_a_dispatch / (tile_width_on(m_device) * surface_tile_height));
    PointParameters pixels(picture.target, picture.surface, picture.component, static_cast<float>(picture.most_error));
    const auto push_constants = std::as_bytes(std::span(&pixels, 1));
    if (m_listed.is_indirect()) {
        pixels.first = TileList::n_header_words;
        kernels.pixels->dispatch_indirect(bindings, push_constants, m_listed.groups());
    } else {
        const TileList::Range range = m_listed.read().shallow;
        in_batches(range.count, tiles_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
            pixels.first = range.first + first;
            kernels.pixels->dispatch(bindings, push_constants, count);
        });
    }
    m_others.compare(kernels.element_class, picture.component, layer, counts);
}

void SurfacePass::draw(const CutPlaneGeometry& view, const SurfaceSolver& solver, const CutShape& shape, std::uint32_t surface,
                       const ShownComponent& component, bool shows_outside, const LayerTarget& target, FrameCounts& counts) {
    const Layer& layer = target.layer;
    const Picture picture{solver,
                          surface,
                          component,
                          target,
                          most_error_along_ray * diagonal_of(m_data.bounds()),
                          divided_up(layer.width, tile_width_on(m_device)),
                          divided_up(layer.height, surface_tile_height),
                          target.tile_rows(surface_tile_height)};
    provide_buffers(layer.n_pixels(), std::uint64_t{picture.tiles_a_row} * picture.tile_rows, solver.boxes_a_tile());
    write_view(m_frame, m_precision, view);
    const bool shows_all = shows_outside || solver.has_own_values();
    solver.begin(shape, view, shows_all ? box_of(shape, m_data.bounds()) : m_data.bounds(), picture.most_error,
                 shows_all && is_endless(shape));
    m_counts.fill(0);
    const OpenPoints::Surface open{
        surface, component, target, m_frame, m_counts, &*m_hits, static_cast<float>(picture.most_error)};
    std::uint32_t n_found_before = 0;
    for (std::uint32_t round = 0; round < most_surface_rounds; ++round) {
        const std::uint32_t n_hits = find_hits(picture, round);
        if (n_hits == 0 || solver.has_own_values()) {
            break;
        }
        for (const ClassKernels& kernels : m_kernels) {
            draw_pixels(kernels, picture, counts);
        }
        for (const ClassKernels& kernels : m_kernels) {
            m_open.search(kernels.element_class, open);
        }
        if (shows_outside) {
            draw_outside(picture);
            break;
        }
        const std::uint32_t n_found = m_counts.read_items<std::uint32_t>(1, n_pass_counts)[0];
        const std::uint32_t n_open = n_hits - (n_found - n_found_before);
        if (n_open == 0) {
            break;
        }
        n_found_before = n_found;
        // Rays that meet more crossings outside of elements than are followed.
        counts.work_limit_pixels += round + 1 == most_surface_rounds ? n_open : 0;
    }
    add_pass_counts(target.layer, m_counts, counts);
}

void SurfacePass::draw_outside(const Picture& picture) {
    if (!m_outside) {
        m_outside = std::make_unique<OutsidePass>(m_device, m_precision, false);
    }
    m_outside->draw(m_frame, &*m_hits, picture.surface, picture.target);
}

} // namespace elvis
