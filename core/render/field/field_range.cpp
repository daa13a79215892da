#include <core/base/in_parts.hpp>
#include <core/base/infinity.hpp>
#include <core/expression/glsl.hpp>
#include <core/render/device/in_batches.hpp>
#include <core/render/field/field_range.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

namespace elvis {

namespace {

/** Elements whose ranges a thread asks for at once. */
constexpr std::uint64_t ranges_block = 16384;
constexpr std::uint32_t range_group_size = 32;

void include(FieldRange& range, double lower, double upper) {
    range.lower = std::min(range.lower, lower);
    range.upper = std::max(range.upper, upper);
}

} // namespace

std::vector<FieldRange> ranges_from_plugin(Background& background, const RuntimeVolume& volume, std::uint32_t field,
                                           std::uint32_t time_step, elvis_certainty& certainty,
                                           const std::function<void()>& check) {
    const std::size_t n_components = volume.fields()[field].n_components;
    std::vector<FieldRange> total(n_components, {infinity, -infinity});
    certainty = ELVIS_CERTIFIED;
    std::mutex mutex;
    const auto take_part = [&](std::uint64_t first, std::uint64_t count) {
        std::vector<FieldRange> ranges(count * n_components), of_part(n_components, {infinity, -infinity});
        const elvis_certainty how_sure = volume.field_ranges(field, time_step, first, count, ranges);
        for (std::size_t index = 0; index < ranges.size(); ++index) {
            // An element with values that are not finite has no range; the others have.
            if (std::isfinite(ranges[index].lower) && std::isfinite(ranges[index].upper)) {
                include(of_part[index % n_components], ranges[index].lower, ranges[index].upper);
            }
        }
        const std::lock_guard lock(mutex);
        certainty = std::max(certainty, how_sure);
        for (std::size_t component = 0; component < n_components; ++component) {
            include(total[component], of_part[component].lower, of_part[component].upper);
        }
    };
    in_parts(background, volume.n_elements(), ranges_block, take_part, check);
    return total;
}

double rounding_of_expression(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                              const Expression& expression) {
    struct ErrorParameters {
        std::uint32_t n_sampled, stride;
    };
    double largest = 0;
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const auto n_elements = static_cast<std::uint32_t>(volume.classes()[index].n_elements);
        if (n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.name = "expression_error of element class " + std::to_string(index);
        request.kernel = "field/expression_error.comp";
        request.watches_loops = true;
        request.precision = data.precision();
        request.buffers = data.host_buffers(index);
        data.add_field(request, index);
        request.text = error_glsl(expression, data.about_class(index));
        request.bindings = {{0, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(ErrorParameters);
        const std::uint32_t stride = divided_up(n_elements, expression_error_samples);
        const ErrorParameters parameters{divided_up(n_elements, stride), stride};
        const Buffer output(device, parameters.n_sampled * real_bytes(data.precision()));
        const std::array<const Buffer*, 1> bindings = {&output};
        ComposedKernel(device, request)
            .dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), divided_up(parameters.n_sampled, range_group_size));
        for (const double error : read_reals(output, data.precision(), parameters.n_sampled)) {
            largest = std::max(largest, error);
        }
    }
    return largest;
}

} // namespace elvis
