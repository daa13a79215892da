/**
 * @file part_volume.hpp
 * Some of the elements of a native volume.
 */
#pragma once

#include <elvis/native/volume_source.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace elvis {

/**
 * Has all classes, some of them maybe without elements. Elements keep their numbers. Faces between an element that is there and
 * one that is not have an unknown neighbour: they are no boundary. Of coefficients only those are read that are asked for.
 */
class PartVolume final : public native::VolumeSource {
public:
    /** `elements`: by class, counted in it, ascending. Reads numbers and faces; throws native::FileError. */
    PartVolume(std::shared_ptr<const native::VolumeSource> whole, std::vector<std::vector<std::uint64_t>> elements);

    const native::Description& description() const override { return m_description; }
    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const override;
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const override;
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const override;
    void read_faces(std::uint64_t first, std::uint64_t count, std::span<native::Face> faces) const override;
    /** None: those of the whole are not its own. */
    std::vector<native::Extrema> read_extrema(std::size_t, std::size_t) const override { return {}; }

private:
    void read_own_faces();

    std::shared_ptr<const native::VolumeSource> m_whole;
    std::vector<std::vector<std::uint64_t>> m_elements;
    native::Description m_description;
    std::vector<native::Face> m_faces;
};

} // namespace elvis
