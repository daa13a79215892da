/**
 * @file element_finder.hpp
 * Which elements hold a point.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** Any number of threads may ask. */
class ElementFinder {
public:
    explicit ElementFinder(const RuntimeVolume& volume);

    /** Appends the elements whose boxes come near the point, or within `reach` of it, in no particular order. */
    void append_near(const Vector3& position, std::vector<std::uint32_t>& elements, double reach = 0) const {
        m_hierarchy.find(position, m_tolerance + reach, elements);
    }
    /** Of the volume they were made of, on the CPU: the elements that hold the point, and where; ascending. */
    std::vector<ReferencePoint> holders(const RuntimeVolume& volume, const Vector3& position) const;
    /** Of the volume's bounds. */
    double diagonal() const { return m_diagonal; }

private:
    Hierarchy m_hierarchy;
    /** Distance from boxes within which elements are tried: rounding of positions. */
    double m_tolerance = 0;
    double m_diagonal = 0;
};

} // namespace elvis
