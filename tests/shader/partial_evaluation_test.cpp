/*
 * Kernels that are evaluated as far as is known compute what they computed before. The functions below are C++ and GLSL at
 * once: the compiler of the host says what the kernel must give.
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

#define INOUT(type, name) type& name
#define BOTH(...)                                                                                                              \
    __VA_ARGS__                                                                                                                \
    constexpr const char* text = #__VA_ARGS__;

namespace loops {

// `u` is not known before the kernel runs.
BOTH(
    struct Numbers {
        uint a[4];
        uint b;
    };

    uint core_known_sum(uint u) {
        uint a[4];
        for (int i = 0; i < 4; ++i) {
            a[i] = u * uint(i + 1);
        }
        uint sum = 0u;
        for (int i = 3; i >= 0; --i) {
            sum = 7u * sum + a[i];
        }
        return sum;
    } uint core_unknown_length(uint u) {
        uint sum = 1u;
        for (uint i = 0u; i < u % 9u; ++i) {
            sum = 3u * sum + i;
        }
        return sum;
    }
    // An array that is written before the loop, in it, and read behind it.
    uint core_array_across(uint u) {
        uint a[3];
        a[0] = 5u;
        a[1] = u;
        a[2] = 9u;
        for (uint i = 0u; i < u % 5u; ++i) {
            a[1] += a[0];
            a[i % 3u] += 2u;
        }
        return a[0] + 100u * a[1] + 10000u * a[2];
    } uint core_ends_early(uint u) {
        uint sum = 0u;
        for (uint i = 0u; i < 6u; ++i) {
            if (i > u % 8u) {
                break;
            }
            sum += i * i;
        }
        return sum;
    } uint core_skips(uint u) {
        uint sum = 0u;
        for (uint i = 0u; i < 6u; ++i) {
            if (((u >> i) & 1u) == 0u) {
                continue;
            }
            sum = 2u * sum + i;
        }
        return sum;
    } uint core_skips_known(uint u) {
        uint sum = 0u;
        for (uint i = 0u; i < 6u; ++i) {
            if (i % 2u == 0u) {
                continue;
            }
            if (i == 5u) {
                break;
            }
            sum = 2u * sum + i * u;
        }
        return sum;
    } uint core_nested(uint u) {
        uint sum = 0u;
        for (uint i = 0u; i < 3u; ++i) {
            for (uint j = 0u; j < u % 4u; ++j) {
                for (uint k = i; k < 3u; ++k) {
                    sum = 5u * sum + i + 2u * j + 3u * k;
                }
            }
        }
        return sum;
    } uint core_last_tested(uint u) {
        uint n = 0u;
        do {
            n += 3u;
        } while (n < 12u);
        uint v = u;
        do {
            v = v / 2u;
            n += v;
        } while (v > 3u);
        while (v < 20u) {
            v = 2u * v + 1u;
        }
        return n + 1000u * v;
    } uint core_too_long(uint u) {
        uint sum = u;
        for (uint i = 0u; i < 100u; ++i) {
            sum = 3u * sum + i;
        }
        return sum;
    } uint core_without_rounds(uint u) {
        uint sum = u;
        for (uint i = 4u; i < 4u; ++i) {
            sum += 1000u;
        }
        return sum;
    })

} // namespace loops

namespace branches {

BOTH(
    uint core_guards(uint u) {
        if (u < 5u) {
            return 1u;
        }
        if (u % 3u == 0u) {
            return 2u + u;
        }
        uint v = u * u;
        if (u % 3u == 1u) {
            v += 7u;
        } else {
            return v + 3u;
        }
        return v;
    } uint core_both_return(uint u) {
        if (u % 2u == 0u) {
            return u / 2u;
        } else {
            return 3u * u + 1u;
        }
    } uint core_changes_in_one(uint u) {
        uint a = 3u;
        uint b = 4u;
        if (u > 20u) {
            a = 5u;
            b = u;
        } else if (u > 10u) {
            b = 6u;
        }
        if (a == 3u) {
            b += 100u;
        }
        return 1000u * a + b;
    }
    // Both branches store the same.
    uint core_agrees(uint u) {
        uint a = 1u;
        if (u > 7u) {
            a = 2u;
        } else {
            a = 2u;
        }
        return a + u;
    } bool core_step(INOUT(uint, n), uint u) {
        n += 1u;
        return u % 2u == 0u;
    } uint core_short_circuit(uint u) {
        uint n = 0u;
        bool a = u > 9u && core_step(n, u);
        bool b = u > 30u || core_step(n, u + 1u) || core_step(n, u);
        return n + (a ? 10u : 0u) + (b ? 100u : 0u);
    } void core_nothing(INOUT(uint, n), uint u) {
        if (u == 4u) {
            return;
        }
        n += u;
    } uint core_calls_nothing(uint u) {
        uint n = 1u;
        core_nothing(n, u);
        core_nothing(n, 4u);
        core_nothing(n, 5u);
        return n;
    })

} // namespace branches

namespace numbers {

BOTH(uint core_wraps(uint u) {
    uint most = 4294967295u;
    int least = -7;
    uint sum = most + 3u;
    sum = 31u * sum + (most >> 28u);
    sum = 31u * sum + uint(least >> 1);
    sum = 31u * sum + uint(least * 3);
    sum = 31u * sum + (1u << 31u);
    sum = 31u * sum + (least < 3 ? 1u : 0u);
    sum = 31u * sum + (uint(least) < 3u ? 1u : 0u);
    sum = 31u * sum + (~5u & 255u) + (6u ^ 3u) + 17u / 5u + 17u % 5u;
    sum = 31u * sum + uint(17 / 5) + uint(17 % 5) + uint(-(-4));
    return sum + u;
})

} // namespace numbers

// GLSL copies what it hands to a function in and, for `inout`, out: what is seen of that in C++ is none of these.
constexpr const char* of_glsl = R"(
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
void arguments(uint u, uint first) {
    // Nothing of it is known before the kernel runs.
    core_pair p = core_some(), q = core_some();
    p.a += u;
    q.a += u;
    result[first + 0] = core_read(p);
    result[first + 1] = core_write_and_read(p, p);
    result[first + 2] = core_read(p);
    result[first + 3] = core_write_own(q);
    result[first + 4] = core_read(q);
    core_write_through(q);
    result[first + 5] = q.b[2];
    result[first + 6] = core_read(q);
    result[first + 7] = core_write_deep(q, q);
    result[first + 8] = core_read(q);
    uint x = 1u + u, v = 2u;
    result[first + 9] = core_add(x, v);
    result[first + 10] = 100u * x + v;
    // Of two arguments that are the same the last one is copied back last.
    core_add(x, x);
    result[first + 11] = x;
    q = core_some();
    q.b[0] += u;
    result[first + 12] = core_with(core_some(), core_change(q));
    result[first + 13] = core_with(q, core_change(p));
    q.a = 5u;
    result[first + 14] = core_read(q);
    for (uint i = 0u; i < 3u + u; ++i) {
        core_pair r = core_some();
        r.a = i;
        q.a += core_change(r) + core_with(r, i);
    }
    result[first + 15] = q.a;
    core_set(q, 6u);
    result[first + 16] = core_read(q);
    // A part of a variable beside the whole.
    core_part_first(q.b[1], q);
    result[first + 17] = q.b[1];
    core_part_last(q, q.b[1]);
    result[first + 18] = q.b[1];
}
)";
const std::vector<uint> arguments{31, 31, 97, 131, 31, 131, 32, 32, 33, 212, 212, 12, 2031, 8042, 45, 3137, 36, 60, 50};

// Whole vectors and matrices beside their components, known and not known.
constexpr const char* of_vectors = R"(
void vectors(uint u, uint first) {
    uvec4 v = uvec4(1u, 2u, 3u, 4u);
    v.y += u;
    v[u] += 10u;
    v = v.wzyx + uvec4(v.xy, 0u, 1u);
    result[first + 0] = v.x + 100u * v.y + 10000u * v.z + 1000000u * v.w;
    mat3 m = mat3(1, 2, 3, 4, 5, 6, 7, 8, 9);
    m[1] = vec3(u);
    m[u][2] = 20.0;
    m[2].y -= 1.0;
    vec3 x = m * vec3(1, 10, 100);
    result[first + 1] = uint(x.x);
    result[first + 2] = uint(x.y);
    result[first + 3] = uint(x.z);
    float table[5] = float[](1.5, 2.5, 3.5, 4.5, 5.5);
    result[first + 4] = uint(table[u + 1u] + table[3]);
    uvec3 w[2] = uvec3[](uvec3(1u), uvec3(2u));
    for (int i = 0; i < 3; ++i) {
        w[1][i] += uint(i);
        w[int(u)] += w[1];
    }
    result[first + 5] = w[0].x + 100u * w[0].y + 10000u * w[0].z;
    result[first + 6] = w[1].x + 100u * w[1].y + 10000u * w[1].z;
}
)";
// With u = 0: v = (11, 2, 3, 4), then (4 + 11, 3 + 2, 2 + 0, 11 + 1). m's columns are (1, 2, 20), (0, 0, 0), (7, 7, 9).
// w[1] is (2, 2, 2), (2, 3, 2), (2, 3, 4), and w[0] starts at 1 and has these added.
const std::vector<uint> vectors{12020515, 701, 702, 920, 7, 90907, 40302};

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

using Case = std::pair<const char*, uint (*)(uint)>;

/** Each function for each invocation, in a kernel and here. */
void check_cases(const std::string& functions, const std::vector<Case>& cases) {
    std::string text = beginning + functions + "\nvoid main() {\n    uint u = gl_WorkGroupID.x;\n";
    for (std::size_t k = 0; k < cases.size(); ++k) {
        text +=
            "    result[" + std::to_string(k) + " * " + std::to_string(n_invocations) + " + u] = " + cases[k].first + "(u);\n";
    }
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
    return test::count_of(compiled(loops::text, "result[u] = " + expression + ";\n"), spv::OpLoopMerge);
}

} // namespace

TEST_CASE("Loops that are written out compute what they computed") {
    using namespace loops;
    check_cases(text, {{"core_known_sum", core_known_sum},
                       {"core_unknown_length", core_unknown_length},
                       {"core_array_across", core_array_across},
                       {"core_ends_early", core_ends_early},
                       {"core_skips", core_skips},
                       {"core_skips_known", core_skips_known},
                       {"core_nested", core_nested},
                       {"core_last_tested", core_last_tested},
                       {"core_too_long", core_too_long},
                       {"core_without_rounds", core_without_rounds}});
}

TEST_CASE("Branches and returns in functions without calls compute what they computed") {
    using namespace branches;
    check_cases(text, {{"core_guards", core_guards},
                       {"core_both_return", core_both_return},
                       {"core_changes_in_one", core_changes_in_one},
                       {"core_agrees", core_agrees},
                       {"core_short_circuit", core_short_circuit},
                       {"core_calls_nothing", core_calls_nothing}});
}

TEST_CASE("Integers are computed by the compiler as by the device") {
    check_cases(numbers::text, {{"core_wraps", numbers::core_wraps}});
}

TEST_CASE("Arguments are handed over as GLSL says") {
    const std::string call = "void main() { if (gl_WorkGroupID.x < 1u) arguments(gl_WorkGroupID.x, 0u); }\n";
    CHECK(results(beginning + of_glsl + call, arguments.size()) == arguments);
}

TEST_CASE("Parts of vectors and matrices are what they are as a whole") {
    const std::string call = "void main() { if (gl_WorkGroupID.x < 1u) vectors(gl_WorkGroupID.x, 0u); }\n";
    CHECK(results(beginning + of_vectors + call, vectors.size()) == vectors);
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
    // The outer one is, three times the one inside it, and of what that holds, too.
    CHECK(count_loops("core_nested(u)") == 3);
    CHECK(count_loops("core_last_tested(u)") == 2);
    // The result is known.
    CHECK(test::count_of(compiled(loops::text, "result[u] = core_known_sum(3u);\n"), spv::OpIMul) == 0);
}

TEST_CASE("Nothing is left of what is stored and not loaded") {
    const auto spirv = compiled(loops::text, "result[u] = core_known_sum(u);\n");
    CHECK(test::is_valid(spirv));
    CHECK(test::count_of(spirv, spv::OpFunctionCall) == 0);
    CHECK(test::count_of(spirv, spv::OpVariable) == 2);
    CHECK(test::count_of(spirv, spv::OpStore) == 1);
    CHECK(test::count_of(spirv, spv::OpName) == 0);
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
