/**
 * @file conversion.hpp
 * From coefficients of a native space to coefficients of its device space: the same functions in another basis.
 */
#pragma once

#include <elvis/native/device_space.hpp>

#include <memory>
#include <span>
#include <vector>

namespace elvis::native::device {

/**
 * Both bases are products, so the conversion is a product of small matrices where the factors separate (hexahedra and tensor
 * pyramids in three directions, prisms in direction 2 against the triangle of directions 1 and 3), and one dense matrix for
 * tetrahedra and the other pyramids. Built once for a space, in double precision, from values of the native modes at Gauss
 * points; `apply` may be called from several threads.
 */
class Conversion {
public:
    explicit Conversion(const Space& space);

    const DeviceSpace& device_space() const { return m_device; }
    std::size_t n_native() const { return m_gather.size(); }

    /** Device coefficients in the order of the record: slab by slab. Sizes n_native() and device_space().n_modes(). */
    void apply(std::span<const double> native_coefficients, std::span<double> device_coefficients) const;

    /**
     * Native coefficients of the function 1. To subtract a constant before the conversion keeps the digits that the conversion
     * would round away after it.
     */
    const std::vector<double>& native_one() const { return m_native_one; }

private:
    struct Axes;
    static Axes build_axes(const Space& space, const DeviceSpace& device, std::vector<std::size_t>& gather);
    void find_native_one();

    DeviceSpace m_device;
    /** Native index of each entry of the array [n_2][n_1][n_0] on which the matrices work. */
    std::vector<std::size_t> m_gather;
    std::shared_ptr<const Axes> m_axes;
    std::vector<double> m_native_one;
};

/**
 * Where a function of a tensor pyramid has a single value at the apex, all its functions without a power of t but the constant
 * vanish. Round-off of the data leaves about 1e-16 to 1e-13 of the largest native coefficient, which 1/t in the gradient would
 * blow up near the apex; a true part is never so small. Zeroing changes values by less than 1e-12 of their size.
 */
void clean_apex(const DeviceSpace& space, std::span<const double> coefficients, std::span<double> modes);

} // namespace elvis::native::device
