#include <core/render/device/pixel_kernel.hpp>
#include <core/render/picture/color_pass.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace elvis {

namespace {

struct ColorParameters {
    std::uint32_t n_pixels, groups_x, width;
    std::uint32_t n_points, n_isovalues, n_clips;
    std::uint32_t common_flags;
    std::uint32_t surface;
    /** Of the two kinds of lines: 1 undecided pixels have a colour; contours: 2 they have colours of their own, 4 undecided
     * pixels without a colour are not drawn. */
    std::uint32_t contour_style, mesh_style;
    float contour_reach, mesh_reach;
    std::uint32_t is_plane;
};

/** Words a surface: whether there are values below, above, and none at all, and whether a pixel shows it. */
constexpr std::size_t n_special = 4;

constexpr std::uint32_t with_undecided_color = 1;
constexpr std::uint32_t with_own_color = 2;
constexpr std::uint32_t only_decided = 4;

std::uint32_t style_bits(const LineStyle& style) {
    return (style.undecided_color ? with_undecided_color : 0u) | (style.color ? with_own_color : 0u);
}

float half_width(const LineStyle& style) { return static_cast<float>(0.5 * style.width); }

bool has_wide_lines(const Surface& surface) {
    return (surface.contours && surface.contours->style.width > 1) ||
           (surface.mesh_lines && surface.mesh_lines->style.width > 1);
}

void append(std::vector<double>& numbers, const std::optional<std::array<double, 3>>& color) {
    const std::array<double, 3> rgb = color.value_or(std::array<double, 3>{});
    numbers.insert(numbers.end(), {rgb[0], rgb[1], rgb[2], 1.0});
}

/**
 * Values up to the first have no place on the table's scale; below the second and above the third they are outside by more than
 * rounding may have done (core/render/frame.hpp).
 */
std::array<double, 3> special_limits(const ColorTable& table, Precision precision) {
    constexpr double beyond = 1e-4;
    const double lower = table.points.front().value, upper = table.points.back().value;
    if (table.is_logarithmic) {
        const double factor = std::exp(beyond * (std::log(upper) - std::log(lower)));
        return {0, lower / factor, upper * factor};
    }
    const double least = precision == Precision::float64 ? std::numeric_limits<double>::lowest()
                                                         : static_cast<double>(std::numeric_limits<float>::lowest());
    return {least, lower - beyond * (upper - lower), upper + beyond * (upper - lower)};
}

KernelRequest color_kernel(Precision precision, const Surface& surface, bool is_lit) {
    const bool has_lines = surface.has_lines(), is_clipped = !surface.clip.empty(), is_shaded = surface.lic.has_value();
    const bool is_wide = has_wide_lines(surface);
    const std::string name = std::string(is_lit ? "lit_color" : "color") +
                             (is_wide     ? "_with_wide_lines"
                              : has_lines ? "_with_lines"
                                          : "") +
                             (is_clipped ? "_clipped" : "") + (is_shaded ? "_shaded" : "");
    const BufferCounts buffers{.uniform = 1, .storage = (is_lit ? 8u : 6u) + (is_shaded ? 1u : 0u) + (is_wide ? 1u : 0u)};
    KernelRequest request = pixel_kernel(name, precision, buffers, sizeof(ColorParameters));
    request.kernel = "picture/color.comp";
    request.defines.emplace_back("CORE_IS_LIT", is_lit ? "1" : "0");
    request.defines.emplace_back("CORE_HAS_LINES", has_lines ? "1" : "0");
    request.defines.emplace_back("CORE_HAS_WIDE_LINES", is_wide ? "1" : "0");
    request.defines.emplace_back("CORE_IS_CLIPPED", is_clipped ? "1" : "0");
    request.defines.emplace_back("CORE_IS_SHADED", is_shaded ? "1" : "0");
    return request;
}

} // namespace

ColorPass::ColorPass(const Device& device, Precision precision)
    : m_device(device), m_precision(precision), m_frame(view_buffer(device, precision)) {}

const ComposedKernel& ColorPass::provide(const Surface& surface, bool is_lit) {
    const bool is_wide = has_wide_lines(surface);
    if (is_wide && !m_stretches_pass) {
        m_stretches_pass = std::make_unique<LineStretchesPass>(m_device, m_precision);
    }
    std::unique_ptr<ComposedKernel>& kernel =
        m_kernels[{surface.has_lines(), is_wide, is_lit, !surface.clip.empty(), surface.lic.has_value()}];
    if (!kernel) {
        kernel = std::make_unique<ComposedKernel>(m_device, color_kernel(m_precision, surface, is_lit));
    }
    return *kernel;
}

void ColorPass::begin(std::size_t n_surfaces) {
    if (!m_special || n_surfaces > m_n_surfaces) {
        m_special = std::make_unique<Buffer>(m_device, n_surfaces * n_special * sizeof(std::uint32_t));
    }
    m_n_surfaces = n_surfaces;
    m_special->fill(0);
}

std::vector<SpecialValues> ColorPass::special_values(std::span<const std::uint32_t> words) const {
    std::vector<SpecialValues> result;
    for (std::size_t at = 0; at < n_special * m_n_surfaces; at += n_special) {
        result.push_back({words[at] != 0, words[at + 1] != 0, words[at + 2] != 0, words[at + 3] != 0});
    }
    return result;
}

void ColorPass::draw(const Layer& layer, const Surface& surface, std::size_t index, const CutPlaneGeometry& view,
                     const Color& background, double offset, std::uint32_t common_flags, const Lighting* lighting,
                     const Buffer* shades) {
    std::vector<double> numbers;
    const ColorTable& table = surface.colors;
    for (const ColorTable::Point& point : table.points) {
        numbers.insert(numbers.end(), {point.value - offset, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    for (const Color& color : {table.below, table.above, table.nan, background}) {
        numbers.insert(numbers.end(), color.begin(), color.end());
    }
    const LineStyle contour = surface.contours ? surface.contours->style : LineStyle{};
    const bool has_inks = surface.contours && !surface.contours->inks.empty();
    const LineStyle mesh = surface.mesh_lines ? surface.mesh_lines->style : LineStyle{};
    for (const auto& color : {contour.undecided_color, mesh.color, mesh.undecided_color}) {
        append(numbers, color);
    }
    const std::array<double, 3> outside = surface.outside.value_or(std::array<double, 3>{});
    numbers.insert(numbers.end(), {surface.opacity, outside[0], outside[1], outside[2]});
    const std::array<double, 3> limits = special_limits(table, m_precision);
    numbers.insert(numbers.end(), {limits[0] - offset, limits[1] - offset, limits[2] - offset, 0});
    for (const std::array<double, 4>& plane : surface.clip) {
        // Relative to the reference point of the rays.
        const std::array<double, 4>& reference = view.rows[6];
        const double level = plane[0] * reference[0] + plane[1] * reference[1] + plane[2] * reference[2] + plane[3];
        numbers.insert(numbers.end(), {plane[0], plane[1], plane[2], level});
    }
    const std::vector<double> isovalues = surface.contours ? surface.contours->values : std::vector<double>{};
    for (std::size_t i = 0; i < isovalues.size(); ++i) {
        const std::array<double, 3> rgb = surface.contours->color(i);
        numbers.insert(numbers.end(), {isovalues[i] - offset, rgb[0], rgb[1], rgb[2]});
    }
    const Buffer rows(m_device, numbers.size() * real_bytes(m_precision));
    write_reals(rows, m_precision, numbers);
    write_view(m_frame, m_precision, view);
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const ColorParameters parameters{n_pixels,
                                     pixel_groups_x,
                                     layer.width,
                                     static_cast<std::uint32_t>(table.points.size()),
                                     static_cast<std::uint32_t>(isovalues.size()),
                                     static_cast<std::uint32_t>(surface.clip.size()),
                                     common_flags,
                                     static_cast<std::uint32_t>(index),
                                     style_bits(contour) | (has_inks ? with_own_color | only_decided : 0u),
                                     style_bits(mesh),
                                     half_width(contour),
                                     half_width(mesh),
                                     traits_of(surface.geometry).plane != nullptr ? 1u : 0u};
    const std::span<const std::byte> push_constants = std::as_bytes(std::span(&parameters, 1));
    std::vector<const Buffer*> bindings = {&m_frame,     &layer.samples,  &rows,       &layer.colors,
                                           &layer.marks, m_special.get(), &layer.marks};
    std::optional<Buffer> lights;
    if (lighting) {
        const std::array<double, 4>& reference = view.rows[6];
        const std::vector<double> light_numbers = lighting_rows(*lighting, {reference[0], reference[1], reference[2]});
        write_reals(lights.emplace(m_device, light_numbers.size() * real_bytes(m_precision)), m_precision, light_numbers);
        bindings.insert(bindings.end(), {&*lights, &layer.normals});
    }
    if (shades) {
        bindings.push_back(shades);
    }
    if (has_wide_lines(surface)) {
        std::vector<double> levels = isovalues;
        std::ranges::transform(levels, levels.begin(), [&](double value) { return value - offset; });
        bindings.push_back(&m_stretches_pass->draw(layer, levels));
    }
    dispatch_rows(provide(surface, lighting != nullptr), bindings, push_constants, layer);
}

} // namespace elvis
