/**
 * @file field.hpp
 * A grid function on a mesh, ready to be evaluated in any element.
 */
#pragma once

#include "element/space.hpp"
#include "element/tabulation.hpp"
#include "mesh.hpp"

#include <array>
#include <memory>
#include <span>
#include <string>

namespace elvis_mfem {

/** Any thread may evaluate. */
class Field {
public:
    /** `path` is for messages; topology may be null if Space::needs_topology() is false. Throws elvis::api::Error. */
    Field(std::string name, const std::string& path, GridFunction function, const Mesh& mesh, const Topology* topology);

    const std::string& name() const { return m_name; }
    const Collection& collection() const { return m_function.collection; }
    std::size_t n_components() const {
        return static_cast<std::size_t>(collection().is_vector() ? m_mesh.dimension : m_function.n_components);
    }

    /**
     * Values at points of ElVis's reference shape, n_components() numbers every `stride`. ND and RT fields are pulled back to
     * ElVis's reference coordinates (uhat of elvis/element.h).
     */
    void evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const;

private:
    std::string m_name;
    GridFunction m_function;
    const Mesh& m_mesh;
    Space m_space;
    /** By geometry. */
    std::array<std::unique_ptr<const Tabulation>, 8> m_tabulations;
};

} // namespace elvis_mfem
