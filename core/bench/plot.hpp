/**
 * @file plot.hpp
 * Line plots as SVG files, for the pictures of measurements: nothing to install, and sharp at every size.
 */
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace elvis {

struct PlotSeries {
    std::string name;
    /** In the order in which they are joined. Those with a number that is not finite are left out; in curves, they are gaps. */
    std::vector<std::array<double, 2>> points;
    /** Without a mark at each point. */
    bool is_curve = false;
};

struct PlotAxis {
    std::string label;
    /** On a logarithmic axis, what is not greater than zero is drawn hollow at its lower end, which is then labelled 0. */
    bool is_logarithmic = false;
};

struct Plot {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;
};

/** The document's text. */
std::string to_svg(const Plot& plot);

/** Writes it; an Error that names the file if that fails. */
void write_svg(const std::filesystem::path& path, const Plot& plot);

} // namespace elvis
