/**
 * @file extrema.hpp
 * The smallest and the largest value of a field over all its elements, by branch and bound on Bernstein forms in collapsed
 * coordinates, where the functions of every space are polynomials, pyramids included.
 */
#pragma once

#include <elvis/native/volume_file.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace elvis::native {

/**
 * Distance, over that of the two extrema, which values of the field may keep from the ones that are found. Also what is stored
 * in files.
 */
inline constexpr double extrema_tolerance = 1e-4;

/**
 * Finds the extrema of one field at one time step: of each component, and of the magnitude where there are several. Two rounds:
 * `add` takes all elements in blocks, in any order, and keeps those whose bounds reach beyond all values seen; `finish` reads
 * these again, in an order of its own, and divides them. So the result does not depend on the blocks, and memory holds a
 * number for each element that is kept, not the field.
 *
 * Elements with coefficients that are not finite are passed over. Not for fields with a transform, which are rational.
 */
class ExtremaSearch {
public:
    /** The space of the field in each class. */
    ExtremaSearch(std::span<const Space> spaces, std::uint32_t n_components);
    ~ExtremaSearch();
    /** Copies, one for each time step, share tables and memory for intermediate results: one thread at a time. */
    ExtremaSearch(const ExtremaSearch&);
    ExtremaSearch(ExtremaSearch&&) noexcept;
    ExtremaSearch& operator=(ExtremaSearch&&) noexcept;

    /** Elements first .. first+count-1 of a class: coefficients[(element * n_components + component) * n_modes + mode]. */
    void add(std::size_t element_class, std::uint64_t first, std::uint64_t count, std::span<const double> coefficients);

    /** Coefficients of a range of elements as for `add`. */
    using Read = std::function<void(std::size_t element_class, std::uint64_t first, std::uint64_t count, std::span<double>)>;
    /** Once, after all elements were added. One entry a component, then one for the magnitude if there are several. */
    std::vector<Extrema> finish(const Read& read);

private:
    class Impl;
    std::unique_ptr<Impl> m_impl;
};

/** All of it for a field of a file. */
std::vector<Extrema> find_extrema(const VolumeSource& reader, std::size_t field, std::size_t time_step);

} // namespace elvis::native
