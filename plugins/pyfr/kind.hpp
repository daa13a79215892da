/**
 * @file kind.hpp
 * PyFR's kinds of elements, their reference coordinates, nodes, corners and faces (format.md, section 1).
 */
#pragma once

#include <elvis/native/space.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace elvis_pyfr {

struct Kind {
    /** As in the names of datasets. */
    std::string_view name;
    elvis::native::Shape shape;
    int n_faces;
    /** ElVis's local face of each of PyFR's. */
    std::array<int, 6> faces;
};

/** All, in the order of their names, which is that of a volume's elements. */
std::span<const Kind> kinds();
/** None if there is no kind of that name. */
const Kind* find_kind(std::string_view name);

/** Highest order that is read: what is beyond would take minutes to prepare. */
std::uint32_t most_order(const Kind& kind);

/** ElVis's reference coordinates of PyFR's. */
std::array<double, 3> to_native(const Kind& kind, const std::array<double, 3>& x);
/** The same for points with as many coordinates as the kind has dimensions, to three each. */
std::vector<double> to_native(const Kind& kind, std::span<const double> points);

/** Nodes of the geometry, in ElVis's coordinates: equidistant, x fastest, then y, then z. Order at least 1. */
std::vector<double> shape_nodes(const Kind& kind, std::uint32_t order);

} // namespace elvis_pyfr
