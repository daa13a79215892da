#include "field.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <stdexcept>

namespace elvis_mfem {

namespace {

/** L2 pyramids are polynomials in collapsed coordinates with no limit at the apex, which no native pyramid has. */
bool is_singular(const Collection& collection, Geometry geometry) {
    return geometry == Geometry::pyramid && collection.family == Family::l2 && collection.order > 0;
}

} // namespace

Field::Field(std::string name, const std::string& path, GridFunction function, const Mesh& mesh, const Topology* topology)
    : ElementFunction(std::move(name),
                      static_cast<std::size_t>(function.collection.is_vector() ? mesh.dimension : function.n_components)),
      m_function(std::move(function)), m_mesh(mesh), m_space(m_function.collection, mesh, topology) {
    const std::size_t n_expected = m_space.n_dofs() * static_cast<std::size_t>(m_function.n_components);
    if (m_function.values.size() != n_expected) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path,
                                "the file holds " + std::to_string(m_function.values.size()) +
                                    " values, but on this mesh its space has " + std::to_string(m_space.n_dofs()) +
                                    " degrees of freedom with " + std::to_string(m_function.n_components) + " component(s)");
    }
    for (const MeshElement& element : mesh.elements) {
        auto& tabulation = m_tabulations[static_cast<std::size_t>(element.geometry)];
        if (tabulation) {
            continue;
        }
        try {
            tabulation = std::make_unique<Tabulation>(make_element(collection(), element.geometry), element.geometry);
        } catch (const std::invalid_argument& error) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, path, error.what());
        }
    }
}

elvis_continuity Field::continuity() const {
    return collection().family == Family::h1 ? ELVIS_CONTINUITY_CONTINUOUS : ELVIS_CONTINUITY_DISCONTINUOUS;
}

elvis_transform Field::transform() const {
    return collection().family == Family::nd   ? ELVIS_TRANSFORM_COVARIANT
           : collection().family == Family::rt ? ELVIS_TRANSFORM_CONTRAVARIANT
                                               : ELVIS_TRANSFORM_NONE;
}

/** The native space that contains the collection's; the one nearest to it if it is singular. */
ElementFunction::NativeSpace Field::native_space(std::size_t element) const {
    const bool is_contained = !is_singular(collection(), m_mesh.elements[element].geometry);
    return {is_contained ? collection().polynomial_order() : std::max(2, collection().order), is_contained};
}

void Field::evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const {
    const Geometry geometry = m_mesh.elements[element].geometry;
    const Tabulation& tabulation = *m_tabulations[static_cast<std::size_t>(geometry)];
    const std::size_t n = tabulation.element().n_dofs();
    const auto n_copies = static_cast<std::size_t>(m_function.n_components);
    // Distance of two degrees of freedom and of two components in the file.
    const std::size_t dof_step = m_function.is_interleaved ? n_copies : 1;
    const std::size_t copy_step = m_function.is_interleaved ? 1 : m_space.n_dofs();
    std::vector<double> dofs(n * n_copies);
    m_space.for_terms(element, [&](std::size_t local, std::size_t global, double factor) {
        for (std::size_t copy = 0; copy < n_copies; ++copy) {
            dofs[copy * n + local] += factor * m_function.values[global * dof_step + copy * copy_step];
        }
    });
    tabulation.combine(xi, dofs, n_copies, values, stride);
    if (!collection().is_vector()) {
        return;
    }
    // With A = dxi/dX = 2 R (R a rotation) and J to X: J^-T = J_xi^-T R/2, J / det J = (J_xi / det J_xi) R/4, in two dimensions
    // R/2.
    const double factor = collection().family == Family::rt && m_mesh.dimension == 3 ? 0.25 : 0.5;
    for (std::size_t point = 0; point < xi.size() / 3; ++point) {
        double* value = values + point * stride;
        Point vector{};
        std::copy_n(value, n_components(), vector.begin());
        const Point turned = rotate_to_elvis(geometry, vector);
        for (std::size_t d = 0; d < n_components(); ++d) {
            value[d] = factor * turned[d];
        }
    }
}

} // namespace elvis_mfem
