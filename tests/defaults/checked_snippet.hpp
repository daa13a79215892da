/**
 * @file checked_snippet.hpp
 * What a snippet and its defaults give at chosen points, by shaders/conformance/snippet_check.comp.
 */
#pragma once

#include "points.hpp"

#include <core/shader/composer.hpp>

#include <span>
#include <vector>

namespace elvis::test {

struct CheckPoint {
    Point xi;
    std::uint32_t element = 0;
    std::uint32_t component = 0;
};
static_assert(sizeof(CheckPoint) == 32);

struct Checked {
    double value;
    /** Value and gradient in xi of elvis_field_gradient. */
    double value_beside_gradient;
    Point gradient;
    Point position;
    /** Position and columns of elvis_mapping_jacobian. */
    Point position_beside_jacobian;
    std::array<Point, 3> jacobian;
};
static_assert(sizeof(Checked) == 20 * sizeof(double));

inline std::vector<Checked> check_snippet(const SnippetInstance& instance, Precision precision,
                                          const std::vector<CheckPoint>& points) {
    KernelRequest request;
    request.name = "snippet check";
    request.kernel = "conformance/snippet_check.comp";
    request.precision = precision;
    request.instances = {instance};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = 4;
    const ComposedKernel kernel(validated_device(), request);
    const Buffer input(validated_device(), points.size() * sizeof(CheckPoint));
    const Buffer output(validated_device(), points.size() * sizeof(Checked));
    input.write_items(std::span<const CheckPoint>(points));
    const auto n = static_cast<std::uint32_t>(points.size());
    const std::array<const Buffer*, 2> bindings{&input, &output};
    kernel.dispatch(bindings, std::as_bytes(std::span(&n, 1)), (n + 7) / 8);
    return output.read_items<Checked>(points.size());
}

} // namespace elvis::test
