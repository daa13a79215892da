#include <core/render/cut_surface/cut_plane_pass.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <iterator>

namespace elvis {

namespace {

/** Nodes of a tile and their number: shaders/tiles/node_tiles.glsl. */
constexpr std::uint32_t plane_tile_stride = 32;
constexpr std::uint32_t plane_tiles_group_size = 32;
/**
 * Pixels of one dispatch: bounds its time, so that no driver's time limit is met. Software drivers give each thread one share
 * of consecutive groups: in a dispatch of few tiles all shares have about the same to do.
 */
constexpr std::uint32_t plane_pixels_a_dispatch = 1u << 17;

struct PlaneTilesParameters {
    std::uint32_t tiles_a_row, n_tiles;
};

struct PixelsParameters {
    std::uint32_t width, height;
    std::uint32_t first_listed;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t lists_others;
    float value_tolerance;
    std::uint32_t n_isovalues;
};

struct PlaneListParameters {
    std::uint32_t n_pixels, groups_x;
    std::uint32_t width, tiles_a_row;
};

struct LinesParameters {
    std::uint32_t width, tiles_a_row;
    std::uint32_t first, n_listed;
    std::uint32_t first_component, end_component;
    std::uint32_t n_isovalues;
    std::uint32_t with_mesh_lines;
    std::uint32_t subdivisions;
};

constexpr std::uint32_t lines_group_size = 32;
/** Pixels looked at closely in one dispatch. */
constexpr std::uint32_t plane_listed_a_dispatch = 1u << 15;

} // namespace

CutPlanePass::CutPlanePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, bool with_lines,
                           const KernelEdit& edit)
    : m_device(device), m_data(data), m_precision(data.precision()), m_with_lines(with_lines),
      m_tile_width(tile_width_on(device)), m_tile_height(tile_height_on(device)), m_listed(device),
      m_frame(view_buffer(device, data.precision())), m_counts(device, n_pass_counts * sizeof(std::uint32_t)),
      m_others(device, data), m_open(device, volume, data, true) {
    compile(volume, data, edit);
}

void CutPlanePass::compile(const RuntimeVolume& volume, const DeviceVolume& data, const KernelEdit& edit) {
    const std::vector<std::pair<std::string, std::string>> tile_size = {
        {"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"}, {"CORE_TILE_HEIGHT", std::to_string(m_tile_height) + "u"}};
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.precision = m_precision;
        request.buffers = data.host_buffers(index);
        request.defines = tile_size;
        request.name = "cut_tiles";
        request.kernel = "cut_surface/cut_tiles.comp";
        request.bindings = buffer_bindings({.uniform = 1, .storage = 2});
        request.push_constant_bytes = sizeof(PlaneTilesParameters);
        ClassKernels kernels;
        kernels.element_class = index;
        kernels.tiles = std::make_unique<ComposedKernel>(m_device, request);
        std::ranges::copy(m_open.buffers(index), std::back_inserter(request.buffers));

        data.add_field(request, index, m_with_lines);
        if (edit) {
            edit(request, index);
        }
        request.defines.emplace_back("CORE_OVERLAPS", data.has_overlaps() ? "1" : "0");
        request.defines.emplace_back("CORE_LINES", m_with_lines ? "1" : "0");
        request.defines.push_back(data.strongly_bent_define(index));
        request.name = "cut_plane of element class " + std::to_string(index);
        request.kernel = "cut_surface/cut_plane.comp";
        request.bindings = buffer_bindings({.uniform = 1, .storage = 9});
        request.push_constant_bytes = sizeof(PixelsParameters);
        kernels.pixels = std::make_unique<ComposedKernel>(m_device, request);
        if (m_with_lines) {
            request.name = "cut_lines of element class " + std::to_string(index);
            request.kernel = "lines/cut_lines.comp";
            request.bindings = buffer_bindings({.uniform = 1, .storage = 6});
            request.push_constant_bytes = sizeof(LinesParameters);
            kernels.lines = std::make_unique<ComposedKernel>(m_device, request);
        }
        m_kernels.push_back(std::move(kernels));
    }
    if (m_with_lines) {
        KernelRequest request = pixel_kernel("picture/list_pixels", m_precision, {.storage = 4}, sizeof(PlaneListParameters));
        request.defines.insert(request.defines.end(), tile_size.begin(), tile_size.end());
        m_list_pixels.emplace(m_device, request);
    }
}

void CutPlanePass::draw(const CutPlaneGeometry& geometry, std::uint32_t surface, const ShownComponent& component,
                        const LineRequest& lines, const LayerTarget& target, FrameCounts& counts) {
    write_view(m_frame, m_precision, geometry);
    m_counts.fill(0);
    const auto n_isovalues = static_cast<std::uint32_t>(lines.isovalues.size());
    if (m_with_lines) {
        // A buffer cannot be empty.
        provide_buffer(m_isovalues, m_device, std::max<std::uint64_t>(n_isovalues, 1) * real_bytes(m_precision));
        write_reals(*m_isovalues, m_precision, lines.isovalues);
    }
    for (ClassKernels& kernels : m_kernels) {
        draw_pixels(kernels, surface, component, n_isovalues, target, counts);
    }
    const OpenPoints::Surface open{surface, component, target, m_frame, m_counts};
    for (const ClassKernels& kernels : m_kernels) {
        m_open.search(kernels.element_class, open);
    }
    add_pass_counts(target.layer, m_counts, counts);
}

void CutPlanePass::draw_lines(const ShownComponent& component, const LineRequest& lines, const LayerTarget& target,
                              FrameCounts& counts) {
    m_counts.fill(0);
    for (const ClassKernels& kernels : m_kernels) {
        draw_lines(kernels, component, lines, target, counts);
    }
    add_pass_counts(target.layer, m_counts, counts);
}

void CutPlanePass::draw_outside(const CutPlaneGeometry& geometry, std::uint32_t surface, const LayerTarget& target) {
    if (!m_outside) {
        m_outside = std::make_unique<OutsidePass>(m_device, m_precision, true);
    }
    std::array<double, 6> box = box_around(m_data.bounds());
    const std::array<double, 4>& reference = geometry.rows[6];
    for (std::size_t i = 0; i < box.size(); ++i) {
        box[i] -= reference[i % 3];
    }
    m_outside->set_box(box);
    m_outside->draw(m_frame, nullptr, surface, target);
}

void CutPlanePass::draw_pixels(ClassKernels& kernels, std::uint32_t surface, const ShownComponent& component,
                               std::uint32_t n_isovalues, const LayerTarget& target, FrameCounts& counts) {
    const Layer& layer = target.layer;
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    const std::uint32_t tile_rows = divided_up(layer.height, m_tile_height);
    provide_buffer(kernels.tile_nodes, m_device,
                   std::uint64_t{tiles_a_row} * tile_rows * plane_tile_stride * sizeof(std::uint32_t));
    const PlaneTilesParameters tiles{tiles_a_row, tiles_a_row * tile_rows};
    const Buffer& listed = m_listed.begin(tiles.n_tiles);
    const std::array<const Buffer*, 3> tiles_bindings = {&m_frame, &*kernels.tile_nodes, &listed};
    kernels.tiles->dispatch(tiles_bindings, std::as_bytes(std::span(&tiles, 1)),
                            divided_up(tiles.n_tiles, plane_tiles_group_size));
    // Isovalues are not read without lines: anything of reals.
    const Buffer& isovalues = m_with_lines ? *m_isovalues : layer.samples;
    const auto [open, wanted_reaches] = m_open.begin(kernels.element_class, layer.n_pixels());
    const std::array<const Buffer*, 10> bindings = {&m_frame,
                                                    &layer.samples,
                                                    &*kernels.tile_nodes,
                                                    &m_counts,
                                                    &layer.marks,
                                                    &isovalues,
                                                    &listed,
                                                    &m_others.begin(layer.n_pixels(), component),
                                                    open,
                                                    wanted_reaches};
    const std::uint32_t tiles_a_dispatch = items_a_dispatch(m_device, plane_pixels_a_dispatch / (m_tile_width * m_tile_height));
    PixelsParameters pixels{layer.width,
                            layer.height,
                            TileList::n_header_words,
                            surface,
                            component.first(),
                            component.end(),
                            component.is_discontinuous ? 1u : 0u,
                            component.value_tolerance,
                            n_isovalues};
    const auto push_constants = std::as_bytes(std::span(&pixels, 1));
    if (m_listed.is_indirect()) {
        kernels.pixels->dispatch_indirect(bindings, push_constants, m_listed.groups());
    } else {
        const TileList::Range range = m_listed.read().shallow;
        in_batches(range.count, tiles_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
            pixels.first_listed = range.first + first;
            kernels.pixels->dispatch(bindings, push_constants, count);
        });
    }
    m_others.compare(kernels.element_class, component, layer, counts);
}

void CutPlanePass::draw_lines(const ClassKernels& kernels, const ShownComponent& component, const LineRequest& lines,
                              const LayerTarget& target, FrameCounts& counts) {
    const Layer& layer = target.layer;
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    provide_buffer(m_list, m_device, layer.n_pixels() * sizeof(std::uint32_t));
    const Buffer n_listed_buffer(m_device, sizeof(std::uint32_t));
    n_listed_buffer.fill(0);
    const PlaneListParameters list{n_pixels, pixel_groups_x, layer.width, tiles_a_row};
    dispatch_pixels(*m_list_pixels, {&layer.marks, &*kernels.tile_nodes, &*m_list, &n_listed_buffer},
                    std::as_bytes(std::span(&list, 1)), n_pixels);
    const std::uint32_t n_listed = n_listed_buffer.read_items<std::uint32_t>(1)[0];
    counts.refined_pixels += n_listed;
    const std::array<const Buffer*, 7> bindings = {&m_frame,     &*kernels.tile_nodes, &*m_list,      &m_counts,
                                                   &layer.marks, &*m_isovalues,        &layer.samples};
    in_batches(n_listed, items_a_dispatch(m_device, plane_listed_a_dispatch, lines_group_size),
               [&](std::uint32_t first, std::uint32_t count) {
                   const LinesParameters parameters{layer.width,
                                                    tiles_a_row,
                                                    first,
                                                    count,
                                                    component.first(),
                                                    component.end(),
                                                    static_cast<std::uint32_t>(lines.isovalues.size()),
                                                    lines.mesh_lines ? 1u : 0u,
                                                    lines.subdivisions};
                   kernels.lines->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)),
                                           divided_up(count, lines_group_size));
               });
}

} // namespace elvis
