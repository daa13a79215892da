/**
 * @file bound_rows.hpp
 * What kernels fetch from the bounds of a class's elements.
 */
#pragma once

#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>

#include <array>
#include <vector>

namespace elvis::test {

/** (H, L, F, certainty) by element of the class, then component, in double. */
inline std::vector<std::array<double, 4>> bound_rows(const Device& device, const DeviceVolume& data,
                                                     std::uint32_t element_class, std::uint32_t n_elements,
                                                     std::uint32_t n_components) {
    KernelRequest request;
    request.name = "bound rows";
    request.kernel = "bound_rows.comp";
    request.kernel_text = R"(
layout(local_size_x = 32) in;
layout(set = 0, binding = 0, std430) writeonly buffer core_output { elvis_real core_rows[]; };
layout(push_constant) uniform core_parameters { uint core_n_elements, core_n_components; };
void main() {
    const uint row = gl_GlobalInvocationID.x;
    if (row >= core_n_elements * core_n_components) {
        return;
    }
    const elvis_vec4 numbers = elvis_fetch4_core_bounds(row / core_n_components, row % core_n_components);
    for (uint i = 0u; i < 4u; ++i) {
        core_rows[4u * row + i] = numbers[i];
    }
}
)";
    request.precision = data.precision();
    request.instances = {data.instance(element_class)};
    request.buffers = {data.derivative_bounds(element_class)};
    request.bindings = {{0, BindingType::storage_buffer}};
    request.push_constant_bytes = 8;
    const ComposedKernel kernel(device, request);
    const std::size_t n_rows = std::size_t{n_elements} * n_components;
    const Buffer output(device, 4 * n_rows * sizeof(double));
    const std::array<const Buffer*, 1> bindings{&output};
    const std::array<std::uint32_t, 2> parameters{n_elements, n_components};
    kernel.dispatch(bindings, std::as_bytes(std::span(parameters)), static_cast<std::uint32_t>((n_rows + 31) / 32));
    std::vector<std::array<double, 4>> rows(n_rows);
    const auto take = [&rows](const auto& numbers) {
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            rows[i / 4][i % 4] = static_cast<double>(numbers[i]);
        }
    };
    if (data.precision() == Precision::float64) {
        take(output.read_items<double>(4 * n_rows));
    } else {
        take(output.read_items<float>(4 * n_rows));
    }
    return rows;
}

} // namespace elvis::test
