/**
 * @file volume_accuracy.hpp
 * Volumes drawn by the program against the oracle's pictures of them.
 */
#pragma once

#include <core/oracle/samples/random_volumes.hpp>
#include <core/oracle/volume/volume_integral.hpp>

#include <core/render/frame.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <string>

namespace elvis::oracle {

/** What is drawn, but for how. */
struct VolumeScene {
    /** For people. */
    std::string description;
    /** As the oracle reads it, and as the program does. */
    VolumeData data;
    std::string path;
    TransferFunction transfer;
    Camera camera;
    /** Opaque: over a transparent one, colours are not multiplied by opacity, and those of a thin veil are mostly rounding. */
    Color background{0.1, 0.2, 0.3, 1};
};

/** Three peaks of density in the sphere field, in one hexahedron or in 4 x 4 x 6 cells of a shape; writes the volume. */
VolumeScene sphere_scene(const std::string& shape, bool is_one_element, double peak_width, const std::string& path);
/** A random volume with one of many random transfer functions; writes the volume. */
VolumeScene random_scene(std::uint64_t seed, const std::string& path);
/** A native volume seen from outside, with peaks of density in its first field if `transfer` has no points. */
VolumeScene file_scene(const std::string& path, TransferFunction transfer);

/** {"color": [[value, r, g, b], ..], "density": [[value, density], ..]}. Throws an Error that names the file. */
TransferFunction read_transfer(const std::string& path);

struct VolumeComparison {
    std::size_t n_pixels = 0;
    /** Pixels whose light is not that of the background alone. */
    std::size_t n_touched = 0;
    std::size_t n_flagged = 0;
    /** Pixels with a channel off by more than the tolerance. */
    std::size_t n_above = 0;
    /** Those of them that say so (pixel_flag::volume_tolerance). */
    std::size_t n_above_flagged = 0;
    /** Of the others, those that would be right for a field off by its rounding. */
    std::size_t n_above_rounding = 0;
    /** The rest: neither flagged nor rounding. */
    std::size_t n_wrong = 0;
    /** Largest of a channel, opacity included, where it is not flagged and where it is; and the mean over pixels of the
     * largest. */
    double error = 0, flagged_error = 0, mean_error = 0;
    /** A wrong pixel, or else that of the largest error. */
    std::size_t worst_pixel = 0, worst_channel = 0;
    /** Largest estimate of the oracle for itself. */
    double oracle_error = 0;

    VolumeComparison& operator+=(const VolumeComparison& other);
};

/** `rounding`: of the field, over its range. The frame has buffers. */
VolumeComparison compare(const Model& model, const VolumeOptics& optics, const Camera& camera, const Color& background,
                         const VolumePicture& exact, const Frame& frame, double tolerance, double rounding);

/** How the program draws it. */
struct VolumeSettings {
    std::uint32_t size = 200;
    /** Pixels that are compared, by chance; 0: all. */
    std::size_t n_pixels = 0;
    Integrator integrator = Integrator::exact;
    double tolerance = 1e-3;
    /** Over the volume's diagonal. */
    double step = 0.005;
    std::vector<Precision> precisions{Precision::float32, Precision::float64};
};

FrameRequest volume_request(const VolumeScene& scene, const VolumeSettings& settings, double diagonal);

/** One scene drawn in each precision, and by the oracle once. */
struct VolumeAccuracy {
    /** One a precision. */
    std::vector<VolumeComparison> comparisons;
    std::vector<FrameCounts> counts;
    std::vector<double> render_milliseconds;
    VolumePicture exact;
};
VolumeAccuracy measure_volume(const Device* device, const VolumeScene& scene, const VolumeSettings& settings);

/** For people: a line for each thing counted. */
std::string to_text(const VolumeComparison& comparison);

} // namespace elvis::oracle
