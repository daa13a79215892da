#include "nurbs_function.hpp"

#include <elvis/plugin.hpp>

namespace elvis_mfem {

namespace {

const NurbsPatches& patches_of(const Mesh& mesh, const std::string& path) {
    if (!mesh.nurbs) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "the function is one of NURBS, but the mesh is not");
    }
    return *mesh.nurbs;
}

/**
 * Quotients of polynomials are no polynomials. A quarter of a circle in one element is hit to 1e-6 of its radius by six orders
 * more than the splines have; each order more gains a factor of five.
 */
constexpr int additional_orders = 6;

} // namespace

NurbsFunction::NurbsFunction(std::string name, const std::string& path, GridFunction function, const Mesh& mesh)
    : ElementFunction(std::move(name), static_cast<std::size_t>(function.n_components)), m_function(std::move(function)),
      m_patches(patches_of(mesh, path)) {
    const int order = m_patches.order(0);
    if (m_function.nurbs_order != order) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path,
                                "NURBS of order " + std::to_string(m_function.nurbs_order) + " on a mesh of order " +
                                    std::to_string(order) + " are not supported, only those of the mesh's own order");
    }
    if (m_function.values.size() != m_patches.weights.size() * n_components()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "the file holds " + std::to_string(m_function.values.size()) + " values, but the mesh has " +
                                    std::to_string(m_patches.weights.size()) + " control points, with " +
                                    std::to_string(n_components()) + " component(s)");
    }
}

ElementFunction::NativeSpace NurbsFunction::native_space(std::size_t element) const {
    const int order = m_patches.order(element);
    return m_patches.is_polynomial(element) ? NativeSpace{order, true} : NativeSpace{order + additional_orders, false};
}

void NurbsFunction::evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const {
    const std::size_t step = m_function.is_interleaved ? n_components() : 1;
    const std::size_t component_step = m_function.is_interleaved ? 1 : m_patches.weights.size();
    for (std::size_t point = 0; point < xi.size() / 3; ++point) {
        const double* at = &xi[3 * point];
        double* value = values + point * stride;
        std::fill_n(value, n_components(), 0.0);
        for (const auto& [number, weight] :
             m_patches.shares(element, {0.5 * (1 + at[0]), 0.5 * (1 + at[1]), 0.5 * (1 + at[2])})) {
            for (std::size_t c = 0; c < n_components(); ++c) {
                value[c] += weight * m_function.values[static_cast<std::size_t>(number) * step + c * component_step];
            }
        }
    }
}

} // namespace elvis_mfem
