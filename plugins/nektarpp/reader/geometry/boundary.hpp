/**
 * @file boundary.hpp
 * Which elements belong to the domain, and which composites its boundary consists of.
 */
#pragma once

#include "geometry_data.hpp"

namespace nektarpp {

/** For each element of the data, whether the composites of the domain hold it; all if there is no domain. */
std::vector<bool> elements_of_domain(const GeometryData& data);

/** Sides of the domain's boundary that composites hold. */
struct BoundaryGroups {
    /** NAME of the composites, or "C[1]". */
    std::vector<std::string> names;
    /** By element of the data and local side: the first composite that holds it, or ELVIS_GROUP_NONE. */
    std::vector<std::array<std::int32_t, 6>> of_element;
};

BoundaryGroups find_boundary_groups(const GeometryData& data, const std::vector<bool>& is_in_domain);

} // namespace nektarpp
