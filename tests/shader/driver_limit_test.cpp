// Drivers may end loops that take many iterations, without a word: what kernels that draw columns of pixels make of it.
#include "fixture.hpp"

#include <core/base/error.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <vector>

using namespace elvis;

namespace {

constexpr std::uint32_t width = 8, height = 16;

/** Counts the iterations of a loop in each row of a column, as a stand-in for what the pixels of a column do. */
constexpr const char* kernel_text = R"(
layout(local_size_x = 8) in;
#include "picture/samples.glsl"
layout(std430, set = 0, binding = 0) buffer marks_block { core_mark core_marks[]; };
layout(std430, set = 0, binding = 1) buffer iterations_block { uint n_iterations[]; };
layout(push_constant) uniform parameters {
    uvec2 core_size;
    uint zero;
    uint iterations_a_row;
};
#include "picture/distrust_column.glsl"

void main() {
    const uint column = gl_LocalInvocationID.x, end_row = core_size.y;
    uint row = 0u;
    while (row < end_row) {
        uint n = 0u;
        while (n < iterations_a_row + zero * column) {
            n += 1u;
            n_iterations[row * core_size.x + column] += 1u;
        }
        row += 1u;
    }
    const bool is_cut_short = row < end_row || core_has_driver_given_up(zero);
    core_distrust_column(column, 0u, is_cut_short ? end_row : 0u);
}
)";

struct Parameters {
    std::uint32_t width, height, zero, iterations_a_row;
};

struct Mark {
    std::uint32_t owner, flags;
};

struct Columns {
    std::vector<Mark> marks;
    std::vector<std::uint32_t> n_iterations;
};

Columns run(const Device& device, std::uint32_t iterations_a_row) {
    KernelRequest request;
    request.name = "columns";
    request.kernel = "driver_limit_test";
    request.kernel_text = kernel_text;
    request.defines = {{"CORE_TILE_HEIGHT", std::to_string(height) + "u"}};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(Parameters);
    const ComposedKernel kernel(device, request);
    const Buffer marks(device, width * height * sizeof(Mark)), iterations(device, width * height * sizeof(std::uint32_t));
    marks.fill(0);
    iterations.fill(0);
    const Parameters parameters{width, height, 0, iterations_a_row};
    const std::array<const Buffer*, 2> bindings{&marks, &iterations};
    kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), 1);
    return {marks.read_items<Mark>(width * height), iterations.read_items<std::uint32_t>(width * height)};
}

} // namespace

TEST_CASE("pixels that a driver has cut short are marked, in every row of a column") {
    const test::CacheFolder cache;
    const Device device;
    // Less than any driver grants to all rows together, and more than some do.
    for (const std::uint32_t iterations_a_row : {100u, 10'000u}) {
        const Columns columns = run(device, iterations_a_row);
        std::size_t n_short = 0, n_silent = 0;
        for (std::size_t pixel = 0; pixel < columns.marks.size(); ++pixel) {
            const bool is_short = columns.n_iterations[pixel] < iterations_a_row;
            n_short += is_short ? 1 : 0;
            n_silent += is_short && columns.marks[pixel].flags == 0 ? 1 : 0;
            if (iterations_a_row == 100) {
                CHECK(columns.marks[pixel].flags == 0);
            }
        }
        CAPTURE(iterations_a_row, n_short);
        CHECK(n_silent == 0);
        if (iterations_a_row == 100) {
            CHECK(n_short == 0);
        } else {
            WARN(n_short << " of " << columns.marks.size() << " pixels cut short by the driver");
        }
    }
}

TEST_CASE("a kernel that is watched fails where a driver has ended its loops, and only there") {
    const test::CacheFolder cache;
    const Device device;
    KernelRequest request;
    request.name = "long loop";
    request.kernel = "long_loop";
    request.kernel_text = R"(
layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) buffer iterations_block { uint n_iterations; };
layout(push_constant) uniform parameters { uint wanted; };
void main() {
    n_iterations = 0u;
    for (uint i = 0u; i < wanted; ++i) {
        n_iterations += 1u + n_iterations / 100000u;
    }
}
)";
    request.bindings = {{0, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(std::uint32_t);
    request.watches_loops = true;
    const ComposedKernel kernel(device, request);
    const Buffer iterations(device, sizeof(std::uint32_t));
    const std::array<const Buffer*, 1> bindings{&iterations};
    // The last one sees that a failure is not remembered.
    for (const std::uint32_t wanted : {1000u, 90'000u, 1000u}) {
        CAPTURE(wanted);
        bool has_failed = false;
        try {
            kernel.dispatch(bindings, std::as_bytes(std::span(&wanted, 1)), 1);
        } catch (const Error& error) {
            has_failed = true;
            CHECK(std::string(error.what()).find("kernel 'long loop'") != std::string::npos);
            CHECK(std::string(error.what()).find("ended its loops early") != std::string::npos);
        }
        CHECK(has_failed == (iterations.read_items<std::uint32_t>(1).front() < wanted));
        CHECK((wanted > 1000 || !has_failed));
    }
}
