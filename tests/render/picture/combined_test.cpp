// Opaque and transparent surfaces, isosurfaces and the volume itself in one picture, pixel by pixel against the oracle.
#include <core/oracle/volume/volume_integral.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

/** The box [-1, 1]^3 with the field |x|^2, which elements of order 2 hold exactly. */
void write_box(const std::string& shape, const std::string& path) {
    generate(R"({"generator": 1, "mesh": "box", "shape": ")" + shape +
                 R"(", "box": [[-1, -1, -1], [1, 1, 1]], "elements": [3, 3, 3], )" +
                 R"("order": 2, "geometry_order": 1, "field": "sphere"})",
             path);
}

/** What a ray meets. */
struct SurfaceHit {
    double depth;
    Color color;
};

Surface surface_of(const SurfaceGeometry& geometry, const Color& color) {
    Surface surface;
    surface.geometry = geometry;
    surface.colors.points = {{0, {color[0], color[1], color[2]}}};
    surface.colors.below = surface.colors.above = {color[0], color[1], color[2], 1};
    surface.opacity = color[3];
    return surface;
}

constexpr double plane_at = 0.15, clip_at = 0.25;
constexpr std::array<double, 2> spheres = {0.3, 0.6};
const Color plane_color{0, 0, 1, 1}, boundary_color{1, 0.9, 0.2, 0.25}, sphere_color{0, 0.8, 0.3, 0.4};

/** In closed form: the boundary of the box, spheres, and the part of the plane x + 0.2 z = 0.15 with y < 0.25. */
std::vector<SurfaceHit> crossings(const Line& ray, bool with_plane) {
    std::vector<SurfaceHit> found;
    double from = -1e30, to = 1e30;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double a = (-1 - ray.origin[axis]) / ray.direction[axis], b = (1 - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    if (from >= to) {
        return found;
    }
    found = {{from, boundary_color}, {to, boundary_color}};
    const double along = -ray.origin.dot(ray.direction), nearest = ray.at(along).squaredNorm();
    for (const double square : spheres) {
        if (nearest < square) {
            found.push_back({along - std::sqrt(square - nearest), sphere_color});
            found.push_back({along + std::sqrt(square - nearest), sphere_color});
        }
    }
    const Vector normal(1, 0, 0.2);
    const double depth = (plane_at - normal.dot(ray.origin)) / normal.dot(ray.direction);
    if (with_plane && depth > from && depth < to && ray.at(depth).y() < clip_at) {
        found.push_back({depth, plane_color});
    }
    std::sort(found.begin(), found.end(), [](const SurfaceHit& a, const SurfaceHit& b) { return a.depth < b.depth; });
    return found;
}

/** Light of the volume between crossings, and of these, from front to back. */
Color exact_color(const Line& ray, const std::vector<SurfaceHit>& met, VolumeTracer& tracer, const Color& background) {
    std::array<double, 3> rgb{};
    double left = 1;
    VolumeLight before;
    const auto pass = [&](double until) {
        const VolumeLight light = tracer.integrate(ray, until);
        for (std::size_t i = 0; i < 3; ++i) {
            rgb[i] += left * (light.rgb[i] - before.rgb[i]);
        }
        before = light;
    };
    const auto meet = [&](const Color& color) {
        for (std::size_t i = 0; i < 3; ++i) {
            rgb[i] += left * before.transmittance * color[3] * color[i];
        }
        left *= 1 - color[3];
    };
    for (const SurfaceHit& crossing : met) {
        pass(crossing.depth);
        meet(crossing.color);
    }
    if (left > 0) {
        pass(1e300);
        meet(background);
    }
    return {rgb[0], rgb[1], rgb[2], 1};
}

double distance(const Color& a, const Color& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double error = std::abs(a[i] - b[i]);
        largest = std::max(largest, std::isnan(error) ? 1e30 : error);
    }
    return largest;
}

/** How many surfaces are met, and which: what changes from one side of an edge to the other. */
bool are_alike(const std::vector<SurfaceHit>& a, const std::vector<SurfaceHit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const SurfaceHit& x, const SurfaceHit& y) { return x.color == y.color; });
}

} // namespace

TEST_CASE("boundary, cut plane, isosurfaces and volume lie in each other as along the rays") {
    const TransferFunction transfer{{{0, 0.1}, {0.5, 0.8}, {1, 0.2}, {3, 0.6}},
                                    {{0, {1, 0, 0}}, {1, {1, 1, 0}}, {3, {0, 1, 1}}}};
    for (const std::string shape : {"hexahedron", "tetrahedron"}) {
        const TemporaryFile file("combined.h5");
        write_box(shape, file.path());
        const Model model(read_volume(file.path()));
        VolumeTracer tracer(model, {scalar_of_field(model.volume, 0), transfer});
        const RuntimeVolume volume = open_volume(file.path());
        FrameRequest request;
        request.width = request.height = 48;
        request.camera.eye = {3.1, 1.9, 2.3};
        request.camera.up = {0, 0, 1};
        request.camera.field_of_view = 46;
        request.background = {0.25, 0.5, 1, 1};
        request.volume.emplace();
        request.volume->transfer = transfer;
        for (const bool with_plane : {true, false}) {
            Surface plane = surface_of(CutPlane{{1, 0, 0.2, -plane_at}}, plane_color);
            plane.clip = {{0, -1, 0, clip_at}};
            Isosurfaces isosurfaces;
            isosurfaces.values.assign(spheres.begin(), spheres.end());
            request.surfaces = {surface_of(BoundaryFaces{}, boundary_color), plane, surface_of(isosurfaces, sphere_color)};
            if (!with_plane) {
                request.surfaces.erase(request.surfaces.begin() + 1);
            }
            for (const Precision precision : {Precision::float32, Precision::float64}) {
                const Frame frame = Renderer(device(), volume, precision).render(request);
                double largest = 0;
                std::size_t n_layers = 0, n_hits = 0, n_edges = 0;
                for (std::uint32_t pixel = 0; pixel < frame.counts.pixels; ++pixel) {
                    const auto ray_at = [&](double column, double row) {
                        return line_of(pixel_ray(request.camera, frame.width, frame.height, pixel % frame.width + column,
                                                 pixel / frame.width + row));
                    };
                    const std::vector<SurfaceHit> met = crossings(ray_at(0, 0), with_plane);
                    // Within a thousandth of a pixel of an edge or silhouette it is rounding that says what is met.
                    bool is_edge = false;
                    for (const auto& [column, row] : {std::pair(1e-3, 0.0), {-1e-3, 0.0}, {0.0, 1e-3}, {0.0, -1e-3}}) {
                        is_edge = is_edge || !are_alike(met, crossings(ray_at(column, row), with_plane));
                    }
                    if (is_edge) {
                        ++n_edges;
                        continue;
                    }
                    n_hits += met.empty() ? 0 : 1;
                    n_layers = std::max(n_layers, met.size());
                    const Color expected = exact_color(ray_at(0, 0), met, tracer, request.background);
                    const Color drawn{frame.color[4 * pixel], frame.color[4 * pixel + 1], frame.color[4 * pixel + 2],
                                      frame.color[4 * pixel + 3]};
                    const double error = distance(drawn, expected);
                    largest = std::max(largest, error);
                    CAPTURE(shape, with_plane, pixel, met.size(), frame.flags[pixel]);
                    // A tenth of the tolerance of volumes.
                    REQUIRE(error <= 1e-4);
                }
                WARN(shape << (precision == Precision::float32 ? ", float32: " : ", float64: ") << largest << " in " << n_hits
                           << " pixels, up to " << n_layers << " layers, " << n_edges << " at edges");
                CHECK(n_hits > 700);
                CHECK(n_layers == (with_plane ? 7 : 6));
                CHECK(n_edges < 20);
            }
        }
    }
}

namespace {

void check_sharing(const std::string& shape) {
    const TemporaryFile file("shared.h5");
    generate(
        R"({"generator": 1, "mesh": "ball", "elements": 2, "order": 2, "geometry_order": 2, "field": "waves", "shape": ")" +
            shape + "\"}",
        file.path());
    const RuntimeVolume volume = open_volume(file.path());
    FrameRequest request;
    request.width = 48;
    request.height = 36;
    request.camera.eye = {2.3, 1.9, 1.6};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 42;
    request.background = {0, 0, 1, 1};
    const auto colored = [](const SurfaceGeometry& geometry, double opacity) {
        Surface surface;
        surface.geometry = geometry;
        surface.colors.points = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
        surface.opacity = opacity;
        return surface;
    };
    Surface plane = colored(CutPlane{{0.3, 0.25, 1, -0.05}}, 1), behind = colored(CutPlane{{1, 0, 0.1, 0.1}}, 1);
    plane.contours = behind.contours = Contours{{-0.5, 0, 0.5}, {}};
    plane.mesh_lines = behind.mesh_lines = MeshLines{};
    Surface boundary = colored(BoundaryFaces{}, 0.3), sphere = colored(Sphere{{0.1, 0, 0}, 0.6}, 0.5);
    Isosurfaces isosurfaces;
    isosurfaces.values = {-0.2, 0.4};
    request.surfaces = {boundary, colored(isosurfaces, 0.5), plane, sphere, behind};
    request.volume.emplace();
    request.volume->transfer = {{{-1, 0}, {0, 1}, {0.2, 0}, {1, 3}}, {{-1, {1, 0, 0}}, {1, {1, 1, 0}}}};
    {
        Renderer renderer(device(), volume, Precision::float32);
        request.sharing = Sharing::none();
        const Frame unshared = renderer.render(request);
        CHECK(unshared.counts.hidden_pixels == 0);
        CHECK(unshared.counts.spared_pixels == 0);
        std::vector<std::pair<std::string, Sharing>> ways = Sharing::each();
        ways.emplace_back("everything", Sharing::all());
        for (const auto& [name, sharing] : ways) {
            request.sharing = sharing;
            const Frame frame = renderer.render(request);
            CAPTURE(name);
            double largest = 0;
            std::size_t n_differ = 0;
            for (std::size_t i = 0; i < frame.color.size(); ++i) {
                largest = std::max(largest, std::abs(frame.color[i] - unshared.color[i]));
                n_differ += frame.color[i] != unshared.color[i] ? 1 : 0;
            }
            CAPTURE(largest, n_differ);
            // Crossings are refined from other pieces of rays.
            CHECK(largest <= (sharing.depths ? 1e-6 : 0));
            CHECK(frame.element == unshared.element);
            CHECK((frame.counts.hidden_pixels > 0) == sharing.depths);
            CHECK((frame.counts.spared_pixels > 0) == sharing.rows);
            if (sharing.depths) {
                CHECK(frame.counts.field_evaluations < unshared.counts.field_evaluations);
            }
            for (std::size_t i = 0; i < frame.special_values.size(); ++i) {
                CHECK(frame.special_values[i].above == unshared.special_values[i].above);
                CHECK(frame.special_values[i].below == unshared.special_values[i].below);
            }
        }
    }
}

} // namespace

TEST_CASE("what passes share changes no picture, but for the rounding of isosurfaces in front of what hides others") {
    check_sharing("prism");
}

TEST_CASE("What passes share changes no picture of a ball of all shapes", "[.long]") { check_sharing("mixed"); }

} // namespace elvis::oracle
