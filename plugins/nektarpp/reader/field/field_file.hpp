/**
 * @file field_file.hpp
 * One time step of fields (.fld, .chk, or a directory of partitions), in memory.
 */
#pragma once

#include "../geometry/mesh.hpp"
#include "mode_set.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nektarpp {

/** Files that make up one time step. */
struct FieldPaths {
    /** What the user named. */
    std::string path;
    std::vector<std::string> parts;
    /** Info.xml of a directory; may be empty. */
    std::string info;
};

/** What is read of a file: all, or names, time and modes alone, which takes a fraction of the time. */
enum class FieldContent { everything, modes };

/** Immutable after construction: any thread may read. */
class FieldFile {
public:
    /** Reads and checks. Throws elvis::api::Error with the byte and the tag of what is wrong. */
    FieldFile(const FieldPaths& paths, const Mesh& mesh, FieldContent content = FieldContent::everything);

    const std::vector<std::string>& fields() const { return m_fields; }
    /** From the metadata. */
    std::optional<double> time() const { return m_time; }

    /** The modes of a field in an element of the mesh; null if the file has no data there. */
    const ModeSet* modes(std::size_t field, std::uint64_t element) const;
    /** Their coefficients; only if everything was read. */
    std::span<const double> coefficients(std::size_t field, std::uint64_t element) const;

private:
    class Builder;

    struct KnownSet {
        ModeSet modes;
        std::size_t n_coefficients = 0;
    };
    /** Index of the set in the upper 16 bits, first coefficient in the lower 48. */
    using Place = std::uint64_t;
    static constexpr Place no_place = ~Place{0};

    std::vector<std::string> m_fields;
    std::optional<double> m_time;
    std::vector<KnownSet> m_sets;
    /** By field and element. */
    std::vector<std::vector<Place>> m_places;
    std::vector<double> m_coefficients;
};

} // namespace nektarpp
