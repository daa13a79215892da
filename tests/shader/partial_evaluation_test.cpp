/*
 * Kernels that are evaluated as far as is known compute what they computed before. Most functions are GLSL and C++ at once: the
 * compiler of the host says what a kernel must give.
 */
#include "fixture.hpp"
#include "spirv.hpp"

#include <core/shader/compiler.hpp>
#include <core/shader/composer.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>

using namespace elvis;

namespace {

using uint = std::uint32_t;

// Both languages read these files.
#define INOUT(type, name) type& name
namespace loops {
#include "evaluated/loops.glsl"
}
namespace branches {
#include "evaluated/branches.glsl"
}
namespace integers {
#include "evaluated/integers.glsl"
}
#undef INOUT

std::string text_of(const std::string& name) {
    return test::read_file(std::string(ELVIS_TEST_SHADERS) + "/evaluated/" + name + ".glsl");
}

constexpr std::size_t n_invocations = 40;

/** What a kernel leaves in `result`, which has so many numbers. */
std::vector<uint> results(const std::string& text, std::size_t count) {
    const test::CacheFolder cache;
    DeviceOptions options;
    options.validation = true;
    const Device device(options);
    const Buffer result(device, count * sizeof(uint));
    KernelRequest request;
    request.name = "evaluated";
    request.kernel = "evaluated";
    request.kernel_text = text;
    request.bindings = buffer_bindings({.storage = 1});
    const ComposedKernel kernel(device, request);
    const std::array<const Buffer*, 1> bindings{&result};
    kernel.dispatch(bindings, {}, n_invocations);
    CHECK(device.validation_messages() == std::vector<std::string>{});
    return result.read_items<uint>(count);
}

const std::string beginning = "#define INOUT(type, name) inout type name\n"
                              "layout(local_size_x = 1) in;\n"
                              "layout(std430, set = 0, binding = 0) buffer output_block { uint result[]; };\n";

/** Of a file's function of that name, called for the first invocation, whose number it doesn't know. */
std::vector<uint> results_of_first(const std::string& name, std::size_t count) {
    return results(beginning + text_of(name) + "void main() { uint u = gl_WorkGroupID.x; if (u < 1u) " + name + "(u, 0u); }\n",
                   count);
}

using Case = std::pair<const char*, uint (*)(uint)>;

/** Each function for each invocation, in a kernel and here. */
void check_cases(const std::string& functions, const std::vector<Case>& cases) {
    std::string text = beginning + functions + "\nvoid main() {\n    uint u = gl_WorkGroupID.x;\n";
    for (std::size_t k = 0; k < cases.size(); ++k) {
        text +=
            "    result[" + std::to_string(k) + " * " + std::to_string(n_invocations) + " + u] = " + cases[k].first + "(u);\n";
    }
    const test::CacheFolder cache;
    CHECK(test::count_of(compile_shader("#version 460\n" + text + "}\n", "evaluated"), spv::OpFunctionCall) == 0);
    const std::vector<uint> found = results(text + "}\n", cases.size() * n_invocations);
    for (std::size_t k = 0; k < cases.size(); ++k) {
        for (uint u = 0; u < n_invocations; ++u) {
            INFO(cases[k].first << "(" << u << ")");
            CHECK(found[k * n_invocations + u] == cases[k].second(u));
        }
    }
}

std::vector<std::uint32_t> compiled(const std::string& functions, const std::string& body) {
    const test::CacheFolder cache;
    return compile_shader(
        "#version 460\n" + beginning + functions + "void main() {\nuint u = gl_WorkGroupID.x;\n" + body + "}\n", "test");
}

std::size_t count_loops(const std::string& expression) {
    return test::count_of(compiled(text_of("loops"), "result[u] = " + expression + ";\n"), spv::OpLoopMerge);
}

} // namespace

TEST_CASE("Loops that are written out compute what they computed") {
    using namespace loops;
    check_cases(text_of("loops"), {{"core_known_sum", core_known_sum},
                                   {"core_unknown_length", core_unknown_length},
                                   {"core_array_across", core_array_across},
                                   {"core_ends_early", core_ends_early},
                                   {"core_skips", core_skips},
                                   {"core_skips_known", core_skips_known},
                                   {"core_nested", core_nested},
                                   {"core_last_tested", core_last_tested},
                                   {"core_too_long", core_too_long},
                                   {"core_without_rounds", core_without_rounds},
                                   {"core_copied_stack", core_copied_stack},
                                   {"core_written_by_calls", core_written_by_calls}});
}

TEST_CASE("Branches and returns in functions without calls compute what they computed") {
    using namespace branches;
    check_cases(text_of("branches"), {{"core_guards", core_guards},
                                      {"core_both_return", core_both_return},
                                      {"core_changes_in_one", core_changes_in_one},
                                      {"core_agrees", core_agrees},
                                      {"core_short_circuit", core_short_circuit},
                                      {"core_calls_nothing", core_calls_nothing}});
}

TEST_CASE("Integers are computed by the compiler as by the device") {
    check_cases(text_of("integers"), {{"core_wraps", integers::core_wraps}});
}

TEST_CASE("Arguments are handed over as GLSL says") {
    // Which copies them in and, where they are `inout`, out.
    CHECK(results_of_first("arguments", 19) ==
          std::vector<uint>{31, 31, 97, 131, 31, 131, 32, 32, 33, 212, 212, 12, 2031, 8042, 45, 3137, 36, 60, 50});
}

TEST_CASE("Parts of vectors and matrices are what they are as a whole") {
    // With u = 0: v = (11, 2, 3, 4), then (4 + 11, 3 + 2, 2 + 0, 11 + 1). m's columns are (1, 2, 20), (0, 0, 0), (7, 7, 9).
    // w[1] is (2, 2, 2), (2, 3, 2), (2, 3, 4), and w[0] starts at 1 and has these added.
    CHECK(results_of_first("vectors", 7) == std::vector<uint>{12020515, 701, 702, 920, 7, 90907, 40302});
}

TEST_CASE("Only loops of a known, small number of rounds are written out") {
    CHECK(count_loops("core_known_sum(u)") == 0);
    CHECK(count_loops("core_without_rounds(u)") == 0);
    CHECK(count_loops("core_skips_known(u)") == 0);
    // What is known where it is called.
    CHECK(count_loops("core_unknown_length(7u)") == 0);
    CHECK(count_loops("core_unknown_length(u)") == 1);
    CHECK(count_loops("core_ends_early(u)") == 1);
    CHECK(count_loops("core_too_long(u)") == 1);
    // Not the outer one, as the middle one stays; of the inner one it is not known where it begins.
    CHECK(count_loops("core_nested(u)") == 3);
    CHECK(count_loops("core_last_tested(u)") == 2);
    // Of 30^4 rounds that store alone few are written out.
    const auto stores = compiled("", "uint a[32];\nfor (int i = 0; i < 30; ++i) for (int j = 0; j < 30; ++j)\n"
                                     "for (int k = 0; k < 30; ++k) for (int l = 0; l < 30; ++l) { a[l] = u; a[i] = a[l]; }\n"
                                     "result[u] = a[u % 32u];\n");
    CHECK(stores.size() < 30000);
    // The result is known.
    CHECK(test::count_of(compiled(text_of("loops"), "result[u] = core_known_sum(3u);\n"), spv::OpIMul) == 0);
}

TEST_CASE("Nothing is left of what is stored and not loaded") {
    const auto spirv = compiled(text_of("loops"), "result[u] = core_known_sum(u);\n");
    CHECK(test::is_valid(spirv));
    CHECK(test::count_of(spirv, spv::OpFunctionCall) == 0);
    CHECK(test::count_of(spirv, spv::OpVariable) == 2);
    CHECK(test::count_of(spirv, spv::OpStore) == 1);
    CHECK(test::count_of(spirv, spv::OpName) == 0);
}

TEST_CASE("Indices outside of what they index, where control never comes, are no error") {
    const auto spirv =
        compiled("", "uint a[3] = uint[](1u, 2u, 3u);\nuvec3 v = uvec3(u);\nuvec2 w = uvec2(u, 5u);\n"
                     "for (int i = 0; i < 3; ++i) {\n"
                     "    if (u > 1000u + uint(i)) { result[u] += a[i - 1] + v[i + 1] + (w + uvec2(i))[i + 1]; }\n"
                     "}\n");
    CHECK(test::is_valid(spirv));
    CHECK(test::count_of(spirv, spv::OpLoopMerge) == 0);
}

TEST_CASE("What must not be contracted keeps its mark, each time that it is written out") {
    const auto spirv = compiled("", "precise float x = uintBitsToFloat(u);\n"
                                    "for (int i = 0; i < 5; ++i) { x = x * x + 1.0; }\n"
                                    "result[u] = floatBitsToUint(x);\n");
    CHECK(test::count_of(spirv, spv::OpLoopMerge) == 0);
    CHECK(test::count_of(spirv, spv::OpFMul) == 5);
    std::size_t n_marks = 0;
    for (std::size_t at = 5; at < spirv.size(); at += spirv[at] >> spv::WordCountShift) {
        n_marks += (spirv[at] & spv::OpCodeMask) == spv::OpDecorate && spirv[at + 2] == spv::DecorationNoContraction ? 1 : 0;
    }
    CHECK(n_marks == 10);
}

TEST_CASE("A kernel with a switch, or that returns from within a loop, is left as it is") {
    const std::string with_return = "uint core_f(uint u) { for (uint i = 0u; i < 8u; ++i) { if (i * i > u) { return i; } }"
                                    " return 8u; }\n";
    const std::string with_switch =
        "uint core_f(uint u) { switch (u) { case 1u: return 5u; case 2u: break; default: return 7u; }"
        " return 8u; }\n";
    for (const std::string& function : {with_return, with_switch}) {
        const auto spirv = compiled(function, "result[u] = core_f(u);\n");
        CHECK(test::is_valid(spirv));
        CHECK(test::count_of(spirv, spv::OpFunctionCall) == 1);
    }
    const std::vector<uint> found = results(
        beginning + with_return + "void main() { result[gl_WorkGroupID.x] = core_f(gl_WorkGroupID.x); }\n", n_invocations);
    CHECK(found[0] == 1);
    CHECK(found[4] == 3);
    CHECK(found[39] == 7);
}
