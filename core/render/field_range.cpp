#include <core/expression/glsl.hpp>
#include <core/render/field_range.hpp>
#include <core/render/real_array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace elvis {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t block = 65536;
constexpr std::uint32_t group_size = 32;
/** Elements of one dispatch: bounds its time. */
constexpr std::uint32_t elements_a_dispatch = 65536;
/** shaders/kernels/field_range.comp */
constexpr std::uint32_t n_points = 343, points_a_dispatch = 7;

struct Parameters {
    std::uint32_t first, n_elements, component;
    std::uint32_t first_point, end_point;
};

void include(FieldRange& range, double lower, double upper) {
    range.lower = std::min(range.lower, lower);
    range.upper = std::max(range.upper, upper);
}

} // namespace

std::vector<FieldRange> ranges_from_plugin(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step,
                                           elvis_certainty& certainty) {
    const std::size_t n_components = volume.fields()[field].n_components;
    std::vector<FieldRange> total(n_components, {infinity, -infinity});
    std::vector<FieldRange> ranges;
    certainty = ELVIS_CERTIFIED;
    for (std::uint64_t first = 0; first < volume.n_elements(); first += block) {
        const std::uint64_t count = std::min(block, volume.n_elements() - first);
        ranges.resize(count * n_components);
        certainty = std::max(certainty, volume.field_ranges(field, time_step, first, count, ranges));
        for (std::size_t index = 0; index < ranges.size(); ++index) {
            // An element with values that are not finite has no range; the others have.
            if (std::isfinite(ranges[index].lower) && std::isfinite(ranges[index].upper)) {
                include(total[index % n_components], ranges[index].lower, ranges[index].upper);
            }
        }
    }
    return total;
}

std::vector<FieldRange> ranges_from_samples(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                            std::uint32_t n_components) {
    std::vector<FieldRange> total(n_components, {infinity, -infinity});
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const auto n_elements = static_cast<std::uint32_t>(volume.classes()[index].n_elements);
        if (n_elements == 0) {
            continue;
        }
        KernelRequest request;
        request.name = "field_range of element class " + std::to_string(index);
        request.kernel = "kernels/field_range.comp";
        request.watches_loops = true;
        request.precision = data.precision();
        request.buffers = data.host_buffers(index);
        data.add_field(request, index);
        request.bindings = {{0, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(Parameters);
        const ComposedKernel kernel(device, request);
        const Buffer output(device, std::uint64_t{2} * elements_a_dispatch * sizeof(double));
        const std::array<const Buffer*, 1> bindings = {&output};
        for (std::uint32_t component = 0; component < n_components; ++component) {
            for (std::uint32_t first = 0; first < n_elements; first += elements_a_dispatch) {
                const std::uint32_t count = std::min(elements_a_dispatch, n_elements - first);
                for (std::uint32_t point = 0; point < n_points; point += points_a_dispatch) {
                    const Parameters parameters{first, count, component, point, point + points_a_dispatch};
                    kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (count + group_size - 1) / group_size);
                }
                const auto take = [&](const auto& numbers) {
                    for (std::size_t at = 0; at < numbers.size(); at += 2) {
                        if (numbers[at] <= numbers[at + 1]) {
                            include(total[component], static_cast<double>(numbers[at]), static_cast<double>(numbers[at + 1]));
                        }
                    }
                };
                if (data.precision() == Precision::float64) {
                    take(output.read_items<double>(std::size_t{2} * count));
                } else {
                    take(output.read_items<float>(std::size_t{2} * count));
                }
            }
        }
    }
    return total;
}

double rounding_of_expression(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                              const Expression& expression) {
    // Enough to meet what is large, and no more than a picture costs.
    constexpr std::uint32_t most_elements = 2048;
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
        request.kernel = "kernels/expression_error.comp";
        request.watches_loops = true;
        request.precision = data.precision();
        request.buffers = data.host_buffers(index);
        data.add_field(request, index);
        request.text = error_glsl(expression, data.about_class(index));
        request.bindings = {{0, BindingType::storage_buffer}};
        request.push_constant_bytes = sizeof(ErrorParameters);
        const std::uint32_t stride = (n_elements + most_elements - 1) / most_elements;
        const ErrorParameters parameters{(n_elements + stride - 1) / stride, stride};
        const Buffer output(device, parameters.n_sampled * real_bytes(data.precision()));
        const std::array<const Buffer*, 1> bindings = {&output};
        ComposedKernel(device, request)
            .dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (parameters.n_sampled + group_size - 1) / group_size);
        for (const double error : read_reals(output, data.precision(), parameters.n_sampled)) {
            largest = std::max(largest, error);
        }
    }
    return largest;
}

} // namespace elvis
