#include "fixture.hpp"

#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>

#include <catch2/catch.hpp>

#include <glslang/SPIRV/spirv.hpp>

#include <array>
#include <cstdint>

using namespace elvis;

namespace {

constexpr const char* functions = R"(
layout(local_size_x = 1) in;
layout(std430, set = 0, binding = 0) buffer output_block { uint result[]; };
struct core_pair { uint a; uint b[3]; };

core_pair core_some() { return core_pair(1u, uint[](2u, 3u, 4u)); }
uint core_read(core_pair x) { return x.a + 10u * x.b[1]; }
// What is written to the one is not seen in the other.
uint core_write_and_read(inout core_pair x, core_pair y) {
    x.a = 7u;
    x.b[1] = 9u;
    return core_read(y);
}
// The caller's stays as it is.
uint core_write_own(core_pair x) {
    x.a += 100u;
    return core_read(x);
}
void core_write_through(inout core_pair x) {
    x.b[2] = core_write_own(x);
    x.a += 1u;
}
// Through another function's parameter.
uint core_write_deep(inout core_pair x, core_pair y) {
    core_write_through(x);
    return core_read(y);
}
uint core_add(inout uint x, inout uint y) {
    x += 1u;
    y += 10u;
    return 100u * x + y;
}
void core_part_first(inout uint part, inout core_pair x) {
    part = 50u;
    x.b[1] = 60u;
}
void core_part_last(inout core_pair x, inout uint part) {
    part = 50u;
    x.b[1] = 60u;
}
uint core_change(inout core_pair x) {
    x.a += 1u;
    x.b[1] += 1u;
    return x.a;
}
uint core_with(core_pair x, uint y) { return core_read(x) + 1000u * y; }
void core_set(out core_pair x, uint a) {
    x = core_some();
    x.a = a;
}
)";

constexpr const char* calls = R"(
void main() {
    core_pair p = core_some(), q = core_some();
    result[0] = core_read(p);
    result[1] = core_write_and_read(p, p);
    result[2] = core_read(p);
    result[3] = core_write_own(q);
    result[4] = core_read(q);
    core_write_through(q);
    result[5] = q.b[2];
    result[6] = core_read(q);
    result[7] = core_write_deep(q, q);
    result[8] = core_read(q);
    uint u = 1u, v = 2u;
    result[9] = core_add(u, v);
    result[10] = 100u * u + v;
    // Of two arguments that are the same the last one is copied back last.
    core_add(u, u);
    result[11] = u;
    q = core_some();
    result[12] = core_with(core_some(), core_change(q));
    result[13] = core_with(q, core_change(p));
    q.a = 5u;
    result[14] = core_read(q);
    for (uint i = 0u; i < 3u; ++i) {
        core_pair r = core_some();
        r.a = i;
        q.a += core_change(r) + core_with(r, i);
    }
    result[15] = q.a;
    core_set(q, 6u);
    result[16] = core_read(q);
    // A part of a variable beside the whole.
    core_part_first(q.b[1], q);
    result[17] = q.b[1];
    core_part_last(q, q.b[1]);
    result[18] = q.b[1];
}
)";

/** How many instructions of this kind a kernel has. */
std::size_t count(const std::string& text, spv::Op op) {
    const std::vector<std::uint32_t> spirv = compile_shader(text, "test");
    std::size_t n = 0;
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> spv::WordCountShift) {
        n += (spirv[at] & spv::OpCodeMask) == op ? 1 : 0;
    }
    return n;
}

} // namespace

TEST_CASE("Arguments that are not copied are as if they were") {
    const test::CacheFolder cache;
    DeviceOptions options;
    options.validation = true;
    const Device device(options);
    constexpr std::size_t n = 19;
    const Buffer result(device, n * sizeof(std::uint32_t));
    KernelRequest request;
    request.name = "argument test";
    request.kernel = "arguments";
    request.kernel_text = functions;
    request.kernel_text += calls;
    request.bindings = buffer_bindings({.storage = 1});
    const ComposedKernel kernel(device, request);
    const std::array<const Buffer*, 1> bindings{&result};
    kernel.dispatch(bindings, {}, 1);
    const std::vector<std::uint32_t> expected{31,  31, 97,   131,  31, 131,  32, 32, 33, 212,
                                              212, 12, 2031, 8042, 45, 3137, 36, 60, 50};
    CHECK(result.read_items<std::uint32_t>(n) == expected);
    CHECK(device.validation_messages() == std::vector<std::string>{});
}

TEST_CASE("A structure is copied for a call only where the call needs a copy of its own") {
    const test::CacheFolder cache;
    const auto of_main = [](const std::string& body) {
        std::string text = "#version 460\n";
        text += functions;
        text += "void main() { core_pair p = core_some(); ";
        return text.append(body).append(" result[0] = core_read(p); }\n");
    };
    const std::size_t n_without = count(of_main(""), spv::OpVariable);
    CHECK(count(of_main("core_change(p);"), spv::OpVariable) == n_without);
    // In core_write_through alone.
    CHECK(count(of_main("core_write_through(p);"), spv::OpVariable) == n_without + 1);
    CHECK(count(of_main("result[1] = core_read(p);"), spv::OpVariable) == n_without);
    CHECK(count(of_main("result[1] = core_write_own(p);"), spv::OpVariable) == n_without + 1);
    CHECK(count(of_main("result[1] = core_write_and_read(p, p);"), spv::OpVariable) > n_without);
    CHECK(count(of_main(""), spv::OpName) == 0);
}
