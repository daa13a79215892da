#include "fixture.hpp"

#include <core/base/cache.hpp>
#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <span>
#include <thread>

using namespace elvis;
using elvis::test::CacheFolder;
namespace fs = std::filesystem;

namespace {

const char* const text = "#version 460\n#extension GL_GOOGLE_cpp_style_line_directive : require\n"
                         "layout(local_size_x = 8) in;\nlayout(std430, binding = 0) buffer B { float x[]; };\n"
                         "void main() { x[gl_GlobalInvocationID.x] = 1.0; }\n";

} // namespace

TEST_CASE("Compiling twice gives the same words, the second time from the cache") {
    const CacheFolder cache;
    const auto first = compile_shader(text, "test");
    REQUIRE(first.size() > 20);
    REQUIRE(first.front() == 0x07230203u);
    std::size_t n_entries = 0;
    for (const auto& entry : fs::directory_iterator(cache.path())) {
        ++n_entries;
        // Damage it: the next compilation must notice.
        std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(40);
        file.put('\x55');
    }
    REQUIRE(n_entries == 1);
    REQUIRE(compile_shader(text, "test") == first);
    REQUIRE(compile_shader(text, "test") == first);
}

TEST_CASE("A second compilation is served by the cache") {
    const CacheFolder cache;
    compile_shader(text, "test");
    const std::string entry = fs::directory_iterator(cache.path())->path().filename().string();
    const std::vector<std::uint32_t> mark{1, 2, 3};
    REQUIRE(write_cache_entry(entry, std::as_bytes(std::span(mark))));
    CHECK(compile_shader(text, "test") == mark);
    CHECK(compile_shader(std::string(text) + " ", "test") != mark);
}

TEST_CASE("Without a place for the cache, shaders compile all the same") {
    ::setenv("ELVIS_CACHE_PATH", "/dev/null/nowhere", 1);
    CHECK(compile_shader(text, "test").size() > 20);
    ::unsetenv("ELVIS_CACHE_PATH");
}

TEST_CASE("Includes reach the library, and their errors name its files") {
    const CacheFolder cache;
    const std::string with_types = "#version 460\n#define ELVIS_REAL_IS_DOUBLE 0\n#include \"arithmetic/types.glsl\"\n"
                                   "elvis_real f() { return elvis_real(1); }\nvoid main() {}\n";
    CHECK(compile_shader(with_types, "test").size() > 20);
    CHECK_THROWS_WITH(compile_shader("#version 460\n\n#include \"picture/nothing.glsl\"\n", "my.comp"),
                      Catch::Contains("my.comp:3") && Catch::Contains("picture/nothing.glsl"));
    CHECK_THROWS_WITH(compile_shader(with_types + "void g() { h(); }\n", "my.comp"), Catch::Contains("my.comp:6: 'h'"));
}

TEST_CASE("Threads may compile at the same time") {
    const CacheFolder cache;
    std::array<std::vector<std::uint32_t>, 4> results;
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < results.size(); ++t) {
            threads.emplace_back([&results, t] {
                for (int i = 0; i < 5; ++i) {
                    // The same function under names of different kernels, so that each is compiled.
                    results[t] = compile_shader(std::string(text) + "// " + std::to_string(10 * t) + std::to_string(i), "test");
                }
            });
        }
    }
    for (const auto& result : results) {
        CHECK(result == results[0]);
    }
}

TEST_CASE("An error names file and line") {
    const CacheFolder cache;
    std::string bad(text);
    bad += "#line 7 \"plugin/heat.glsl\"\nfloat f() { return missing; }\n";
    REQUIRE_THROWS_WITH(compile_shader(bad, "test"), Catch::Contains("plugin/heat.glsl:7:") && Catch::Contains("missing"));
}
