/**
 * @file jacobian_check.hpp
 * Which elements have a negative Jacobian determinant somewhere.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace elvis {

/** Of the determinant, over its largest magnitude in the element; see elvis_runtime.check_jacobians. */
inline constexpr double default_jacobian_tolerance = 1e-9;

struct JacobianReport {
    /** Estimated: from the plugin's own estimate, or from samples; an element negative between samples is called positive. */
    elvis_certainty certainty = ELVIS_ESTIMATED;
    /** One sign an element, by position in the volume. */
    std::vector<elvis_jacobian_sign> signs;
    /** The elements that are not positive, ascending, with what is known of them. */
    std::vector<std::pair<std::uint64_t, JacobianCheck>> findings;
    std::uint64_t n_positive = 0;
    std::uint64_t n_negative = 0;
    std::uint64_t n_undecided = 0;
};

/**
 * Whether the plugin bounds Jacobians or lets them be sampled. In two dimensions they are sampled, where all elements lie in a
 * plane of constant z; surfaces in space have none.
 */
bool can_check_jacobians(const RuntimeVolume& volume);

/** Of all elements; needs can_check_jacobians(). Reports progress and stops as `control` says. */
JacobianReport check_jacobians(const RuntimeVolume& volume, double tolerance = default_jacobian_tolerance,
                               const TaskControl* control = nullptr);

} // namespace elvis
