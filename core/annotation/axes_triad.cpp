#include <core/annotation/items.hpp>
#include <core/base/vector3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace elvis {

namespace {

/** An axis on the picture: for the point that the camera looks at, the projection's derivative points the same way. */
struct Axis {
    std::size_t number = 0;
    Point2 direction{}; ///< right, down; its length is the sine of the angle to the view
    double away = 0;    ///< cosine of the angle to the view: > 0 if the axis points away from the viewer
};

std::array<Axis, 3> project(const Camera& camera) {
    const Vector3 view = unit(minus(camera.look_at, camera.eye));
    const Vector3 right = unit(cross(view, camera.up));
    const Vector3 top = cross(right, view);
    std::array<Axis, 3> axes;
    for (std::size_t i = 0; i < 3; ++i) {
        axes[i] = {i, {right[i], -top[i]}, view[i]};
    }
    return axes;
}

/** Red, green, blue for x, y, z, of about the same brightness and clear on black as on white. */
constexpr std::array<Color, 3> axis_colors = {{{0.86, 0.20, 0.18, 1}, {0.20, 0.62, 0.20, 1}, {0.16, 0.44, 0.90, 1}}};

Color darker(const Color& color) { return {0.62 * color[0], 0.62 * color[1], 0.62 * color[2], 1}; }

Point2 scaled(const Point2& p, double factor) { return {factor * p[0], factor * p[1]}; }

/** An ellipse, the image of a circle across the axis. */
std::vector<Point2> rim(const Point2& center, const Axis& axis, double radius) {
    constexpr int n_points = 48;
    const double length = std::hypot(axis.direction[0], axis.direction[1]);
    const Point2 along = length > 1e-9 ? scaled(axis.direction, 1 / length) : Point2{1, 0};
    const double flat = std::abs(axis.away);
    std::vector<Point2> points;
    for (int i = 0; i < n_points; ++i) {
        const double angle = 2 * std::numbers::pi * i / n_points;
        const double a = radius * flat * std::cos(angle), b = radius * std::sin(angle);
        points.push_back({center[0] + a * along[0] - b * along[1], center[1] + a * along[1] + b * along[0]});
    }
    return points;
}

/** The convex hull (monotone chain): the silhouette of a cone is that of its tip and rim. */
std::vector<Point2> hull(std::vector<Point2> points) {
    std::sort(points.begin(), points.end());
    std::vector<Point2> result;
    const auto turns_right = [](const Point2& a, const Point2& b, const Point2& c) {
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0;
    };
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = result.size();
        for (const Point2& point : points) {
            while (result.size() >= begin + 2 && turns_right(result[result.size() - 2], result.back(), point)) {
                result.pop_back();
            }
            result.push_back(point);
        }
        result.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return result;
}

Drawing arrow(const Axis& axis, const ItemStyle& style) {
    const double shaft = 0.035 * style.axes, head = 0.11 * style.axes;
    constexpr double neck = 0.68;
    const Color color = axis_colors[axis.number], shade = darker(color);
    const Point2 tip = scaled(axis.direction, style.axes), base = scaled(axis.direction, neck * style.axes);
    std::vector<Point2> rod = rim({0, 0}, axis, shaft);
    const std::vector<Point2> end = rim(base, axis, shaft);
    rod.insert(rod.end(), end.begin(), end.end());
    const std::vector<Point2> disc = rim(base, axis, head);
    std::vector<Point2> cone = disc;
    cone.push_back(tip);

    Drawing drawing;
    if (axis.away > 0) {
        // From behind: the cone's base hides its tip, and the rod lies before it.
        drawing.add(polygon_mask(hull(cone)), color, true);
        drawing.add(polygon_mask(disc), shade);
        drawing.add(polygon_mask(hull(rod)), color, true);
    } else {
        drawing.add(polygon_mask(hull(rod)), shade, true);
        drawing.add(polygon_mask(hull(cone)), color, true);
    }
    return drawing;
}

/** The letter's place: beyond the tip, or where no other letter is. */
Mask letter(const Font& font, const Axis& axis, const std::vector<PixelBox>& taken, const ItemStyle& style) {
    static const std::array<std::string, 3> names = {"x", "y", "z"};
    Mask mask = font.text(names[axis.number], style.text);
    const double length = std::hypot(axis.direction[0], axis.direction[1]);
    const double angle = length > 1e-9 ? std::atan2(axis.direction[1], axis.direction[0]) : 0;
    const double center_x = 0.5 * (mask.box.left + mask.box.right), center_y = 0.5 * (mask.box.top + mask.box.bottom);
    const PixelBox start = mask.box;
    constexpr int n_turns = 12;
    for (int turn = 0; turn < n_turns; ++turn) {
        // 0, 30, -30, 60, ... degrees from the axis. An arrow towards the viewer has its letter beside the head.
        const int n_steps = (turn % 2 == 0 ? 1 : -1) * ((turn + 1) / 2);
        const double away = angle + n_steps * std::numbers::pi / 6;
        const double gap = std::max(0.65 * style.text, 0.11 * style.axes * (1 - length) + 0.6 * style.text);
        const double x = style.axes * axis.direction[0] + gap * std::cos(away);
        const double y = style.axes * axis.direction[1] + gap * std::sin(away);
        mask.box = moved(start, static_cast<int>(std::lround(x - center_x)), static_cast<int>(std::lround(y - center_y)));
        const PixelBox here = grown(mask.box, std::max(1, style.line));
        if (std::none_of(taken.begin(), taken.end(), [&](const PixelBox& other) { return other.meets(here); })) {
            return mask;
        }
    }
    return mask;
}

} // namespace

Drawing axes_triad(const Font& font, const Camera& camera, const ItemStyle& style) {
    std::array<Axis, 3> axes = project(camera);
    std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.away > b.away; });
    Drawing drawing;
    std::vector<PixelBox> taken;
    for (const Axis& axis : axes) {
        Drawing one = arrow(axis, style);
        // Letters keep clear of the heads.
        std::vector<Point2> head = rim(scaled(axis.direction, style.axes), axis, 0.02 * style.axes);
        taken.push_back(polygon_mask(head).box);
        drawing.add(std::move(one));
    }
    std::reverse(axes.begin(), axes.end());
    for (const Axis& axis : axes) {
        Mask mask = letter(font, axis, taken, style);
        taken.push_back(mask.box);
        drawing.add(std::move(mask));
    }
    return drawing;
}

} // namespace elvis
