/**
 * @file mapping_curvature.hpp
 * A proven bound of how far the mapping of an element is from linear.
 *
 * The curvature of shaders/element/prediction.glsl in the element K, with the maximum norm throughout:
 *
 *     C = 1/2 sup over a, b in K and |u| = |v| = 1 of |J(a)^-1 D^2x(b)(u, v)|
 *
 * Of a polynomial mapping, D^2x is a Bernstein form, and the norm is convex: |J(a)^-1 D^2x| is at most what it is at one of the
 * coefficients. For one point a of a part of K whose points are no farther than r from it, this is a number C_a; on the part J
 * changes by 2 C_a r relative to J(a), so that (Neumann's series) C <= C_a / (1 - 2 C_a r) there. Parts are halved until this
 * is close.
 *
 * At a point a that is known, the rows of J0^-1 D^2x tell more, with J0 the Jacobian at the centroid, and s_m the most that
 * its row m makes of u and v:
 *
 *     1/2 sup over b and |u| = |v| = 1 of |J(a)^-1 D^2x(b)(u, v)| <= 1/2 max_i sum_m |J(a)^-1 J0|_im s_m.
 *
 * That bounds how far a prediction from a is off, however the element bends elsewhere (shaders/element/local_curvature.glsl).
 *
 * It is that of the polynomial through positions as they are evaluated. The mapping differs from it by the rounding of
 * positions, which all who compare positions allow for.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/element/bend_form.hpp>
#include <core/volume/element/second_derivatives.hpp>

#include <array>
#include <functional>
#include <span>

namespace elvis {

/** Positions (3 numbers a point), Jacobians (9 a point, entry 3i+j = dx_i/dxi_j), or both, at points of an element. */
using ElementMapping = std::function<void(std::uint64_t element, std::span<const double> xi, std::span<double> positions,
                                          std::span<double> jacobians)>;

/** Where no bound is found: of elements that are strongly bent, or fold. CORE_UNKNOWN_CURVATURE of
 * shaders/element/prediction.glsl. */
inline constexpr float unknown_curvature = 1e9F;

/** Rays are followed through elements with larger ones: CORE_FOLLOWED_CURVATURE of shaders/segments/segment.glsl. */
inline constexpr float followed_curvature = 0.25F;

/** Larger ones are not proven: CORE_MOST_MEASURED_CURVATURE of shaders/element/local_curvature.glsl. */
inline constexpr float most_measured_curvature = 4.0F;

/** What is known of how an element bends; all zero where nothing is, and of elements that fold. */
struct ElementBends {
    /** s_m J0 e_m, one after the other. */
    std::array<float, 9> vectors{};
    /** Only of elements without a proven curvature. */
    BendForm form{};

    bool operator==(const ElementBends&) const = default;
};

/** Of one shape and order. Any thread may call. */
class CurvatureBounder {
public:
    /** Whether mappings of the class are known to be polynomials, and of no degree that would take too long. */
    static bool can_bound(const ClassInfo& element_class);

    CurvatureBounder(elvis_shape shape, std::span<const std::uint32_t, 3> order);

    /** Of elements from `first` on. */
    void operator()(const ElementMapping& mapping, std::uint64_t first, std::span<float> curvatures,
                    std::span<ElementBends> bends) const;

private:
    struct Group;
    struct Element;

    void bound_group(Group& group, std::span<float> curvatures, std::span<ElementBends> bends) const;
    /** Seen at the nodes of its mapping. */
    bool folds(const Element& element) const;
    /** `shown`: C_a of some point. */
    double bound_in_parts(const Element& element, double shown) const;

    elvis_shape m_shape;
    SecondDerivatives m_derivatives;
};

} // namespace elvis
