#include "pictures.hpp"

#include <core/annotation/items.hpp>

#include <catch2/catch.hpp>

#include <numbers>
#include <random>

using namespace elvis;
using namespace elvis::test;

namespace {

/** Where the camera's formulas put a point: s to the right, v upwards. */
std::array<double, 2> picture_place(const Camera& camera, const Vector3& x) {
    const auto dot = [](const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto cross = [](const Vector3& a, const Vector3& b) {
        return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto unit = [&](const Vector3& a) {
        const double length = std::sqrt(dot(a, a));
        return Vector3{a[0] / length, a[1] / length, a[2] / length};
    };
    const Vector3 d =
        unit({camera.look_at[0] - camera.eye[0], camera.look_at[1] - camera.eye[1], camera.look_at[2] - camera.eye[2]});
    const Vector3 right = unit(cross(d, camera.up)), top = cross(right, d);
    const Vector3 from_eye = {x[0] - camera.eye[0], x[1] - camera.eye[1], x[2] - camera.eye[2]};
    const double scale =
        camera.orthographic ? 0.5 * camera.height : dot(from_eye, d) * std::tan(camera.field_of_view * std::numbers::pi / 360);
    return {dot(from_eye, right) / scale, dot(from_eye, top) / scale};
}

/** Red for x, and so on: which axis a pixel shows, or -1. */
int axis_of(const double* p) {
    const double most = std::max({p[0], p[1], p[2]}), least = std::min({p[0], p[1], p[2]});
    if (most - least < 0.25) {
        return -1;
    }
    return p[0] == most ? 0 : p[1] == most ? 1 : 2;
}

} // namespace

TEST_CASE("the triad's arrows point along the projected axes") {
    std::mt19937 random(17);
    std::normal_distribution<double> normal;
    const Font font;
    double worst = 0;
    for (int repetition = 0; repetition < 60; ++repetition) {
        Camera camera;
        camera.orthographic = repetition % 2 == 0;
        camera.look_at = {normal(random), normal(random), normal(random)};
        camera.eye = {camera.look_at[0] + 3 * normal(random), camera.look_at[1] + 3 * normal(random),
                      camera.look_at[2] + 3 * normal(random)};
        camera.up = {normal(random), normal(random), normal(random)};
        ItemStyle style;
        style.axes = 100;
        Drawing drawing = axes_triad(font, camera, style);
        constexpr int center = 150;
        drawing.move(center, center);
        Frame frame = plain(2 * center, 2 * center);
        drawing.paint(frame, Color{0, 0, 0, 1}, 1);
        const std::array<double, 2> origin = picture_place(camera, camera.look_at);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // A step small enough for perspective to be as its derivative.
            Vector3 x = camera.look_at;
            const double step = 1e-6;
            x[axis] += step;
            const std::array<double, 2> place = picture_place(camera, x);
            const double across = place[0] - origin[0], up = place[1] - origin[1];
            const double scale = camera.orthographic
                                     ? 0.5 * camera.height
                                     : std::hypot(camera.eye[0] - camera.look_at[0], camera.eye[1] - camera.look_at[1],
                                                  camera.eye[2] - camera.look_at[2]) *
                                           std::tan(camera.field_of_view * std::numbers::pi / 360);
            const double length = std::hypot(across, up) * scale / step;
            // Far enough from the middle for its pixels to be nobody else's.
            if (length < 0.5) {
                continue;
            }
            double sum_x = 0, sum_y = 0, farthest = 0;
            for (int row = 0; row < 2 * center; ++row) {
                for (int column = 0; column < 2 * center; ++column) {
                    const double dx = column + 0.5 - center, dy = row + 0.5 - center;
                    if (axis_of(pixel(frame, column, row)) == static_cast<int>(axis) &&
                        std::hypot(dx, dy) > 0.35 * style.axes) {
                        sum_x += dx;
                        sum_y -= dy;
                        farthest = std::max(farthest, std::hypot(dx, dy));
                    }
                }
            }
            if (farthest < 0.9 * length * style.axes) {
                // Hidden behind a nearer arrow: the test below counts how often.
                continue;
            }
            const double cosine = (sum_x * across + sum_y * up) / (std::hypot(sum_x, sum_y) * std::hypot(across, up));
            worst = std::max(worst, std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi);
            // The arrow ends where a unit step ends; its base's rim may reach a little further when seen from its side.
            CHECK(farthest == Approx(length * style.axes).margin(8));
        }
    }
    std::printf("triad: arrows within %.2f degrees of the projected axes\n", worst);
    // Half-hidden arrows have their middles beside their axes: those of the heads by at most 11 in 35.
    CHECK(worst < 8);
}

TEST_CASE("the axis nearest to the viewer lies in front") {
    const Font font;
    Camera camera;
    camera.orthographic = true;
    camera.eye = {0, 0, 5};
    camera.up = {0, 1, 0};
    ItemStyle style;
    style.axes = 100;
    for (const double side : {1.0, -1.0}) {
        camera.eye[2] = 5 * side;
        Drawing drawing = axes_triad(font, camera, style);
        drawing.move(150, 150);
        Frame frame = plain(300, 300);
        drawing.paint(frame, std::nullopt, 1);
        // z points at the viewer and covers the others' begin, or away and is covered where they begin.
        CHECK((axis_of(pixel(frame, 148, 148)) == 2) == (side > 0));
        CHECK(axis_of(pixel(frame, side > 0 ? 220 : 80, 150)) == 0);
        CHECK(axis_of(pixel(frame, 150, 80)) == 1);
    }
}
