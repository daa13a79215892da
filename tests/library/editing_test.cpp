// What programs need in which people change scenes: texts, cameras and colours that wait for no data.

#include "some_volume.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace elvis;
using nlohmann::json;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

/** As descriptions tell it. */
struct Extent {
    std::vector<double> outline;
    elvis_extent extent = detail::sized<elvis_extent>();

    explicit Extent(const data& volume) {
        auto options = detail::sized<elvis_describe_options>();
        options.flags = ELVIS_DESCRIBE_BRIEF | ELVIS_DESCRIBE_OUTLINE;
        const json description = json::parse(volume.describe(options));
        for (const json& point : description["outline"]) {
            outline.insert(outline.end(), point.begin(), point.end());
        }
        std::copy_n(volume.info().bounds, 6, extent.bounds);
        extent.outline = outline.data();
        extent.n_outline = outline.size() / 3;
    }
};

/** The largest difference of numbers in two cameras of the same kind. */
double difference(const json& one, const json& other) {
    const json a = one.flatten(), b = other.flatten();
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (const auto& [key, value] : a.items()) {
        if (value.is_number()) {
            most = std::max(most, std::abs(value.get<double>() - b.at(key).get<double>()));
        } else {
            CHECK(value == b.at(key));
        }
    }
    return most;
}

} // namespace

TEST_CASE("A scene's text has everything in full, and reads as the same scene from where it is written") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const std::string near_file = folder.path("volume.h5");
    scene shown = library.make_scene();
    shown.set("/volume/path", json(near_file).dump());
    shown.set("/lighting", "\"default\"");
    shown.set("/surfaces/-", R"({"type": "plane", "point": [0, 0, 0.5], "normal": [0, 0, 2]})");
    const std::string text = shown.text(folder.path(""));
    const json document = json::parse(text);
    CHECK(document["volume"]["path"] == "volume.h5");
    CHECK(document["lighting"]["headlight"].size() == 3);
    CHECK(document["surfaces"][0]["plane"] == json{0.0, 0.0, 2.0, -1.0});
    CHECK(library.parse_scene(text, folder.path("")).text(folder.path("")) == text);
    shown.write(folder.path("scene.json"));
    std::ifstream written(folder.path("scene.json"));
    CHECK(std::string(std::istreambuf_iterator<char>(written), {}) == text);
    CHECK(elvis_scene_write_text(shown.get(), nullptr, nullptr) == ELVIS_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("Cameras are placed without data as they are with it") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const Extent whole(volume);
    for (const char* const surface : {R"({"type": "boundary"})", R"({"type": "plane", "plane": [1, 0, 0, -0.5]})"}) {
        for (const char* const camera :
             {"{}", R"({"type": "orthographic"})", R"({"eye": [3, 1, 2]})", R"({"up": [0, 0, 1]})"}) {
            INFO(surface << camera);
            scene shown = library.make_scene();
            shown.set("/surfaces/-", surface);
            shown.set("/camera", camera);
            shown.set("/image/annotation", "\"default\"");
            const json expected = json::parse(shown.completed(volume).json("/camera"));
            scene placed = shown.copy();
            placed.complete_camera(whole.extent);
            CHECK(difference(json::parse(placed.json("/camera")), expected) < 1e-12);
        }
    }
    // Fitted, it keeps its direction, and is that of a scene that says the direction alone.
    scene far_away = library.make_scene();
    far_away.set("/camera", R"({"eye": [55, 45, 70], "look_at": [0, 0, 0], "near": 0.001})");
    far_away.fit_camera(whole.extent);
    const json fitted = json::parse(far_away.json("/camera"));
    scene open = library.make_scene();
    open.set("/surfaces/-", R"({"type": "boundary"})");
    open.complete_camera(whole.extent);
    json usual = json::parse(open.json("/camera"));
    usual["near"] = 0.001;
    CHECK(difference(fitted, usual) < 1e-12);
    auto wrong = whole.extent;
    wrong.bounds[2] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(open.fit_camera(wrong), Catch::Contains("not finite"));
    wrong = whole.extent;
    wrong.outline = nullptr;
    CHECK_THROWS_WITH(open.complete_camera(wrong), Catch::Contains("outline"));
    open.set("/camera", R"({"eye": [1, 1, 1], "look_at": [1, 1, 1]})");
    CHECK_THROWS_WITH(open.complete_camera(whole.extent), Catch::Contains("same point"));
    CHECK(json::parse(open.json("/camera")) == json::parse(R"({"eye": [1, 1, 1], "look_at": [1, 1, 1]})"));
}

TEST_CASE("Expressions of a scene are written out for functions that do not know it") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    scene shown = library.make_scene();
    shown.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 2, -1], "name": "cut"})");
    CHECK(shown.expression("p + 1") == "p + 1");
    const probed found = volume.probe({0.5, 0.5, 0.75}, {shown.expression("distance(cut)")});
    CHECK(found.values[0] == Approx(0.25));
    CHECK_THROWS_WITH(shown.expression("distance(cat)"), Catch::Contains("nearest is 'cut'"));
}

TEST_CASE("Transfer functions are told as volumes are drawn with them") {
    const context library(own_plugins());
    scene shown = library.make_scene();
    const json usual = json::parse(shown.transfer({-1, 3}, 2));
    REQUIRE(usual["density"].size() == 2);
    CHECK(usual["density"][0] == json{-1.0, 0.0});
    CHECK(usual["density"][1][0] == 3);
    CHECK(std::exp(-2 * usual["density"][1][1].get<double>()) == Approx(0.05));
    CHECK(usual["color"].front()[0] == -1);
    CHECK(usual["color"].back()[0] == 3);
    shown.set("/color_map", R"({"points": [[0, 1, 0, 0], [1, 0, 0, 1]], "range": [5, 6]})");
    shown.set("/volume_rendering", R"({"opacity": [[5, 0], [6, 0.5]], "unit_distance": 2})");
    const json own = json::parse(shown.transfer({-1, 3}, 2));
    CHECK(own["color"] == json::parse("[[5.0, 1.0, 0.0, 0.0], [6.0, 0.0, 0.0, 1.0]]"));
    CHECK(own["density"].back()[1].get<double>() == Approx(std::log(2.0) / 2));
    CHECK_THROWS_WITH(shown.transfer({1, 0}, 2), Catch::Contains("smaller to a larger"));
    CHECK_THROWS_WITH(shown.transfer({0, 1}, 0), Catch::Contains("above 0"));
    shown.set("/color_map", R"({"scale": "logarithmic"})");
    CHECK_THROWS_WITH(shown.transfer({0, 1}, 2), Catch::Contains("logarithmic"));
}

TEST_CASE("Whether a scene suits data is known before anything is drawn") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const auto wrong = [&](const json& keys) -> std::string {
        json document{{"version", 1}, {"camera", {{"eye", {3, 2, 1}}, {"look_at", {0, 0, 0}}}}};
        document.update(keys);
        try {
            volume.check_scene(library.parse_scene(document.dump()));
        } catch (const error& told) {
            return told.what();
        }
        return {};
    };
    const std::string name = volume.field(0).name;
    CHECK(wrong(json::object()).empty());
    CHECK(wrong({{"field", "x + " + name}, {"color_map", {{"scale", "logarithmic"}}}, {"threshold", name + " > 0"}}).empty());
    CHECK(wrong({{"surfaces",
                  {{{"type", "plane"}, {"name", "cut"}, {"plane", {0, 0, 1, 0}}},
                   {{"type", "isosurface"}, {"values", {0.5}}, {"color_field", "distance(cut)"}}}}})
              .empty());
    const auto surface = [](json keys) { return json{{"surfaces", json::array({std::move(keys)})}}; };
    for (const auto& [keys, word] : std::vector<std::pair<json, std::string>>{
             {{{"field", "nothing"}}, "'nothing' is unknown"},
             {{{"threshold", "x > "}}, "where a value is expected"},
             {surface({{"type", "boundary"}, {"visible", false}, {"field", "sqrt("}}), "sqrt("},
             {surface({{"type", "streamlines"}, {"flow", "nothing"}}), "nothing"},
             {surface({{"type", "arrows"}, {"vectors", "x"}}), "x"},
             {surface({{"type", "isosurface"}, {"values", {0.5}}, {"color_field", "distance(none)"}}), "none"},
             {{{"lic", {{"field", "x"}}}}, "x"},
             {{{"warp", {{"field", "nothing"}}}}, "nothing"},
             {{{"volume_rendering", {{"field", "y +"}}}}, "y +"}}) {
        CAPTURE(keys.dump());
        CHECK(wrong(keys).find(word) != std::string::npos);
    }
}

TEST_CASE("Memory has a limit, beyond which no kernel is made, and is given back") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const auto drawn = [&](const std::string& field) {
        const json document{{"version", 1},
                            {"field", field},
                            {"image", {{"size", {40, 30}}}},
                            {"surfaces", json::array({{{"type", "plane"}, {"plane", {0, 0, 1, 0}}}})}};
        return volume.render(library.parse_scene(document.dump())).read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    };
    const auto first = drawn("x + 2 * y");
    const auto n_kernels = [&] { return json::parse(library.describe_device())["n_kernels"].get<int>(); };
    CHECK(n_kernels() > 0);
    volume.free_memory();
    CHECK(n_kernels() == 0);
    library.free_memory();
    library.limit_memory(1 << 20);
    try {
        drawn("x + 3 * y");
        FAIL("there is no room");
    } catch (const error& told) {
        CHECK(told.result() == ELVIS_ERROR_OUT_OF_MEMORY);
        CHECK(std::string(told.what()).find("that it may") != std::string::npos);
    }
    library.limit_memory(0);
    CHECK(drawn("x + 2 * y") == first);
}
