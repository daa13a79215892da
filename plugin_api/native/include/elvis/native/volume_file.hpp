/**
 * @file volume_file.hpp
 * Reads and writes the native volume (HDF5). The format is specified in format.md.
 *
 * Errors of either class throw FileError, whose text names the file, the object in it and what is wrong. HDF5 serialises its
 * calls: an object of these classes may be used by one thread at a time; different objects may be used by different threads,
 * because every call takes one process-wide lock.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace elvis::native {

class FileError : public std::runtime_error {
public:
    FileError(std::string file, const std::string& what);
    const std::string& file() const { return m_file; }

private:
    std::string m_file;
};

enum class Continuity : std::uint32_t { unknown, continuous, discontinuous };
enum class Transform : std::uint32_t { none, covariant, contravariant };

struct Field {
    std::string name;
    std::string unit;
    std::uint32_t n_components = 1;
    Continuity continuity = Continuity::unknown;
    Transform transform = Transform::none;
    /** Largest jump across shared faces; NaN if not measured. */
    double max_jump = std::numeric_limits<double>::quiet_NaN();
};

/** Elements with the same shape and spaces. */
struct ElementClass {
    Space geometry;
    /** One space for each field of the volume. */
    std::vector<Space> fields;
    std::uint64_t n_elements = 0;
};

/** One face; elements are native element numbers (position in the source file). Neighbours as in elvis/element.h. */
struct Face {
    std::int64_t element = 0;
    std::int64_t neighbour = -2;
    std::int32_t local_face = 0;
    std::int32_t neighbour_local_face = -1;
    std::int32_t group = -1;
};

/** A smallest or largest value of a field, and where it is taken. */
struct Extremum {
    /** NaN if no element has finite coefficients. */
    double value = std::numeric_limits<double>::quiet_NaN();
    /** Certified: no value of the field lies beyond. */
    double bound = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t element_class = 0;
    /** Place of the element in its class. */
    std::uint64_t element = 0;
    Point xi{};
};

struct Extrema {
    Extremum minimum, maximum;
};

/** Entries of a field's list of extrema: its components, and the magnitude if there are several. */
inline std::size_t n_extrema(std::uint32_t n_components) { return n_components > 1 ? n_components + 1u : 1u; }

/** All of a volume but its numbers. */
struct Description {
    int dimension = 3;
    std::vector<ElementClass> classes;
    std::vector<Field> fields;
    /** Physical time of each step; at least one. */
    std::vector<double> times{0.0};
    std::vector<std::string> boundary_groups;
    std::uint64_t n_faces = 0;
    /** Provenance and other facts as (key, value): "source file", "converter", "converter version", "created", ... */
    std::vector<std::pair<std::string, std::string>> notes;

    std::uint64_t n_elements() const;
};

class Reader {
public:
    /** Opens and checks structure, version and sizes; reads no coefficients. */
    explicit Reader(const std::string& path);
    ~Reader();
    Reader(Reader&&) noexcept;
    Reader& operator=(Reader&&) noexcept;

    /** 100 if the file carries the native volume's mark, 0 otherwise, a missing file included. Never throws. */
    static int probe(const std::string& path) noexcept;

    const Description& description() const;

    /**
     * Geometry of elements first .. first+count-1 of a class: coefficients[(element * 3 + direction) * n_modes + mode],
     * world coordinates, no origin subtracted.
     */
    void read_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<double> coefficients) const;

    /** Field coefficients[(element * n_components + component) * n_modes + mode]; uhat where the field has a transform. */
    void read_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                    std::uint64_t count, std::span<double> coefficients) const;

    /** Native element number of elements of a class. */
    void read_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                      std::span<std::int64_t> numbers) const;

    void read_faces(std::uint64_t first, std::uint64_t count, std::span<Face> faces) const;

    /**
     * Extrema of a field as the file says: n_extrema(n_components) entries, or none if it does not say (files of version 1.0
     * and of other writers, fields with a transform). See find_extrema in extrema.hpp.
     */
    std::vector<Extrema> read_extrema(std::size_t field, std::size_t time_step) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/**
 * Writes to a temporary file beside the target; `commit` renames it into place. Destroyed without commit, it leaves nothing.
 * Blocks may come in any order, each element once; `commit` refuses a volume with unwritten blocks. The extrema of fields
 * without a transform are found on the way (extrema.hpp).
 */
class Writer {
public:
    Writer(const std::string& path, const Description& description);
    ~Writer();
    Writer(Writer&&) noexcept;
    Writer& operator=(Writer&&) noexcept;

    void write_geometry(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                        std::span<const double> coefficients);
    void write_field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t first,
                     std::uint64_t count, std::span<const double> coefficients);
    void write_numbers(std::size_t element_class, std::uint64_t first, std::uint64_t count,
                       std::span<const std::int64_t> numbers);
    void write_faces(std::uint64_t first, std::uint64_t count, std::span<const Face> faces);
    /** Known only after all blocks. */
    void set_max_jump(std::size_t field, double jump);
    /** Replaces the label given in the description: what the jumps show is known only after all blocks. */
    void set_continuity(std::size_t field, Continuity continuity);
    /** Adds or replaces a note. */
    void set_note(const std::string& key, const std::string& value);
    void commit();

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis::native
