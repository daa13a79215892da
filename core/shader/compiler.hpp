/**
 * @file compiler.hpp
 * GLSL to SPIR-V at run time (glslang), with a cache on disk.
 */
#pragma once

#include <core/spirv/partial_evaluation.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace elvis {

/** Text of a file below shaders/, built into the program, by its path there ("element/newton.glsl"). Error if there is none. */
std::string_view shader_source(std::string_view path);

/**
 * Compiles a complete compute shader for Vulkan 1.3. `#include "..."` reaches shader_source. Errors are an Error whose text has
 * one line per message, "file:line: message", where file and line follow #line directives with names.
 * The result is kept in the cache folder ($ELVIS_CACHE_PATH, else $XDG_CACHE_HOME or ~/.cache, /elvis), keyed by a hash of the
 * text with all includes, of the target and of the compiler's version; an unwritable or damaged cache is ignored.
 */
std::vector<std::uint32_t> compile_shader(const std::string& text, const std::string& name,
                                          SpirvTarget target = SpirvTarget::graphics_card);

} // namespace elvis
