#include "images.hpp"
#include "session.hpp"

#include <apps/elvis/view/model/camera_motion.hpp>

#include <core/base/error.hpp>
#include <core/scene/picture_room.hpp>
#include <core/scene/write/write_scene.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace elvis::serve {

namespace {

using nlohmann::json;

/** Of pictures on the page, and of those that are saved: their memory is the server's. */
constexpr std::uint32_t most_pixels_across = 8192;
constexpr std::uint64_t most_saved_pixels = 64u << 20u;
constexpr std::size_t most_tasks = 16;

double number(const json& message, const char* key, double least, double most) {
    const json& value = message.at(key);
    if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < least ||
        value.get<double>() > most) {
        throw Error("'" + std::string(key) + "' is no number from " + json(least).dump() + " to " + json(most).dump());
    }
    return value.get<double>();
}

double pixels(const json& message, const char* key) { return number(message, key, -1e5, 1e5); }

std::array<std::uint32_t, 2> size_of(const json& message) {
    return {static_cast<std::uint32_t>(number(message, "width", 1, most_pixels_across)),
            static_cast<std::uint32_t>(number(message, "height", 1, most_pixels_across))};
}

PictureSize picture_size(const Scene& scene) {
    return {static_cast<double>(scene.size[0]), static_cast<double>(scene.size[1])};
}

Vector3 vector_of(const json& message, const char* key) {
    const auto numbers = message.at(key).get<std::vector<double>>();
    if (numbers.size() != 3 || !std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); })) {
        throw Error("'" + std::string(key) + "' are not three numbers");
    }
    return {numbers[0], numbers[1], numbers[2]};
}

constexpr std::array<const char*, 4> kinds = {"surface", "volume", "light", "hidden light"};

json item_json(const Scene& scene, const view::ItemId& item) {
    return {{"kind", kinds[static_cast<std::size_t>(item.kind)]},
            {"index", item.index},
            {"label", view::item_label(scene, item)},
            {"name", view::item_kind_name(scene, item)},
            {"shown", view::is_shown(scene, item)}};
}

json name_or_null(const std::optional<std::string>& name) { return name ? json(*name) : json(); }

} // namespace

Session::Handler Session::handler_of(const std::string& type) {
    static const std::map<std::string, Handler> handlers = {{"resize", &Session::resize},
                                                            {"orbit", &Session::orbit},
                                                            {"pan", &Session::pan},
                                                            {"zoom", &Session::zoom},
                                                            {"roll", &Session::roll},
                                                            {"view", &Session::look_from},
                                                            {"projection", &Session::project},
                                                            {"camera", &Session::place_camera},
                                                            {"release", &Session::release},
                                                            {"set", &Session::set},
                                                            {"merge", &Session::merge},
                                                            {"load", &Session::load},
                                                            {"undo", &Session::undo},
                                                            {"redo", &Session::redo},
                                                            {"add", &Session::add},
                                                            {"remove", &Session::remove},
                                                            {"show", &Session::show},
                                                            {"copy", &Session::copy},
                                                            {"pick", &Session::pick},
                                                            {"range", &Session::range},
                                                            {"undecided", &Session::undecided},
                                                            {"save scene", &Session::save_scene},
                                                            {"save picture", &Session::save_picture},
                                                            {"shown", &Session::shown}};
    const auto found = handlers.find(type);
    if (found == handlers.end()) {
        throw Error("there is no message of type '" + type.substr(0, 40) + "'");
    }
    return found->second;
}

void Session::receive(std::string_view text) {
    const std::lock_guard lock(m_mutex);
    Json id;
    try {
        const Json message = parsed(text);
        if (!message.is_object()) {
            throw Error("a message is an object in braces");
        }
        id = message.value("id", Json());
        if (message.contains("time")) {
            m_echo = message["time"].is_number() ? message["time"] : Json();
        }
        Json answer = (this->*handler_of(message.at("type").get<std::string>()))(message);
        if (!answer.is_null() && !id.is_null()) {
            answer["type"] = "answer";
            answer["id"] = id;
            send(answer);
        }
    } catch (const std::exception& error) {
        send({{"type", "error"}, {"id", id}, {"text", error.what()}});
    }
}

Session::Json Session::resize(const Json& message) {
    if (m_model.scene().size != size_of(message)) {
        m_model.set_size(size_of(message));
        changed(false);
        send(state());
    }
    return Json::object();
}

void Session::move_camera(const Camera& camera) {
    const double diagonal = m_served->facts.diagonal();
    const double distance = length(minus(camera.look_at, camera.eye));
    const bool is_near = distance > 1e-9 * diagonal && distance < 1e6 * diagonal;
    const bool has_height = !camera.orthographic || (camera.height > 1e-9 * diagonal && camera.height < 1e6 * diagonal);
    if (!is_near || !has_height || !std::isfinite(dot(camera.up, camera.up)) || !std::isfinite(dot(camera.eye, camera.eye))) {
        throw Error("the camera would be too near, or too far away");
    }
    m_model.set_camera(camera);
    changed(true);
}

Session::Json Session::orbit(const Json& message) {
    move_camera(view::orbited(m_model.camera(), picture_size(m_model.scene()), {pixels(message, "dx"), pixels(message, "dy")}));
    return Json::object();
}

Session::Json Session::pan(const Json& message) {
    move_camera(view::panned(m_model.camera(), picture_size(m_model.scene()), {pixels(message, "dx"), pixels(message, "dy")}));
    return Json::object();
}

Session::Json Session::zoom(const Json& message) {
    move_camera(view::zoomed(m_model.camera(), picture_size(m_model.scene()), {pixels(message, "x"), pixels(message, "y")},
                             number(message, "factor", 0.01, 100)));
    return Json::object();
}

Session::Json Session::roll(const Json& message) {
    move_camera(view::rolled(m_model.camera(), number(message, "degrees", -360, 360)));
    return Json::object();
}

Session::Json Session::look_from(const Json& message) {
    const auto name = message.at("name").get<std::string>();
    const PictureRoom room = room_for_volume(m_model.scene());
    const VolumeExtent extent = m_served->facts.extent();
    if (name == "all") {
        m_model.set_camera(fitted(m_model.camera(), extent, room));
    } else {
        const auto& views = view::standard_views();
        const auto found = std::ranges::find(views, name, &view::StandardView::name);
        if (found == views.end()) {
            throw Error("there is no view '" + name.substr(0, 40) + "'");
        }
        m_model.set_camera(view::from_standard_view(m_model.camera(), *found, extent, room));
    }
    changed(false);
    return Json::object();
}

Session::Json Session::project(const Json& message) {
    m_model.set_camera(view::with_projection(m_model.camera(), message.at("orthographic").get<bool>()));
    changed(false);
    send(state());
    return Json::object();
}

Session::Json Session::place_camera(const Json& message) {
    Camera camera = m_model.camera();
    camera.eye = vector_of(message, "eye");
    camera.look_at = vector_of(message, "look_at");
    camera.up = vector_of(message, "up");
    const Vector3 across = cross(minus(camera.look_at, camera.eye), camera.up);
    if (!(length(across) > 0)) {
        throw Error("'up' is parallel to the view");
    }
    move_camera(camera);
    return Json::object();
}

Session::Json Session::release(const Json&) {
    m_model.end_gesture();
    m_schedule.release();
    m_changed.notify_all();
    return Json::object();
}

Session::Json Session::page_json() const { return Json::parse(scene_json(m_model.scene(), m_served->page_scene).dump()); }

void Session::edit(const std::string& what, const Json& scene) {
    m_served->paths.check(scene);
    const std::string folder = std::filesystem::path(m_served->page_scene).parent_path().string();
    m_served->library.parse_scene(scene.dump(), folder);
    Scene wanted = scene_of(scene, m_served->page_scene);
    if (wanted.size[0] > most_pixels_across || wanted.size[1] > most_pixels_across) {
        throw Error("'image.size' is larger than the page can be");
    }
    if (wanted.time_step >= m_served->facts.times.size() && wanted.time_step > 0) {
        throw Error("the volume has " + std::to_string(m_served->facts.times.size()) + " time steps");
    }
    set_camera(wanted.camera, resolve_camera(wanted, m_served->facts.extent(), {}));
    m_model.edit(what, std::move(wanted));
    changed(false);
    send(state());
}

Session::Json Session::set(const Json& message) {
    Json scene = page_json();
    const auto pointer = message.at("pointer").get<std::string>();
    set_at(scene, pointer, message.value("value", Json()));
    edit(message.value("name", pointer), scene);
    return Json::object();
}

Session::Json Session::merge(const Json& message) {
    Json scene = page_json();
    scene.merge_patch(message.at("patch"));
    edit(message.value("name", "scene"), scene);
    return Json::object();
}

Session::Json Session::load(const Json& message) {
    Json scene = message.at("scene");
    if (scene.is_object() && !scene.contains("volume")) {
        scene["volume"] = page_json()["volume"];
    }
    const auto size = m_model.scene().size;
    m_model.end_gesture();
    edit("load a scene", scene);
    m_model.end_gesture();
    m_model.set_size(size);
    changed(false);
    send(state());
    return Json::object();
}

Session::Json Session::undo(const Json&) {
    m_model.undo();
    changed(false);
    send(state());
    return Json::object();
}

Session::Json Session::redo(const Json&) {
    m_model.redo();
    changed(false);
    send(state());
    return Json::object();
}

view::ItemId Session::item_of(const Json& message) const {
    const auto kind = std::ranges::find(kinds, message.at("kind").get<std::string>());
    const view::ItemId item{static_cast<view::ItemKind>(kind - kinds.begin()), message.at("index").get<std::size_t>()};
    if (kind == kinds.end() || !view::exists(m_model.scene(), item)) {
        throw Error("there is no such item");
    }
    return item;
}

void Session::change_items(const std::string& what, Scene&& scene) {
    m_model.end_gesture();
    m_model.edit(what, std::move(scene));
    m_model.end_gesture();
    changed(false);
    send(state());
}

Session::Json Session::add(const Json& message) {
    const auto name = message.at("name").get<std::string>();
    const auto& all = view::new_items();
    const auto found = std::ranges::find_if(all, [&](const view::NewItemInfo& info) { return info.name == name; });
    if (found == all.end() || !view::can_add(m_model.scene(), m_served->facts, found->item)) {
        throw Error("'" + name.substr(0, 40) + "' cannot be added");
    }
    const view::NewItem item = found->item;
    double middle = 0;
    if (item == view::NewItem::isosurface) {
        if (!message.contains("middle")) {
            throw Error("an isosurface needs 'middle', a value of the field");
        }
        middle = number(message, "middle", -1e300, 1e300);
    }
    Scene scene = m_model.scene();
    const view::ItemId added = view::add(scene, m_served->facts, item, middle);
    const std::string what = "add " + view::item_kind_name(scene, added);
    change_items(what, std::move(scene));
    return item_json(m_model.scene(), added);
}

Session::Json Session::remove(const Json& message) {
    const view::ItemId item = item_of(message);
    Scene scene = m_model.scene();
    const std::string what = "remove " + view::item_kind_name(scene, item);
    view::remove(scene, item);
    change_items(what, std::move(scene));
    return Json::object();
}

Session::Json Session::show(const Json& message) {
    const view::ItemId item = item_of(message);
    const bool is_shown = message.at("shown").get<bool>();
    Scene scene = m_model.scene();
    const std::string what = (is_shown ? "show " : "hide ") + view::item_kind_name(scene, item);
    view::set_shown(scene, item, is_shown);
    change_items(what, std::move(scene));
    return Json::object();
}

Session::Json Session::copy(const Json& message) {
    const view::ItemId item = item_of(message);
    Scene scene = m_model.scene();
    const std::string what = "copy " + view::item_kind_name(scene, item);
    const view::ItemId copied = view::duplicate(scene, item);
    change_items(what, std::move(scene));
    return item_json(m_model.scene(), copied);
}

void Session::post(const Json& message, std::string activity, Job job) {
    if (m_tasks.size() >= most_tasks) {
        throw Error("too much is being asked at once");
    }
    m_tasks.push_back({{{"id", message.value("id", Json())}}, std::move(activity), m_model.scene(), std::move(job)});
    // Somebody waits for the answer; the exact picture is drawn again.
    m_cancelled = m_cancelled || (m_drawing && m_drawing->stage == FrameStage::exact);
    m_changed.notify_all();
}

Session::Json Session::pick(const Json& message) {
    const double column = pixels(message, "column"), row = pixels(message, "row");
    post(message, "picking", [served = m_served, column, row](const Scene& scene, const task& watch) -> Encoded {
        return {{{"picked", pick_at(*served, scene, column, row, watch)}}, {}};
    });
    return {};
}

Session::Json Session::range(const Json& message) {
    const Scene& scene = m_model.scene();
    const std::string field = message.value("field", scene.field.value_or(m_served->facts.fields.at(0).name));
    post(message, "finding a range", [served = m_served, field](const Scene& shown, const task&) -> Encoded {
        const elvis_range found = served->volume.range(field, shown.time_step);
        return {{{"minimum", found.minimum}, {"maximum", found.maximum}}, {}};
    });
    return {};
}

Session::Json Session::undecided(const Json& message) {
    post(message, "looking for undecided pixels",
         [served = m_served](const Scene& scene, const task& watch) { return draw_undecided(*served, scene, watch); });
    return {};
}

Session::Json Session::save_scene(const Json&) {
    return {{"scene", Json::parse(scene_json(m_model.scene(), m_served->page_scene).dump())},
            {"text", scene_json(m_model.scene(), m_served->page_scene).dump(2)}};
}

Session::Json Session::save_picture(const Json& message) {
    const std::array<std::uint32_t, 2> size = size_of(message);
    if (std::uint64_t{size[0]} * size[1] > most_saved_pixels) {
        throw Error("the picture would have more than 64 million pixels");
    }
    post(message, "drawing a picture to save", [served = m_served, size](const Scene& scene, const task& watch) {
        Scene resized = scene;
        // The shift is in pixels: a larger picture has what is looked at in the same place.
        for (double& shift : resized.camera.image_shift) {
            shift *= static_cast<double>(size[1]) / scene.size[1];
        }
        resized.size = size;
        return draw_exactly(*served, resized, watch);
    });
    return {};
}

Session::Json Session::state() const {
    const Scene& scene = m_model.scene();
    Json items = Json::array();
    for (const view::ItemId& item : view::items_of(scene)) {
        items.push_back(item_json(scene, item));
    }
    Json addable = Json::array();
    for (const view::NewItemInfo& info : view::new_items()) {
        if (view::can_add(scene, m_served->facts, info.item)) {
            addable.push_back({{"name", info.name}, {"help", info.help}});
        }
    }
    return {{"type", "state"},
            {"revision", m_model.revision()},
            {"scene", page_json()},
            {"items", std::move(items)},
            {"addable", std::move(addable)},
            {"undo", name_or_null(m_model.undo_name())},
            {"redo", name_or_null(m_model.redo_name())}};
}

Session::Json Session::volume() const {
    const view::VolumeFacts& facts = m_served->facts;
    Json fields = Json::array();
    for (const FieldInfo& field : facts.fields) {
        fields.push_back({{"name", field.name}, {"unit", field.unit}, {"components", field.n_components}});
    }
    Json views = Json::array();
    for (const view::StandardView& view : view::standard_views()) {
        views.push_back(view.name);
    }
    return {{"path", std::filesystem::path(facts.path).filename().string()},
            {"dimension", facts.dimension},
            {"elements", facts.n_elements},
            {"bounds", facts.bounds},
            {"fields", std::move(fields)},
            {"times", facts.times},
            {"views", std::move(views)}};
}

} // namespace elvis::serve
