// The oracle for volume rendering against closed forms, brute force and a second formula.
#include <core/oracle/samples/meshes.hpp>
#include <core/oracle/samples/random_volumes.hpp>
#include <core/oracle/volume/transfers.hpp>
#include <core/oracle/volume/volume_integral.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

namespace elvis::oracle {
namespace {

using native::Shape;

const std::array<Shape, 4> shapes{Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron};

// n cells of one shape along each direction of [-1,1]^3.
VolumeData cube_of(Shape shape, int n, std::uint32_t order, const Function& field) {
    const std::vector<Map> maps = compose(cube(shape, n), [](const Vector& x) -> Vector { return 2 * x - Vector::Ones(); });
    VolumeData data;
    data.classes.push_back(make_class(space_of(shape, 1), space_of(shape, order), maps, field));
    return data;
}

VolumeOptics optics_of(const Model& model, const TransferFunction& transfer) {
    return {scalar_of_field(model.volume, 0), transfer};
}

double distance(const VolumeLight& a, const VolumeLight& b) {
    double largest = std::abs(a.transmittance - b.transmittance);
    for (std::size_t c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(a.rgb[c] - b.rgb[c]));
    return largest;
}

VolumeLight light_of(double transmittance, const std::array<double, 3>& rgb) { return {rgb, transmittance, 0, 0}; }

// The midpoint rule for both integrals, by a transfer function that knows nothing of breakpoints.
class BruteForce {
public:
    explicit BruteForce(const TransferFunction& transfer) : m_transfer(transfer) {}

    template <class Field> void add(const Field& field, double length, int n) {
        const double h = length / n;
        for (int i = 0; i < n; ++i) {
            const OpticalPoint point = optical_point(m_transfer, field((i + 0.5) / n));
            const double depth = h * point.density;
            // Emission of half a step is half absorbed in it: exp at the step's middle.
            const double weight = m_light.transmittance * std::exp(-0.5 * depth) * depth;
            for (std::size_t c = 0; c < 3; ++c)
                m_light.rgb[c] += weight * point.rgb[c];
            m_light.transmittance *= std::exp(-depth);
        }
    }
    const VolumeLight& light() const { return m_light; }

private:
    const TransferFunction& m_transfer;
    VolumeLight m_light;
};

std::vector<Line> some_lines(int n, double reach) {
    std::mt19937 random(3);
    const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1; };
    std::vector<Line> lines;
    for (int i = 0; i < n; ++i) {
        const Vector target(0.8 * number(), 0.8 * number(), 0.8 * number());
        const Vector direction = Vector(number(), number(), number()).normalized();
        lines.push_back({target - reach * direction, direction});
    }
    return lines;
}

} // namespace

TEST_CASE("series are integrated and differentiated") {
    // exp to rounding.
    std::vector<double> values;
    for (const double s : lobatto_points(20))
        values.push_back(std::exp(s));
    const ChebyshevSeries series(values);
    for (const double s : {-1.0, -0.3, 0.0, 0.7, 1.0}) {
        CHECK(std::abs(series.antiderivative()(s) - (std::exp(s) - std::exp(-1.0))) < 1e-14);
        CHECK(std::abs(series.derivative()(s) - std::exp(s)) < 1e-11);
    }
}

TEST_CASE("a transfer function has its values, and those above at steps") {
    const TransferFunction transfer{{{0, 1}, {1, 3}, {1, 5}, {2, 0}}, {{0.5, {0, 0, 0.2}}, {1.5, {1, 0, 0.2}}}};
    CHECK(optical_point(transfer, -1).density == 1);
    CHECK(optical_point(transfer, 0.5).density == 2);
    CHECK(optical_point(transfer, 1).density == 5);
    CHECK(optical_point(transfer, std::nextafter(1, 0)).density == Approx(3));
    CHECK(optical_point(transfer, 1.5).density == 2.5);
    CHECK(optical_point(transfer, 7).density == 0);
    CHECK(optical_point(transfer, 0).rgb[0] == 0);
    CHECK(optical_point(transfer, 1.25).rgb[0] == 0.75);
    CHECK(optical_point(transfer, 9).rgb == std::array<double, 3>{1, 0, 0.2});
}

TEST_CASE("the program's pieces of transfer functions are the functions themselves") {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const TransferFunction transfer = random_transfer(seed, -2, 3, 1).transfer;
        const TransferTable table = cut_at_breakpoints(transfer);
        for (double value = -2.6; value < 3.6; value += 0.01) {
            const OpticalPoint point = optical_point(transfer, value);
            const TransferPiece& piece = table.piece_at(value);
            CAPTURE(seed, value);
            // Slopes of peaks reach 1e5.
            REQUIRE(std::abs(piece.density + piece.density_slope * (value - piece.from) - point.density) < 1e-9);
            // Where there is no density the colour is not kept.
            for (std::size_t c = 0; c < 3 && point.density > 0; ++c)
                REQUIRE(std::abs(piece.rgb[c] + piece.rgb_slope[c] * (value - piece.from) - point.rgb[c]) < 1e-9);
        }
    }
}

TEST_CASE("constant density and colour have a closed form") {
    const TransferFunction transfer{{{0, 0.7}}, {{0, {0.2, 0.5, 0.9}}}};
    for (const Shape shape : shapes) {
        const Model model(cube_of(shape, 2, 2, [](const Vector& x) { return x.squaredNorm(); }));
        VolumeTracer tracer(model, optics_of(model, transfer));
        double largest = 0;
        for (const Line& line : some_lines(60, 4)) {
            // Length in the box, by slabs; and half of it, by a cut-off.
            double from = 0, to = 100;
            for (Eigen::Index d = 0; d < 3; ++d) {
                const double one = (-1 - line.origin[d]) / line.direction[d], other = (1 - line.origin[d]) / line.direction[d];
                from = std::max(from, std::min(one, other));
                to = std::min(to, std::max(one, other));
            }
            for (const double share : {1.0, 0.5}) {
                const double kept = std::exp(-0.7 * share * (to - from));
                const VolumeLight exact = light_of(kept, {0.2 * (1 - kept), 0.5 * (1 - kept), 0.9 * (1 - kept)});
                const VolumeLight light = tracer.integrate(line, share == 1 ? 1e300 : from + share * (to - from));
                largest = std::max(largest, distance(light, exact));
                CHECK(light.error < 1e-12);
            }
        }
        CAPTURE(native::name(shape), largest);
        CHECK(largest < 1e-12);
        CHECK(tracer.integrate({{-4, 3, 0}, {1, 0, 0}}).n_smooth_intervals == 0);
        CHECK(tracer.integrate({{-4, 3, 0}, {1, 0, 0}}).transmittance == 1);
        CHECK(tracer.n_failures() == 0);
    }
}

TEST_CASE("density and colour that grow along a ray have a closed form") {
    // f = x. Density a (x - p) from p on, colour c (x - p): with u = x - p, k = a / 2 and L = 1 - p, the integral of
    // c a u^2 exp(-k u^2) over [0, L] is c (sqrt(pi / k) / 2 erf(sqrt(k) L) - L exp(-k L^2)).
    for (const double a : {0.5, 8.0, 500.0, 1e6})
        for (const double p : {-0.35, 0.61}) {
            const double end = p + 4;
            const TransferFunction transfer{{{p, 0}, {end, 4 * a}}, {{p, {0, 0, 0}}, {end, {4 * 0.3, 4 * 0.2, 0}}}};
            const double k = 0.5 * a, length = 1 - p, kept = std::exp(-k * length * length);
            const double unit = 0.5 * std::sqrt(std::numbers::pi / k) * std::erf(std::sqrt(k) * length) - length * kept;
            const VolumeLight exact = light_of(kept, {0.3 * unit, 0.2 * unit, 0});
            for (const Shape shape : shapes) {
                const Model model(cube_of(shape, 3, 1, [](const Vector& x) { return x.x(); }));
                VolumeTracer tracer(model, optics_of(model, transfer));
                const VolumeLight light = tracer.integrate({{-3, 0.123, 0.456}, {1, 0, 0}});
                CAPTURE(a, p, native::name(shape), light.rgb[0], exact.rgb[0], light.error);
                CHECK(distance(light, exact) < 1e-13);
                // The series' rounding times the density's slope.
                CHECK(light.error < 1e-12 * std::max(1.0, a / 500));
                // As much is absorbed from the other side.
                const VolumeLight back = tracer.integrate({{3, 0.123, 0.456}, {-1, 0, 0}});
                CHECK(std::abs(back.transmittance - kept) < 1e-14);
            }
        }
}

TEST_CASE("steps of colour and of density are where the field takes their value") {
    // f = x^2 + y^2 + z^2, transparent but for a shell 0.25 < f < 0.64 of density 2; red inside f < 0.5, blue beyond.
    const TransferFunction transfer{{{0.25, 0}, {0.25, 2}, {0.64, 2}, {0.64, 0}}, {{0.5, {1, 0, 0}}, {0.5, {0, 0, 1}}}};
    const Model model(cube_of(Shape::tetrahedron, 2, 2, [](const Vector& x) { return x.squaredNorm(); }));
    VolumeTracer tracer(model, optics_of(model, transfer));
    const auto half = [](double value, double nearest) { return value > nearest ? std::sqrt(value - nearest) : 0; };
    double largest = 0;
    for (const Line& line : some_lines(100, 5)) {
        const double middle = -line.origin.dot(line.direction), nearest = (line.origin + middle * line.direction).squaredNorm();
        const double a = half(0.25, nearest), b = half(0.5, nearest), c = half(0.64, nearest);
        VolumeLight exact;
        for (const auto& [length, channel] : {std::pair(c - b, 2u), {b - a, 0u}, {b - a, 0u}, {c - b, 2u}}) {
            const double kept = std::exp(-2 * length);
            exact.rgb[channel] += exact.transmittance * (1 - kept);
            exact.transmittance *= kept;
        }
        largest = std::max(largest, distance(tracer.integrate(line), exact));
    }
    CAPTURE(largest);
    CHECK(largest < 1e-12);
}

TEST_CASE("in curved elements spheres are where they are") {
    // The number is |x - c|^2 of the place itself, so that neither elements nor their bend show; rays begin and end inside.
    const Vector centre = quadratic_bend(Vector::Zero());
    const Scalar square = with_differences([centre](const Volume& volume, std::size_t element, const Vector& xi) {
        return (volume.position(element, xi) - centre).squaredNorm();
    });
    const TransferFunction transfer{{{0.01, 3}, {0.01, 0}, {0.04, 0}, {0.04, 5}, {0.07, 5}, {0.07, 2}},
                                    {{0.05, {1, 0, 0.3}}, {0.05, {0, 1, 0.6}}}};
    for (const Shape shape : shapes) {
        VolumeData data = cube_of(shape, 2, 1, [](const Vector& x) { return x.x(); });
        const std::vector<Map> maps =
            compose(cube(shape, 2), [](const Vector& x) -> Vector { return quadratic_bend(1.6 * x - 0.8 * Vector::Ones()); });
        data.classes[0].geometry = space_of(shape, 2);
        data.classes[0].geometry_coefficients =
            make_class(space_of(shape, 2), space_of(shape, 1), maps, [](const Vector&) { return 0.0; }).geometry_coefficients;
        const Model model(std::move(data));
        VolumeTracer tracer(model, {square, transfer});
        double largest = 0;
        for (Line line : some_lines(60, 0)) {
            line.origin = centre + 0.35 * line.origin;
            const double until = 0.6 * line.origin.norm() + 0.2;
            std::vector<double> cuts{0, until};
            const Vector away = line.origin - centre;
            const double middle = -away.dot(line.direction), nearest = (away + middle * line.direction).squaredNorm();
            for (const double value : {0.01, 0.04, 0.05, 0.07})
                for (const double sign : {-1.0, 1.0})
                    if (const double t = middle + sign * std::sqrt(value - nearest); t > 0 && t < until)
                        cuts.push_back(t);
            std::sort(cuts.begin(), cuts.end());
            VolumeLight exact;
            for (std::size_t i = 1; i < cuts.size(); ++i) {
                const OpticalPoint point =
                    optical_point(transfer, (away + 0.5 * (cuts[i - 1] + cuts[i]) * line.direction).squaredNorm());
                const double kept = std::exp(-point.density * (cuts[i] - cuts[i - 1]));
                for (std::size_t c = 0; c < 3; ++c)
                    exact.rgb[c] += exact.transmittance * (1 - kept) * point.rgb[c];
                exact.transmittance *= kept;
            }
            largest = std::max(largest, distance(tracer.integrate(line, until), exact));
        }
        CAPTURE(native::name(shape), largest);
        CHECK(largest < 1e-11);
        CHECK(tracer.n_failures() == 0);
    }
}

TEST_CASE("a million steps give the same") {
    // Of the field in closed form along the ray; elements and their faces play no part.
    for (const double width : {0.01, 0.1}) {
        const TransferFunction transfer = sphere_peaks(width);
        VolumeData data;
        data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 2),
                                          boxes({-1, -1, -2}, {1, 1, 4}, {2, 2, 3}),
                                          [](const Vector& x) { return x.squaredNorm(); }));
        const Model model(std::move(data));
        VolumeTracer tracer(model, optics_of(model, transfer));
        for (const Line& line : {Line{{0.3, 0.2, 6}, {0, 0, -1}}, Line{{3, 2, 2.5}, Vector(-3, -2.1, -2).normalized()}}) {
            double from = 0, to = 100;
            for (const auto& [axis, low, high] : {std::tuple(0, -1.0, 1.0), {1, -1.0, 1.0}, {2, -2.0, 4.0}})
                if (line.direction[axis] != 0) {
                    const double one = (low - line.origin[axis]) / line.direction[axis],
                                 other = (high - line.origin[axis]) / line.direction[axis];
                    from = std::max(from, std::min(one, other));
                    to = std::min(to, std::max(one, other));
                }
            BruteForce brute(transfer);
            brute.add([&](double share) { return line.at(from + share * (to - from)).squaredNorm(); }, to - from, 1000000);
            const VolumeLight light = tracer.integrate(line);
            CAPTURE(width, light.transmittance, light.n_smooth_intervals, light.error, distance(light, brute.light()));
            CHECK(light.transmittance < 0.9);
            CHECK(light.n_smooth_intervals >= 6);
            // A bend of the density costs the midpoint rule the square of a step times its slope, of 200 a unit for narrow
            // peaks.
            CHECK(distance(light, brute.light()) < (width < 0.05 ? 1e-8 : 1e-10));
        }
    }
}

TEST_CASE("in random volumes the integral by parts and brute force give the same") {
    double by_parts = 0, by_force = 0, estimate = 0;
    std::size_t n_rays = 0, n_dim = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const RandomVolume random = random_volume(seed);
        const Model model(random.data);
        VolumeTracer range(model, {scalar_of_field(model.volume, 0), random_transfer(0, 0, 1, 1).transfer});
        for (std::uint64_t second = 0; second < 4; ++second) {
            const RandomTransfer transfer = random_transfer(16 * seed + second, range.low(), range.high(), model.diagonal);
            VolumeTracer tracer(model, optics_of(model, transfer.transfer));
            const VolumePicture picture =
                draw_volume(model, optics_of(model, transfer.transfer), random.camera, 40, 40, sampled_pixels(1600, 40, seed));
            REQUIRE(picture.n_failures == 0);
            for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
                const Line line = line_of(pixel_ray(random.camera, 40, 40, static_cast<long double>(picture.pixels[i] % 40),
                                                    static_cast<long double>(picture.pixels[i] / 40)));
                const VolumeLight& light = picture.answers[i];
                CAPTURE(seed, second, random.description, transfer.description, picture.pixels[i], light.transmittance);
                const double off = distance(light, tracer.integrate(line, 1e300, VolumeFormula::by_parts));
                by_parts = std::max(by_parts, off);
                estimate = std::max(estimate, light.error);
                REQUIRE(off < 1e-11);
                ++n_rays;
                n_dim += light.transmittance < 0.99;
                if (i % 20 == 0) {
                    BruteForce brute(transfer.transfer);
                    for (const OwnedInterval& owned : tracer.owned_intervals(line)) {
                        const double length = 0.5 * (owned.end - owned.begin) * (owned.interval.to - owned.interval.from);
                        brute.add(
                            [&](double share) { return owned.interval.field(owned.begin + share * (owned.end - owned.begin)); },
                            length, 10000);
                    }
                    by_force = std::max(by_force, distance(light, brute.light()));
                }
            }
        }
    }
    WARN(n_rays << " rays, " << n_dim << " of them through the volume; by parts off by " << by_parts << ", estimate "
                << estimate << ", by 10000 steps in each element " << by_force);
    CHECK(n_dim > 600);
    // At a step midpoints are off by half a step, of 1e-4 in an element.
    CHECK(by_force < 1e-3);
    CHECK(estimate < 1e-10);
}

TEST_CASE("where elements overlap the one entered first owns the ray to its exit") {
    // Along x: [0, 2] with f = 1, [1, 3] with f = 2, and a gap to [4, 5] with f = 3.
    VolumeData data;
    const auto box = [](double low, double high) { return boxes({low, -1, -1}, {high, 1, 1}, {1, 1, 1}); };
    std::int64_t number = 0;
    for (const auto& [low, high, value] : {std::tuple(1.0, 3.0, 2.0), {0.0, 2.0, 1.0}, {4.0, 5.0, 3.0}}) {
        const double constant = value;
        data.classes.push_back(make_class(
            space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1), box(low, high),
            [constant](const Vector&) { return constant; }, number++));
    }
    const Model model(std::move(data));
    const TransferFunction transfer{{{0, 0.3}}, {{1.5, {1, 0, 0}}, {1.5, {0, 1, 0}}, {2.5, {0, 1, 0}}, {2.5, {0, 0, 1}}}};
    VolumeTracer tracer(model, optics_of(model, transfer));
    const double one = std::exp(-0.3), two = std::exp(-0.6);
    CHECK(distance(tracer.integrate({{-1, 0.1, 0.2}, {1, 0, 0}}),
                   light_of(one * one * two, {1 - two, two * (1 - one), one * two * (1 - one)})) < 1e-14);
    // From the other side the last element is entered first, and [1, 3] before [0, 2].
    CHECK(distance(tracer.integrate({{6, 0.1, 0.2}, {-1, 0, 0}}),
                   light_of(one * one * two, {two * one * (1 - one), one * (1 - two), 1 - one})) < 1e-14);
    // From within [0, 2], up to within [1, 3].
    CHECK(distance(tracer.integrate({{0.5, 0.1, 0.2}, {1, 0, 0}}, 2),
                   light_of(std::exp(-0.6), {1 - std::exp(-0.45), std::exp(-0.45) - two, 0})) < 1e-14);
}

TEST_CASE("light lies over a background as other layers do") {
    const VolumeLight light = light_of(0.25, {0.3, 0.6, 0.1});
    const Color over = color_over(light, {0.4, 0.8, 0, 1});
    CHECK(over[0] == Approx(0.4));
    CHECK(over[1] == Approx(0.8));
    CHECK(over[2] == Approx(0.1));
    CHECK(over[3] == 1);
    // Over nothing: its own opacity, and colours not multiplied by it.
    const Color alone = color_over(light, {0.4, 0.8, 0, 0});
    CHECK(alone[3] == 0.75);
    CHECK(alone[0] == Approx(0.4));
    CHECK(color_over({}, {0.4, 0.8, 0, 0}) == Color{0.4, 0.8, 0, 0});
}

} // namespace elvis::oracle
