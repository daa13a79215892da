/**
 * @file level_function.hpp
 * How far an expression is from a value, over a block of an element.
 */
#pragma once

#include <core/integrate/element_blocks.hpp>
#include <core/integrate/element_sampler.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** At one point. */
struct LevelSample {
    /** The expression less the value; zero where it is no more than rounding. */
    double value = 0;
    /** By the coordinates of the block, and by reference coordinates. */
    Vector3 slope{}, reference_slope{};
    Vector3 xi{};
    /** Of the block's map to reference coordinates: its determinant's magnitude. */
    double volume = 0;
};

class LevelFunction {
public:
    /** The sampler has one expression, which has a gradient(). All must outlive this. */
    LevelFunction(const ElementSampler& sampler, std::uint64_t element, const ElementBlock& block, double isovalue)
        : m_sampler(sampler), m_element(element), m_block(block), m_isovalue(isovalue) {}

    /** One sample a point; points are in the cube [0,1]^3. */
    const std::vector<LevelSample>& at(std::span<const Vector3> points);
    std::uint64_t n_evaluations() const { return m_n_evaluations; }

private:
    bool is_rounding(double value, const Vector3& slope) const;

    const ElementSampler& m_sampler;
    std::uint64_t m_element;
    const ElementBlock& m_block;
    double m_isovalue;
    std::uint64_t m_n_evaluations = 0;
    std::vector<double> m_xi;
    std::vector<ElementBlock::Place> m_places;
    ElementSamples m_samples;
    std::vector<LevelSample> m_answers;
};

} // namespace elvis
