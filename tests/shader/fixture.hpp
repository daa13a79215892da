/**
 * @file fixture.hpp
 * What the tests of shaders share.
 */
#pragma once

#include <core/shader/composer.hpp>
#include <tests/support/files.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace elvis::test {

/** An empty cache folder of its own while it lives, so that no test depends on what others compiled. */
class CacheFolder {
public:
    CacheFolder() { setenv("ELVIS_CACHE_PATH", path().c_str(), 1); }
    ~CacheFolder() { unsetenv("ELVIS_CACHE_PATH"); }
    CacheFolder(const CacheFolder&) = delete;
    CacheFolder& operator=(const CacheFolder&) = delete;

    const std::filesystem::path& path() const { return m_folder.path(); }

private:
    TemporaryFolder m_folder;
};

/** GLSL: all bits of a number. */
inline constexpr const char* bits_glsl = R"(
uvec2 bits(elvis_real x) {
#if ELVIS_REAL_IS_DOUBLE
    return unpackDouble2x32(x);
#else
    return uvec2(floatBitsToUint(x), 0u);
#endif
}
)";

/** The smallest complete snippet: a box scaled by two about each axis, field x + component. */
inline Snippet simple_snippet() {
    return {0,
            "simple",
            {{"simple.glsl", "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) { return elvis_real(2) * xi; }\n"
                             "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) { return elvis_mat3(elvis_real(2)); }\n"
                             "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {\n"
                             "    return elvis_real(2) * xi.x + elvis_real(component);\n"
                             "}\n"}}};
}

} // namespace elvis::test
