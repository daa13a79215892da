/*
 * Fetches that are the same in all rounds of a loop stand before it, in kernels for processors, and nothing else is computed
 * for it.
 */
#include "fixture.hpp"
#include "spirv.hpp"

#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

using namespace elvis;

namespace {

using uint = std::uint32_t;

constexpr uint n_invocations = 40;

const std::string beginning = "layout(local_size_x = 1) in;\n"
                              "layout(std430, set = 0, binding = 0) buffer output_block { uint result[]; };\n"
                              "layout(set = 0, binding = 1) uniform utextureBuffer numbers;\n"
                              "uint last;\n"
                              "uint fetched(uint at) { return texelFetch(numbers, int(at)).x; }\n";

std::string text_of(const std::string& body) {
    return beginning + "void main() {\n    uint u = gl_WorkGroupID.x;\n    uint sum = 0u;\n" + body +
           "    result[u] = sum;\n}\n";
}

/** For each fetch, in their order: in how many loops it is. */
std::vector<std::size_t> loops_around(const std::string& body, SpirvTarget target) {
    const test::CacheFolder cache;
    const std::vector<uint> spirv = compile_shader("#version 460\n" + text_of(body), "test", target);
    CHECK(test::is_valid(spirv));
    std::vector<std::size_t> counts;
    std::vector<uint> ends;
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> spv::WordCountShift) {
        const uint op = spirv[at] & spv::OpCodeMask;
        if (op == spv::OpLoopMerge) {
            ends.push_back(spirv[at + 1]);
        } else if (op == spv::OpLabel && !ends.empty() && spirv[at + 1] == ends.back()) {
            ends.pop_back();
        } else if (op == spv::OpImageFetch) {
            counts.push_back(ends.size());
        }
    }
    return counts;
}

/** By invocation; the first of each four `numbers` is a square. */
std::vector<uint> results(const std::string& body) {
    const test::CacheFolder cache;
    DeviceOptions options;
    options.validation = true;
    const Device device(options);
    std::vector<std::array<uint, 4>> squares;
    for (uint i = 0; i < 100; ++i) {
        squares.push_back({i * i, 0, 0, 0});
    }
    const Buffer result(device, n_invocations * sizeof(uint)), numbers(device, squares.size() * sizeof(squares[0]));
    numbers.write(0, std::as_bytes(std::span(squares)));
    KernelRequest request;
    request.name = request.kernel = "hoisted";
    request.kernel_text = text_of(body);
    request.bindings = buffer_bindings({.storage = 2});
    const ComposedKernel kernel(device, request);
    const std::array<const Buffer*, 2> bindings{&result, &numbers};
    kernel.dispatch(bindings, {}, n_invocations);
    CHECK(device.validation_messages() == std::vector<std::string>{});
    return result.read_items<uint>(n_invocations);
}

using Counts = std::vector<std::size_t>;

} // namespace

TEST_CASE("A fetch that is the same in all rounds stands before the loop, on processors") {
    const std::string body = "for (uint i = 0u; i < u; ++i) {\n"
                             "    if (i % 2u == 0u) { sum += fetched(2u * u + 1u); }\n"
                             "    sum += fetched(i);\n"
                             "}\n";
    CHECK(loops_around(body, SpirvTarget::processor) == Counts{0, 1});
    CHECK(loops_around(body, SpirvTarget::graphics_card) == Counts{1, 1});
    const std::vector<uint> found = results(body);
    for (uint u = 0; u < n_invocations; ++u) {
        uint sum = 0;
        for (uint i = 0; i < u; ++i) {
            const uint at = 2 * u + 1;
            sum += (i % 2 == 0 ? at * at : 0) + i * i;
        }
        CHECK(found[u] == sum);
    }
}

TEST_CASE("A fetch stands before the outermost loop in which it is the same") {
    const std::string body =
        "for (uint i = 0u; i < u; ++i) {\n"
        "    for (uint k = 0u; k < i; ++k) {\n"
        "        sum += fetched(k) * fetched(i) + fetched(u) + fetched(fetched(2u) + i) - fetched(fetched(3u));\n"
        "    }\n"
        "}\n";
    // u, 2, 3 and the last; i, 2's; k.
    CHECK(loops_around(body, SpirvTarget::processor) == Counts{0, 0, 0, 0, 1, 1, 2});
    const std::vector<uint> found = results(body);
    for (uint u = 0; u < n_invocations; ++u) {
        uint sum = 0;
        for (uint i = 0; i < u; ++i) {
            for (uint k = 0; k < i; ++k) {
                sum += k * k * i * i + u * u + (4 + i) * (4 + i) - 81;
            }
        }
        CHECK(found[u] == sum);
    }
}

TEST_CASE("A fetch whose place is told by what the loop changes stays") {
    const std::string body = "uint at = u;\n"
                             "for (uint i = 0u; i < u; ++i) {\n"
                             "    sum += fetched(at % 100u);\n"
                             "    at = sum + i;\n"
                             "}\n";
    CHECK(loops_around(body, SpirvTarget::processor) == Counts{1});
    const std::vector<uint> found = results(body);
    for (uint u = 0; u < n_invocations; ++u) {
        uint sum = 0, at = u;
        for (uint i = 0; i < u; ++i) {
            sum += (at % 100) * (at % 100);
            at = sum + i;
        }
        CHECK(found[u] == sum);
    }
}

TEST_CASE("A fetch whose place is told by a variable of the kernel stays in the loop that changes it") {
    const std::string body = "last = u;\n"
                             "for (uint i = 0u; i < u; ++i) {\n"
                             "    sum += fetched(last);\n"
                             "    if (i % 3u == 0u) { last = i; }\n"
                             "}\n";
    CHECK(loops_around(body, SpirvTarget::processor) == Counts{1});
    const std::vector<uint> found = results(body);
    for (uint u = 0; u < n_invocations; ++u) {
        uint sum = 0, last = u;
        for (uint i = 0; i < u; ++i) {
            sum += last * last;
            last = i % 3 == 0 ? i : last;
        }
        CHECK(found[u] == sum);
    }
}

TEST_CASE("Few fetches are moved out of a loop, and out of one that was written out and is in it") {
    const std::string body =
        "for (uint i = 0u; i < u; ++i) {\n"
        "    for (uint k = 0u; k < 30u; ++k) { for (uint l = 0u; l < 10u; ++l) { sum += fetched(u * k + l) + i; } }\n"
        "}\n";
    Counts expected(256, 0);
    expected.resize(300, 1);
    CHECK(loops_around(body, SpirvTarget::processor) == expected);
    // Written out, it is too large for graphics cards.
    CHECK(loops_around(body, SpirvTarget::graphics_card).size() < 31);
}
