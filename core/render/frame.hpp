/**
 * @file frame.hpp
 * What the renderer is asked for, with everything decided (no optional left), and what it gives back.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/camera/camera.hpp>
#include <core/render/picture/lighting.hpp>
#include <core/render/surface.hpp>
#include <core/render/volume/light_run.hpp>
#include <core/render/volume_rendering.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** What passes of one picture take from each other. Each can be turned on and off to compare. */
struct Sharing {
    /**
     * Of surfaces without lines, what opaque ones drawn before hide is not evaluated; isosurfaces are looked for only in front
     * of them. Volume rendering always ends at them. Not by default: it changes crossings with isosurfaces by rounding (1e-7 of
     * a colour), and on processors has not been seen to save time.
     */
    bool depths = false;
    /**
     * What is drawn in several rounds is drawn only in the rows of the picture, or of its tiles, that still want more, and
     * surfaces are merged only in rows in which the volume can be seen. To the bit the same picture.
     */
    bool rows = true;

    static Sharing none() { return {false, false}; }
    static Sharing all() { return {true, true}; }
    /** Each alone, by the names of `elvis render --share`. */
    static std::vector<std::pair<std::string, Sharing>> each() { return {{"depths", {true, false}}, {"rows", {false, true}}}; }
};

/** Some rows of a larger picture: their rays are those of the larger one, to the bit. */
struct PicturePart {
    /** Of the larger picture, and of a first pixel in it. A multiple of part_rows: tiles are then those of the larger one, too.
     */
    std::uint32_t first_row = 0;
    std::uint32_t of_height = 0;
};
inline constexpr std::uint32_t part_rows = 16;

struct FrameRequest {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    /** Of which picture these are rows; none: of themselves. */
    std::optional<PicturePart> part;
    Camera camera;
    Color background{};
    std::uint32_t time_step = 0;
    /** The nearest hit wins. */
    std::vector<Surface> surfaces;
    /** Light of the volume itself. */
    std::optional<VolumeRendering> volume;
    /** Without surfaces: depths in front of which light of the volume is wanted, one a pixel, infinite where nothing hides it.
     */
    std::shared_ptr<const std::vector<double>> hidden_from;
    /**
     * Of one surface with line integral convolution: by what its colours are multiplied, one a pixel, in place of what would be
     * found along its vectors.
     */
    std::shared_ptr<const std::vector<double>> shades;
    /** Of a part of a volume, with hidden_from: Frame::runs are given in place of colours. */
    bool gives_runs = false;
    /**
     * Then: depths at which runs end and others begin. First of each pixel the nearest one, then the second, and so on;
     * infinite where there is none.
     */
    std::vector<std::vector<double>> stops;
    /** Of one surface that can be seen through: Frame::layers are given. */
    bool gives_layers = false;
    /** Surfaces show their colours as they are if absent. */
    std::optional<Lighting> lighting;
    /** Frame's vectors other than color stay empty if false: to read them takes as long as to draw a simple picture. */
    bool with_buffers = true;
    /** Frame::screen is given, a fourth or an eighth of the bytes, and all other vectors stay empty. */
    bool for_screen = false;
    Sharing sharing;
    /** What people should know of how the request came to be; nothing to the renderer. */
    std::vector<std::string> remarks;

    PicturePart place() const { return part.value_or(PicturePart{0, height}); }
};

/** Bits of Frame::flags; the same numbers in `--buffers` files. */
namespace pixel_flag {
inline constexpr std::uint32_t contour = 1;
inline constexpr std::uint32_t contour_undecided = 2;
inline constexpr std::uint32_t mesh_line = 4;
inline constexpr std::uint32_t newton_failure = 8;
inline constexpr std::uint32_t nan = 16;
inline constexpr std::uint32_t isosurface = 32;
inline constexpr std::uint32_t isosurface_undecided = 64;
inline constexpr std::uint32_t volume_tolerance = 128;
inline constexpr std::uint32_t undecided = 256;
inline constexpr std::uint32_t mesh_line_undecided = 512;
inline constexpr std::uint32_t work_limit = 1024;
inline constexpr std::uint32_t estimated = 2048;
inline constexpr std::uint32_t range_too_fine = 4096;
inline constexpr std::uint32_t overlap = 8192;
} // namespace pixel_flag

struct FrameCounts {
    std::uint64_t pixels = 0;
    std::uint64_t hit_pixels = 0;
    std::uint64_t field_evaluations = 0;
    /** Of the mapping alone, where volume rendering follows rays. */
    std::uint64_t mapping_evaluations = 0;
    std::uint64_t newton_failures = 0;
    /** Elements of which faces were chosen, but are drawn without the boundary that their own snippet gives them
     * (elvis_inside). */
    std::uint64_t half_drawn_elements = 0;
    std::uint64_t newton_iterations = 0;
    std::uint64_t undecided_pixels = 0;
    /** Elements of which a part lies in another element; pixels of cut surfaces whose point two elements hold. */
    std::uint64_t overlapping_elements = 0;
    std::uint64_t overlap_pixels = 0;
    std::uint64_t nan_pixels = 0;
    std::uint64_t work_limit_pixels = 0;
    /** Pixels near silhouettes of faces, which take more than Newton's method. */
    std::uint64_t careful_pixels = 0;
    /** Pixels of faces where a crossing could be missed. */
    std::uint64_t estimated_pixels = 0;
    std::uint64_t contour_pixels = 0;
    std::uint64_t undecided_contour_pixels = 0;
    std::uint64_t mesh_line_pixels = 0;
    std::uint64_t undecided_mesh_line_pixels = 0;
    std::uint64_t isosurface_pixels = 0;
    std::uint64_t undecided_isosurface_pixels = 0;
    /** Ray intervals that surely hold no isovalue; that stayed open; and crossings, hidden ones included. */
    std::uint64_t excluded_intervals = 0;
    std::uint64_t undecided_intervals = 0;
    std::uint64_t isosurface_crossings = 0;
    /** Pixels of isosurfaces that were drawn by projection. */
    std::uint64_t projected_pixels = 0;
    /**
     * Of projection: segments that surely hold no isovalue; fits along rays, the sum of their degrees, and those of them that
     * hold none as far as their error estimate is right; places that stayed open.
     */
    std::uint64_t certified_segments = 0;
    std::uint64_t fits = 0, fit_degrees = 0;
    std::uint64_t verified_fits = 0;
    std::uint64_t undecided_fits = 0;
    /** Pixels that the volume itself colours; those where its tolerance was not reached. */
    std::uint64_t volume_pixels = 0;
    std::uint64_t inexact_volume_pixels = 0;
    /** Segments that were integrated, that were passed over as empty; of the first, steps and breakpoints met. */
    std::uint64_t volume_segments = 0, empty_segments = 0;
    std::uint64_t volume_steps = 0, volume_breakpoints = 0;
    /** Pixels that had to be looked at more closely for lines. */
    std::uint64_t refined_pixels = 0;
    /**
     * What sharing saved: pixels of surfaces behind which nothing was looked for; pixels times the rounds in
     * which they were not drawn again, by surfaces and by each kernel of volume rendering.
     */
    std::uint64_t hidden_pixels = 0, spared_pixels = 0;
};

/**
 * Which values beyond the points of its colour table one surface shows, pixels included that surfaces drawn later hide. Those
 * that are outside by less than 1e-4 of the table's extent do not count: the end of a range may be missed by rounding.
 */
struct SpecialValues {
    bool below = false, above = false, nan = false;
    /** Whether a pixel shows the surface at all. */
    bool is_shown = false;
};

/** One picture, top row first; every vector has width * height entries (times components), if asked for. */
struct Frame {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<double> color;         ///< 4 a pixel, before quantisation
    std::vector<double> value;         ///< field value in world units of the field; NaN where nothing was hit
    std::vector<double> depth;         ///< distance from the ray's origin; NaN where nothing was hit
    std::vector<std::int64_t> element; ///< element number as people know it; -1 where nothing was hit
    std::vector<double> normal;        ///< 3 a pixel, unit, towards the viewer; NaN where nothing was hit
    std::vector<std::uint32_t> flags;
    /**
     * 4 bytes a pixel, if FrameRequest::for_screen: colours in 256 levels, rounded as in PNG files; over grey where the picture
     * is not opaque, and opaque.
     */
    std::vector<std::uint8_t> screen;
    /** Light of the volume, if FrameRequest::gives_runs: by pixel, and along each ray. */
    std::vector<LightRun> runs;
    /** What each channel of all light of a ray is off besides. */
    double color_error = 0;
    /**
     * If FrameRequest::gives_layers: the surface where rays meet it for the first time, the second time and so on, each with
     * all vectors above. Of colours the last number is the opacity, 0 where nothing is seen of it.
     */
    std::vector<Frame> layers;
    FrameCounts counts;
    /** Of each surface that was asked for, and of such as the renderer adds. */
    std::vector<SpecialValues> special_values;
    /** Of each surface that was asked for: whether a pixel's ray meets it where it is not clipped. What others hide is met,
     * too. */
    std::vector<bool> is_met;
    /** Wall time of this frame, without upload, hierarchy and compilation. */
    double render_milliseconds = 0;
    /** What render_milliseconds would be on a machine with nothing else to do (DeviceTimer). */
    double device_milliseconds = 0;
    /** How often work of this frame was handed to the device, and how often it was waited for: all that the device did
     * meanwhile. */
    std::uint64_t submissions = 0, host_waits = 0;
};

} // namespace elvis
