/**
 * @file nurbs_function.hpp
 * A function in the NURBS space of the mesh.
 */
#pragma once

#include "../element_function.hpp"
#include "nurbs_patches.hpp"

namespace elvis_mfem {

class NurbsFunction : public ElementFunction {
public:
    /** `path` is for messages. Throws elvis::api::Error if the function is not one of this mesh. */
    NurbsFunction(std::string name, const std::string& path, GridFunction function, const Mesh& mesh);

    elvis_continuity continuity() const override { return ELVIS_CONTINUITY_CONTINUOUS; }
    NativeSpace native_space(std::size_t element) const override;
    void evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const override;

private:
    GridFunction m_function;
    const NurbsPatches& m_patches;
};

} // namespace elvis_mfem
