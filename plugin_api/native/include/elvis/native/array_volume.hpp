/**
 * @file array_volume.hpp
 * A native volume in memory.
 */
#pragma once

#include <elvis/native/volume_source.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis::native {

/** Its arrays are there from the start, filled with zeros; elements are numbered class by class. */
class ArrayVolume : public VolumeSource {
public:
    /** `faces`: as many as the description says. Throws std::invalid_argument for spaces that do not exist. */
    ArrayVolume(Description description, std::vector<Face> faces);

    std::shared_ptr<ArrayVolume> copy() const;

    const Description& description() const override { return m_description; }

    /** Laid out as read_geometry and read_field have it, of all elements of the class. */
    std::span<double> geometry(std::size_t element_class) { return m_geometry[element_class]; }
    std::span<double> field(std::size_t field, std::size_t time_step, std::size_t element_class) {
        return m_fields[place(field, time_step, element_class)];
    }

    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const override;
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const override;
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const override;
    void read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const override;
    /** None: they are to be found. */
    std::vector<Extrema> read_extrema(std::size_t, std::size_t) const override { return {}; }

private:
    std::size_t place(std::size_t field, std::size_t time_step, std::size_t element_class) const {
        return (field * m_description.times.size() + time_step) * m_description.classes.size() + element_class;
    }

    Description m_description;
    std::vector<Face> m_faces;
    /** By class. */
    std::vector<std::vector<double>> m_geometry;
    /** By place(). */
    std::vector<std::vector<double>> m_fields;
};

} // namespace elvis::native
