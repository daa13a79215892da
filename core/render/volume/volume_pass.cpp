#include <core/expression/expression.hpp>
#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/volume/volume_pass.hpp>
#include <core/segment/tables.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

/** Of the polynomials of one step. */
constexpr int step_degree = 5;
/** A ray has no more walks, and walks no more segments in different classes: far more than there are elements along a ray. */
constexpr std::uint32_t most_volume_rounds = 4096;
/** Beyond all values, and a number in single precision. */
constexpr double unbounded = 3e38;
/** Of m_counts. */
constexpr std::size_t n_volume_counts = 8;
struct VolumeMarchCount {
    enum : std::size_t { moved, evaluations, mappings, segments, empty_segments, steps, breakpoints, failures };
};
enum FinishCount : std::size_t { volume_pixels };

struct VolumeMarchParameters {
    std::uint32_t width, height;
    std::uint32_t first_group;
    std::uint32_t first_element, n_elements;
    std::uint32_t first_component, end_component;
    std::uint32_t n_breakpoints;
    std::uint32_t has_depths, has_stops;
    std::uint32_t skips_by_range;
    std::uint32_t zero;
    float extent, data_error;
    float tolerance, steepest, step;
};

struct VolumePixelParameters {
    std::uint32_t n_pixels, groups_x;
    float tolerance, color_error;
};

/**
 * Of the tolerance, for colours of fewer breakpoints: light of a ray is off by no more, as it is a mean of colours. Coolwarm
 * has 255 pieces, within 1/4 of 0.001 it has 55; 1/8 leaves 82.
 */
constexpr double color_share = 0.25;

double largest(const std::array<double, 3>& numbers) {
    return std::max({std::abs(numbers[0]), std::abs(numbers[1]), std::abs(numbers[2])});
}

/** How much density and light per length change at most with the value, from `from` on over `width`. */
double steepness(const TransferPiece& piece, double width) {
    const double end = piece.density + piece.density_slope * width;
    const double color = std::max(largest(piece.rgb),
                                  largest({piece.rgb[0] + piece.rgb_slope[0] * width, piece.rgb[1] + piece.rgb_slope[1] * width,
                                           piece.rgb[2] + piece.rgb_slope[2] * width}));
    return std::abs(piece.density_slope) * std::max(color, 1.0) + std::max(piece.density, end) * largest(piece.rgb_slope);
}

/** Whether the second does not begin as the first ends, in density or light, but for rounding. */
bool is_jump(const TransferPiece& first, const TransferPiece& second) {
    const double width = second.from - first.from;
    const auto differ = [](double a, double b) { return std::abs(a - b) > 1e-9 * (std::abs(a) + std::abs(b)) + 1e-12; };
    const double density = first.density + first.density_slope * width;
    bool is_one = differ(density, second.density);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        is_one = is_one || differ(density * (first.rgb[channel] + first.rgb_slope[channel] * width),
                                  second.density * second.rgb[channel]);
    }
    return is_one;
}

} // namespace

struct VolumePass::Picture {
    const Layer& layer;
    /** Of opaque surfaces, and of the next transparent one; null if there is none. */
    const Buffer *depths, *stops;
    WalkRays rays;
    bool only_live;
    /** Where light goes on the way; null if all stays with the rays. */
    LightRuns* runs;
};

namespace {

/** Of the field in the class, along a straight line in reference coordinates; what is no polynomial counts as one of order 8.
 */
int degree_along_line(const RuntimeVolume& volume, std::uint32_t element_class, std::uint32_t field) {
    constexpr int otherwise = 8;
    const elvis_shape shape = volume.classes()[element_class].shape;
    const bool is_simplex = shape == ELVIS_SHAPE_TETRAHEDRON || shape == ELVIS_SHAPE_TRIANGLE;
    int sum = 0, largest = 0;
    for (const std::int32_t order : volume.class_field(element_class, field).order) {
        const int known = order < 0 ? otherwise : order;
        sum += known;
        largest = std::max(largest, known);
    }
    return is_simplex ? largest : sum;
}

/** Of what is shown. */
int degree_along_line(const RuntimeVolume& volume, std::uint32_t element_class, const FieldChoice& choice) {
    const std::vector<std::uint32_t> fields = choice.expression ? choice.expression->fields() : std::vector{choice.field};
    int degree = 1;
    for (const std::uint32_t field : fields) {
        degree = std::max(degree, degree_along_line(volume, element_class, field));
    }
    return degree;
}

/**
 * How often a segment is halved at least by the adaptive rule: so that values and slopes at its samples, two intervals a step,
 * are as many numbers as the field has along a line. With fewer a peak between samples can be missed whole.
 */
std::uint32_t first_level(int degree) {
    constexpr std::uint32_t most = 4;
    std::uint32_t level = 0;
    while (level < most && 2 * ((2 << level) + 1) < degree + 1) {
        ++level;
    }
    return level;
}

} // namespace

VolumePass::VolumePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data)
    : m_device(device), m_volume(volume), m_data(data), m_precision(data.precision()), m_walk_data(device, volume, data),
      m_search(device, data, m_walk_data, volume, {}, false), m_models(device, volume, data),
      m_begin(device, pixel_kernel("volume/volume_begin", data.precision(), {.storage = 1}, sizeof(VolumePixelParameters))),
      m_transparent_layer(
          device, pixel_kernel("volume/volume_transparency", data.precision(), {.storage = 4}, sizeof(VolumePixelParameters))),
      m_finish(device, pixel_kernel("volume/volume_finish", data.precision(), {.storage = 4}, sizeof(VolumePixelParameters))),
      m_live(device, data.precision(), m_search.tile_width(), WalkSearch::tile_height),
      m_frame(view_buffer(device, data.precision())), m_counts(device, n_volume_counts * sizeof(std::uint32_t)),
      m_march(m_search.ranges().size()) {}

void VolumePass::choose(const VolumeRendering& wanted, double offset, const ShownComponent& component) {
    const TransferTable table =
        cut_at_breakpoints(wanted.transfer, has_steps(wanted.integrator) ? 0 : color_share * wanted.tolerance);
    m_color_error = table.color_error;
    std::vector<double> values, pieces;
    for (const double value : table.breakpoints) {
        values.push_back(value - offset);
    }
    m_n_breakpoints = static_cast<std::uint32_t>(values.size());
    // Buffers are never empty.
    values.resize(std::max<std::size_t>(values.size(), 1));
    m_steepest = 1e-30;
    m_has_jumps = false;
    for (std::size_t i = 0; i < table.pieces.size(); ++i) {
        const TransferPiece& piece = table.pieces[i];
        const bool is_bounded = i > 0 && i < table.breakpoints.size();
        const double steep = is_bounded ? steepness(piece, table.breakpoints[i] - piece.from) : 0;
        m_steepest = std::max(m_steepest, steep);
        m_has_jumps = m_has_jumps || (i > 0 && is_jump(table.pieces[i - 1], piece));
        const double below = i > 0 ? table.breakpoints[i - 1] - offset : -unbounded;
        const double above = i < table.breakpoints.size() ? table.breakpoints[i] - offset : unbounded;
        const std::array<double, 12> rows = {piece.from - offset, piece.density,      piece.density_slope, steep,
                                             piece.rgb[0],        piece.rgb[1],       piece.rgb[2],        below,
                                             piece.rgb_slope[0],  piece.rgb_slope[1], piece.rgb_slope[2],  above};
        pieces.insert(pieces.end(), rows.begin(), rows.end());
    }
    write_reals(provide_buffer(m_breakpoints, m_device, values.size() * real_bytes(m_precision)), m_precision, values);
    write_reals(provide_buffer(m_pieces, m_device, pieces.size() * real_bytes(m_precision)), m_precision, pieces);
    m_wanted = wanted;
    m_component = component;
    m_models.provide({component.first(), component.end()});
    m_search.compile();
    for (std::size_t index = 0; index < m_march.size(); ++index) {
        march_kernel(index);
    }
}

const ComposedKernel& VolumePass::march_kernel(std::size_t index) {
    const std::pair key{m_wanted.integrator, m_has_jumps};
    const auto compiled = m_march[index].find(key);
    if (compiled != m_march[index].end()) {
        return compiled->second;
    }
    const WalkSearch::Range& range = m_search.ranges()[index];
    KernelRequest request = m_search.request(range, "volume/volume_march");
    request.buffers.push_back(m_models.host_buffer(range.element_class));
    m_data.add_field(request, range.element_class, true);
    request.text += segment::segment_glsl(segment::fixed_plan(step_degree));
    request.defines.emplace_back("CORE_INTEGRATOR", std::to_string(static_cast<int>(m_wanted.integrator)));
    request.defines.emplace_back("CORE_HAS_JUMPS", m_has_jumps ? "1" : "0");
    const int degree = degree_along_line(m_volume, range.element_class, m_wanted.field);
    request.defines.emplace_back("CORE_FIELD_DEGREE", std::to_string(degree));
    request.defines.emplace_back("CORE_FIRST_LEVEL", std::to_string(first_level(degree)) + "u");
    request.bindings = buffer_bindings({.uniform = 1, .storage = 7});
    request.push_constant_bytes = sizeof(VolumeMarchParameters);
    return m_march[index].try_emplace(key, m_device, request).first->second;
}

void VolumePass::march(std::size_t index, const Picture& picture, const RayGroups& groups) {
    const VolumeMarchParameters parameters{picture.layer.width,
                                           picture.layer.height,
                                           0,
                                           m_search.ranges()[index].first_element,
                                           m_search.ranges()[index].n_elements,
                                           m_component.first(),
                                           m_component.end(),
                                           m_n_breakpoints,
                                           picture.depths ? 1u : 0u,
                                           picture.stops ? 1u : 0u,
                                           m_wanted.skips_by_range ? 1u : 0u,
                                           0,
                                           m_search.extent(),
                                           m_search.data_error(),
                                           static_cast<float>(m_wanted.tolerance),
                                           static_cast<float>(m_steepest),
                                           static_cast<float>(m_wanted.step)};
    // What is not there is not read: anything of reals.
    const Buffer& depths = picture.depths ? *picture.depths : picture.layer.normals;
    const Buffer& stops = picture.stops ? *picture.stops : picture.layer.normals;
    const std::array<const Buffer*, 8> bindings = {&m_frame,   &*m_states, &depths, &*m_breakpoints,
                                                   &*m_pieces, &m_counts,  &stops,  groups.list};
    groups.dispatch(march_kernel(index), bindings, parameters);
}

/** Whether rays have moved, or look for a start. */
bool VolumePass::count(FrameCounts& counts) const {
    const std::vector<std::vector<std::uint32_t>> words = Buffer::read_words({&m_search.counts(), &m_counts});
    const WalkSearch::Found starts = WalkSearch::found_in(words[0]);
    const std::vector<std::uint32_t>& found = words[1];
    counts.field_evaluations += found[VolumeMarchCount::evaluations];
    counts.mapping_evaluations += found[VolumeMarchCount::mappings] + starts.evaluations;
    counts.volume_segments += found[VolumeMarchCount::segments];
    counts.empty_segments += found[VolumeMarchCount::empty_segments];
    counts.volume_steps += found[VolumeMarchCount::steps];
    counts.volume_breakpoints += found[VolumeMarchCount::breakpoints];
    counts.newton_failures += found[VolumeMarchCount::failures];
    return starts.is_seeking || found[VolumeMarchCount::moved] > 0;
}

void VolumePass::march_all(const Picture& picture, FrameCounts& counts) {
    const RayGroups all = m_live.all();
    RayGroups live = all;
    const auto spare = [&] { counts.spared_pixels += std::uint64_t{all.count - live.count} * m_search.tile_width(); };
    bool is_open = true;
    for (std::uint32_t round = 0; is_open && round < most_volume_rounds; ++round) {
        m_search.begin_search();
        m_counts.fill(0);
        if (picture.only_live) {
            live = m_live.seeking();
        }
        for (std::size_t index = 0; index < m_march.size(); ++index) {
            spare();
            m_search.seek(index, picture.rays, live);
        }
        if (picture.runs != nullptr) {
            picture.runs->take(m_frame, *m_states, LightRuns::When::between_walks);
        }
        for (std::size_t index = 0; index < m_march.size(); ++index) {
            if (picture.only_live) {
                const WalkSearch::Range& range = m_search.ranges()[index];
                live = m_live.going(range.first_element, range.n_elements);
            }
            spare();
            march(index, picture, live);
        }
        is_open = count(counts);
    }
}

VolumePass::Picture VolumePass::begin(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged,
                                      bool only_live, double color_error, FrameCounts& counts) {
    const Layer& layer = merged.picture();
    const Buffer& states = provide_buffer(m_states, m_device, layer.n_pixels() * volume_state_bytes(m_precision));
    write_view(m_frame, m_precision, view);
    m_walk_data.look_from(start);
    Picture picture{layer, merged.depths(), nullptr, {layer.width, layer.height, m_frame, states, nullptr}, only_live, nullptr};
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const VolumePixelParameters parameters{n_pixels, pixel_groups_x, static_cast<float>(m_wanted.tolerance),
                                           static_cast<float>(color_error)};
    dispatch_pixels(m_begin, {&states}, std::as_bytes(std::span(&parameters, 1)), n_pixels);
    m_search.list_starts(picture.rays);
    m_live.begin(states, m_search.has_starts(), layer.width, layer.height);
    counts.mapping_evaluations += m_search.start_at_eyes(picture.rays, m_live.all());
    return picture;
}

void VolumePass::draw(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged, bool only_live,
                      FrameCounts& counts) {
    Picture picture = begin(view, start, merged, only_live, m_color_error, counts);
    const Layer& layer = picture.layer;
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const VolumePixelParameters parameters{n_pixels, pixel_groups_x, static_cast<float>(m_wanted.tolerance),
                                           static_cast<float>(m_color_error)};
    const std::span<const std::byte> bytes = std::as_bytes(std::span(&parameters, 1));
    for (std::size_t i = 0; i < merged.n_transparent_layers(); ++i) {
        picture.stops = &merged.transparent_layer(i).depths;
        march_all(picture, counts);
        dispatch_rows(m_transparent_layer, {&*m_states, &merged.transparent_layer(i).colors, picture.stops, picture.depths},
                      bytes, layer);
    }
    picture.stops = nullptr;
    march_all(picture, counts);
    m_counts.fill(0);
    dispatch_pixels(m_finish, {&*m_states, &layer.colors, &layer.marks, &m_counts}, bytes, n_pixels);
    counts.volume_pixels += m_counts.read_items<std::uint32_t>(n_volume_counts)[volume_pixels];
}

std::vector<LightRun> VolumePass::runs(const CutPlaneGeometry& view, const ViewStart& start, const MergePass& merged,
                                       std::span<const std::vector<double>> stops, bool only_live, FrameCounts& counts) {
    Picture picture = begin(view, start, merged, only_live, 0, counts);
    if (!m_runs) {
        m_runs.emplace(m_device, m_precision);
    }
    picture.runs = &*m_runs;
    m_runs->begin(picture.layer.width, picture.layer.height);
    for (const std::vector<double>& depths : stops) {
        picture.stops = &provide_buffer(m_stops, m_device, depths.size() * real_bytes(m_precision));
        write_reals(*m_stops, m_precision, device_depths(depths));
        march_all(picture, counts);
        m_runs->take(m_frame, *m_states, LightRuns::When::at_stop);
    }
    picture.stops = nullptr;
    march_all(picture, counts);
    m_runs->take(m_frame, *m_states, LightRuns::When::at_end);
    return m_runs->sorted();
}

} // namespace elvis
