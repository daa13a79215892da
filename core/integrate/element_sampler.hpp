/**
 * @file element_sampler.hpp
 * The mapping, and expressions, at many points of one element, on the CPU.
 */
#pragma once

#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis {

struct ElementSamples {
    /** Three numbers a point. */
    std::vector<double> positions;
    /** Nine numbers a point, entry 3 i + j = dx_i/dxi_j. */
    std::vector<double> jacobians;
    /** Of each point one number an expression. */
    std::vector<double> values;
    /** By reference coordinates: three numbers a value. Only if they were asked for. */
    std::vector<double> slopes;
};

/** May be used by several threads at once. */
class ElementSampler {
public:
    /** The volume has CPU evaluation (RuntimeVolume::has_evaluation), and outlives this. */
    ElementSampler(const RuntimeVolume& volume, std::vector<std::shared_ptr<const Expression>> expressions,
                   std::uint32_t time_step);

    std::size_t n_expressions() const { return m_expressions.size(); }

    /** `xi`: three numbers a point. What was in `samples` goes. */
    void sample(std::uint64_t element, std::span<const double> xi, ElementSamples& samples) const;
    /** With slopes, which every expression has as its gradient(); without positions and Jacobians, unless expressions read
     * them. */
    void sample_slopes(std::uint64_t element, std::span<const double> xi, ElementSamples& samples) const;

private:
    class Point;
    struct FieldSamples {
        std::vector<double> values, gradients;
    };
    /** Of the volume's fields those that are used. */
    void sample_mapping(std::uint64_t element, std::span<const double> xi, ElementSamples& samples) const;
    void sample_expressions(std::uint64_t element, std::span<const double> xi, bool with_slopes, ElementSamples& samples) const;
    std::vector<FieldSamples> fields_at(std::uint64_t element, std::span<const double> xi, bool with_slopes) const;

    const RuntimeVolume& m_volume;
    std::vector<std::shared_ptr<const Expression>> m_expressions;
    std::uint32_t m_time_step;
    /** By the volume's fields: whether an expression reads them, and their gradients. */
    std::vector<bool> m_reads_value, m_reads_gradient;
    /** An expression is more than a component of a field. */
    bool m_reads_mapping = false;
};

} // namespace elvis
