#include <core/render/boundary/face_pass.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

/** Words of a tile's list: shaders/tiles/ray_tiles.glsl. */
constexpr std::uint32_t face_tile_stride = 64;
constexpr std::uint32_t face_group_size = 32;
/** Pixels of one dispatch: bounds its time, and gives the threads of software drivers even shares. */
constexpr std::uint32_t face_pixels_a_dispatch = 1u << 17;
/** Those of the careful kernel: each may take a hundred times as long. */
constexpr std::uint32_t careful_pixels_a_dispatch = 1u << 15;
/** Evaluations, steps, failures; pixels left to the careful kernel. */
constexpr std::size_t n_face_counts = n_pass_counts + 1;

struct FaceTilesParameters {
    std::uint32_t tiles_a_row, n_tiles, first_tile, end_tile;
};

struct FaceParameters {
    std::uint32_t width, height;
    std::uint32_t tiles_a_row;
    std::uint32_t first;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t is_discontinuous;
    float value_tolerance;
    std::uint32_t has_beyond;
    std::uint32_t wants_normals;
    std::uint32_t wants_places;
};

} // namespace

const ComposedKernel& FacePass::ClassKernels::provide(const Device& device, Draws what) {
    std::unique_ptr<ComposedKernel>& kernel = drawing[static_cast<std::size_t>(what)];
    if (!kernel) {
        KernelRequest own = request;
        const bool is_careful = what == Draws::careful;
        own.kernel = is_careful ? "boundary/faces_careful.comp" : "boundary/faces.comp";
        own.name = std::string(is_careful ? "faces_careful" : "faces") + " of element class " + std::to_string(element_class);
        own.defines.emplace_back("CORE_DESCENDS", what == Draws::pixels ? "0" : "1");
        kernel = std::make_unique<ComposedKernel>(device, own);
    }
    return *kernel;
}

FacePass::FacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, const FaceSet& faces)
    : m_device(device), m_precision(data.precision()), m_tile_width(tile_width_on(device)),
      m_tile_height(tile_height_on(device)), m_listed(device), m_frame(view_buffer(device, data.precision())),
      m_counts(device, n_face_counts * sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const FaceSet::ClassFaces& own = faces.of_class(index);
        if (own.n_faces == 0) {
            continue;
        }
        ClassKernels kernels;
        KernelRequest request;
        request.precision = m_precision;
        request.buffers = {{"core_nodes", own.nodes.get()}};
        request.defines = {{"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"},
                           {"CORE_TILE_HEIGHT", std::to_string(m_tile_height) + "u"},
                           {"CORE_LISTS_TILES", "1"}};
        request.name = "ray_tiles";
        request.kernel = "tiles/ray_tiles.comp";
        request.bindings = buffer_bindings({.uniform = 1, .storage = 2});
        request.push_constant_bytes = sizeof(FaceTilesParameters);
        kernels.tiles = std::make_unique<ComposedKernel>(device, request);

        request.buffers = {{"core_nodes", own.nodes.get()},
                           {"core_faces", own.faces.get()},
                           {"core_patches", own.patches.get()},
                           {"core_face_points", own.points.get()}};
        data.add_field(request, index);
        if (own.is_polynomial) {
            request.defines.emplace_back("CORE_FACE_ORDER", std::to_string(own.order));
        }
        request.bindings = buffer_bindings({.uniform = 1, .storage = 9});
        request.defines.emplace_back("CORE_CLASS", std::to_string(index) + "u");
        request.push_constant_bytes = sizeof(FaceParameters);
        kernels.request = request;
        kernels.element_class = index;
        kernels.provide(m_device, Draws::pixels);
        m_kernels.push_back(std::move(kernels));
    }
}

void FacePass::draw(const CutPlaneGeometry& view, std::uint32_t first_surface, const ShownComponent& component,
                    const LayerTarget& target, FrameCounts& counts) {
    const Layer& layer = target.layer;
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    const std::uint32_t tile_rows = divided_up(layer.height, m_tile_height);
    const std::uint32_t n_tiles = tiles_a_row * tile_rows;
    const TileRows wanted = target.tile_rows(m_tile_height);
    const Buffer& tiles = provide_buffer(m_tiles, m_device, std::uint64_t{n_tiles} * face_tile_stride * sizeof(std::uint32_t));
    const Buffer& list = provide_buffer(m_list, m_device, std::uint64_t{layer.width} * layer.height * sizeof(std::uint32_t));
    write_view(m_frame, m_precision, view);
    const std::uint32_t tiles_a_dispatch = items_a_dispatch(m_device, face_pixels_a_dispatch / (m_tile_width * m_tile_height));
    // The last one is not read without depths: anything of reals.
    const Buffer& beyond = target.beyond ? *target.beyond : layer.normals;
    const Buffer& places = target.places ? *target.places : layer.normals;
    for (std::uint32_t index = 0; index < m_kernels.size(); ++index) {
        ClassKernels& kernels = m_kernels[index];
        m_counts.fill(0);
        const Buffer& listed = m_listed.begin(n_tiles);
        const std::array<const Buffer*, 10> bindings = {&m_frame, &layer.samples, &layer.normals, &m_counts, &layer.marks,
                                                        &tiles,   &list,          &beyond,        &places,   &listed};
        const FaceTilesParameters of_tiles{tiles_a_row, n_tiles, wanted.first * tiles_a_row, wanted.end * tiles_a_row};
        const std::array<const Buffer*, 3> tiles_bindings = {&m_frame, &tiles, &listed};
        kernels.tiles->dispatch(tiles_bindings, std::as_bytes(std::span(&of_tiles, 1)),
                                divided_up(of_tiles.end_tile - of_tiles.first_tile, face_group_size));
        FaceParameters parameters{layer.width,
                                  layer.height,
                                  tiles_a_row,
                                  0,
                                  first_surface + index,
                                  component.first(),
                                  component.end(),
                                  component.is_discontinuous ? 1u : 0u,
                                  component.value_tolerance,
                                  target.beyond ? 1u : 0u,
                                  target.wants_normals ? 1u : 0u,
                                  target.places ? 1u : 0u};
        const auto draw_tiles = [&](Draws what, const TileList::Range& range) {
            in_batches(range.count, tiles_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
                parameters.first = range.first + first;
                kernels.provide(m_device, what).dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), count);
            });
        };
        const bool is_indirect = m_listed.is_indirect();
        if (is_indirect) {
            parameters.first = TileList::n_header_words;
            kernels.provide(m_device, Draws::pixels)
                .dispatch_indirect(bindings, std::as_bytes(std::span(&parameters, 1)), m_listed.groups());
        }
        std::array<std::uint32_t, TileList::n_header_words> header{};
        std::array<std::uint32_t, n_face_counts> found{};
        const Buffer::Read of_counts{&m_counts, std::as_writable_bytes(std::span(found))};
        Buffer::read_together({{&listed, std::as_writable_bytes(std::span(header))}, of_counts});
        const TileList::Ranges ranges = m_listed.ranges(header);
        if (!is_indirect) {
            draw_tiles(Draws::pixels, ranges.shallow);
        }
        draw_tiles(Draws::deep_pixels, ranges.deep);
        if (!is_indirect || ranges.deep.count > 0) {
            Buffer::read_together({of_counts});
        }
        const std::uint32_t n_careful = found[n_pass_counts];
        in_batches(n_careful, items_a_dispatch(m_device, careful_pixels_a_dispatch, face_group_size),
                   [&](std::uint32_t first, std::uint32_t count) {
                       parameters.first = first;
                       kernels.provide(m_device, Draws::careful)
                           .dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(count, face_group_size));
                   });
        add_pass_counts(layer, m_counts, counts);
        counts.careful_pixels += n_careful;
    }
}

} // namespace elvis
