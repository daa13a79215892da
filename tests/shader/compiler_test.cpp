#include <core/base/error.hpp>
#include <core/shader/compiler.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace elvis;
namespace fs = std::filesystem;

namespace {

/** A cache folder of the test's own. */
struct PrivateCache {
    fs::path folder = fs::temp_directory_path() / ("elvis-cache-" + std::to_string(::getpid()));
    PrivateCache() { ::setenv("ELVIS_CACHE_PATH", folder.c_str(), 1); }
    ~PrivateCache() {
        ::unsetenv("ELVIS_CACHE_PATH");
        std::error_code ignored;
        fs::remove_all(folder, ignored);
    }
};

const char* const text = "#version 460\n#extension GL_GOOGLE_cpp_style_line_directive : require\n"
                         "layout(local_size_x = 8) in;\nlayout(std430, binding = 0) buffer B { float x[]; };\n"
                         "void main() { x[gl_GlobalInvocationID.x] = 1.0; }\n";

} // namespace

TEST_CASE("Compiling twice gives the same words, the second time from the cache") {
    const PrivateCache cache;
    const auto first = compile_shader(text, "test");
    REQUIRE(first.size() > 20);
    REQUIRE(first.front() == 0x07230203u);
    std::size_t n_entries = 0;
    for (const auto& entry : fs::directory_iterator(cache.folder)) {
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

TEST_CASE("An error names file and line") {
    const PrivateCache cache;
    const std::string bad = std::string(text) + "#line 7 \"plugin/heat.glsl\"\nfloat f() { return missing; }\n";
    REQUIRE_THROWS_WITH(compile_shader(bad, "test"), Catch::Contains("plugin/heat.glsl:7:") && Catch::Contains("missing"));
}
