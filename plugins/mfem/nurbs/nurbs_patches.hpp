/**
 * @file nurbs_patches.hpp
 * The patches of a NURBS mesh. Its elements are the spans between knots, in which functions are quotients of polynomials.
 */
#pragma once

#include "../mesh.hpp"
#include "knots.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis_mfem {

struct NurbsPatch {
    std::array<KnotVector, 3> knots;
    /** Numbers of the control points, first direction fastest. */
    std::vector<std::int32_t> control_points;
};

struct NurbsElement {
    std::uint32_t patch = 0;
    /** By direction, see KnotVector::spans(). */
    std::array<int, 3> spans{};
};

struct NurbsPatches {
    int dimension = 3;
    std::vector<NurbsPatch> patches;
    std::vector<NurbsElement> elements;
    /** By number of the control point, as all functions' values. */
    std::vector<double> weights;

    /** Highest order of a direction of an element. */
    int order(std::size_t element) const;
    /** Whether the weights of an element are equal: its functions are polynomials of that order. */
    bool is_polynomial(std::size_t element) const;

    /** Control points of an element and their shares of a function at t in [0, 1]^3. */
    struct Share {
        std::int32_t control_point;
        double weight;
    };
    std::vector<Share> shares(std::size_t element, const Point& t) const;

private:
    template <class Visit> void for_control_points(std::size_t element, Visit&& visit) const;
};

} // namespace elvis_mfem
