#include <core/render/color_pass.hpp>
#include <core/render/pixel_kernel.hpp>
#include <core/render/real_array.hpp>

#include <array>
#include <cmath>

namespace elvis {

namespace {

struct ColorParameters {
    std::uint32_t n_pixels, groups_x, width;
    std::uint32_t n_points, n_isovalues, n_clips;
    std::uint32_t common_flags;
    /** Of the two kinds of lines: 1 undecided pixels have a colour; contours: 2 they have a colour of their own. */
    std::uint32_t contour_style, mesh_style;
    float contour_reach, mesh_reach;
};

constexpr std::uint32_t with_undecided_color = 1;
constexpr std::uint32_t with_own_color = 2;

std::uint32_t style_bits(const LineStyle& style) {
    return (style.undecided_color ? with_undecided_color : 0u) | (style.color ? with_own_color : 0u);
}

/** From the middle of a pixel that meets the line, to that of the farthest that is drawn. */
float reach(const LineStyle& style) { return static_cast<float>(0.5 * (std::max(style.width, 1.0) - 1.0)); }

void append(std::vector<double>& numbers, const std::optional<std::array<double, 3>>& color) {
    const std::array<double, 3> rgb = color.value_or(std::array<double, 3>{});
    numbers.insert(numbers.end(), {rgb[0], rgb[1], rgb[2], 1.0});
}

} // namespace

ColorPass::ColorPass(const Device& device, Precision precision)
    : m_device(device), m_precision(precision),
      m_color(device, pixel_kernel("color", precision,
                                   {BindingType::uniform_buffer, BindingType::storage_buffer, BindingType::storage_buffer,
                                    BindingType::storage_buffer, BindingType::storage_buffer},
                                   sizeof(ColorParameters))),
      m_frame(device, cut_plane_rows * 4 * real_bytes(precision), Buffer::Use::uniform) {}

void ColorPass::draw(const Layer& layer, const Surface& surface, const CutPlaneGeometry& view, const Color& background,
                     double offset, std::uint32_t common_flags) {
    std::vector<double> numbers;
    const ColorTable& table = surface.colors;
    for (const ColorTable::Point& point : table.points) {
        numbers.insert(numbers.end(), {point.value - offset, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    for (const Color& color : {table.below, table.above, table.nan, background}) {
        numbers.insert(numbers.end(), color.begin(), color.end());
    }
    const LineStyle contour = surface.contours ? surface.contours->style : LineStyle{};
    const LineStyle mesh = surface.mesh_lines ? surface.mesh_lines->style : LineStyle{};
    for (const auto& color : {contour.color, contour.undecided_color, mesh.color, mesh.undecided_color}) {
        append(numbers, color);
    }
    numbers.insert(numbers.end(), {surface.opacity, 0, 0, 0});
    for (const std::array<double, 4>& plane : surface.clip) {
        // Relative to the reference point of the rays.
        const std::array<double, 4>& reference = view.rows[6];
        const double level = plane[0] * reference[0] + plane[1] * reference[1] + plane[2] * reference[2] + plane[3];
        numbers.insert(numbers.end(), {plane[0], plane[1], plane[2], level});
    }
    const std::vector<double> isovalues = surface.contours ? surface.contours->values : std::vector<double>{};
    for (const double value : isovalues) {
        numbers.insert(numbers.end(), {value - offset, 0, 0, 0});
    }
    const Buffer rows(m_device, numbers.size() * real_bytes(m_precision));
    write_reals(rows, m_precision, numbers);
    write_reals(m_frame, m_precision, std::span<const double>(view.rows.front().data(), 4 * view.rows.size()));
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const ColorParameters parameters{n_pixels,
                                     pixel_groups_x,
                                     layer.width,
                                     static_cast<std::uint32_t>(table.points.size()),
                                     static_cast<std::uint32_t>(isovalues.size()),
                                     static_cast<std::uint32_t>(surface.clip.size()),
                                     common_flags,
                                     style_bits(contour),
                                     style_bits(mesh),
                                     reach(contour),
                                     reach(mesh)};
    dispatch_pixels(m_color, {&m_frame, &layer.samples, &rows, &layer.colors, &layer.marks},
                    std::as_bytes(std::span(&parameters, 1)), n_pixels);
}

} // namespace elvis
