/**
 * @file kernel_table.hpp
 * What each file shaders/ROOM/NAME.comp is compiled with: the core's requests, as a table.
 */
#pragma once

#include <core/shader/composer.hpp>

#include <string>
#include <utility>
#include <vector>

namespace elvis::test {

/** What a kernel has of an element class. */
enum class Element {
    none,
    /** The snippet, once. */
    snippet,
    /** The snippet; once for each field where an expression is shown, with the expression's value. */
    value,
    /** The same, with bounds of derivatives and models (shaders/field/shown_model.glsl). */
    model,
    /** Always an expression, with its gradient, or with what rounding does to it. */
    expression_gradient,
    expression_error,
};

/** A #define and the values that it takes. */
struct Choice {
    std::string name;
    std::vector<std::string> values;
};

/** One way in which the program asks for a kernel; all choices are combined. */
struct KernelUse {
    /** The file's name without its end. */
    std::string kernel;
    Element element = Element::none;
    /** Of the host; those that belong to Element::model come by themselves. */
    std::vector<std::string> buffers{};
    std::vector<Choice> choices{};
    /** Behind that of an expression. */
    std::string text{};
    /** Before the kernel's. */
    std::string includes{};
    /** Two-dimensional volumes have no use for it. */
    bool is_for_solids = false;
    bool is_double_only = false;
    /** Whether what cuts elements can be shown (shaders/field/own_boundary.glsl). */
    bool shows_own_boundary = false;
    bool with_second_derivatives = false;
    bool watches_loops = false;
    bool is_debug_build = false;
    std::size_t n_instances = 1;
};

/** Every kernel at least once. */
std::vector<KernelUse> kernel_uses();

} // namespace elvis::test
