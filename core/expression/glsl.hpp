/**
 * @file glsl.hpp
 * Expressions as GLSL: text that stands behind the snippets' instances of a kernel (KernelRequest::text), of which instance k
 * has field slot k, Expression::fields()[k], without offset, and all are of one element class.
 *
 *     elvis_real core_shown_value(uint element, elvis_vec3 xi)
 *     void core_shown_gradient(uint element, elvis_vec3 xi, out elvis_real value, out elvis_vec3 gradient)   by xi
 *     core_model core_shown_model(uint element, elvis_vec3 xi, core_region region, out elvis_real value)
 *     bool core_is_model_estimated(uint element)   (both by shaders/arithmetic/model.glsl)
 *
 * and for implicit expressions, without any instance, of world coordinates less an origin,
 *
 *     elvis_real core_implicit_value(elvis_vec3 x)
 *     void core_implicit(elvis_vec3 x, out elvis_real value, out elvis_vec3 gradient)
 *     core_interval core_implicit_range(core_interval x, core_interval y, core_interval z)   (shaders/arithmetic/interval.glsl)
 *     core_interval core_implicit_slopes(core_interval x, core_interval y, core_interval z,
 *                                        out core_interval dx, out core_interval dy, out core_interval dz)
 *
 * of which the last gives the ranges of value and derivatives; of the latter infinite ones where the value may jump.
 *
 * Every field, its gradient and its second derivatives are read once in each. `element` in an expression reads the host's
 * buffer core_elements. Models of fields rest on core_field_bounds(element, component), of which instance k has
 * core_field_bounds_k.
 */
#pragma once

#include <core/expression/expression.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

/** The element class that the text is for. */
struct ExpressionClass {
    std::uint32_t dimension = 3;
    /** The mapping's Jacobian is constant in every element. */
    bool is_affine = false;
    /** ELVIS_SNIPPET_... of its snippet. */
    std::uint32_t capabilities = 0;
    /** Largest order of each field of the volume; -1: not polynomial. */
    std::vector<std::int32_t> orders;
    /** What each component of each field slot lacks on the device; empty: nothing. */
    std::vector<std::vector<double>> offsets{};
};

/** All about one class of a volume. */
ExpressionClass expression_class(const RuntimeVolume& volume, std::uint32_t element_class);

std::string value_glsl(const Expression& expression, const ExpressionClass& element_class);
std::string gradient_glsl(const Expression& expression, const ExpressionClass& element_class);
/** value_glsl() comes first; has gradient_glsl() in it where it needs it. */
std::string model_glsl(const Expression& expression, const ExpressionClass& element_class);
/** elvis_real core_shown_error(uint element, elvis_vec3 xi): about what the value loses by rounding, to first order. */
std::string error_glsl(const Expression& expression, const ExpressionClass& element_class);
/**
 * `origin`: what its coordinates are relative to. Constants next to coordinates are put together with it in extended precision,
 * so that x - 10000.3 keeps its digits near an origin at 10000.
 */
std::string implicit_glsl(const Expression& expression, const std::array<double, 3>& origin = {});

/** Whether the value, or gradient_glsl's gradient, rests on differences because the plugin does not give what it needs. */
bool value_is_estimated(const Expression& expression, const ExpressionClass& element_class);
bool gradient_is_estimated(const Expression& expression, const ExpressionClass& element_class);

} // namespace elvis
