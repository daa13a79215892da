#include <core/render/color_pass.hpp>
#include <core/render/real_array.hpp>

#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t group_size = 256;
/** Groups along x; more pixels go along y, because a device need not allow more than 65535 in one direction. */
constexpr std::uint32_t groups_x = 1024;

struct ColorParameters {
    std::uint32_t n_pixels, groups_x, n_points, common_flags;
};

std::uint32_t groups_y(std::uint32_t n_pixels) { return (n_pixels + group_size * groups_x - 1) / (group_size * groups_x); }

KernelRequest request(const char* kernel, Precision precision, std::uint32_t n_bindings, std::uint32_t push_bytes) {
    KernelRequest result;
    result.name = kernel;
    result.kernel = std::string("kernels/") + kernel + ".comp";
    result.precision = precision;
    for (std::uint32_t binding = 0; binding < n_bindings; ++binding) {
        result.bindings.push_back({binding, BindingType::storage_buffer});
    }
    result.push_constant_bytes = push_bytes;
    return result;
}

} // namespace

ColorPass::ColorPass(const Device& device, Precision precision)
    : m_device(device), m_precision(precision), m_color(device, request("color", precision, 4, sizeof(ColorParameters))) {}

void ColorPass::draw(const SampleTarget& target, const Buffer& colors, const ColorTable& table, const Color& background,
                     double offset, std::uint32_t common_flags) const {
    std::vector<double> numbers;
    for (const ColorTable::Point& point : table.points) {
        numbers.insert(numbers.end(), {point.value - offset, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    for (const Color& color : {table.below, table.above, table.nan, background}) {
        numbers.insert(numbers.end(), color.begin(), color.end());
    }
    const Buffer points(m_device, numbers.size() * real_bytes(m_precision));
    write_reals(points, m_precision, numbers);
    const std::uint32_t n_pixels = target.width * target.height;
    const ColorParameters parameters{n_pixels, groups_x, static_cast<std::uint32_t>(table.points.size()), common_flags};
    const std::array<const Buffer*, 4> bindings = {&target.samples, &points, &colors, &target.marks};
    m_color.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), groups_x, groups_y(n_pixels));
}

} // namespace elvis
