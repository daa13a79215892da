#include <core/render/device/pixel_kernel.hpp>
#include <core/render/picture/merge_pass.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

struct MergeParameters {
    std::uint32_t n_pixels, groups_x;
    std::uint32_t surface;
    std::uint32_t has_normals;
    std::uint32_t is_first;
    std::uint32_t width;
};

struct MergePixelParameters {
    std::uint32_t n_pixels, groups_x;
};

} // namespace

std::vector<double> device_depths(std::span<const double> depths) {
    constexpr double behind_all = 3e38; // CORE_FAR
    std::vector<double> finite(depths.begin(), depths.end());
    std::ranges::replace_if(
        finite, [](double depth) { return !(depth < behind_all); }, behind_all);
    return finite;
}

MergePass::MergePass(const Device& device, Precision precision)
    : m_device(device), m_precision(precision),
      m_merge(device, pixel_kernel("picture/merge", precision, {.storage = 12}, sizeof(MergeParameters))),
      m_take(device, pixel_kernel("picture/take_layer", precision, {.storage = 5}, sizeof(MergePixelParameters))),
      m_order(device, pixel_kernel("picture/order_layers", precision, {.storage = 4}, sizeof(MergePixelParameters))),
      m_blend(device, pixel_kernel("picture/blend", precision, {.storage = 4}, sizeof(MergePixelParameters))),
      m_fill(device, pixel_kernel("picture/background", precision, {.storage = 2}, sizeof(MergePixelParameters))),
      m_counts(device, 3 * sizeof(std::uint32_t)), m_background_color(device, 4 * real_bytes(precision)) {}

void MergePass::begin(std::uint32_t width, std::uint32_t height, const PixelRows& rows, const Color& background) {
    if (!m_picture || m_picture->width != width || m_picture->height != height) {
        m_transparent_layers.clear();
        m_picture = std::make_unique<Layer>(m_device, m_precision, width, height);
        m_depths = std::make_unique<Buffer>(m_device, m_picture->n_pixels() * real_bytes(m_precision));
        m_beyond = std::make_unique<Buffer>(m_device, m_picture->n_pixels() * real_bytes(m_precision));
    }
    m_picture->rows = rows;
    m_n_transparent_layers = 0;
    write_reals(m_background_color, m_precision, background);
    m_is_empty = true;
}

MergePass::Wanted MergePass::merge(const Layer& layer, std::uint32_t surface, bool has_normals, bool is_see_through) {
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const MergeParameters parameters{n_pixels,   pixel_groups_x, surface, has_normals ? 1u : 0u, m_is_empty ? 1u : 0u,
                                     layer.width};
    constexpr std::array<std::uint32_t, 3> no_rows = {0, 0xffffffffu, 0};
    m_counts.write_items(std::span<const std::uint32_t>(no_rows));
    const std::vector<const Buffer*> bindings = {
        &layer.samples,      &layer.marks,       &layer.normals, &layer.colors,  &m_picture->samples, &m_picture->marks,
        &m_picture->normals, &m_picture->colors, m_depths.get(), m_beyond.get(), &m_counts,           &m_background_color};
    const std::span<const std::byte> bytes = std::as_bytes(std::span(&parameters, 1));
    if (m_is_empty) {
        // The background, too.
        dispatch_pixels(m_merge, bindings, bytes, n_pixels);
    } else {
        dispatch_rows(m_merge, bindings, bytes, layer);
    }
    m_is_empty = false;
    if (!is_see_through) {
        return {};
    }
    keep(layer);
    const std::vector<std::uint32_t> found = m_counts.read_items<std::uint32_t>(3);
    return {found[0], found[1], found[2]};
}

void MergePass::keep(const Layer& layer) {
    if (m_n_transparent_layers == m_transparent_layers.size()) {
        const std::uint64_t bytes = layer.n_pixels() * real_bytes(m_precision);
        m_transparent_layers.push_back({Buffer(m_device, 4 * bytes), Buffer(m_device, bytes)});
    }
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const MergePixelParameters parameters{n_pixels, pixel_groups_x};
    const std::span<const std::byte> bytes = std::as_bytes(std::span(&parameters, 1));
    const TransparentLayer& taken = m_transparent_layers[m_n_transparent_layers];
    dispatch_rows(m_take, {&layer.samples, &layer.marks, &layer.colors, &taken.colors, &taken.depths}, bytes, layer);
    // Insertion: the new layer moves forward past every one that is farther.
    for (std::size_t i = m_n_transparent_layers; i > 0; --i) {
        const TransparentLayer& nearer = m_transparent_layers[i - 1];
        const TransparentLayer& farther = m_transparent_layers[i];
        dispatch_rows(m_order, {&nearer.colors, &nearer.depths, &farther.colors, &farther.depths}, bytes, layer);
    }
    ++m_n_transparent_layers;
}

void MergePass::fill_empty() {
    if (m_is_empty) {
        const auto n_pixels = static_cast<std::uint32_t>(m_picture->n_pixels());
        const MergePixelParameters parameters{n_pixels, pixel_groups_x};
        dispatch_pixels(m_fill, {&m_picture->colors, &m_background_color}, std::as_bytes(std::span(&parameters, 1)), n_pixels);
        m_picture->marks.fill(0);
    }
}

void MergePass::hide_behind(std::span<const double> depths) {
    fill_empty();
    write_reals(*m_depths, m_precision, device_depths(depths));
    m_is_empty = false;
}

void MergePass::finish() {
    const auto n_pixels = static_cast<std::uint32_t>(m_picture->n_pixels());
    const MergePixelParameters parameters{n_pixels, pixel_groups_x};
    for (std::size_t i = m_n_transparent_layers; i > 0; --i) {
        const TransparentLayer& layer = m_transparent_layers[i - 1];
        dispatch_rows(m_blend, {&layer.colors, &layer.depths, &m_picture->colors, m_depths.get()},
                      std::as_bytes(std::span(&parameters, 1)), *m_picture);
    }
}

} // namespace elvis
