#include <core/render/pixel_kernel.hpp>
#include <core/render/real_array.hpp>
#include <core/render/volume_pass.hpp>
#include <core/segment/tables.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

constexpr std::uint32_t tile_height = 16;
/** Words of a tile's list: shaders/library/ray_tiles.glsl. */
constexpr std::uint32_t tile_stride = 64;
constexpr std::uint32_t group_size = 32;
/** Of the polynomials of one step. */
constexpr int step_degree = 5;
/** A ray has no more chains, and chains no more parts in different classes: far more than there are elements along a ray. */
constexpr std::uint32_t most_rounds = 4096;
/** Beyond all values, and a number in single precision. */
constexpr double unbounded = 3e38;
/** Of m_counts. */
constexpr std::size_t n_counts = 8;
enum SeekCount : std::size_t { seeking, seek_evaluations };
enum MarchCount : std::size_t { moved, evaluations, mappings, segments, empty_segments, steps, breakpoints, failures };
enum FinishCount : std::size_t { volume_pixels };

struct TilesParameters {
    std::uint32_t tiles_a_row, n_tiles;
};

struct SeekParameters {
    std::uint32_t width, height;
    std::uint32_t tiles_a_row;
    std::uint32_t first_row;
    std::uint32_t first_element;
    std::uint32_t zero;
    float extent;
};

struct MarchParameters {
    std::uint32_t width, height;
    std::uint32_t first_row;
    std::uint32_t first_element, n_elements;
    std::uint32_t first_component, end_component;
    std::uint32_t n_breakpoints;
    std::uint32_t has_depths, has_stops;
    std::uint32_t skips_by_range;
    std::uint32_t zero;
    float extent;
    float tolerance, steepest, step;
};

struct PixelParameters {
    std::uint32_t n_pixels, groups_x;
    float tolerance;
};

/** Bytes of one core_volume_state. */
std::size_t state_bytes(Precision precision) { return 9 * real_bytes(precision) + 4 * sizeof(std::uint32_t); }

std::uint32_t divided_up(std::uint32_t number, std::uint32_t by) { return (number + by - 1) / by; }

/** Makes the buffer anew if it is of another size. */
const Buffer& provide(std::optional<Buffer>& buffer, const Device& device, std::uint64_t bytes) {
    if (!buffer || buffer->bytes() != bytes) {
        buffer.reset();
        buffer.emplace(device, bytes);
    }
    return *buffer;
}

double largest(const std::array<double, 3>& numbers) {
    return std::max({std::abs(numbers[0]), std::abs(numbers[1]), std::abs(numbers[2])});
}

/** How much density and light per length change at most with the value, from `from` on over `width`. */
double steepness(const TransferPiece& piece, double width) {
    const double end = piece.density + piece.density_slope * width;
    const double color = std::max(largest(piece.rgb), largest({piece.rgb[0] + piece.rgb_slope[0] * width, piece.rgb[1] + piece.rgb_slope[1] * width,
                                                               piece.rgb[2] + piece.rgb_slope[2] * width}));
    return std::abs(piece.density_slope) * std::max(color, 1.0) + std::max(piece.density, end) * largest(piece.rgb_slope);
}

/** Whether the second does not begin as the first ends, in density or light, but for rounding. */
bool is_step(const TransferPiece& first, const TransferPiece& second) {
    const double width = second.from - first.from;
    const auto differ = [](double a, double b) { return std::abs(a - b) > 1e-9 * (std::abs(a) + std::abs(b)) + 1e-12; };
    const double density = first.density + first.density_slope * width;
    bool is_one = differ(density, second.density);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        is_one = is_one || differ(density * (first.rgb[channel] + first.rgb_slope[channel] * width), second.density * second.rgb[channel]);
    }
    return is_one;
}

} // namespace

struct VolumePass::Picture {
    const Layer& layer;
    /** Of opaque surfaces, and of the next transparent one; null if there is none. */
    const Buffer *depths, *stops;
    std::uint32_t tiles_a_row, n_tiles;
    bool only_live;
};

VolumePass::VolumePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_data(data), m_precision(data.precision()), m_tile_width(std::clamp(device.subgroup_size(), 8u, 64u)),
      m_chains(device, volume, data), m_models(device, volume, data),
      m_begin(device, pixel_kernel("volume_begin", data.precision(), {BindingType::storage_buffer}, sizeof(PixelParameters))),
      m_veil(device, pixel_kernel("volume_veil", data.precision(),
                                  {BindingType::storage_buffer, BindingType::storage_buffer, BindingType::storage_buffer,
                                   BindingType::storage_buffer},
                                  sizeof(PixelParameters))),
      m_finish(device, pixel_kernel("volume_finish", data.precision(),
                                    {BindingType::storage_buffer, BindingType::storage_buffer, BindingType::storage_buffer,
                                     BindingType::storage_buffer},
                                    sizeof(PixelParameters))),
      m_live(device, data.precision(), m_tile_width, tile_height),
      m_frame(device, cut_plane_rows * 4 * real_bytes(data.precision()), Buffer::Use::uniform),
      m_counts(device, n_counts * sizeof(std::uint32_t)) {
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double side = data.bounds()[axis + 3] - data.bounds()[axis];
        square += side * side;
    }
    m_extent = std::sqrt(square);
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        if (info.n_elements > 0) {
            ClassKernels kernels;
            kernels.element_class = index;
            kernels.first_element = info.first_element;
            kernels.n_elements = info.n_elements;
            m_kernels.push_back(std::move(kernels));
        }
    }
}

KernelRequest VolumePass::request_of(const ClassKernels& kernels, const char* name) const {
    KernelRequest request;
    request.name = std::string(name) + " of element class " + std::to_string(kernels.element_class);
    request.kernel = std::string("kernels/") + name + ".comp";
    request.precision = m_precision;
    request.buffers = m_chains.host_buffers(kernels.element_class);
    for (const FetchBuffer& buffer : m_data.host_buffers(kernels.element_class)) {
        if (buffer.name != "core_nodes") {
            request.buffers.push_back(buffer);
        }
    }
    request.defines = {{"CORE_TILE_WIDTH", std::to_string(m_tile_width) + "u"},
                       {"CORE_TILE_HEIGHT", std::to_string(tile_height) + "u"},
                       {"CORE_LEAF_WORD", "index"},
                       m_chains.curved_define(kernels.element_class)};
    request.bindings = {{0, BindingType::uniform_buffer}};
    return request;
}

void VolumePass::choose(const VolumeRendering& wanted, double offset, const ShownComponent& component) {
    const TransferTable table = cut_at_breakpoints(wanted.transfer);
    std::vector<double> values, pieces;
    for (const double value : table.breakpoints) {
        values.push_back(value - offset);
    }
    m_n_breakpoints = static_cast<std::uint32_t>(values.size());
    // Buffers are never empty.
    values.resize(std::max<std::size_t>(values.size(), 1));
    m_steepest = 1e-30;
    m_has_steps = false;
    for (std::size_t i = 0; i < table.pieces.size(); ++i) {
        const TransferPiece& piece = table.pieces[i];
        const bool is_bounded = i > 0 && i < table.breakpoints.size();
        const double steep = is_bounded ? steepness(piece, table.breakpoints[i] - piece.from) : 0;
        m_steepest = std::max(m_steepest, steep);
        m_has_steps = m_has_steps || (i > 0 && is_step(table.pieces[i - 1], piece));
        const double below = i > 0 ? table.breakpoints[i - 1] - offset : -unbounded;
        const double above = i < table.breakpoints.size() ? table.breakpoints[i] - offset : unbounded;
        const std::array<double, 12> rows = {piece.from - offset, piece.density, piece.density_slope, steep,
                                             piece.rgb[0], piece.rgb[1], piece.rgb[2], below,
                                             piece.rgb_slope[0], piece.rgb_slope[1], piece.rgb_slope[2], above};
        pieces.insert(pieces.end(), rows.begin(), rows.end());
    }
    write_reals(provide(m_breakpoints, m_device, values.size() * real_bytes(m_precision)), m_precision, values);
    write_reals(provide(m_pieces, m_device, pieces.size() * real_bytes(m_precision)), m_precision, pieces);
    m_wanted = wanted;
    m_component = component;
    m_models.provide({component.first(), component.end()});
    for (ClassKernels& kernels : m_kernels) {
        if (!kernels.seek) {
            KernelRequest tiles = request_of(kernels, "ray_tiles");
            tiles.defines.emplace_back("CORE_TESTS_STARTS", "1");
            tiles.bindings.push_back({1, BindingType::storage_buffer});
            tiles.bindings.push_back({2, BindingType::storage_buffer});
            tiles.push_constant_bytes = sizeof(TilesParameters);
            tiles.instances = {m_data.instance(kernels.element_class)};
            kernels.tiles = std::make_unique<ComposedKernel>(m_device, tiles);
            KernelRequest seek = request_of(kernels, "chain_seek");
            seek.instances = {m_data.instance(kernels.element_class)};
            for (std::uint32_t binding = 1; binding <= 3; ++binding) {
                seek.bindings.push_back({binding, BindingType::storage_buffer});
            }
            seek.push_constant_bytes = sizeof(SeekParameters);
            kernels.seek = std::make_unique<ComposedKernel>(m_device, seek);
        }
        march_kernel(kernels);
    }
}

const ComposedKernel& VolumePass::march_kernel(ClassKernels& kernels) {
    std::unique_ptr<ComposedKernel>& kernel = kernels.march[2 * static_cast<std::size_t>(m_wanted.integrator) + (m_has_steps ? 1 : 0)];
    if (!kernel) {
        KernelRequest request = request_of(kernels, "volume_march");
        request.buffers.push_back(m_models.host_buffer(kernels.element_class));
        m_data.add_field(request, kernels.element_class, true);
        request.text += segment::segment_glsl(segment::fixed_plan(step_degree));
        request.defines.emplace_back("CORE_INTEGRATOR", std::to_string(static_cast<int>(m_wanted.integrator)));
        request.defines.emplace_back("CORE_HAS_STEPS", m_has_steps ? "1" : "0");
        for (std::uint32_t binding = 1; binding <= 6; ++binding) {
            request.bindings.push_back({binding, BindingType::storage_buffer});
        }
        request.push_constant_bytes = sizeof(MarchParameters);
        kernel = std::make_unique<ComposedKernel>(m_device, request);
    }
    return *kernel;
}

void VolumePass::list_starts(ClassKernels& kernels, const Picture& picture) {
    const Buffer& lists = provide(kernels.tile_lists, m_device, std::uint64_t{picture.n_tiles} * tile_stride * sizeof(std::uint32_t));
    if (m_chains.n_starts(kernels.element_class) == 0) {
        lists.fill(0);
        return;
    }
    const TilesParameters parameters{picture.tiles_a_row, picture.n_tiles};
    const std::array<const Buffer*, 3> bindings = {&m_frame, &lists, &m_counts};
    kernels.tiles->dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(picture.n_tiles, group_size));
}

bool VolumePass::seek(const ClassKernels& kernels, const Picture& picture, std::span<const RayBox> boxes, FrameCounts& counts) {
    m_counts.fill(0);
    SeekParameters parameters{picture.layer.width, picture.layer.height, picture.tiles_a_row, 0,
                              static_cast<std::uint32_t>(kernels.first_element), 0, static_cast<float>(m_extent)};
    const std::array<const Buffer*, 4> bindings = {&m_frame, &*m_states, &*kernels.tile_lists, &m_counts};
    for (const RayBox& box : boxes) {
        parameters.first_row = box.first_row;
        kernels.seek->dispatch_from(box.first, bindings, std::as_bytes(std::span(&parameters, 1)), box.end - box.first,
                                    box.end_row - box.first_row);
    }
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_counts);
    counts.mapping_evaluations += found[seek_evaluations];
    return found[seeking] > 0;
}

bool VolumePass::march(ClassKernels& kernels, const Picture& picture, std::span<const RayBox> boxes, FrameCounts& counts) {
    m_counts.fill(0);
    MarchParameters parameters{picture.layer.width,
                               picture.layer.height,
                               0,
                               static_cast<std::uint32_t>(kernels.first_element),
                               static_cast<std::uint32_t>(kernels.n_elements),
                               m_component.first(),
                               m_component.end(),
                               m_n_breakpoints,
                               picture.depths ? 1u : 0u,
                               picture.stops ? 1u : 0u,
                               m_wanted.skips_by_range ? 1u : 0u,
                               0,
                               static_cast<float>(m_extent),
                               static_cast<float>(m_wanted.tolerance),
                               static_cast<float>(m_steepest),
                               static_cast<float>(m_wanted.step)};
    // What is not there is not read: anything of reals.
    const Buffer& depths = picture.depths ? *picture.depths : picture.layer.normals;
    const Buffer& stops = picture.stops ? *picture.stops : picture.layer.normals;
    const std::array<const Buffer*, 7> bindings = {&m_frame, &*m_states, &depths, &*m_breakpoints, &*m_pieces, &m_counts, &stops};
    const ComposedKernel& kernel = march_kernel(kernels);
    for (const RayBox& box : boxes) {
        parameters.first_row = box.first_row;
        kernel.dispatch_from(box.first, bindings, std::as_bytes(std::span(&parameters, 1)), box.end - box.first,
                             box.end_row - box.first_row);
    }
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(n_counts);
    counts.field_evaluations += found[evaluations];
    counts.mapping_evaluations += found[mappings];
    counts.volume_segments += found[segments];
    counts.empty_segments += found[empty_segments];
    counts.volume_steps += found[steps];
    counts.volume_breakpoints += found[breakpoints];
    counts.newton_failures += found[failures];
    return found[moved] > 0;
}

void VolumePass::march_all(const Picture& picture, FrameCounts& counts) {
    const std::uint32_t width = picture.layer.width, height = picture.layer.height;
    const std::array<RayBox, 1> whole = {RayBox{0, picture.tiles_a_row, 0, height}};
    const auto spare = [&](const std::vector<RayBox>& live) {
        std::uint64_t tiles = whole[0].area();
        for (const RayBox& box : live) {
            tiles -= box.area();
        }
        counts.spared_pixels += tiles * m_tile_width;
    };
    std::vector<RayBox> live(whole.begin(), whole.end());
    bool is_open = true;
    for (std::uint32_t round = 0; is_open && round < most_rounds; ++round) {
        bool is_seeking = false;
        if (picture.only_live) {
            live = m_live.seeking(*m_states, width, height);
        }
        for (const ClassKernels& kernels : m_kernels) {
            spare(live);
            is_seeking = seek(kernels, picture, live, counts) || is_seeking;
        }
        is_open = is_seeking;
        for (ClassKernels& kernels : m_kernels) {
            if (picture.only_live) {
                live = m_live.going(*m_states, width, height, static_cast<std::uint32_t>(kernels.first_element),
                                    static_cast<std::uint32_t>(kernels.n_elements));
            }
            spare(live);
            is_open = march(kernels, picture, live, counts) || is_open;
        }
    }
}

void VolumePass::draw(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged, bool only_live,
                      FrameCounts& counts) {
    const Layer& layer = merged.picture();
    const Buffer& states = provide(m_states, m_device, layer.n_pixels() * state_bytes(m_precision));
    write_reals(m_frame, m_precision, std::span<const double>(view.rows.front().data(), 4 * view.rows.size()));
    m_chains.look_from(start);
    const std::uint32_t tiles_a_row = divided_up(layer.width, m_tile_width);
    Picture picture{layer,
                    merged.depths(),
                    nullptr,
                    tiles_a_row,
                    tiles_a_row * divided_up(layer.height, tile_height),
                    only_live};
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const PixelParameters parameters{n_pixels, pixel_groups_x, static_cast<float>(m_wanted.tolerance)};
    const std::span<const std::byte> bytes = std::as_bytes(std::span(&parameters, 1));
    dispatch_pixels(m_begin, {&states}, bytes, n_pixels);
    for (ClassKernels& kernels : m_kernels) {
        list_starts(kernels, picture);
    }
    for (std::size_t i = 0; i < merged.n_veils(); ++i) {
        picture.stops = &merged.veil(i).depths;
        march_all(picture, counts);
        dispatch_pixels(m_veil, {&states, &merged.veil(i).colors, picture.stops, picture.depths}, bytes, n_pixels);
    }
    picture.stops = nullptr;
    march_all(picture, counts);
    m_counts.fill(0);
    dispatch_pixels(m_finish, {&states, &layer.colors, &layer.marks, &m_counts}, bytes, n_pixels);
    counts.volume_pixels += m_counts.read_items<std::uint32_t>(n_counts)[volume_pixels];
}

} // namespace elvis
