/**
 * @file convert.hpp
 * From a foreign data set to the native volume, by projection.
 *
 * Elements are grouped into classes with the same shape and spaces. For each class, blocks of elements are sampled at collapsed
 * Gauss points and projected (projector.hpp), compared with the source at other points, and written: memory is bounded by a
 * block and the mesh's topology. Coefficients are element-local; nothing is averaged.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

struct ConvertOptions {
    /** Order of every field; none: what the source advises. */
    std::optional<std::uint32_t> order;
    /** Overrides the continuity that the source declares. */
    std::optional<elvis_continuity> continuity;
    /** Names of the fields to convert, in this order; empty: all. */
    std::vector<std::string> fields;
    /** Written into the file's provenance. */
    std::string program_version;
};

struct FieldReport {
    std::string name;
    /** The target contains the source, and the residual is no more than round-off. */
    bool exact = false;
    /** Largest difference from the source at check points, relative to the field's range (to its size if that is zero). */
    double residual = 0;
    std::uint32_t mantissa_bits = 53;
    /** Largest jump across shared faces, in the field's unit. */
    double max_jump = 0;
    /** As the jump shows it. */
    elvis_continuity continuity = ELVIS_CONTINUITY_UNKNOWN;
    double lower = 0;
    double upper = 0;
    std::uint64_t n_not_finite = 0;
};

struct ConvertReport {
    std::vector<FieldReport> fields;
    /** Largest distance between converted and source geometry, relative to the volume's extent. */
    double geometry_residual = 0;
    /** Elements by shape. */
    std::map<std::string, std::uint64_t> elements;
    std::uint64_t n_faces = 0;
    std::uint64_t n_boundary_faces = 0;
    /** Faces whose neighbour could not be told: hanging, or matched by more than two elements. */
    std::uint64_t n_unknown_faces = 0;
    double seconds = 0;
};

/** The report as JSON text (keys of the launcher's contract). */
std::string to_json(const ConvertReport& report);

/** Converts into `output`, which appears only when everything is done. Uses all processors. */
ConvertReport convert(const SourceVolume& source, const std::string& output, const ConvertOptions& options,
                      const TaskControl& control);

} // namespace elvis
