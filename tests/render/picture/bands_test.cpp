// One picture by several devices: lavapipe, opened several times.
#include <core/base/error.hpp>
#include <core/bench/waves.hpp>
#include <core/expression/expression.hpp>
#include <core/render/bands.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstdlib>
#include <map>
#include <memory>
#include <vector>

using namespace elvis;

namespace {

constexpr std::uint32_t width = 70, height = 83;

/** A device, the volume opened for it, and its renderer. */
struct Drawer {
    Device device;
    RuntimeVolume volume;
    Renderer renderer;

    Drawer(const PluginRegistry& registry, const BenchFolder& folder, Precision precision)
        : volume(waves_volume(registry, folder, 3, 3)), renderer(device, volume, precision) {}
};

FrameRequest sized(FrameRequest request) {
    request.width = width;
    request.height = height;
    request.with_buffers = true;
    return request;
}

/** Of every kind that has rows of its own to reckon with. */
std::map<std::string, FrameRequest> requests() {
    std::map<std::string, FrameRequest> all;
    FrameRequest lines = sized(waves_cut_plane(1));
    lines.surfaces[0].contours.emplace().values = {-0.6, 0.1, 0.7};
    lines.surfaces[0].contours->style.width = 9;
    lines.surfaces[0].mesh_lines.emplace();
    all["lines on a plane"] = lines;
    all["boundary"] = sized(waves_boundary(1));
    all["boundary"].lighting.emplace();
    FrameRequest face_lines = all["boundary"];
    face_lines.surfaces[0].contours = lines.surfaces[0].contours;
    all["lines on the boundary"] = face_lines;
    all["isosurface"] = sized(waves_isosurface(1, 0.2, true));
    all["shifted, orthographic"] = sized(waves_cut_plane(1));
    all["shifted, orthographic"].camera.orthographic = true;
    all["shifted, orthographic"].camera.height = 2.7;
    all["shifted, orthographic"].camera.image_shift = {3.3, -4.7};
    FrameRequest layers = sized(waves_boundary(1));
    layers.surfaces[0].opacity = 0.3;
    layers.surfaces.push_back(waves_cut_plane(1).surfaces[0]);
    layers.surfaces.push_back(layers.surfaces[0]);
    layers.surfaces.back().geometry = WireFrame{};
    layers.surfaces.back().opacity = 1;
    layers.surfaces.push_back(lines.surfaces[0]);
    layers.surfaces.back().geometry = CutShape(Torus{{0, 0, 0}, {0, 0, 1}, 0.6, 0.3});
    all["layers"] = layers;
    for (const char* const kind : {"boundary", "shifted, orthographic"}) {
        FrameRequest lic = all[kind];
        Lic& along = lic.surfaces[0].lic.emplace();
        const char* const components[] = {"0.3 - y", "x + 0.2 * z", "sin(x)"};
        for (std::size_t i = 0; i < 3; ++i) {
            along.vectors[i].expression = std::make_shared<const Expression>(components[i], std::span<const FieldInfo>());
        }
        along.length = 14;
        along.grain = 2;
        lic.surfaces[0].opacity = 0.6;
        all[std::string("line integral convolution, ") + kind] = lic;
    }
    FrameRequest volume = sized(waves_cut_plane(1));
    volume.volume.emplace();
    volume.volume->transfer.color = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
    volume.volume->transfer.density = {{-1, 2}, {-0.3, 0}, {0.3, 0}, {1, 2}};
    all["volume behind a plane"] = volume;
    return all;
}

template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    const auto x = std::as_bytes(std::span(a)), y = std::as_bytes(std::span(b));
    return std::equal(x.begin(), x.end(), y.begin(), y.end());
}

void check_same(const Frame& bands, const Frame& whole) {
    CHECK(bands.width == whole.width);
    CHECK(bands.height == whole.height);
    CHECK(same_bits(bands.color, whole.color));
    CHECK(same_bits(bands.value, whole.value));
    CHECK(same_bits(bands.depth, whole.depth));
    CHECK(same_bits(bands.normal, whole.normal));
    CHECK(bands.element == whole.element);
    CHECK(bands.flags == whole.flags);
    CHECK(bands.is_met == whole.is_met);
    CHECK(bands.counts.pixels == whole.counts.pixels);
    CHECK(bands.counts.hit_pixels >= whole.counts.hit_pixels);
    REQUIRE(bands.special_values.size() == whole.special_values.size());
    for (std::size_t i = 0; i < whole.special_values.size(); ++i) {
        CHECK(bands.special_values[i].is_shown == whole.special_values[i].is_shown);
        CHECK(bands.special_values[i].below == whole.special_values[i].below);
        CHECK(bands.special_values[i].above == whole.special_values[i].above);
    }
}

} // namespace

TEST_CASE("Several devices draw the picture of one of them, to the bit") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    std::vector<std::unique_ptr<Drawer>> drawers;
    std::vector<Renderer*> renderers;
    for (int i = 0; i < 3; ++i) {
        drawers.push_back(std::make_unique<Drawer>(registry, folder, Precision::float32));
        renderers.push_back(&drawers.back()->renderer);
    }
    Drawer one(registry, folder, Precision::float32);
    for (const auto& [name, request] : requests()) {
        INFO(name);
        const Frame whole = one.renderer.render(request);
        REQUIRE(whole.color.size() == 4 * width * height);
        const Frame by_two = render_in_bands(std::span(renderers).first(2), request);
        check_same(by_two, whole);
        if (!request.surfaces[0].has_lines() && !request.surfaces[0].lic && request.surfaces.size() == 1) {
            CHECK(by_two.counts.hit_pixels == whole.counts.hit_pixels); // Nothing is drawn twice.
        }
        check_same(render_in_bands(renderers, request), whole);
    }
}

TEST_CASE("One device draws bands one after the other, to the bit, where its buffers are too small for all rows") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    Drawer one(registry, folder, Precision::float32);
    Renderer* const renderer = &one.renderer;
    for (const auto& [name, request] : requests()) {
        INFO(name);
        const Frame whole = one.renderer.render(request);
        std::vector<double> color(whole.color.size());
        std::uint32_t n_bands = 0;
        const Frame sum =
            render_bands(std::span(&renderer, 1), request, part_rows, nullptr, [&](const Frame& band, const Rows& rows) {
                REQUIRE(band.color.size() == 4 * std::size_t{width} * (rows.end - rows.first));
                std::ranges::copy(band.color, color.begin() + static_cast<std::ptrdiff_t>(4 * width * rows.first));
                ++n_bands;
            });
        CHECK(color == whole.color);
        CHECK(n_bands == (height + part_rows - 1) / part_rows);
        CHECK(sum.counts.pixels == whole.counts.pixels);
    }
    // As many rows as can be bound, or all.
    FrameRequest request = sized(waves_cut_plane(1));
    CHECK(rows_a_band(std::span(&renderer, 1), request) >= request.height);
    request.width = 32768;
    request.height = 32768;
    const std::uint32_t n_rows = rows_a_band(std::span(&renderer, 1), request);
    CHECK(n_rows % part_rows == 0);
    CHECK(n_rows < request.height);
    CHECK(std::uint64_t{n_rows} * request.width <= one.renderer.most_pixels(request));
}

TEST_CASE("There may be more devices than rows for them, and what one of them throws is thrown") {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    const BenchFolder folder("");
    Drawer first(registry, folder, Precision::float64), second(registry, folder, Precision::float64);
    const std::array<Renderer*, 2> renderers{&first.renderer, &second.renderer};
    FrameRequest request = sized(waves_cut_plane(1));
    request.height = 9;
    check_same(render_in_bands(renderers, request), first.renderer.render(request));
    TaskControl control;
    control.cancelled = true;
    CHECK_THROWS_AS(render_in_bands(renderers, sized(waves_cut_plane(1)), &control), Cancelled);
}
