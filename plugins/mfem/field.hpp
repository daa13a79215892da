/**
 * @file field.hpp
 * A grid function in one of the collections, ready to be evaluated in any element.
 */
#pragma once

#include "element/space.hpp"
#include "element/tabulation.hpp"
#include "element_function.hpp"
#include "mesh.hpp"

#include <array>
#include <memory>
#include <span>
#include <string>

namespace elvis_mfem {

class Field : public ElementFunction {
public:
    /** `path` is for messages; topology may be null if Space::needs_topology() is false. Throws elvis::api::Error. */
    Field(std::string name, const std::string& path, GridFunction function, const Mesh& mesh, const Topology* topology);

    elvis_continuity continuity() const override;
    elvis_transform transform() const override;
    NativeSpace native_space(std::size_t element) const override;
    void evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const override;

private:
    const Collection& collection() const { return m_function.collection; }

    GridFunction m_function;
    const Mesh& m_mesh;
    Space m_space;
    /** By geometry. */
    std::array<std::unique_ptr<const Tabulation>, 8> m_tabulations;
};

} // namespace elvis_mfem
