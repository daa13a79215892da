/**
 * @file scene.hpp
 * The scene as its file has it: what was not said is absent. scene.schema.json describes the file.
 */
#pragma once

#include <core/base/memory_budget.hpp>
#include <core/render/frame.hpp>
#include <core/scene/animation.hpp>
#include <core/scene/color/opacity.hpp>
#include <core/scene/scene_annotation.hpp>
#include <core/vulkan/precision.hpp>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace elvis {

using Rgb = std::array<double, 3>;

enum class ColorSpace { rgb, lab, hsv, diverging, step };

struct SceneColorMap {
    /** At most one of name, file and points. */
    std::string name;
    std::string file;
    struct Point {
        double position = 0;
        Rgb rgb{};
    };
    std::vector<Point> points;
    ColorSpace space = ColorSpace::rgb;
    /** Equal parts of the map are for equal ratios of values, all above 0. */
    bool is_logarithmic = false;
    std::optional<std::array<double, 2>> range;
    std::optional<Rgb> below, above, nan;
};

struct SceneCamera {
    std::optional<bool> orthographic;
    std::optional<Vector3> eye, look_at, up;
    std::optional<double> field_of_view, height, near;
    std::array<double, 2> image_shift{};
};

struct SceneLineStyle {
    double width = 1;
    std::optional<Rgb> color, undecided_color;
};

/** A camera with a name. */
struct SceneView {
    std::string name;
    SceneCamera camera;
};

/** The values, or how many of them divide a range evenly. */
struct SceneContours {
    std::vector<double> values;
    std::uint32_t count = 0;
    /** Instead of both: some ten round values of the range. */
    bool is_round = false;
    /** Of the colour map if absent. */
    std::optional<std::array<double, 2>> range;
    /** Without a colour, each line is black or white, whichever stands out from the colour map at its value. */
    SceneLineStyle style;
    /** The lines have the colour map's colour at their value. */
    bool has_map_color = false;
};

/** Of pathlines: points that move with a field through its time steps. */
struct ScenePathTimes {
    /** When points are at their seeds, and till when, or backward since when, they are followed. */
    std::optional<double> start{}, end{};
    /** Between time steps; else cubic. */
    bool is_linear = false;
};

/** Curves that are everywhere tangent to a vector field at the scene's time step; or pathlines. */
struct SceneStreamlines {
    enum class Direction { both, forward, backward };

    /** The vector field or expression. */
    std::string flow;
    /** Points that the lines go through; if nothing else is said either, a grid over the volume's bounds. */
    std::vector<Vector3> seeds{};
    /** Ends of a line of evenly spaced seeds, and how many these are. */
    std::optional<std::array<Vector3, 2>> seed_line{};
    std::uint32_t seed_count = 20;
    /** The name of the scene's surface on which seeds are evenly spaced. */
    std::string on{};
    /** Between seeds, there or, without a surface, in the volume; by default a part of the diagonal of the bounds. */
    std::optional<double> spacing{};
    /** Points of the grid along the longest side of the bounds. */
    std::uint32_t seed_grid = 5;
    Direction direction = Direction::both;
    /** Of each line, in each direction; by default ten times the diagonal of the bounds, of pathlines without limit. */
    std::optional<double> length{};
    /** Of a step's error, as a share of the diagonal of the bounds. */
    double tolerance = 1e-9;
    /** Of the tubes; by default a part of the diagonal. */
    std::optional<double> radius{};
    /** They are ribbons of this width, which turn with the flow, in place of tubes. */
    std::optional<double> ribbon_width{};
    /** They are pathlines. */
    std::optional<ScenePathTimes> times{};
};

/** Arrows of a vector field, from evenly spaced points on; their colours are those of the surface's field there. */
struct SceneArrows {
    /** A vector field or expression. */
    std::string vectors{};
    /** The name of the scene's surface on which they stand; in the volume if empty. */
    std::string on{};
    /** Between them; by default a part of the diagonal of the bounds. */
    std::optional<double> spacing{};
    /** Length of the arrow for a vector of length 1; by default the longest arrow is as long as the spacing. */
    std::optional<double> scale{};
};

/** Line integral convolution on surfaces. */
struct SceneLic {
    /** A vector field or expression. */
    std::string field{};
    /** In pixels, on each side; by default by the picture's size. */
    std::optional<double> length{};
    double contrast = Lic{}.contrast;
};

/** What it lacks it takes from the scene. */
struct SceneSurface {
    SurfaceGeometry geometry;
    /** For expressions; may be empty. */
    std::string name{};
    std::optional<std::string> field{};
    /** Of isosurfaces, which `field` has the values of. */
    std::optional<std::string> color_field{};
    std::optional<SceneColorMap> color_map{};
    std::optional<SceneContours> contours{};
    std::optional<SceneLineStyle> mesh_lines{};
    std::optional<SceneLic> lic{};
    std::vector<std::array<double, 4>> clip{};
    double opacity = 1;
    std::optional<Rgb> outside{};
    bool is_lit = true;
    /** Surfaces that are not drawn are there for expressions, and to be shown again. */
    bool is_shown = true;
    /** Of a TubeSurface or RibbonSurface: what it is about. */
    std::optional<SceneStreamlines> streamlines{};
    /** Of an ArrowSurface: what its arrows are. */
    std::optional<SceneArrows> arrows{};
};

/** A triangle of density around a value, such as makes a semi-transparent isosurface. */
struct ScenePeak {
    double value = 0;
    /** From where the density starts to rise to where it has gone. */
    double width = 0;
    double density = 0;
    /** The transfer function's if absent. */
    std::optional<Rgb> color;
};

/** What it lacks it takes from the scene. */
struct SceneVolumeRendering {
    std::optional<std::string> field;
    /** The transfer function: from a file, as it is, or a colour map with density or opacity, or with a ramp without all. */
    std::string transfer_file;
    std::optional<TransferFunction> transfer;
    std::optional<SceneColorMap> color_map;
    std::vector<TransferFunction::DensityPoint> density;
    std::vector<OpacityPoint> opacity;
    /** Of opacity. */
    double unit_distance = 1;
    /** Added to the density. */
    std::vector<ScenePeak> peaks;
    Integrator integrator = VolumeRendering{}.integrator;
    /** By default the diagonal of the volume's bounds / 256. */
    std::optional<double> step;
    double tolerance = VolumeRendering{}.tolerance;
    bool skips_by_range = true;
    bool is_shown = true;

    /** Whether colours come from the colour map, not with the transfer function. */
    bool is_colored_by_map() const { return transfer_file.empty() && !transfer; }
    bool has_default_density() const { return is_colored_by_map() && density.empty() && opacity.empty() && peaks.empty(); }
};

/** As scenes and the command line call them: exact, riemann, trapezoid, categories, adaptive-trapezoid. */
const std::vector<std::pair<std::string, Integrator>>& integrator_names();
std::optional<Integrator> integrator_named(const std::string& name);

/** The geometry is displaced by factor * Re((field + i imaginary) e^(i phase)). */
struct SceneWarp {
    std::string field;
    std::optional<std::string> imaginary;
    double factor = 1;
    /** Degrees. */
    double phase = 0;

    friend bool operator==(const SceneWarp&, const SceneWarp&) = default;
};

/** A volume beside the scene's own. It shows what that shows, each in its own coordinates. */
struct SceneVolume {
    /** Empty: the scene's own files. */
    std::string path{};
    std::vector<std::string> more_files{};
    std::string plugin{};
    /** JSON text, or empty. */
    std::string plugin_options{};
    /** If absent, 0; of the scene's own files the scene's. */
    std::optional<std::uint32_t> time_step{};
    /** By which it is moved. */
    Vector3 offset{};
    /** The scene's if absent. */
    std::optional<std::string> field{};
};

/** A volume with the same elements, whose fields are there beside the scene's own: its p is NAME.p. */
struct SceneJoin {
    std::string name;
    /** Empty: the scene's own files. */
    std::string path{};
    std::vector<std::string> more_files{};
    std::string plugin{};
    /** JSON text, or empty. */
    std::string plugin_options{};
    /** If absent, the scene's; of a volume with one time step, that. */
    std::optional<std::uint32_t> time_step{};
};

struct Scene {
    std::string volume;
    /** Further files of the same foreign data set. */
    std::vector<std::string> more_files;
    std::string plugin;
    /** JSON text, or empty. */
    std::string plugin_options;
    std::uint32_t time_step = 0;
    std::vector<SceneJoin> joined;
    /** Further ones in the same picture. */
    std::vector<SceneVolume> volumes;
    std::optional<SceneWarp> warp;
    std::optional<std::string> field;
    /** Which part of the volume is shown (threshold.hpp). */
    std::optional<std::string> threshold;
    std::optional<Precision> precision;
    /** What a picture may take, of which only the elements are read that it needs; if absent all are. */
    std::optional<MemoryBudget> memory;
    SceneCamera camera;
    std::array<std::uint32_t, 2> size{1024, 768};
    std::array<double, 4> background{1, 1, 1, 1};
    /** Each pixel of a still picture's colours is the mean of so many across and down. */
    std::uint32_t samples = 1;
    /** Nothing is written on the picture if absent: then its colours are those of the surfaces. */
    std::optional<SceneAnnotation> annotation;
    SceneColorMap color_map;
    std::optional<SceneContours> contours;
    std::optional<SceneLineStyle> mesh_lines;
    std::optional<SceneLic> lic;
    /** How often a pixel is halved at most to decide whether it meets a line. */
    std::uint32_t subdivisions = Surface{}.subdivisions;
    std::vector<SceneSurface> surfaces;
    std::optional<SceneVolumeRendering> volume_rendering;
    /** Colours are those of the colour map if absent. */
    std::optional<Lighting> lighting;
    std::optional<SceneAnimation> animation;
    /** Steps whose values colour maps span where no range is given; the one that is drawn if empty. */
    std::vector<std::uint32_t> range_steps;
    /** Lights that are switched off. */
    std::vector<Light> hidden_lights;
    /** Cameras that people come back to. */
    std::vector<SceneView> views;
};

/** Reads a scene file; paths in it become relative to the working directory. Throws Error naming file, key and cause. */
Scene read_scene(const std::string& path);

/** The same of what the file at `path` would hold; it need not be there. */
Scene scene_of(const nlohmann::json& document, const std::string& path);

/** The JSON Schema of the file, as text. */
std::string_view scene_schema_text();

/** Whether a file is a scene rather than a volume: a JSON object with the key "version". */
bool is_scene(const std::string& path);

} // namespace elvis
