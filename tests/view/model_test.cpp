// What the window does to a scene and its camera, without a window.

#include <apps/elvis/view/model/histogram.hpp>
#include <apps/elvis/view/model/model.hpp>
#include <apps/elvis/view/model/second_view.hpp>
#include <apps/elvis/view/model/settings.hpp>
#include <apps/elvis/view/scene/camera_motion.hpp>
#include <apps/elvis/view/scene/handles.hpp>
#include <apps/elvis/view/scene/value_scale.hpp>

#include <core/base/temporary_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

using namespace elvis;
using namespace elvis::view;

namespace {

VolumeFacts facts() {
    VolumeFacts volume;
    volume.path = "ball.h5";
    volume.bounds = volume.shown_bounds = {-1, -2, -3, 3, 2, 1};
    volume.fields.push_back({});
    volume.times = {0, 1};
    volume.has_faces = true;
    return volume;
}

/** Plugins and devices are not needed. */
const context& library() {
    static const context own = [] {
        auto options = detail::sized<elvis_context_options>();
        options.plugin_path = "";
        return context(options);
    }();
    return own;
}

Scene with_whole_camera(const Scene& scene) {
    elvis::scene complete = library().parse_scene(scene.dump());
    const VolumeFacts volume = facts();
    complete.complete_camera(volume.extent());
    return Scene::parse(complete.text());
}

Model opened() {
    Model model;
    Scene scene = scene_of_files({"ball.h5"});
    scene["surfaces"] = {{{"type", "boundary"}}};
    model.open(with_whole_camera(scene), facts(), "");
    return model;
}

Camera camera(bool orthographic) {
    Camera result;
    result.orthographic = orthographic;
    result.eye = {3, 4, 5};
    result.look_at = {0.5, -0.2, 0.1};
    result.up = {0.1, 1, 0};
    result.field_of_view = 40;
    result.height = 6;
    return result;
}

void change_opacity(Model& model, double opacity) {
    Scene scene = model.scene();
    scene["surfaces"][0]["opacity"] = opacity;
    model.edit("opacity", std::move(scene));
}

double opacity(const Model& model) { return model.scene()["surfaces"][0].value("opacity", 1.0); }

const PictureSize size{640, 480};

double distance(const Vector3& a, const Vector3& b) { return length(minus(a, b)); }

} // namespace

TEST_CASE("Edits of one gesture are one step of undo") {
    Model model = opened();
    CHECK_FALSE(model.undo_name());
    CHECK_FALSE(model.is_changed());
    for (const double opacity : {0.9, 0.8, 0.7}) {
        change_opacity(model, opacity);
    }
    model.end_gesture();
    change_opacity(model, 0.2);
    CHECK(model.is_changed());
    model.undo();
    CHECK(opacity(model) == 0.7);
    model.undo();
    CHECK(opacity(model) == 1);
    CHECK_FALSE(model.undo_name());
    model.redo();
    model.redo();
    CHECK(opacity(model) == 0.2);
    CHECK_FALSE(model.redo_name());
    model.undo();
    change_opacity(model, 0.5);
    CHECK_FALSE(model.redo_name());
}

TEST_CASE("Undo leaves camera and size alone") {
    Model model = opened();
    change_opacity(model, 0.5);
    model.set_camera(camera(true));
    model.set_size({123, 45});
    const std::uint64_t revision = model.revision();
    model.undo();
    CHECK(model.camera().eye == camera(true).eye);
    CHECK(model.camera().orthographic);
    CHECK(size_of(model.scene()) == std::array<std::uint32_t, 2>{123, 45});
    CHECK(model.revision() > revision);
}

TEST_CASE("An opened scene has a camera that sees the whole volume") {
    const Model model = opened();
    const auto& b = facts().bounds;
    const PictureSize picture{1024, 768};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto place =
            project(model.camera(), picture, {b[(corner & 1) ? 3 : 0], b[(corner & 2) ? 4 : 1], b[(corner & 4) ? 5 : 2]});
        REQUIRE(place);
        CHECK(((*place)[0] > 0 && (*place)[0] < 1024 && (*place)[1] > 0 && (*place)[1] < 768));
    }
}

TEST_CASE("Rays and projections are inverse") {
    std::mt19937 random(3);
    for (const bool orthographic : {false, true}) {
        Camera shifted = camera(orthographic);
        shifted.image_shift = {0.25, -3};
        for (int i = 0; i < 100; ++i) {
            const PicturePoint place = {std::uniform_real_distribution<double>(0, 640)(random),
                                        std::uniform_real_distribution<double>(0, 480)(random)};
            const Vector3 point = ray_through(shifted, size, place).at(std::uniform_real_distribution<double>(0.1, 20)(random));
            const auto back = project(shifted, size, point);
            REQUIRE(back);
            CHECK((*back)[0] == Approx(place[0]).margin(1e-9));
            CHECK((*back)[1] == Approx(place[1]).margin(1e-9));
        }
    }
}

TEST_CASE("Zooming keeps what is below the cursor, panning follows it") {
    for (const bool orthographic : {false, true}) {
        const Camera before = camera(orthographic);
        const PicturePoint place = {500.5, 100.5};
        // The point below the cursor at the distance of what is looked at.
        const ViewAxes axes = axes_of(before);
        const Ray ray = ray_through(before, size, place);
        const double depth = dot(minus(before.look_at, ray.origin), axes.forward) / dot(ray.direction, axes.forward);
        const Vector3 point = ray.at(depth);
        const Camera zoomed_in = zoomed(before, size, place, 0.5);
        const auto after = project(zoomed_in, size, point);
        REQUIRE(after);
        CHECK((*after)[0] == Approx(place[0]));
        CHECK((*after)[1] == Approx(place[1]));
        CHECK(pixel_length(zoomed_in, size, point) == Approx(0.5 * pixel_length(before, size, point)));
        const auto moved = project(panned(before, size, {30, -20}), size, point);
        REQUIRE(moved);
        CHECK((*moved)[0] == Approx(place[0] + 30));
        CHECK((*moved)[1] == Approx(place[1] - 20));
    }
}

TEST_CASE("Orbiting keeps the distance, and what is looked at in the middle") {
    Camera turned_camera = camera(false);
    for (int i = 0; i < 50; ++i) {
        turned_camera = orbited(turned_camera, size, {13, 47});
        CHECK(distance(turned_camera.eye, turned_camera.look_at) == Approx(distance(camera(false).eye, camera(false).look_at)));
        CHECK(turned_camera.look_at == camera(false).look_at);
        const ViewAxes axes = axes_of(turned_camera);
        CHECK(std::abs(dot(axes.forward, turned_camera.up)) < 1e-9);
    }
    // A drag to the right turns the front of the volume to the right.
    const Camera before = camera(false), after = orbited(before, size, {20, 0});
    const Vector3 front = plus(before.look_at, scaled(axes_of(before).forward, -1));
    CHECK((*project(after, size, front))[0] > (*project(before, size, front))[0]);
}

TEST_CASE("Another projection shows what is looked at as large") {
    const Camera before = camera(false);
    const Camera parallel = with_projection(before, true);
    CHECK(pixel_length(parallel, size, before.look_at) == Approx(pixel_length(before, size, before.look_at)));
    const Camera back = with_projection(parallel, false);
    CHECK(distance(back.eye, before.eye) < 1e-9);
}

TEST_CASE("A plane's handles move and turn it") {
    Model model = opened();
    Scene scene = model.scene();
    const ItemId item = add(scene, facts(), NewItem::cut_plane, 0);
    const std::vector<Handle> handles = handles_of(scene, item, facts());
    REQUIRE(handles.size() == 2);
    const Camera seen = model.camera();
    // Dragged to where it is seen a length along the normal, the plane is there.
    const Vector3 there = plus(handles[0].position, scaled(handles[0].direction, 0.7));
    const auto from = project(seen, size, handles[0].position), to = project(seen, size, there);
    REQUIRE((from && to));
    const Vector3 position = dragged_to(handles[0], seen, size, *from, *to);
    CHECK(distance(position, there) < 1e-9);
    const Scene moved = with_moved_handle(scene, item, facts(), 0, position);
    CHECK(distance(handles_of(moved, item, facts())[0].position, there) < 1e-9);
    const Vector3 aside = plus(handles[1].position, {0.3, 0.2, 0.1});
    const Scene turned_scene = with_moved_handle(scene, item, facts(), 1, aside);
    const Handle after = handles_of(turned_scene, item, facts())[0];
    CHECK(distance(after.direction, unit(minus(aside, handles[0].position))) < 1e-9);
    CHECK(distance(after.position, handles[0].position) < 1e-9);
}

TEST_CASE("Handles of shapes and lights take them where they go") {
    for (const NewItem kind : {NewItem::sphere, NewItem::cylinder, NewItem::cone, NewItem::torus, NewItem::point_light}) {
        Scene scene = scene_of_files({});
        const ItemId item = add(scene, facts(), kind, 0);
        const std::vector<Handle> handles = handles_of(scene, item, facts());
        REQUIRE_FALSE(handles.empty());
        for (std::size_t i = 0; i < handles.size(); ++i) {
            const Vector3 by =
                handles[i].kind == Handle::Kind::along ? scaled(handles[i].direction, 0.2) : Vector3{0.1, 0.2, 0.3};
            const Vector3 to = plus(handles[i].position, by);
            CHECK(distance(handles_of(with_moved_handle(scene, item, facts(), i, to), item, facts())[i].position, to) < 1e-9);
        }
    }
}

TEST_CASE("Planes that cut a surface away have handles, after those of its place") {
    for (const NewItem kind : {NewItem::boundary, NewItem::sphere, NewItem::cut_plane}) {
        Scene scene = scene_of_files({});
        const ItemId item = add(scene, facts(), kind, 0);
        const std::size_t n_own = handles_of(scene, item, facts()).size();
        part_of(scene, item)["clip"] = {{1, 0, 0, -0.5}, {0, 0, 2, 1}};
        const Json whole = part_of(scene, item);
        const std::vector<Handle> handles = handles_of(scene, item, facts());
        REQUIRE(handles.size() == n_own + 4);
        const Handle& mover = handles[n_own + 2];
        const Vector3 to = plus(mover.position, scaled(mover.direction, 0.25));
        Scene moved = with_moved_handle(scene, item, facts(), n_own + 2, to);
        CHECK(part_of(moved, item)["clip"] == Json{{1, 0, 0, -0.5}, {0.0, 0.0, 2.0, 0.5}});
        moved = with_moved_handle(scene, item, facts(), n_own + 1, plus(handles[n_own].position, {0, 3, 0}));
        CHECK(part_of(moved, item)["clip"] == Json{{0.0, 1.0, 0.0, 0.0}, {0, 0, 2, 1}});
        part_of(moved, item)["clip"] = whole["clip"];
        CHECK(part_of(moved, item) == whole);
    }
}

TEST_CASE("Everything that can be added can be hidden, copied, removed, and written") {
    for (const NewItemInfo& info : new_items()) {
        INFO(info.name);
        Scene scene = scene_of_files({});
        REQUIRE(can_add(scene, facts(), info.item));
        const ItemId item = add(scene, facts(), info.item, 0.5);
        REQUIRE(exists(scene, item));
        CHECK(is_shown(scene, item));
        CHECK_FALSE(item_label(scene, item).empty());
        set_shown(scene, item, false);
        CHECK_FALSE(is_shown(scene, item));
        set_shown(scene, item, true);
        CHECK(is_shown(scene, item));
        const ItemId copy = duplicate(scene, item);
        CHECK(exists(scene, copy));
        CHECK(items_of(scene).size() == (info.item == NewItem::volume ? 1u : 2u));
        // The library takes it, and says it in full.
        const std::string text = library().parse_scene(scene.dump()).text();
        CHECK(library().parse_scene(text).text() == text);
        CHECK(items_of(Scene::parse(text)) == items_of(scene));
        remove(scene, copy);
        CHECK(items_of(scene).size() == (info.item == NewItem::volume ? 0u : 1u));
    }
}

TEST_CASE("A second view has its own camera once it is unlinked, and its own choice of items") {
    Model model = opened();
    const auto add_item = [&](NewItem item) {
        Scene scene = model.scene();
        add(scene, *model.volume(), item, 0.5);
        model.edit("add", std::move(scene));
        model.end_gesture();
    };
    add_item(NewItem::cut_plane);
    SecondView second;
    second.turn_on(model);
    second.set_size({300, 200});
    second.follow(model);
    CHECK(size_of(second.scene()) == std::array<std::uint32_t, 2>{300, 200});
    const auto orbit = [&](const Camera& camera) { return orbited(camera, {300, 200}, {40, 10}); };

    second.set_camera(model, orbit(second.camera(model)));
    CHECK(second.camera(model).eye == model.camera().eye);
    second.set_linked(model, false);
    const Camera first = model.camera();
    second.set_camera(model, orbit(first));
    second.follow(model);
    CHECK(model.camera().eye == first.eye);
    CHECK(camera_of(part_of(second.scene(), "camera")).eye == orbit(first).eye);
    // What the first view alone shows is nothing new.
    const std::uint64_t revision = second.revision();
    model.set_camera(orbit(orbit(first)));
    second.follow(model);
    CHECK(second.revision() == revision);

    second.set_shown(1, false);
    second.follow(model);
    const auto shown = [&] {
        std::vector<bool> all;
        for (const ItemId& item : items_of(second.scene())) {
            all.push_back(is_shown(second.scene(), item));
        }
        return all;
    };
    CHECK(is_shown(model.scene(), items_of(model.scene())[1]));
    CHECK(shown() == std::vector<bool>{true, false});
    add_item(NewItem::isosurface);
    second.follow(model);
    CHECK(shown() == std::vector<bool>{true, false, true});
    Scene changed = model.scene();
    changed["surfaces"][1]["plane"] = {1, 0, 0, 0.25};
    model.edit("move", std::move(changed));
    second.follow(model);
    CHECK(shown() == std::vector<bool>{true, false, true});
    Scene fewer = model.scene();
    remove(fewer, items_of(fewer)[0]);
    model.edit("remove", std::move(fewer));
    second.follow(model);
    CHECK(shown() == std::vector<bool>{false, true});
    model.undo();
    second.follow(model);
    CHECK(shown() == std::vector<bool>{true, false, true});
}

TEST_CASE("A scene of another size has what is looked at in the same place, and cameras that are said stay") {
    Scene scene = scene_of_files({"a.exo", "b.exo"});
    CHECK(scene["volume"]["more_paths"] == Json{"b.exo"});
    CHECK_FALSE(is_placed(scene));
    CHECK(time_step_of(scene) == 0);
    scene["camera"] = {{"eye", {1, 2, 3}}, {"image_shift", {4, -6}}, {"near", 0.25}};
    CHECK(is_placed(scene));
    const Scene larger = resized(scene, {2048, 1536});
    CHECK(larger["camera"]["image_shift"] == Json{8.0, -12.0});
    CHECK(size_of(larger) == std::array<std::uint32_t, 2>{2048, 1536});
    say_camera(scene["camera"], camera(true));
    CHECK(scene["camera"]["near"] == 0.25);
    CHECK(camera_of(scene["camera"]).eye == camera(true).eye);
    CHECK(camera_of(scene["camera"]).orthographic);
}

TEST_CASE("Scales of values have both ends, and are their own inverse") {
    for (const bool is_logarithmic : {false, true}) {
        const ValueScale scale({0.5, 8}, is_logarithmic);
        CHECK(scale.position(0.5) == 0);
        CHECK(scale.position(8) == 1);
        CHECK(scale.position(scale.value(0.3)) == Approx(0.3));
        CHECK(scale.position(-1) < 0);
    }
    CHECK(ValueScale({0.5, 8}, true).value(0.5) == Approx(2));
}

TEST_CASE("A histogram counts values, and knows their percentiles") {
    Histogram histogram(0, 1);
    std::vector<double> values;
    for (int i = 0; i <= 1000; ++i) {
        values.push_back(i / 1000.0);
    }
    histogram.add(std::span(values).first(500));
    histogram.add(std::span(values).subspan(500));
    CHECK(histogram.n_values() == 1001);
    CHECK(histogram.quantile(0.02) == Approx(0.02));
    CHECK(histogram.quantile(0.98) == Approx(0.98));
    for (const float bin : histogram.bins()) {
        CHECK(bin > 0.8f);
    }
}

TEST_CASE("Settings are kept, and no file of them can do harm") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "settings/view.json";
    Settings settings;
    settings.window_size = {900, 700};
    settings.is_dark = false;
    settings.text_scale = 1.5;
    for (int i = 0; i < 20; ++i) {
        settings.add_recent("/data/" + std::to_string(i) + ".h5");
    }
    settings.add_recent("/data/15.h5");
    REQUIRE(write_settings(settings, file));
    const Settings read = read_settings(file);
    CHECK(read.window_size == settings.window_size);
    CHECK(read.is_dark == false);
    CHECK(read.text_scale == 1.5f);
    CHECK(read.recent_files == settings.recent_files);
    CHECK(read.recent_files.size() == Settings::most_recent_files);
    CHECK(read.recent_files[0] == "/data/15.h5");
    CHECK(read.folder == "/data");
    for (const char* text : {"", "{", "[1]", R"({"window_width": "wide", "recent_files": 3, "text_scale": 1e300})"}) {
        std::ofstream(file) << text;
        CHECK(read_settings(file).window_size[0] == Settings{}.window_size[0]);
    }
    CHECK(read_settings("/no/such/file").recent_files.empty());
}
