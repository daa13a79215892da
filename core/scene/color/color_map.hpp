/**
 * @file color_map.hpp
 * Colour maps, and the table that the device interpolates.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/** A map over positions in any range; its ends are mapped to the ends of the colour range. */
struct ColorMap {
    ColorSpace space = ColorSpace::rgb;
    std::vector<SceneColorMap::Point> points;
    std::optional<Rgb> nan;
};

/** One colour, whatever the value. */
SceneColorMap uniform_color_map(const Rgb& color);

/** Names of the built-in maps. */
std::vector<std::string> color_map_names();

/** A built-in map; an Error that lists them if there is none of that name. */
ColorMap built_in_color_map(const std::string& name);

/** Reads ParaView JSON or the original ElVis XML, by content. */
ColorMap read_color_map_file(const std::string& path);

/** What tables of surfaces may deviate from the map in a channel: a hundredth of what a picture may. */
inline constexpr double surface_table_tolerance = 1e-5;
/** Of volumes: a tenth of it, as each point costs a root on each ray that takes its value. */
inline constexpr double volume_table_tolerance = 1e-4;

/** Points of the map and between them, linear in display RGB and within `tolerance` of the map in every channel. */
std::vector<SceneColorMap::Point> piecewise_linear(const ColorMap& map, double tolerance);

/** Where values lie between the ends of a map. */
class ColorScale {
public:
    /** An Error if a logarithmic scale does not begin above 0. */
    ColorScale(const std::array<double, 2>& range, bool is_logarithmic);

    /** 0 and 1 at the ends; less than 0 for what a logarithmic scale does not have. */
    double position(double value) const;
    /** The inverse; exact at both ends. */
    double value(double position) const;

private:
    std::array<double, 2> m_range;
    bool m_is_logarithmic;
};

/**
 * So many equal parts of a logarithmic scale that lines between values at their ends are within `tolerance` of a function that
 * changes evenly by `change` over them. `length`: of the part looked at, as a difference of natural logarithms.
 */
std::uint32_t logarithmic_parts(double length, double change, double tolerance);

/**
 * The table for values from `range`: piecewise linear in display RGB, within `tolerance` of the map in every channel. Values
 * outside take the end colours unless the scene says otherwise; NaN is magenta by default, which is in none of the built-in
 * maps.
 */
ColorTable make_color_table(const SceneColorMap& scene, const std::array<double, 2>& range,
                            double tolerance = surface_table_tolerance);

} // namespace elvis
