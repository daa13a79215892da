#include <core/base/error.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/color/color_space.hpp>
#include <core/scene/read/json_reader.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <mutex>

namespace elvis {

namespace {

constexpr int deepest_split = 12;

struct BuiltIn {
    const char* name;
    ColorSpace space;
    /** Colours at equal distances, as 0xrrggbb. */
    std::vector<std::uint32_t> stops;
};

/**
 * viridis, magma, inferno, plasma (S. van der Walt, N. Smith) and cividis (J. Nunez et al.) by ten of their published stops
 * each, interpolated in Lab, where they are nearly straight; coolwarm by K. Moreland's rule; gray in Lab, so that steps look
 * equal.
 */
const std::vector<BuiltIn>& built_ins() {
    static const std::vector<BuiltIn> maps = {
        {"viridis",
         ColorSpace::lab,
         {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725}},
        {"magma",
         ColorSpace::lab,
         {0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f, 0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf}},
        {"inferno",
         ColorSpace::lab,
         {0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d, 0xa52c60, 0xcf4446, 0xed6925, 0xfb9b06, 0xf7d13d, 0xfcffa4}},
        {"plasma",
         ColorSpace::lab,
         {0x0d0887, 0x47039f, 0x7301a8, 0x9c179e, 0xbd3786, 0xd8576b, 0xed7953, 0xfa9e3b, 0xfdc926, 0xf0f921}},
        {"cividis",
         ColorSpace::lab,
         {0x00224e, 0x123570, 0x3b496c, 0x575d6d, 0x707173, 0x8a8678, 0xa59c74, 0xc3b369, 0xe1cc55, 0xfee838}},
        {"coolwarm", ColorSpace::diverging, {0x3b4cc0, 0xb40426}},
        {"gray", ColorSpace::lab, {0x000000, 0xffffff}},
    };
    return maps;
}

Rgb from_hex(std::uint32_t color) { return {(color >> 16) / 255.0, (color >> 8 & 0xff) / 255.0, (color & 0xff) / 255.0}; }

Color opaque(const Rgb& rgb) { return {rgb[0], rgb[1], rgb[2], 1}; }

/** Appends points between two of the map's until straight lines between them are near enough. */
void refine(const ColorMap& map, const SceneColorMap::Point& from, const SceneColorMap::Point& to, double t_from, double t_to,
            const Rgb& rgb_from, const Rgb& rgb_to, double tolerance, int depth, std::vector<SceneColorMap::Point>& out) {
    bool is_near = true;
    // Three places: a curve may cross its chord in the middle.
    for (const double part : {0.25, 0.5, 0.75}) {
        const Rgb exact = interpolate(map.space, from.rgb, to.rgb, t_from + part * (t_to - t_from));
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double straight = rgb_from[channel] + part * (rgb_to[channel] - rgb_from[channel]);
            is_near = is_near && std::abs(exact[channel] - straight) <= tolerance;
        }
    }
    if (is_near || depth >= deepest_split) {
        return;
    }
    const double t = 0.5 * (t_from + t_to);
    const Rgb rgb = interpolate(map.space, from.rgb, to.rgb, t);
    refine(map, from, to, t_from, t, rgb_from, rgb, tolerance, depth + 1, out);
    out.push_back({from.position + t * (to.position - from.position), rgb});
    refine(map, from, to, t, t_to, rgb, rgb_to, tolerance, depth + 1, out);
}

} // namespace

SceneColorMap uniform_color_map(const Rgb& color) {
    SceneColorMap map;
    map.points = {{0, color}};
    map.below = map.above = map.nan = color;
    map.range = {0.0, 1.0};
    return map;
}

std::vector<std::string> color_map_names() {
    std::vector<std::string> names;
    for (const BuiltIn& map : built_ins()) {
        names.emplace_back(map.name);
    }
    return names;
}

ColorMap built_in_color_map(const std::string& name) {
    for (const BuiltIn& built_in : built_ins()) {
        if (built_in.name == name) {
            ColorMap map;
            map.space = built_in.space;
            const auto last = static_cast<double>(built_in.stops.size() - 1);
            for (std::size_t stop = 0; stop < built_in.stops.size(); ++stop) {
                map.points.push_back({static_cast<double>(stop) / last, from_hex(built_in.stops[stop])});
            }
            return map;
        }
    }
    std::string list;
    for (const std::string& known : color_map_names()) {
        list += (list.empty() ? "" : ", ") + known;
    }
    throw Error("no colour map is named '" + name + "'; there are " + list + ", and files");
}

namespace {

std::vector<SceneColorMap::Point> refined(const ColorMap& map, double tolerance) {
    std::vector<SceneColorMap::Point> out = {map.points.front()};
    for (std::size_t index = 1; index < map.points.size(); ++index) {
        const SceneColorMap::Point& from = map.points[index - 1];
        const SceneColorMap::Point& to = map.points[index];
        if (map.space == ColorSpace::step) {
            out.push_back({to.position, from.rgb});
        } else if (map.space != ColorSpace::rgb && from.position < to.position) {
            refine(map, from, to, 0, 1, from.rgb, to.rgb, tolerance, 0, out);
        }
        out.push_back(to);
    }
    return out;
}

bool is_same(const ColorMap& one, const ColorMap& other) {
    const auto is_same_point = [](const SceneColorMap::Point& a, const SceneColorMap::Point& b) {
        return a.position == b.position && a.rgb == b.rgb;
    };
    return one.space == other.space && std::ranges::equal(one.points, other.points, is_same_point);
}

/** Maps that were refined last: each picture asks for the same few again, and the roots in them take a millisecond. */
class RefinedMaps {
public:
    std::vector<SceneColorMap::Point> of(const ColorMap& map, double tolerance) {
        const std::lock_guard lock(m_mutex);
        for (const Entry& entry : m_entries) {
            if (entry.tolerance == tolerance && is_same(entry.map, map)) {
                return entry.points;
            }
        }
        constexpr std::size_t most = 16;
        if (m_entries.size() == most) {
            m_entries.pop_back();
        }
        m_entries.push_front({map, tolerance, refined(map, tolerance)});
        return m_entries.front().points;
    }

private:
    struct Entry {
        ColorMap map;
        double tolerance;
        std::vector<SceneColorMap::Point> points;
    };
    std::mutex m_mutex;
    std::deque<Entry> m_entries;
};

} // namespace

std::vector<SceneColorMap::Point> piecewise_linear(const ColorMap& map, double tolerance) {
    static RefinedMaps maps;
    return maps.of(map, tolerance);
}

ColorScale::ColorScale(const std::array<double, 2>& range, bool is_logarithmic)
    : m_range(range), m_is_logarithmic(is_logarithmic) {
    if (is_logarithmic && !(range[0] > 0)) {
        char text[160];
        std::snprintf(text, sizeof text,
                      "cannot be logarithmic from %.6g to %.6g: all of its range must be above 0. Give it a range of its own",
                      range[0], range[1]);
        throw Error("color map", text);
    }
}

double ColorScale::position(double value) const {
    const auto [lower, upper] = m_range;
    if (m_is_logarithmic) {
        // Quotients of the ends may overflow, differences of logarithms do not.
        return value > 0 ? (std::log(value) - std::log(lower)) / (std::log(upper) - std::log(lower)) : -1;
    }
    return (value - lower) / (upper - lower);
}

double ColorScale::value(double position) const {
    const auto [lower, upper] = m_range;
    if (position == 0 || position == 1) {
        return m_range[position == 1 ? 1 : 0];
    }
    if (!m_is_logarithmic) {
        return lower + position * (upper - lower);
    }
    const double root = std::exp(0.5 * position * (std::log(upper) - std::log(lower)));
    return lower * root * root;
}

std::uint32_t logarithmic_parts(double length, double change, double tolerance) {
    // A chord of the logarithm over a length of L is off by at most an eighth of L of what it rises.
    return static_cast<std::uint32_t>(std::clamp(std::ceil(std::sqrt(change * length / (8 * tolerance))), 1.0, 1e4));
}

namespace {

/** Between two points of the map, which are `from` and `to` on the scale. */
void refine_logarithmic(const ColorScale& scale, double length, double from, double to, const Rgb& rgb_from, const Rgb& rgb_to,
                        double tolerance, ColorTable& table) {
    double change = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        change = std::max(change, std::abs(rgb_to[channel] - rgb_from[channel]));
    }
    const std::uint32_t n_parts = logarithmic_parts(length * (to - from), change, tolerance);
    for (std::uint32_t part = 1; part < n_parts; ++part) {
        const double t = static_cast<double>(part) / n_parts;
        Rgb rgb{};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            rgb[channel] = rgb_from[channel] + t * (rgb_to[channel] - rgb_from[channel]);
        }
        table.points.push_back({scale.value(from + t * (to - from)), rgb});
    }
}

} // namespace

ColorTable make_color_table(const SceneColorMap& scene, const std::array<double, 2>& range, double tolerance) {
    ColorMap map;
    if (!scene.points.empty()) {
        map = {scene.space, scene.points, std::nullopt};
    } else if (!scene.file.empty()) {
        map = read_color_map_file(scene.file);
    } else {
        map = built_in_color_map(scene.name.empty() ? "viridis" : scene.name);
    }
    const double first = map.points.front().position;
    const double extent = map.points.back().position - first;
    const ColorScale scale(range, scene.is_logarithmic);
    const double length = scene.is_logarithmic ? std::log(range[1]) - std::log(range[0]) : 0;
    // The map bends, and so does the scale: half of the tolerance each.
    const double part = scene.is_logarithmic ? 0.5 * tolerance : tolerance;
    ColorTable table;
    table.is_logarithmic = scene.is_logarithmic;
    double before = 0;
    for (const SceneColorMap::Point& point : piecewise_linear(map, part)) {
        const double t = extent > 0 ? (point.position - first) / extent : 0;
        if (scene.is_logarithmic && t > before) {
            const Rgb rgb_before = table.points.back().rgb;
            refine_logarithmic(scale, length, before, t, rgb_before, point.rgb, part, table);
        }
        table.points.push_back({scale.value(t), point.rgb});
        before = t;
    }
    table.below = opaque(scene.below.value_or(map.points.front().rgb));
    table.above = opaque(scene.above.value_or(map.points.back().rgb));
    table.nan = opaque(scene.nan.value_or(map.nan.value_or(Rgb{1, 0, 1})));
    return table;
}

} // namespace elvis
