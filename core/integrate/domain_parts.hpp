/**
 * @file domain_parts.hpp
 * The elements or faces that an integral runs over.
 */
#pragma once

#include <core/integrate/integral.hpp>
#include <core/integrate/part_integral.hpp>

#include <memory>
#include <vector>

namespace elvis {

/** In the order of elements. Throws Error for groups that are not there, and for volumes that do not tell their faces. */
std::vector<DomainPart> domain_parts(const RuntimeVolume& volume, const IntegralRequest& request, const TaskControl& control);

/** The expression whose level set a plane or isosurface is, and its value there. */
struct LevelSet {
    std::shared_ptr<const Expression> expression;
    double isovalue = 0;
};
LevelSet level_set(const RuntimeVolume& volume, const IntegralRequest& request);

/** Of the parts those that the level set may meet, as far as boxes of elements and ranges of fields tell. */
std::vector<DomainPart> met_parts(const RuntimeVolume& volume, const IntegralRequest& request, const LevelSet& level,
                                  std::vector<DomainPart> parts);

} // namespace elvis
