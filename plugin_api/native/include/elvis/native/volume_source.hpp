/**
 * @file volume_source.hpp
 * Where the numbers of a native volume come from: a file (volume_file.hpp) or a program's memory (array_volume.hpp).
 */
#pragma once

#include <elvis/native/description.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis::native {

/** Errors are FileError. Several threads may read at once. */
class VolumeSource {
public:
    VolumeSource() = default;
    virtual ~VolumeSource() = default;
    VolumeSource(const VolumeSource&) = delete;
    VolumeSource& operator=(const VolumeSource&) = delete;

    virtual const Description& description() const = 0;

    /**
     * Geometry of elements first .. first+count-1 of a class: coefficients[(element * 3 + direction) * n_modes + mode],
     * world coordinates, no origin subtracted.
     */
    virtual void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                               std::span<double> coefficients) const = 0;

    /** Field coefficients[(element * n_components + component) * n_modes + mode]; uhat where the field has a transform. */
    virtual void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                            std::uint64_t count, std::span<double> coefficients) const = 0;

    /** Native element number of elements of a class. */
    virtual void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                              std::span<std::int64_t> numbers) const = 0;

    virtual void read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const = 0;

    /**
     * Extrema of a field as the source says: n_extrema(n_components) entries, or none if it does not say. See find_extrema in
     * extrema.hpp.
     */
    virtual std::vector<Extrema> read_extrema(std::size_t field, std::size_t time_step) const = 0;

    /** The parts of the elements of these numbers, each below Description::n_parts, which is not 0. */
    virtual void read_parts(std::uint64_t, std::span<std::uint32_t> parts) const { std::ranges::fill(parts, 0u); }

protected:
    VolumeSource(VolumeSource&&) = default;
    VolumeSource& operator=(VolumeSource&&) = default;
};

} // namespace elvis::native
