// Pictures that are cancelled leave no trace in the next ones.
#include <core/base/milliseconds.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/base/error.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

namespace elvis::oracle {
namespace {

using Clock = std::chrono::steady_clock;

Surface lined(const SurfaceGeometry& geometry, double opacity) {
    Surface surface;
    surface.geometry = geometry;
    surface.colors.points = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
    surface.opacity = opacity;
    surface.contours = Contours{{-0.5, 0, 0.5}, {}};
    surface.mesh_lines = MeshLines{};
    return surface;
}

Surface isosurface(IsosurfaceMethod method) {
    Isosurfaces isosurfaces;
    isosurfaces.values = {-0.2, 0.4};
    isosurfaces.method = method;
    Surface surface = lined(isosurfaces, 0.5);
    surface.contours.reset();
    surface.mesh_lines.reset();
    return surface;
}

std::vector<std::pair<std::string, FrameRequest>> scenes() {
    FrameRequest request;
    request.width = 56;
    request.height = 42;
    request.camera.eye = {2.3, 1.9, 1.6};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 42;
    request.background = {0, 0, 1, 1};
    const auto with = [&](const std::vector<Surface>& surfaces, bool with_volume) {
        FrameRequest result = request;
        result.surfaces = surfaces;
        if (with_volume) {
            result.volume.emplace();
            result.volume->transfer = {{{-1, 0}, {0, 1}, {0.2, 0}, {1, 3}}, {{-1, {1, 0, 0}}, {1, {1, 1, 0}}}};
        }
        return result;
    };
    const Surface plane = lined(CutPlane{{0.3, 0.25, 1, -0.05}}, 1), boundary = lined(BoundaryFaces{}, 0.3);
    const Surface shape = lined(Sphere{{0.1, 0, 0}, 0.6}, 0.5);
    return {{"plane", with({plane}, false)},
            {"boundary", with({boundary}, false)},
            {"sphere", with({shape}, false)},
            {"isosurface", with({isosurface(IsosurfaceMethod::interval)}, false)},
            {"projection", with({isosurface(IsosurfaceMethod::bernstein)}, false)},
            {"volume", with({}, true)},
            {"all", with({plane, boundary, isosurface(IsosurfaceMethod::interval)}, true)}};
}

/** Of one shape: kernels for each are compiled anew for each renderer, which takes the most time. */
void write_ball(const std::string& path) {
    generate(
        R"({"generator": 1, "mesh": "ball", "shape": "prism", "elements": 2, "order": 3, "geometry_order": 2, "field": "waves"})",
        path);
}

void check_same(const Frame& a, const Frame& b) {
    CHECK(a.color == b.color);
    CHECK(a.flags == b.flags);
    CHECK(a.element == b.element);
    CHECK(a.counts.field_evaluations == b.counts.field_evaluations);
}

/** Cancels the picture after that time. Returns how long it took to stop, if there was anything left to do. */
std::optional<double> cancel(Renderer& renderer, const FrameRequest& request, double after_milliseconds) {
    TaskControl control;
    Clock::time_point asked;
    std::jthread owner([&] {
        std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(after_milliseconds));
        asked = Clock::now();
        control.cancelled = true;
    });
    try {
        renderer.render(request, &control);
    } catch (const Cancelled&) {
        const Clock::time_point stopped = Clock::now();
        return std::chrono::duration<double, std::milli>(stopped - asked).count();
    }
    return std::nullopt;
}

} // namespace

TEST_CASE("after a cancelled picture the next one is the same as ever") {
    const TemporaryFile file("cancel.h5");
    write_ball(file.path());
    const RuntimeVolume volume = open_volume(file.path());
    std::size_t n_cancelled = 0;
    for (const auto& [name, request] : scenes()) {
        Renderer reference(device(), volume, Precision::float32);
        const Frame expected = reference.render(request);
        // From the start, while nothing is there yet.
        Renderer renderer(device(), volume, Precision::float32);
        for (const double after : {0.0, 30.0}) {
            n_cancelled += cancel(renderer, request, after) ? 1 : 0;
        }
        check_same(renderer.render(request), expected);
        const Clock::time_point start = Clock::now();
        renderer.render(request);
        const double whole = milliseconds_since(start);
        double longest = 0;
        for (const double share : {0.2, 0.6}) {
            const std::optional<double> latency = cancel(renderer, request, share * whole);
            n_cancelled += latency ? 1 : 0;
            longest = std::max(longest, latency.value_or(0));
            INFO(name << " after " << share);
            check_same(renderer.render(request), expected);
        }
        WARN(name << ": " << whole << " ms, stops within " << longest << " ms");
        // Far more than parts take, for machines that do other work.
        CHECK(longest < 10000);
    }
    CHECK(n_cancelled >= 20);
}

TEST_CASE("a picture cancelled for another step, value or field does not mix them") {
    const TemporaryFile file("steps.h5");
    write_ball(file.path());
    const RuntimeVolume volume = open_volume(file.path());
    const FrameRequest first = scenes().back().second;
    FrameRequest second = first;
    std::get<Isosurfaces>(second.surfaces[2].geometry).values = {0.1};
    second.camera.eye = {-2.1, 1.7, 1.8};
    Renderer reference(device(), volume, Precision::float32);
    const Frame expected_first = reference.render(first);
    const Frame expected_second = Renderer(device(), volume, Precision::float32).render(second);
    Renderer renderer(device(), volume, Precision::float32);
    renderer.render(first);
    for (const double after : {0.0, 10.0}) {
        cancel(renderer, second, after);
        check_same(renderer.render(first), expected_first);
    }
    cancel(renderer, first, 5);
    check_same(renderer.render(second), expected_second);
}

} // namespace elvis::oracle
