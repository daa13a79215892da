/**
 * @file poison.hpp
 * A debug build of snippets: outputs that a function forgets to write are recognized by their value.
 */
#pragma once

#include <core/shader/glsl_scan.hpp>

#include <string>
#include <string_view>

namespace elvis {

/** What poisoned outputs hold, in single and double precision alike; sums with it are of its size. */
constexpr double poison = 0x1p100;

/**
 * The text with an assignment of `poison` to every `out` parameter of type elvis_real, elvis_vec3 or elvis_mat3 at the
 * beginning of every interface function that it defines, and with a count of iterations in every loop with braces: a loop that
 * takes more than 50000 iterations within one call of the interface is left, and core_is_endless set. Lines keep their numbers.
 * `names`: scan_glsl of the text. The variables that it needs are in poison_declarations.
 */
std::string poison_outputs(std::string_view text, const GlslNames& names);

/** Also elvis_debug, which then keeps up to CORE_N_DEBUG numbers. */
constexpr const char* poison_declarations = R"(#define CORE_DEBUG_BUILD 1
#define CORE_N_DEBUG 15u
uint core_loop_iterations = 0u;
bool core_is_endless = false;
uint core_n_debug = 0u;
double core_debug[CORE_N_DEBUG];
void core_keep_debug(double value) {
    if (core_n_debug < CORE_N_DEBUG) {
        core_debug[core_n_debug] = value;
    }
    ++core_n_debug;
}
#undef elvis_debug
#define elvis_debug(value) core_keep_debug(double(value))
)";

} // namespace elvis
