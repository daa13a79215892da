/**
 * @file description.hpp
 * What a native volume is made of, but for its numbers.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstdint>
#include <limits>
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
    /** Of the partition of whoever made the data, such as a solver; 0 if there is none, or it is not known. */
    std::uint32_t n_parts = 0;
    /** Provenance and other facts as (key, value): "source file", "converter", "converter version", "created", ... */
    std::vector<std::pair<std::string, std::string>> notes;

    std::uint64_t n_elements() const;
};

} // namespace elvis::native
