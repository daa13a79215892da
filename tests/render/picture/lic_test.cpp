// Line integral convolution beside closed forms: noise along exact curves, directions in the picture, and nothing but colours.

#include <core/camera/camera_ray.hpp>
#include <core/oracle/samples/exact_volumes.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>
#include <core/session/supersampled.hpp>
#include <tests/support/error_of.hpp>
#include <tests/support/test_volumes.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <numeric>

namespace elvis::oracle {
namespace {

constexpr std::uint32_t size = 200;

/** A volume, and scenes of it in which all colours are white but for line integral convolution. */
struct Ground {
    explicit Ground(const std::string& mesh, Precision precision = Precision::float32)
        : file("lic.h5"), volume(made(mesh, file.path())), renderer(device(), volume, precision) {}

    explicit Ground(const VolumeData& data)
        : file("lic.h5"), volume(written(data, file.path())), renderer(device(), volume, Precision::float32) {}

    static RuntimeVolume written(const VolumeData& data, const std::string& path) {
        write_volume(path, data);
        return open_volume(path);
    }
    static RuntimeVolume made(const std::string& mesh, const std::string& path) {
        generate(R"({"generator": 1, "field": "sphere", )" + mesh + "}", path);
        return open_volume(path);
    }
    FrameRequest request(const std::string& keys, std::uint32_t side = size) {
        const std::string image = R"("image": {"size": [)" + std::to_string(side) + "," + std::to_string(side) + "]}";
        const std::string white = R"("color_map": {"points": [[0, 1, 1, 1], [1, 1, 1, 1]]})";
        const auto json = nlohmann::json::parse(R"({"version": 1, )" + image + "," + white + "," + keys + "}");
        return make_frame_request(scene_of(json, "scene.json"), volume, renderer.ranges());
    }
    Frame frame(const std::string& keys) { return renderer.render(request(keys)); }

    TemporaryFile file;
    RuntimeVolume volume;
    Renderer renderer;
};

constexpr const char* box = R"("mesh": "box", "box": [[-1, -1, -1], [1, 1, 1]], "elements": [2, 2, 2], "order": 2)";
constexpr const char* ball = R"("mesh": "ball", "shape": "hexahedron", "elements": [3, 3, 3], "geometry_order": 4, "order": 3)";
/** (-y, x, 0) */
constexpr const char* rotation = "cross(grad(z), grad(0.5 * (x^2 + y^2)))";

/** The plane z = 0, seen from above: a pixel is 0.01 wide. */
std::string flat(const std::string& lic) {
    return R"("camera": {"type": "orthographic", "eye": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "height": 2},
              "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0], "lic": {)" +
           lic + "}}]";
}

std::string field(const std::string& text) { return R"("field": ")" + text + "\""; }

double shade(const Frame& frame, std::size_t column, std::size_t row) { return frame.color[4 * (row * frame.width + column)]; }

/** As shaders/picture/lic.comp describes it, where a value of the noise is a pixel wide. */
double noise_of(int column, int row) {
    const auto mixed = [](std::uint32_t h) {
        h = (h ^ (h >> 16)) * 0x85ebca6bu;
        h = (h ^ (h >> 13)) * 0xc2b2ae35u;
        return h ^ (h >> 16);
    };
    const auto u = [](int i) { return static_cast<std::uint32_t>(i + 1); };
    return (mixed(u(column) + 0x9e3779b9u * mixed(u(row) + 0x632be5abu)) >> 8) * 0x1p-24;
}

double noise(double column, double row) {
    const int i = static_cast<int>(std::floor(column)), j = static_cast<int>(std::floor(row));
    const double x = column - i, y = row - j;
    return (1 - y) * ((1 - x) * noise_of(i, j) + x * noise_of(i + 1, j)) +
           y * ((1 - x) * noise_of(i, j + 1) + x * noise_of(i + 1, j + 1));
}

/** With a contrast of 1, for a mean over so many pixels. */
double shade_of(double mean, double length) {
    const double deviation = 1 / std::sqrt(18 * length + 27);
    return 0.5 + 0.25 * std::clamp((mean - 0.5) / deviation, -2.0, 2.0);
}

/** The mean along an arc of n half pixels to each side, about the picture's middle. */
double along_circle(double column, double row, int n) {
    const double middle = 0.5 * (size - 1), x = column - middle, y = row - middle, radius = std::hypot(x, y);
    double sum = 0;
    for (int i = -n; i <= n; ++i) {
        const double angle = std::atan2(y, x) + 0.5 * i / radius;
        sum += noise(middle + radius * std::cos(angle), middle + radius * std::sin(angle));
    }
    return sum / (2 * n + 1);
}

double between(const Frame& frame, double column, double row) {
    const auto i = static_cast<std::size_t>(column), j = static_cast<std::size_t>(row);
    const double x = column - static_cast<double>(i), y = row - static_cast<double>(j);
    return (1 - y) * ((1 - x) * shade(frame, i, j) + x * shade(frame, i + 1, j)) +
           y * ((1 - x) * shade(frame, i, j + 1) + x * shade(frame, i + 1, j + 1));
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto mean = [](const std::vector<double>& v) {
        return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
    };
    const double mean_a = mean(a), mean_b = mean(b);
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return ab / std::sqrt(aa * bb);
}

/** All whose distance from the picture's middle lies between two. */
void for_ring(double from, double to, const std::function<void(std::uint32_t column, std::uint32_t row)>& call) {
    for (std::uint32_t row = 0; row < size; ++row) {
        for (std::uint32_t column = 0; column < size; ++column) {
            const double radius = std::hypot(column - 0.5 * (size - 1), row - 0.5 * (size - 1));
            if (radius >= from && radius <= to) {
                call(column, row);
            }
        }
    }
}

/** The least change of colours around a pixel: along streaks. */
double streak_angle(const Frame& frame, std::uint32_t column, std::uint32_t row, int reach) {
    double xx = 0, xy = 0, yy = 0;
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const auto c = static_cast<std::size_t>(static_cast<int>(column) + i);
            const auto r = static_cast<std::size_t>(static_cast<int>(row) + j);
            const double x = shade(frame, c + 1, r) - shade(frame, c - 1, r),
                         y = shade(frame, c, r + 1) - shade(frame, c, r - 1);
            const double weight = std::exp(-2.0 * (i * i + j * j) / (reach * reach));
            xx += weight * x * x;
            xy += weight * x * y;
            yy += weight * y * y;
        }
    }
    return 0.5 * std::atan2(2 * xy, xx - yy) + 0.5 * std::numbers::pi;
}

/** From line b to line a, in degrees. */
double turn_between(double a, double b) { return std::remainder(a - b, std::numbers::pi) * 180 / std::numbers::pi; }

} // namespace

TEST_CASE("Colours are the mean of noise along the exact curve: circles of a rigid rotation") {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Ground ground(box, precision);
        const Frame frame = ground.frame(flat(field(rotation) + R"(, "length": 20, "contrast": 1)"));
        double largest = 0, sum = 0;
        std::size_t n = 0;
        for_ring(10, 75, [&](std::uint32_t column, std::uint32_t row) {
            const double error = std::abs(shade(frame, column, row) - shade_of(along_circle(column, row, 40), 40));
            largest = std::max(largest, error);
            sum += error;
            ++n;
        });
        std::cout << (precision == Precision::float64 ? "double" : "single") << ": shades in [0, 1] of " << n
                  << " pixels are off by at most " << largest << ", " << sum / static_cast<double>(n) << " in the mean\n";
        CHECK(n > 10000);
        CHECK(largest < 0.1);
        CHECK(sum / static_cast<double>(n) < 0.01);
    }
}

TEST_CASE("Intensities are alike along the curves of a rotation and unlike across them") {
    Ground ground(box);
    const Frame frame = ground.frame(flat(field(rotation) + R"(, "length": 20, "contrast": 1)"));
    constexpr double apart = 5;
    std::vector<double> here, along, across;
    for_ring(30, 90, [&](std::uint32_t column, std::uint32_t row) {
        const double middle = 0.5 * (size - 1), x = column - middle, y = row - middle, radius = std::hypot(x, y);
        const double turn = apart / radius, outward = (radius + apart) / radius;
        here.push_back(shade(frame, column, row));
        along.push_back(
            between(frame, middle + std::cos(turn) * x - std::sin(turn) * y, middle + std::sin(turn) * x + std::cos(turn) * y));
        across.push_back(between(frame, middle + outward * x, middle + outward * y));
    });
    std::cout << "correlation of pixels " << apart << " apart: " << correlation(here, along) << " along, "
              << correlation(here, across) << " across\n";
    CHECK(correlation(here, along) > 0.8);
    CHECK(std::abs(correlation(here, across)) < 0.1);
}

TEST_CASE("Streaks on curved surfaces go where the camera sees the tangential part of the vector go") {
    Ground ground(ball);
    for (const std::string& type :
         {std::string(R"("type": "boundary")"), std::string(R"("type": "plane", "plane": [1, 2, 4, 0.3])"),
          std::string(R"("type": "isosurface", "field": "x^2 + y^2 + 2 * z^2", "values": [0.6])")}) {
        FrameRequest request = ground.request(
            R"("camera": {"eye": [1.7, 1.2, 2.2], "field_of_view": 40}, "surfaces": [{)" + type + R"(, "lic": {)" +
            field("cross(grad(z + 0.3 * y), grad(0.5 * (x^2 + y^2 + z^2)))") + R"(, "contrast": 1}}])");
        // Streaks that are wide enough for differences between pixels to be slopes.
        request.surfaces[0].lic->grain = 3;
        const Frame frame = ground.renderer.render(request);
        const auto seen = [&](const Vector3& point) -> std::array<double, 2> {
            const Camera& camera = request.camera;
            const Vector3 axis = unit(minus(camera.look_at, camera.eye)), right = unit(cross(axis, camera.up)),
                          top = cross(right, axis);
            const Vector3 from_eye = minus(point, camera.eye);
            const double scale = 0.5 * size / std::tan(camera.field_of_view * std::numbers::pi / 360) / dot(from_eye, axis);
            return {scale * dot(from_eye, right), -scale * dot(from_eye, top)};
        };
        std::vector<double> errors;
        double sum = 0;
        constexpr int reach = 10;
        for (std::uint32_t row = reach + 1; row + reach + 1 < size; row += 3) {
            for (std::uint32_t column = reach + 1; column + reach + 1 < size; column += 3) {
                const auto is_shown = [&](std::uint32_t c, std::uint32_t r) { return frame.element[r * size + c] >= 0; };
                if (!is_shown(column, row) || !is_shown(column - reach - 1, row) || !is_shown(column + reach + 1, row) ||
                    !is_shown(column, row - reach - 1) || !is_shown(column, row + reach + 1)) {
                    continue;
                }
                const std::size_t pixel = row * size + column;
                const elvis::Ray ray = ray_through(request.camera, {size, size}, {column + 0.5, row + 0.5});
                const Vector3 normal = {frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]};
                const Vector3 point = ray.at(frame.depth[pixel]);
                const Vector3 vector = cross({0, 0.3, 1}, point);
                const Vector3 tangent = minus(vector, scaled(normal, dot(vector, normal)));
                // Where directions change slowly in the window.
                if (std::abs(dot(normal, ray.direction)) < 0.4 || length(tangent) < 0.3) {
                    continue;
                }
                constexpr double little = 1e-4;
                const auto from = seen(minus(point, scaled(tangent, little))), to = seen(plus(point, scaled(tangent, little)));
                const double turn =
                    turn_between(streak_angle(frame, column, row, reach), std::atan2(to[1] - from[1], to[0] - from[0]));
                sum += turn;
                errors.push_back(std::abs(turn));
            }
        }
        REQUIRE(errors.size() > 100);
        std::ranges::sort(errors);
        const auto n = static_cast<double>(errors.size());
        const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / n;
        // One window of noise tells a direction no better than that.
        std::cout << type << ": directions as estimated in " << n << " windows are off by " << mean
                  << " degrees in the mean, 95 of 100 by " << errors[errors.size() * 95 / 100] << ", their mean by " << sum / n
                  << '\n';
        CHECK(mean < 3);
        // They overlap: some thirty of them have noise of their own.
        CHECK(std::abs(sum / n) < 1.5);
        CHECK(errors[errors.size() * 95 / 100] < 8);
    }
}

TEST_CASE("Noise stays as it is where there is no direction, and colours where there is no vector") {
    Ground ground(box);
    const std::string along = rotation;
    const auto is_noise = [](const Frame& frame, std::uint32_t column, std::uint32_t row) {
        return std::abs(shade(frame, column, row) - shade_of(noise_of(static_cast<int>(column), static_cast<int>(row)), 0)) <
               1e-5;
    };
    const auto count = [](const Frame& frame, std::uint32_t from, std::uint32_t to, const auto& holds) {
        std::uint32_t n = 0;
        for (std::uint32_t row = 0; row < size; ++row) {
            for (std::uint32_t column = from; column < to; ++column) {
                n += holds(frame, column, row) ? 1 : 0;
            }
        }
        return n;
    };
    SECTION("the vector is zero on one side") {
        const Frame frame = ground.frame(flat(field("(x > 0) * " + along) + R"(, "contrast": 1)"));
        CHECK(count(frame, 0, 100, is_noise) == 100 * size);
        CHECK(count(frame, 101, 200, is_noise) < 3 * size);
    }
    SECTION("it is perpendicular to the surface") {
        CHECK(count(ground.frame(flat(field("grad(z + 1e-9 * x)") + R"(, "contrast": 1)")), 0, size, is_noise) == size * size);
    }
    SECTION("it is no number on one side") {
        const Frame frame = ground.frame(flat(field("sqrt(x) * " + along) + R"(, "contrast": 1)"));
        const auto is_white = [](const Frame& of, std::uint32_t column, std::uint32_t row) {
            return shade(of, column, row) == 1;
        };
        CHECK(count(frame, 0, 100, is_white) == 100 * size);
        CHECK(count(frame, 100, 200, is_white) < 5 * size);
    }
}

TEST_CASE("Line integral convolution changes colours alone, by factors within the contrast") {
    Ground ground(ball);
    const std::string camera = R"("camera": {"eye": [1.7, 1.2, 2.2], "field_of_view": 40}, )";
    const std::string front = R"("surfaces": [{"type": "plane", "plane": [1, 2, 4, 0.3], "outside": [0.5, 0, 0]}, )";
    for (const std::string& surfaces :
         {std::string(R"("surfaces": [{"type": "plane", "plane": [1, 2, 4, 0.3]}])"),
          front + R"({"type": "boundary", "opacity": 0.5, "clip": [[1, 0, 0, 0.2]]}])",
          front + R"({"type": "torus", "center": [0, 0, 0], "axis": [0, 0, 1], "major_radius": 0.6, "minor_radius": 0.2}],
                     "threshold": "x < 0.4", "mesh_lines": {})",
          front + R"({"type": "isosurface", "field": "x^2 + y^2 + 2 * z^2", "values": [0.3, 0.6], "opacity": 0.4}],
                     "contours": {"count": 4}, "lighting": "default")"}) {
        CAPTURE(surfaces);
        const Frame plain = ground.frame(camera + surfaces);
        const Frame frame = ground.frame(camera + R"("lic": {"contrast": 0.7, )" + field(rotation) + "}, " + surfaces);
        CHECK(frame.flags == plain.flags);
        CHECK(frame.element == plain.element);
        const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
            return std::ranges::equal(a, b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
        };
        CHECK(same(frame.value, plain.value));
        CHECK(same(frame.depth, plain.depth));
        CHECK(same(frame.normal, plain.normal));
        double least = 1, most = 0;
        std::size_t n_changed = 0;
        for (std::size_t i = 0; i < frame.color.size(); ++i) {
            const double ratio = plain.color[i] > 0 ? frame.color[i] / plain.color[i] : 1;
            least = std::min(least, ratio);
            most = std::max(most, ratio);
            n_changed += ratio != 1 ? 1 : 0;
        }
        CHECK(n_changed > 10000);
        CHECK(least > 0.3 - 1e-5);
        CHECK(most <= 1 + 1e-5);
    }
}

TEST_CASE("Streaks in two dimensions are those on a plane through a volume with the same field") {
    VolumeData sheet;
    const std::vector<Map> maps = {[](const Vector& xi) -> Vector { return {xi.x(), xi.y(), 0}; }};
    sheet.classes.push_back(make_class(space_of(native::Shape::quadrilateral, 2), space_of(native::Shape::quadrilateral, 2),
                                       maps, [](const Vector& x) { return x.x(); }));
    Ground solid(box), plane(sheet);
    const std::string seen =
        R"("camera": {"type": "orthographic", "eye": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "height": 2.2}, )";
    const std::string lic = R"("lic": {"contrast": 1, )" + field("grad(x * y)") + "}";
    const Frame flat_frame = plane.frame(seen + lic);
    const Frame frame = solid.frame(seen + lic + R"(, "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])");
    double largest = 0;
    std::size_t n = 0;
    for (std::size_t pixel = 0; pixel < std::size_t{size} * size; ++pixel) {
        if (frame.element[pixel] >= 0 && flat_frame.element[pixel] >= 0) {
            largest = std::max(largest, std::abs(frame.color[4 * pixel] - flat_frame.color[4 * pixel]));
            ++n;
        }
    }
    std::cout << "two dimensions: " << n << " shades differ by at most " << largest << '\n';
    CHECK(n > 30000);
    CHECK(largest < 1e-3);
}

TEST_CASE("Several samples a pixel have the noise of the picture") {
    Ground ground(box);
    const std::string keys = flat(field(rotation) + R"(, "length": 10, "contrast": 1)");
    const Frame frame = ground.frame(keys);
    Renderer* const renderer = &ground.renderer;
    const TaskControl control;
    const SupersampledColors fine = supersampled(std::span(&renderer, 1), ground.request(keys), 2, &control);
    std::vector<double> coarse, mean;
    for_ring(10, 85, [&](std::uint32_t column, std::uint32_t row) {
        coarse.push_back(shade(frame, column, row));
        mean.push_back(fine.color[4 * (row * size + column)]);
    });
    std::cout << "correlation with the picture of 2 x 2 samples: " << correlation(coarse, mean) << '\n';
    CHECK(correlation(coarse, mean) > 0.95);
}

TEST_CASE("What line integral convolution cannot follow is told") {
    Ground ground(box);
    const auto message = [&](const std::string& lic) { return test::error_of([&] { ground.request(flat(lic)); }); };
    using Catch::Matchers::Contains;
    CHECK_THAT(message(field("x * y")), Contains("lic: follows a vector with three components, which 'x * y' is not"));
    CHECK_THAT(message(field("velocitty")), Contains("velocitty"));
    CHECK_THAT(message(R"("length": 3)"), Contains("field"));
    CHECK_THAT(message(field(rotation) + R"(, "length": -1)"), Contains("length"));
    CHECK_THAT(message(field(rotation) + R"(, "contrast": 2)"), Contains("contrast"));
    CHECK_THAT(
        test::error_of([&] { ground.request(R"("surfaces": [{"type": "wireframe", "lic": {)" + field(rotation) + "}}]"); }),
        Contains("'surfaces[0].lic' means nothing where 'type' is \"wireframe\""));
}

} // namespace elvis::oracle
