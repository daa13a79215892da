#include <core/base/bounds.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/isosurface/isosurface_pass.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

constexpr std::uint32_t isosurface_tile_height = 16;
/** Of a tile's list, and its words: shaders/tiles/ray_tiles.glsl. */
constexpr std::uint32_t tile_capacity = 127;
constexpr std::uint32_t isosurface_tile_stride = 2 * tile_capacity + 2;
constexpr std::uint32_t isosurface_group_size = 32;
/** Pixels of one dispatch: bounds its time, and gives the threads of software drivers even shares. */
constexpr std::uint32_t isosurface_pixels_a_dispatch = 1u << 16;
/**
 * Of the volume's diagonal: how far below a clipping plane crossings are still looked for. Colours doubt clipping within a
 * 256th of the distance to what neighbouring pixels show (shaders/picture/color.comp).
 */
constexpr double kept_below_planes = 1.0 / 512;
/** Of m_counts. */
struct IsosurfaceCount {
    enum : std::size_t { evaluations, excluded, outside, undecided, crossings, n_counts };
};

struct IsosurfaceTilesParameters {
    std::uint32_t tiles_a_row, n_tiles, first_tile, end_tile;
    std::uint32_t n_isovalues;
};

struct IsosurfaceParameters {
    std::uint32_t width, height;
    std::uint32_t tiles_a_row;
    std::uint32_t first_listed;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t n_isovalues, n_clips;
    std::uint32_t has_beyond;
    std::uint32_t round;
    float extent;
};

} // namespace

/** Rays that descend to octants may need all iterations. */
std::uint32_t IsosurfacePass::rows_of(const Device& device, Role role) {
    return role == Role::pixels ? rows_an_invocation(device, 4, 1) : 1;
}

const ComposedKernel& IsosurfacePass::ClassKernels::provide(const Device& device, Role role, bool has_one_isovalue) {
    std::unique_ptr<ComposedKernel>& kernel = kernels[static_cast<std::size_t>(role)][has_one_isovalue ? 1 : 0];
    if (!kernel) {
        KernelRequest own = request;
        own.buffers.insert(own.buffers.end(), octants.begin(), octants.end());
        own.defines.emplace_back("CORE_HAS_ONE_ISOVALUE", has_one_isovalue ? "1" : "0");
        if (role == Role::tiles) {
            own.name = "isosurface_tiles";
            own.kernel = "tiles/ray_tiles.comp";
            own.defines.emplace_back("CORE_LISTS_TILES", "1");
            own.push_constant_bytes = sizeof(IsosurfaceTilesParameters);
        } else {
            own.name = "isosurface";
            own.kernel = "isosurface/isosurface.comp";
            const bool has_mask = role == Role::chosen_pixels;
            own.defines.emplace_back("CORE_DESCENDS", role == Role::pixels ? "0" : "1");
            own.defines.emplace_back("CORE_ROWS", std::to_string(rows_of(device, role)) + "u");
            own.defines.emplace_back("CORE_HAS_MASK", has_mask ? "1" : "0");
            own.bindings = buffer_bindings({.uniform = 1, .storage = has_mask ? 12u : 11u});
            own.push_constant_bytes = sizeof(IsosurfaceParameters);
        }
        own.name += " of element class " + std::to_string(element_class);
        kernel = std::make_unique<ComposedKernel>(device, own);
    }
    return *kernel;
}

void IsosurfacePass::ClassKernels::follow_room(const IsovalueSet& set) {
    if (set.room(element_class) > room) {
        kernels = {};
        octants = set.octant_buffers(element_class);
        room = set.room(element_class);
    }
}

IsosurfacePass::IsosurfacePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_precision(data.precision()), m_tile_width(tile_width_on(device)),
      m_extent(static_cast<float>(diagonal_of(data.bounds()))), m_isovalue_set(device, volume, data), m_projection(device),
      m_frame(view_buffer(device, data.precision())), m_counts(device, IsosurfaceCount::n_counts * sizeof(std::uint32_t)) {
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        if (volume.classes()[index].n_elements == 0) {
            continue;
        }
        ClassKernels kernels;
        KernelRequest& request = kernels.request;
        request.precision = m_precision;
        kernels.elements = m_isovalue_set.element_buffers(index);
        request.buffers = {data.elements(index)};
        data.add_field(request, index, true);
        request.defines = {{"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"},
                           {"CORE_TILE_HEIGHT", std::to_string(isosurface_tile_height) + "u"},
                           {"CORE_TILE_CAPACITY", std::to_string(tile_capacity) + "u"},
                           {"CORE_TESTS_ISOVALUES", "1"},
                           {"CORE_CLASS", std::to_string(index) + "u"}};
        request.bindings = buffer_bindings({.uniform = 1, .storage = 3});
        kernels.element_class = index;
        kernels.listed.emplace(device);
        m_kernels.push_back(std::move(kernels));
    }
}

void IsosurfacePass::choose(const Isosurfaces& wanted, std::uint32_t time_step, double offset,
                            const ShownComponent& component) {
    m_values = wanted.values;
    for (double& value : m_values) {
        value -= offset;
    }
    m_component = {component.first(), component.end()};
    std::optional<ToldField> told;
    if (!wanted.field.expression && !wanted.field.is_own_boundary) {
        told = {wanted.field.field, wanted.field.component, time_step, offset};
    }
    m_isovalue_set.choose(m_values, m_component, wanted.skips_by_range, told);
    m_method = wanted.method;
    m_degree = wanted.degree;
    for (ClassKernels& kernels : m_kernels) {
        kernels.follow_room(m_isovalue_set);
        if (m_method == IsosurfaceMethod::interval) {
            kernels.provide(m_device, Role::tiles, m_values.size() == 1);
            kernels.provide(m_device, Role::pixels, m_values.size() == 1);
        }
    }
}

void IsosurfacePass::write_isovalues(const CutPlaneGeometry& view, std::span<const std::array<double, 4>> clip) {
    std::vector<double> numbers = m_values;
    const std::array<double, 4>& reference = view.rows[6];
    for (const std::array<double, 4>& plane : clip) {
        const double height = plane[0] * reference[0] + plane[1] * reference[1] + plane[2] * reference[2] + plane[3];
        const double margin = kept_below_planes * m_extent * std::hypot(plane[0], plane[1], plane[2]);
        numbers.insert(numbers.end(), {plane[0], plane[1], plane[2], height + margin});
    }
    m_n_clips = static_cast<std::uint32_t>(clip.size());
    write_reals(provide_buffer(m_isovalues, m_device, numbers.size() * real_bytes(m_precision)), m_precision, numbers);
}

void IsosurfacePass::draw(const CutPlaneGeometry& view, std::span<const std::array<double, 4>> clip,
                          std::uint32_t first_surface, const LayerTarget& target, FrameCounts& counts) {
    const Layer& layer = target.layer;
    m_round = target.beyond ? m_round + 1 : 0;
    // A core_crossing_record is as large as a sample.
    provide_buffer(m_last, m_device, 2 * layer.n_pixels() * sample_bytes(m_precision));
    provide_buffer(m_bending, m_device, layer.n_pixels() * real_bytes(m_precision));
    write_isovalues(view, clip);
    write_view(m_frame, m_precision, view);
    if (m_isovalue_set.rests_on_estimates()) {
        layer.marks.write_items(std::span<const Mark>(std::vector<Mark>(layer.n_pixels(), Mark{0, pixel_flag::estimated})));
    }
    constexpr std::uint32_t left_open = pixel_flag::isosurface_undecided | pixel_flag::work_limit;
    if (m_method == IsosurfaceMethod::interval) {
        draw_by_intervals(first_surface, target, nullptr, counts);
    } else {
        draw_by_projection(m_method, 0, first_surface, target, counts);
    }
    // A fixed degree is asked for as it is.
    if (m_method != IsosurfaceMethod::interval && m_degree == 0) {
        draw_again_by_intervals(left_open, first_surface, target, counts);
    }
    // Drivers end the many loops of eigenvalues where rays have many of them.
    if (m_method != IsosurfaceMethod::bernstein || m_degree == 0) {
        draw_by_projection(IsosurfaceMethod::bernstein, left_open, first_surface, target, counts);
    }
}

/** Projection leaves strongly bent elements open, or estimates where the ray is in them; octants of these are nearly linear. */
void IsosurfacePass::draw_again_by_intervals(std::uint32_t left_open, std::uint32_t first_surface, const LayerTarget& target,
                                             FrameCounts& counts) {
    const Buffer& mask = provide_buffer(m_mask, m_device, target.layer.n_pixels() * sizeof(std::uint32_t));
    // All pixels have this flag, and keep it, where no bounds are known.
    const bool has_bounds = !m_isovalue_set.rests_on_estimates();
    const std::uint32_t wanted = left_open | (has_bounds ? pixel_flag::estimated : 0);
    if (m_projection.list(target.layer, wanted, has_bounds ? 0 : pixel_flag::estimated, &mask) > 0) {
        draw_by_intervals(first_surface, target, &mask, counts);
    }
}

void IsosurfacePass::draw_by_projection(IsosurfaceMethod method, std::uint32_t flags, std::uint32_t first_surface,
                                        const LayerTarget& target, FrameCounts& counts) {
    const IsosurfaceProjection::Picture picture{
        m_frame,   *m_isovalues, *m_bending, *m_last, target, m_component, static_cast<std::uint32_t>(m_values.size()),
        m_n_clips, m_round,      m_extent};
    if (m_projection.list(target.layer, flags, pixel_flag::estimated) == 0) {
        return;
    }
    std::vector<std::pair<std::uint32_t, const ComposedKernel*>> compiled;
    for (const ClassKernels& kernels : m_kernels) {
        if (m_isovalue_set.n_elements(kernels.element_class) > 0) {
            m_isovalue_set.provide_element_nodes(kernels.element_class);
            KernelRequest request = kernels.request;
            request.buffers.insert(request.buffers.end(), kernels.elements.begin(), kernels.elements.end());
            compiled.emplace_back(kernels.element_class,
                                  &m_projection.provide(request, kernels.element_class, method, m_degree));
        }
    }
    for (const auto& [element_class, kernel] : compiled) {
        m_projection.draw(*kernel, picture, first_surface + element_class, counts);
    }
}

/** Those of each class that see something; they are waited for together. */
std::vector<TileList::Ranges> IsosurfacePass::list_tiles(const Layer& layer, const TileRows& wanted) {
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    const std::uint32_t n_tiles = tiles_a_row * divided_up(layer.height, isosurface_tile_height);
    std::vector<std::array<std::uint32_t, TileList::n_header_words>> headers(m_kernels.size());
    std::vector<Buffer::Read> reads;
    for (std::size_t index = 0; index < m_kernels.size(); ++index) {
        ClassKernels& kernels = m_kernels[index];
        if (m_isovalue_set.n_octants(kernels.element_class) == 0) {
            continue;
        }
        const Buffer& tiles =
            provide_buffer(kernels.tiles, m_device, std::uint64_t{n_tiles} * isosurface_tile_stride * sizeof(std::uint32_t));
        const Buffer& listed = kernels.listed->begin(n_tiles);
        const IsosurfaceTilesParameters of_tiles{tiles_a_row, n_tiles, wanted.first * tiles_a_row, wanted.end * tiles_a_row,
                                                 static_cast<std::uint32_t>(m_values.size())};
        const std::array<const Buffer*, 4> bindings = {&m_frame, &tiles, &listed, &*m_isovalues};
        kernels.provide(m_device, Role::tiles, m_values.size() == 1)
            .dispatch(bindings, std::as_bytes(std::span(&of_tiles, 1)),
                      divided_up(of_tiles.end_tile - of_tiles.first_tile, isosurface_group_size));
        reads.push_back({&listed, std::as_writable_bytes(std::span(headers[index]))});
    }
    Buffer::read_together(reads);
    std::vector<TileList::Ranges> ranges;
    for (std::size_t index = 0; index < m_kernels.size(); ++index) {
        ranges.push_back(m_kernels[index].listed->ranges(headers[index]));
    }
    return ranges;
}

void IsosurfacePass::draw_by_intervals(std::uint32_t first_surface, const LayerTarget& target, const Buffer* mask,
                                       FrameCounts& counts) {
    const Layer& layer = target.layer;
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    const TileRows wanted = target.tile_rows(isosurface_tile_height);
    const std::uint32_t tiles_a_dispatch =
        items_a_dispatch(m_device, isosurface_pixels_a_dispatch / (m_tile_width * isosurface_tile_height));
    // The beyond buffer is not read without depths: anything of reals.
    const Buffer& beyond = target.beyond ? *target.beyond : layer.normals;
    const std::vector<TileList::Ranges> ranges = list_tiles(layer, wanted);
    const Role of_shallow = mask ? Role::chosen_pixels : Role::pixels, of_deep = mask ? Role::chosen_pixels : Role::deep_pixels;
    for (std::size_t index = 0; index < m_kernels.size(); ++index) {
        for (const auto& [role, range] : {std::pair{of_shallow, ranges[index].shallow}, {of_deep, ranges[index].deep}}) {
            if (range.count > 0) {
                m_kernels[index].provide(m_device, role, m_values.size() == 1);
            }
        }
    }
    for (std::uint32_t index = 0; index < m_kernels.size(); ++index) {
        ClassKernels& kernels = m_kernels[index];
        if (m_isovalue_set.n_octants(kernels.element_class) == 0) {
            continue;
        }
        m_counts.fill(0);
        IsosurfaceParameters parameters{layer.width,
                                        layer.height,
                                        tiles_a_row,
                                        0,
                                        first_surface + kernels.element_class,
                                        m_component.first,
                                        m_component.end,
                                        static_cast<std::uint32_t>(m_values.size()),
                                        m_n_clips,
                                        target.beyond ? 1u : 0u,
                                        m_round,
                                        m_extent};
        std::vector<const Buffer*> bindings = {&m_frame,
                                               &layer.samples,
                                               &layer.normals,
                                               &m_counts,
                                               &layer.marks,
                                               &*kernels.tiles,
                                               &*m_isovalues,
                                               &beyond,
                                               target.places,
                                               &*m_bending,
                                               &kernels.listed->buffer(),
                                               &*m_last};
        if (mask) {
            bindings.push_back(mask);
        }
        const auto draw_tiles = [&](Role role, const TileList::Range& range) {
            in_batches(range.count, tiles_a_dispatch, [&](std::uint32_t first, std::uint32_t count) {
                parameters.first_listed = range.first + first;
                kernels.provide(m_device, role, m_values.size() == 1)
                    .dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), count,
                              isosurface_tile_height / rows_of(m_device, role));
            });
        };
        draw_tiles(of_shallow, ranges[index].shallow);
        draw_tiles(of_deep, ranges[index].deep);
        take_counts(layer, m_counts, IsosurfaceCount::n_counts, [&counts](std::span<const std::uint32_t> found) {
            counts.field_evaluations += found[IsosurfaceCount::evaluations];
            counts.excluded_intervals += found[IsosurfaceCount::excluded] + found[IsosurfaceCount::outside];
            counts.undecided_intervals += found[IsosurfaceCount::undecided];
            counts.isosurface_crossings += found[IsosurfaceCount::crossings];
        });
    }
}

} // namespace elvis
