/**
 * @file shared_volume.hpp
 * What one rank knows of a volume whose elements lie on several ranks.
 */
#pragma once

#include <elvis/native/volume_source.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis::library {

/** The place of an element: which class, and where in it. */
struct ElementPlace {
    std::size_t element_class = 0;
    std::uint64_t local = 0;
};

/**
 * The whole volume, of which some elements are held: a rank's own, and those around them. Coefficients of others are NaN. All
 * elements are counted, class by class; those that are held have a slot in their class, in the same order. Values may be
 * changed while no one reads.
 */
class SharedVolume final : public native::VolumeSource {
public:
    /** Of the whole volume, without faces. */
    explicit SharedVolume(native::Description description);

    const native::Description& description() const override { return m_description; }
    std::uint64_t first_element(std::size_t element_class) const { return m_first_elements[element_class]; }
    ElementPlace place(std::uint64_t element) const;

    /** Elements that are held from now on, ascending; their coefficients are zero. */
    void hold(std::span<const std::uint64_t> elements);
    /** Elements of a class that are held: their places in it. */
    const std::vector<std::uint64_t>& held(std::size_t element_class) const { return m_held[element_class]; }
    std::uint64_t slot(const ElementPlace& element) const;

    /** Of the element in a slot: three directions, or components, of modes. */
    std::span<double> geometry(std::size_t element_class, std::uint64_t slot);
    std::span<double> field(std::size_t field, std::size_t element_class, std::uint64_t slot);

    /** Those of elements that are held. */
    void set_faces(std::vector<native::Face> faces);

    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const override;
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const override;
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const override;
    void read_faces(std::uint64_t first, std::uint64_t count, std::span<native::Face> faces) const override;
    std::vector<native::Extrema> read_extrema(std::size_t, std::size_t) const override { return {}; }

private:
    std::size_t geometry_size(std::size_t element_class) const;
    std::size_t field_size(std::size_t field, std::size_t element_class) const;
    /** Of elements of a class, `size` numbers each, kept by slot. */
    void read(const std::vector<double>& kept, std::size_t size, std::size_t element_class, std::uint64_t first,
              std::uint64_t count, std::span<double> numbers) const;

    native::Description m_description;
    std::vector<std::uint64_t> m_first_elements;
    /** By class. */
    std::vector<std::vector<std::uint64_t>> m_held;
    std::vector<std::vector<double>> m_geometry;
    /** By field, then class. */
    std::vector<std::vector<std::vector<double>>> m_fields;
    std::vector<native::Face> m_faces;
};

} // namespace elvis::library
