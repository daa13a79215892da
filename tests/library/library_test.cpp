/*
 * libelvis as programs see it: through elvis.hpp, from the shared library.
 */
#include "some_volume.hpp"

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

extern "C" int elvis_is_usable_from_c(void);

namespace {

using Catch::Contains;
using elvis::test::convert;
using elvis::test::own_plugins;
using elvis::test::read_file;
using elvis::test::TemporaryFolder;

/** A small lit picture with all kinds of surfaces. */
elvis::scene some_scene(const elvis::context& context) {
    elvis::scene scene = context.make_scene();
    scene.set("/image/size", "[64, 48]");
    scene.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, -0.4]})");
    scene.set("/surfaces/-", R"({"type": "isosurface", "values": [0.6]})");
    scene.set("/lighting", "\"default\"");
    return scene;
}

elvis_render_options color_only() {
    auto options = elvis::detail::sized<elvis_render_options>();
    options.flags = ELVIS_RENDER_COLOR_ONLY;
    return options;
}

} // namespace

TEST_CASE("Programs in C99 include both headers and use the library") { CHECK(elvis_is_usable_from_c() == 1); }

TEST_CASE("Values at points are those of the field, with gradients, and NaN outside") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    const elvis_data_info info = data.info();
    CHECK(info.n_elements == 27);
    CHECK(info.dimension == 3);
    CHECK(std::string(data.field(0).name) == "p");
    const elvis::probed found = data.probe({0.3, 0.4, 0.5, 7, 7, 7}, {"p", "2*p", "norm(grad(p))"});
    REQUIRE(found.n_values == 3);
    const double p = 0.3 * 0.3 * 0.4 + 0.5;
    CHECK(found.values[0] == Approx(p).epsilon(1e-12));
    CHECK(found.values[1] == Approx(2 * p).epsilon(1e-12));
    CHECK(found.gradients[0] == Approx(2 * 0.3 * 0.4).epsilon(1e-10));
    CHECK(found.gradients[2] == Approx(1).epsilon(1e-10));
    CHECK(found.elements[0] >= 0);
    CHECK(found.elements[1] == -1);
    CHECK(std::isnan(found.values[3]));
    const elvis_range range = data.range("p");
    CHECK(range.certainty == ELVIS_CERTIFIED);
    CHECK(range.lower_bound <= range.minimum);
    CHECK(range.maximum <= range.upper_bound);
    CHECK_THAT(data.describe_briefly(), Contains("\"n_elements\": 27") && !Contains("negative_jacobians"));
}

TEST_CASE("A picture has the bytes of elvis render, and its arrays are those of its files") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    elvis::scene scene = some_scene(context);
    const elvis::picture picture = data.render(scene);
    picture.write_png(folder.path("library.png"));
    scene.set("/volume", R"({"path": ")" + folder.path("volume.h5") + R"("})");
    scene.write(folder.path("scene.json"));
    const std::string command = "ELVIS_PLUGIN_PATH='" ELVIS_TEST_PLUGINS "' '" ELVIS_PROGRAM "' render '" +
                                folder.path("scene.json") + "' -o '" + folder.path("program.png") + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    CHECK(read_file(folder.path("library.png")) == read_file(folder.path("program.png")));

    const std::vector<double> depth = picture.read<double>(ELVIS_CHANNEL_DEPTH);
    const std::vector<std::int64_t> elements = picture.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT);
    const auto n_seen = static_cast<std::uint64_t>(std::ranges::count_if(depth, [](double d) { return !std::isnan(d); }));
    CHECK(n_seen > 300);
    CHECK(n_seen == picture.info().n_hit_pixels);
    CHECK(std::ranges::count(elements, -1) == static_cast<std::ptrdiff_t>(depth.size() - n_seen));
    CHECK_THAT(picture.stats(), Contains("\"hit_pixels\""));
    CHECK_THAT(picture.color_bars(), Contains("\"p\""));
}

TEST_CASE("Rows go into the caller's array with its strides, also from below") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    const elvis::picture picture = data.render(some_scene(context));
    const std::vector<std::uint8_t> plain = picture.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    // Five bytes a pixel, rows from below, three spare bytes at the end of each.
    constexpr std::ptrdiff_t width = 64, height = 48, step = 5, row = width * step + 3;
    std::vector<std::uint8_t> strided(row * height, 77);
    std::uint8_t* const top = strided.data() + (height - 1) * row;
    REQUIRE(elvis_picture_read(picture.get(), ELVIS_CHANNEL_COLOR, ELVIS_NUMBER_UINT8, top, -row, step) == ELVIS_OK);
    for (std::ptrdiff_t y = 0; y < height; ++y) {
        for (std::ptrdiff_t x = 0; x < width; ++x) {
            const std::uint8_t* const pixel = strided.data() + (height - 1 - y) * row + x * step;
            REQUIRE(std::equal(pixel, pixel + 4, plain.data() + 4 * (y * width + x)));
            REQUIRE(pixel[4] == 77);
        }
    }
    const elvis::picture colors = data.render(some_scene(context), color_only());
    CHECK(colors.read<std::uint8_t>(ELVIS_CHANNEL_COLOR) == plain);
    CHECK_THROWS_WITH(colors.read<double>(ELVIS_CHANNEL_DEPTH), Contains("ELVIS_RENDER_COLOR_ONLY"));
    CHECK_THROWS_WITH(picture.read<float>(ELVIS_CHANNEL_FLAGS), Contains("such numbers"));
}

TEST_CASE("A scene is set key by key, and what its schema refuses leaves it as it was") {
    const elvis::context context(own_plugins());
    elvis::scene scene = some_scene(context);
    const std::string before = scene.json();
    CHECK_THROWS_WITH(scene.set("/camera/eey", "[0, 0, 1]"), Contains("eey") && Contains("eye"));
    CHECK_THROWS_WITH(scene.set("/image/size", "[0, 10]"), Contains("size"));
    CHECK_THROWS_WITH(scene.set("/image/size", "[10"), Contains("no JSON"));
    CHECK_THROWS_WITH(scene.set("image", "{}"), Contains("JSON Pointer"));
    CHECK_THROWS_WITH(scene.set("/field/x", "1"), Contains("no such place") || Contains("field"));
    CHECK_THROWS_WITH(scene.remove("/volume"), Contains("nothing to remove"));
    CHECK_THROWS_WITH(scene.json("/surfaces/2"), Contains("/surfaces/2"));
    CHECK(scene.json() == before);
    scene.remove("/surfaces/0");
    CHECK(scene.json("/surfaces/0/type") == "\"isosurface\"");
    const elvis::scene copy = scene.copy();
    scene.set("/surfaces/0/opacity", "0.5");
    CHECK_THROWS_AS(copy.json("/surfaces/0/opacity"), elvis::error);
    CHECK(scene.json("/surfaces/0/opacity") == "0.5");
}

TEST_CASE("Null pointers, unknown fields and files are errors with a text") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    CHECK(elvis_data_open(context.get(), nullptr, nullptr, nullptr, nullptr, nullptr) == ELVIS_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(elvis_context_error(context.get())) == "data: is NULL");
    CHECK(elvis_render(nullptr, nullptr, nullptr, nullptr, nullptr) == ELVIS_ERROR_INVALID_ARGUMENT);
    CHECK(elvis_context_create(nullptr, nullptr) == ELVIS_ERROR_INVALID_ARGUMENT);
    elvis_picture* picture = nullptr;
    CHECK(elvis_render(data.get(), nullptr, nullptr, nullptr, &picture) == ELVIS_ERROR_INVALID_ARGUMENT);
    elvis_data_info unsized{};
    CHECK(elvis_data_get_info(data.get(), &unsized) == ELVIS_ERROR_INVALID_ARGUMENT);
    CHECK_THROWS_WITH(data.probe({0, 0, 0}, {"q"}), Contains("q"));
    CHECK_THROWS_WITH(data.probe({0, 0, 0}, {"p"}, 3), Contains("time step"));
    CHECK_THROWS_WITH(data.range("p+"), !Contains("std::"));
    CHECK_THROWS_WITH(context.open(folder.write("none.txt", "no volume")), Contains("no conversion plugin reads this file"));
    CHECK_THROWS_WITH(context.open(std::vector<std::string>{}), Contains("paths: there are none"));
    CHECK_THROWS_WITH(context.read_scene(folder.path("none.json")), Contains("none.json"));
    elvis_context_release(nullptr);
    elvis_data_release(nullptr);
    elvis_scene_release(nullptr);
    elvis_picture_release(nullptr);
    elvis_text_release(nullptr);
}

TEST_CASE("A task is stopped, says how far it is, and the next call is as if nothing had been") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    const elvis::scene scene = some_scene(context);
    const auto options = elvis::detail::sized<elvis_render_options>();
    CHECK_THROWS_AS(data.render(scene, options, {{}, [] { return true; }}), elvis::cancelled);
    std::atomic<int> n_questions{0};
    CHECK_THROWS_AS(data.render(scene, options, {{}, [&] { return ++n_questions > 5; }}), elvis::cancelled);
    const auto color = data.render(scene).read<double>(ELVIS_CHANNEL_COLOR);
    CHECK(context.open(folder.path("volume.h5")).render(scene).read<double>(ELVIS_CHANNEL_COLOR) == color);
    std::vector<double> points(3 * 10000, 0.5);
    int n_reports = 0;
    data.probe(points, {"p"}, 0, {[&](double fraction, const char*) { n_reports += fraction >= 0 && fraction <= 1; }, {}});
    CHECK(n_reports > 1);
}

TEST_CASE("Several contexts work in several threads at once, and each hears its own log") {
    const TemporaryFolder folder;
    std::string volume;
    std::vector<double> expected;
    {
        const elvis::context context(own_plugins());
        volume = convert(context, folder);
        expected = context.open(volume).render(some_scene(context)).read<double>(ELVIS_CHANNEL_COLOR);
    }
    // A folder with something that is no plugin: a warning for the context that looks there.
    const std::string bad = folder.path("bad");
    std::filesystem::create_directory(bad);
    std::ofstream(bad + "/broken.so") << "no library";
    std::array<std::atomic<int>, 2> n_lines{};
    std::array<bool, 2> is_right{};
    std::array<std::thread, 2> threads;
    for (std::size_t index = 0; index < threads.size(); ++index) {
        threads[index] = std::thread([&, index] {
            const std::string path = std::string(ELVIS_TEST_PLUGINS) + (index == 0 ? "" : ":" + bad);
            auto options = own_plugins();
            options.plugin_path = path.c_str();
            options.user = &n_lines[index];
            options.log = [](void* user, elvis_log_level level, elvis_string) {
                *static_cast<std::atomic<int>*>(user) += level >= ELVIS_LOG_WARNING;
            };
            const elvis::context context(options);
            is_right[index] = context.open(volume).render(some_scene(context)).read<double>(ELVIS_CHANNEL_COLOR) == expected;
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(is_right == std::array{true, true});
    CHECK(n_lines[0] == 0);
    CHECK(n_lines[1] == 1);
}

TEST_CASE("Kernels are kept where the host says, and the environment has no say where it is switched off") {
    const TemporaryFolder folder;
    const std::string own = folder.path("own"), of_environment = folder.path("environment");
    std::string volume;
    {
        const elvis::context context(own_plugins());
        volume = convert(context, folder);
    }
    const char* const before = std::getenv("ELVIS_CACHE_PATH");
    const std::string kept = before != nullptr ? before : "";
    ::setenv("ELVIS_CACHE_PATH", of_environment.c_str(), 1);
    const auto draw_with_cache = [&](const char* cache, elvis_context_flags flags) {
        auto options = own_plugins();
        options.cache_folder = cache;
        options.flags = flags;
        const elvis::context context(options);
        context.open(volume).render(some_scene(context));
    };
    draw_with_cache(own.c_str(), 0);
    CHECK(std::filesystem::exists(own));
    CHECK_FALSE(std::filesystem::exists(of_environment));
    draw_with_cache("", 0);
    CHECK_FALSE(std::filesystem::exists(of_environment));
    draw_with_cache("", ELVIS_CONTEXT_NO_ENVIRONMENT);
    ::setenv("ELVIS_DEVICE", "no such device", 1);
    CHECK_NOTHROW(draw_with_cache(own.c_str(), ELVIS_CONTEXT_NO_ENVIRONMENT));
    CHECK_THROWS_WITH(draw_with_cache(own.c_str(), 0), Contains("no such device"));
    ::unsetenv("ELVIS_DEVICE");
    draw_with_cache(nullptr, 0);
    CHECK(std::filesystem::exists(of_environment));
    before != nullptr ? ::setenv("ELVIS_CACHE_PATH", kept.c_str(), 1) : ::unsetenv("ELVIS_CACHE_PATH");
}

TEST_CASE("Threads share data, scene and context: all get the same picture and values") {
    const elvis::context context(own_plugins());
    const TemporaryFolder folder;
    const elvis::data data = context.open(convert(context, folder));
    const elvis::scene scene = some_scene(context);
    const std::vector<double> expected = data.render(scene).read<double>(ELVIS_CHANNEL_COLOR);
    const double value = data.probe({0.3, 0.4, 0.5}, {"p"}).values[0];
    std::atomic<int> n_right{0};
    std::vector<std::thread> threads;
    for (int index = 0; index < 4; ++index) {
        threads.emplace_back([&] {
            for (int round = 0; round < 3; ++round) {
                n_right += data.render(scene).read<double>(ELVIS_CHANNEL_COLOR) == expected;
                n_right += data.probe({0.3, 0.4, 0.5}, {"p"}).values[0] == value;
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(n_right == 24);
}

TEST_CASE("Handles are released in any order") {
    const TemporaryFolder folder;
    elvis_context_options options = own_plugins();
    elvis_context* context = nullptr;
    REQUIRE(elvis_context_create(&options, &context) == ELVIS_OK);
    elvis_data* data = nullptr;
    elvis_scene* scene = nullptr;
    elvis_picture* picture = nullptr;
    {
        const elvis::context other(options);
        convert(other, folder);
    }
    REQUIRE(elvis_data_open(context, folder.path("volume.h5").c_str(), nullptr, nullptr, nullptr, &data) == ELVIS_OK);
    REQUIRE(elvis_scene_create(context, &scene) == ELVIS_OK);
    REQUIRE(elvis_scene_set(scene, "/image/size", "[16, 12]") == ELVIS_OK);
    REQUIRE(elvis_render(data, scene, nullptr, nullptr, &picture) == ELVIS_OK);
    elvis_context_release(context);
    elvis_scene_release(scene);
    elvis_data_release(data);
    CHECK(elvis_picture_write_buffers(picture, folder.path("buffers.h5").c_str()) == ELVIS_OK);
    elvis_picture_release(picture);
}
