/**
 * @file joined_volume.hpp
 * A native volume that has the fields of others beside its own: of another time, another order, another solver.
 */
#pragma once

#include <elvis/native/volume_source.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::native {

/** A volume whose fields are joined. */
struct Joined {
    /** Its field p is NAME.p. */
    std::string name;
    std::shared_ptr<const VolumeSource> source;
    /** At each time step this one is shown; if absent, the same, or the only one there is. */
    std::optional<std::size_t> time_step;
};

/**
 * Behind its own fields come those of the others; then, where another has a field p with the name and components of an own one,
 * the field "p - NAME.p". That is the difference of the coefficients, in a space that holds both: what is known of it is not
 * known of two large numbers.
 *
 * Elements are matched by class and place in it, and must be the same: each joined geometry differs from the first by at most
 * `same_geometry` of its largest coordinate. So a point of an element has one place and all values, each exact, whatever the
 * fields' orders.
 */
class JoinedVolume : public VolumeSource {
public:
    static constexpr double same_geometry = 1e-10;

    /**
     * Reads all geometries. Throws std::invalid_argument for names that are no words or are there twice, for volumes with
     * other elements, which it names, and for other numbers of time steps; FileError where a file cannot be read.
     */
    JoinedVolume(std::shared_ptr<const VolumeSource> source, std::vector<Joined> others);
    /** Whether another volume's elements are the same. Reads both geometries; throws FileError where a file cannot be read. */
    static bool has_same_elements(const VolumeSource& source, const VolumeSource& other);
    ~JoinedVolume() override;
    /** Whether fields can have this name before theirs: letters, digits and _, no digit first. */
    static bool is_name(const std::string& name);

    const Description& description() const override { return m_description; }
    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const override;
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const override;
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const override;
    void read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const override;
    std::vector<Extrema> read_extrema(std::size_t field, std::size_t time_step) const override;
    void read_parts(std::uint64_t first, std::span<std::uint32_t> parts) const override;

private:
    /** A field of one of the volumes, at a time step of its own if it has one. */
    struct Place {
        std::size_t field = 0;
        /** Null: the first one. */
        const Joined* joined = nullptr;
    };
    /** Of differences. */
    struct Changes;
    struct Column {
        Place place;
        std::optional<Place> less;
        std::shared_ptr<const Changes> changes;
    };

    void add_fields(const Joined& joined);
    void add_differences(const Joined& joined);
    const VolumeSource& source_of(const Place& place) const;
    std::size_t step_of(const Place& place, std::size_t time_step) const;
    void read(const Place& place, std::size_t time_step, std::size_t element_class, std::uint64_t first, std::uint64_t count,
              std::span<double> coefficients) const;

    std::shared_ptr<const VolumeSource> m_source;
    std::vector<Joined> m_others;
    /** By field. */
    std::vector<Column> m_columns;
    Description m_description;
};

} // namespace elvis::native
