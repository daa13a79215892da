/**
 * @file convert.hpp
 * From a foreign data set to the native volume, by projection.
 *
 * Elements are grouped into classes with the same shape and spaces. Blocks of a class are sampled, projected by one matrix for
 * all its elements, compared with the source at other points, and written. Memory is bounded by the blocks in work and by the
 * mesh's topology (about 150 bytes an element, 300 while faces are paired). Coefficients are element-local; nothing is
 * averaged. The result does not depend on the number of processors.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/team.hpp>
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
    /** The target contains the source, geometry included, and the residuals are no more than round-off. */
    bool exact = false;
    /** Largest difference from the source at check points, relative to the field's range (to its size if that is zero). */
    double residual = 0;
    std::uint32_t mantissa_bits = 53;
    /** Largest jump across shared faces, in the field's unit; NaN for fields with a transform, which is not measured. */
    double max_jump = 0;
    /**
     * Discontinuous if that was declared or if the jump is more than rounding; else continuous. For fields with a transform
     * what the source says.
     */
    elvis_continuity continuity = ELVIS_CONTINUITY_UNKNOWN;
    /** Smallest and largest value among all samples of all components. */
    double lower = 0;
    double upper = 0;
    /** Elements (at one time step each) with samples that are not finite. */
    std::uint64_t n_not_finite = 0;
};

struct ConvertReport {
    std::vector<FieldReport> fields;
    /** Largest distance between converted and source geometry, relative to the volume's extent. */
    double geometry_residual = 0;
    bool geometry_exact = false;
    /** Elements by shape. */
    std::map<std::string, std::uint64_t> elements;
    std::uint64_t n_faces = 0;
    std::uint64_t n_boundary_faces = 0;
    /** Faces whose neighbour could not be told: hanging, with maps that do not coincide, or matched by more than two elements.
     */
    std::uint64_t n_unknown_faces = 0;
    /** Coefficients written, geometry included. */
    std::uint64_t n_coefficients = 0;
    double seconds = 0;
};

/** The report as JSON text (keys of the launcher's contract). */
std::string to_json(const ConvertReport& report);
/** The report that to_json wrote. */
ConvertReport report_from_json(const std::string& text);

/**
 * Converts into `output`, which appears only when everything is done: an error or Cancelled leaves nothing behind. Uses all
 * processors.
 */
ConvertReport convert(const SourceVolume& source, const std::string& output, const ConvertOptions& options,
                      const TaskControl& control);

/**
 * The same by a team, each of which has opened the source: members project blocks of elements, and the first writes them. The
 * file is that of one process, and the report is the first's; others get an empty one. Called by all.
 */
ConvertReport convert(const SourceVolume& source, const std::string& output, const ConvertOptions& options,
                      const TaskControl& control, Team& team);

} // namespace elvis
