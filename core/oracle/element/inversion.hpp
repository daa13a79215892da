/**
 * @file inversion.hpp
 * All reference points of an element that map to a given position: Newton's method where it succeeds, and subdivision of the
 * element's Bernstein form, which cannot miss a solution, where it does not.
 */
#pragma once

#include "enclosure.hpp"

#include <cstdint>
#include <vector>

namespace elvis::oracle {

struct Solution {
    Vector xi;
    /** Largest violated face constraint; <= 0 inside. */
    double excess = 0;
    Matrix jacobian;
};

struct InversionCounts {
    std::uint64_t queries = 0;
    std::uint64_t subdivided = 0;
    /** Subdivision gave up: the answer may lack a solution. */
    std::uint64_t unresolved = 0;
};

/** For one thread; it remembers the last solution in each element, from which the next search starts. */
class Inverter {
public:
    Inverter(const Volume& volume, const std::vector<Enclosure>& enclosures);

    /**
     * Solutions with excess <= tolerance (in reference coordinates). One, if there is one, in elements whose Jacobian keeps its
     * sign; all in folded ones.
     */
    std::vector<Solution> find(std::size_t element, const Vector& x, double tolerance);

    const InversionCounts& counts() const { return m_counts; }

private:
    bool newton(std::size_t element, const Vector& x, Vector xi, Solution& solution) const;
    void subdivide(std::size_t element, const Vector& x, double tolerance, std::vector<Solution>& solutions);

    const Volume* m_volume;
    const std::vector<Enclosure>* m_enclosures;
    std::vector<Vector> m_last;
    InversionCounts m_counts;
};

} // namespace elvis::oracle
