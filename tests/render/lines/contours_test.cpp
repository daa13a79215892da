// Contours against exact tests of each pixel's square.
#include "lines.hpp"
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <functional>
#include <random>

namespace elvis::oracle {
namespace {

using native::Shape;

constexpr std::uint32_t contour_picture_size = 160;

VolumeData volume_of(bool is_curved, std::uint32_t order, const Function& function) {
    VolumeData data;
    const auto bent = [is_curved](const Vector& x) -> Vector { return is_curved ? quadratic_bend(x) : x; };
    data.classes.push_back(make_class(space_of(Shape::hexahedron, is_curved ? 2 : 1),
                                      space_of(Shape::hexahedron, is_curved ? 2 * order : order),
                                      compose(cube(Shape::hexahedron, 4), bent), function));
    return data;
}

} // namespace

TEST_CASE("contours of a circle are right to the pixel at every magnification, or marked undecided") {
    const double radius = 0.31;
    const Point centre = {0.47L, 0.52L};
    const auto function = [](const Vector& x) { return (x.x() - 0.47) * (x.x() - 0.47) + (x.y() - 0.52) * (x.y() - 0.52); };
    const double angle = 0.7;
    const Point on_circle = {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
    for (const bool is_curved : {false, true}) {
        const TemporaryFile file("contours.h5");
        write_volume(file.path(), volume_of(is_curved, 2, function));
        const RuntimeVolume volume = open_volume(file.path());
        for (const Precision precision : {Precision::float64, Precision::float32}) {
            Renderer renderer(device(), volume, precision);
            for (const double magnification : {1.0, 10.0, 100.0, 1000.0}) {
                FrameRequest request =
                    view_around(magnification == 1 ? centre : on_circle, magnification, contour_picture_size);
                request.surfaces[0].contours = Contours{{radius * radius}, {}};
                const Frame frame = renderer.render(request);
                const Verdict verdict =
                    judge(request, frame, pixel_flag::contour, pixel_flag::contour_undecided, [&](const Square& square) {
                        const auto [least, most] = distances(square, centre);
                        const long double level = static_cast<long double>(radius * radius);
                        return least <= level && level <= most;
                    });
                const bool is_double = precision == Precision::float64;
                WARN((is_curved ? "curved" : "straight")
                     << (is_double ? ", float64" : ", float32") << ", magnified " << magnification << ": " << verdict.marked
                     << " pixels, " << verdict.undecided << " undecided, " << verdict.wrong << " wrong");
                CHECK(verdict.wrong == 0);
                CHECK(verdict.marked + verdict.undecided >= contour_picture_size / 2);
                if (is_double) {
                    CHECK(verdict.undecided <= 2);
                }
            }
        }
    }
}

TEST_CASE("nothing is undecided along the horizon of a plane, far behind the volume") {
    const TemporaryFile file("horizon.h5");
    write_volume(file.path(), volume_of(false, 2, [](const Vector& x) { return x.x() * x.y(); }));
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = request.height = contour_picture_size;
    request.camera.eye = {-2, 0.4, 0.9};
    request.camera.look_at = {0.5, 0.5, 0.6};
    request.camera.up = {0.1, 0.2, 1};
    request.camera.field_of_view = 40;
    Surface plane;
    plane.geometry = CutPlane{{0, 0, 1, -0.47}};
    plane.colors.points = {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
    plane.contours = Contours{{0.2, 0.5}, {}};
    plane.mesh_lines.emplace();
    request.surfaces = {plane};
    for (const Precision precision : {Precision::float64, Precision::float32}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        constexpr std::uint32_t undecided = pixel_flag::contour_undecided | pixel_flag::mesh_line_undecided;
        std::size_t n_undecided = 0, n_lines = 0;
        for (const std::uint32_t flags : frame.flags) {
            n_undecided += (flags & undecided) != 0 ? 1 : 0;
            n_lines += (flags & (pixel_flag::contour | pixel_flag::mesh_line)) != 0 ? 1 : 0;
        }
        WARN(n_lines << " pixels with lines, " << n_undecided << " undecided");
        CHECK(n_lines > contour_picture_size);
        CHECK(n_undecided <= 2);
    }
}

namespace {

// A polynomial of order 6 in x and y.
struct Polynomial {
    std::array<double, 28> coefficients{};

    double operator()(double x, double y) const {
        const std::array<double, 7> a = legendre(2 * x - 1), b = legendre(2 * y - 1);
        double sum = 0;
        std::size_t i = 0;
        for (std::size_t p = 0; p <= 6; ++p)
            for (std::size_t q = 0; p + q <= 6; ++q)
                sum += coefficients[i++] * a[p] * b[q];
        return sum;
    }

    static std::array<double, 7> legendre(double z) {
        std::array<double, 7> values = {1, z};
        for (std::size_t n = 1; n < 6; ++n)
            values[n + 1] = ((2.0 * double(n) + 1) * z * values[n] - double(n) * values[n - 1]) / (double(n) + 1);
        return values;
    }
};

enum class Answer { no, yes, open };

// Whether g takes the value 0 in the square of size h around (column, row): by halving, with `bend` a bound of the second
// derivatives' sum, in pixels.
Answer meets_zero(const std::function<double(double, double)>& g, double column, double row, double h, double bend, int depth) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const auto& [a, b] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{-1, 1}, std::pair{1, 1}, std::pair{0, 0}}) {
        const double value = g(column + a * h / 2, row + b * h / 2);
        least = std::min(least, value);
        most = std::max(most, value);
    }
    if (least <= 0 && most >= 0)
        return Answer::yes;
    // Bilinear interpolation of the corners misses at most an eighth of the second derivatives, and the extremes are in
    // between.
    const double nearest = least > 0 ? least : -most;
    if (nearest > 0.125 * bend * h * h)
        return Answer::no;
    if (depth == 0)
        return Answer::open;
    Answer answer = Answer::no;
    for (const auto& [a, b] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{-1, 1}, std::pair{1, 1}}) {
        const Answer part = meets_zero(g, column + a * h / 4, row + b * h / 4, h / 2, bend, depth - 1);
        if (part == Answer::yes)
            return part;
        answer = part == Answer::open ? part : answer;
    }
    return answer;
}

// Contours of so many polynomials on straight and curved elements of different shapes.
void check_polynomials(int n_polynomials) {
    std::mt19937_64 random(20);
    std::uniform_real_distribution<double> any(-1, 1);
    constexpr std::uint32_t small = 64;
    std::array<std::size_t, 9> undecided{};
    std::size_t marked = 0, wrong = 0, open = 0;
    for (int repetition = 0; repetition < n_polynomials; ++repetition) {
        Polynomial f;
        for (double& coefficient : f.coefficients)
            coefficient = any(random);
        const double isovalue = 0.3 * any(random);
        const TemporaryFile file("contours.h5");
        VolumeData data;
        // Bounds of derivatives of curved tetrahedra of order 12 are too wide to decide everything.
        const std::array shapes = {Shape::hexahedron, Shape::prism, Shape::tetrahedron, Shape::hexahedron, Shape::prism};
        const std::size_t kind = static_cast<std::size_t>(repetition) % shapes.size();
        const Shape shape = shapes[kind];
        const bool is_curved = kind >= 3;
        const auto bent = [is_curved](const Vector& x) -> Vector {
            return is_curved ? Vector(x.x() + 0.1 * x.z() * x.z(), x.y() - 0.1 * x.z() * (1 - x.z()), x.z()) : x;
        };
        data.classes.push_back(make_class(space_of(shape, is_curved ? 2 : 1), space_of(shape, is_curved ? 12 : 6),
                                          compose(cube(shape, 2), bent), [&](const Vector& x) { return f(x.x(), x.y()); }));
        write_volume(file.path(), data);
        const RuntimeVolume volume = open_volume(file.path());
        FrameRequest request = view_around({0.5L, 0.5L}, 2, small);
        request.surfaces[0].contours = Contours{{isovalue}, {}};
        const auto g = [&](double column, double row) {
            const Ray ray = pixel_ray(request.camera, small, small, column, row);
            const long double t = (plane_z - ray.origin.z()) / ray.direction.z();
            return f(static_cast<double>(ray.origin.x() + t * ray.direction.x()),
                     static_cast<double>(ray.origin.y() + t * ray.direction.y())) -
                   isovalue;
        };
        // A pixel is at most 0.011 of the cube wide; Legendre polynomials of order 6 bend by at most 4 * 420.
        const double bend = 28 * 2 * 4 * 420 * 0.011 * 0.011;
        Renderer renderer(device(), volume, Precision::float64);
        for (std::uint32_t limit = 0; limit <= 8; limit += 2) {
            request.surfaces[0].subdivisions = limit;
            const Frame frame = renderer.render(request);
            for (std::uint32_t row = 0; row < small; ++row) {
                for (std::uint32_t column = 0; column < small; ++column) {
                    const std::uint32_t flags = frame.flags[std::size_t{row} * small + column];
                    const bool is_undecided = (flags & pixel_flag::contour_undecided) != 0;
                    undecided[limit] += is_undecided ? 1 : 0;
                    if (limit == 4 && !is_undecided) {
                        const Answer answer = meets_zero(g, column, row, 1, bend, 9);
                        open += answer == Answer::open ? 1 : 0;
                        const bool is_marked = (flags & pixel_flag::contour) != 0;
                        marked += is_marked ? 1 : 0;
                        wrong += answer != Answer::open && is_marked != (answer == Answer::yes) ? 1 : 0;
                    }
                }
            }
        }
    }
    WARN(marked << " pixels marked, " << wrong << " wrong, " << open
                << " open to the test; undecided with 0, 2, 4, 6, 8 subdivisions: " << undecided[0] << ", " << undecided[2]
                << ", " << undecided[4] << ", " << undecided[6] << ", " << undecided[8]);
    CHECK(wrong == 0);
    CHECK(open <= marked / 100);
    CHECK(undecided[0] > undecided[2]);
    CHECK(undecided[2] >= undecided[4]);
    CHECK(undecided[8] == 0);
}

} // namespace

TEST_CASE("contours of random polynomials are right to the pixel, and more subdivision leaves fewer undecided") {
    check_polynomials(3);
}

// Run by name: minutes.
TEST_CASE("contours of a hundred random polynomials are right to the pixel", "[.full]") { check_polynomials(100); }

} // namespace elvis::oracle
