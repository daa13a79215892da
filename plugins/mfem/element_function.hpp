/**
 * @file element_function.hpp
 * A function on the mesh as the converter asks for it: evaluated in elements, with the native space that suits it.
 */
#pragma once

#include "mesh.hpp"

#include <elvis/converter.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

namespace elvis_mfem {

/** Any thread may evaluate. */
class ElementFunction {
public:
    ElementFunction(std::string name, std::size_t n_components) : m_name(std::move(name)), m_n_components(n_components) {}
    virtual ~ElementFunction() = default;
    ElementFunction(const ElementFunction&) = delete;
    ElementFunction& operator=(const ElementFunction&) = delete;

    const std::string& name() const { return m_name; }
    std::size_t n_components() const { return m_n_components; }

    virtual elvis_continuity continuity() const = 0;
    virtual elvis_transform transform() const { return ELVIS_TRANSFORM_NONE; }
    /** Order of the native space of an element, and whether it contains the function. */
    struct NativeSpace {
        int order = 0;
        bool is_contained = true;
    };
    virtual NativeSpace native_space(std::size_t element) const = 0;

    /**
     * Values at points of ElVis's reference shape, n_components() numbers every `stride`. With a transform they are pulled back
     * to ElVis's reference coordinates (uhat of elvis/element.h).
     */
    virtual void evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const = 0;

private:
    std::string m_name;
    std::size_t m_n_components;
};

/** The elements' attributes, for meshes without solutions. */
class AttributeFunction : public ElementFunction {
public:
    explicit AttributeFunction(const Mesh& mesh) : ElementFunction("attribute", 1), m_mesh(mesh) {}

    elvis_continuity continuity() const override { return ELVIS_CONTINUITY_DISCONTINUOUS; }
    NativeSpace native_space(std::size_t) const override { return {}; }
    void evaluate(std::size_t element, std::span<const double> xi, double* values, std::size_t stride) const override {
        for (std::size_t point = 0; point < xi.size() / 3; ++point) {
            values[point * stride] = m_mesh.elements[element].attribute;
        }
    }

private:
    const Mesh& m_mesh;
};

} // namespace elvis_mfem
