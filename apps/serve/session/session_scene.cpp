#include "memory_limit.hpp"
#include "message_values.hpp"
#include "session.hpp"

#include <apps/elvis/view/scene/camera_motion.hpp>

#include <core/base/error.hpp>

#include <algorithm>

namespace elvis::serve {

namespace {

using nlohmann::json;

/** Of all steps of undo of a session, as text. */
constexpr std::size_t most_history_bytes = std::size_t{4} << 20u;

constexpr std::array<const char*, 3> kinds = {"surface", "volume", "light"};

json item_json(const Scene& scene, const view::ItemId& item) {
    return {{"kind", kinds[static_cast<std::size_t>(item.kind)]},
            {"index", item.index},
            {"pointer", view::pointer_of(item)},
            {"label", view::item_label(scene, item)},
            {"name", view::item_kind_name(scene, item)},
            {"shown", view::is_shown(scene, item)}};
}

json name_or_null(const std::optional<std::string>& name) { return name ? json(*name) : json(); }

} // namespace

Scene Session::judged(const Json& scene) const {
    m_served->paths.check(scene);
    elvis::scene wanted = m_served->library_scene(scene);
    wanted.complete_camera(m_served->facts.extent());
    Scene full = Json::parse(wanted.text(m_served->folder));
    const auto size = view::size_of(full);
    if (size[0] > most_pixels_across || size[1] > most_pixels_across) {
        throw Error("'image.size' is larger than the page can be");
    }
    check_size(full, size);
    const std::uint32_t time_step = view::time_step_of(full);
    if (time_step >= m_served->facts.times.size() && time_step > 0) {
        throw Error("the volume has " + std::to_string(m_served->facts.times.size()) + " time steps");
    }
    check_suits(wanted);
    return full;
}

void Session::check_suits(const elvis::scene& wanted) const {
    try {
        m_served->volume.check_scene(wanted);
    } catch (const elvis::error&) {
        bool did_before = true;
        try {
            m_served->volume.check_scene(m_served->library_scene(m_model.scene()));
        } catch (const elvis::error&) {
            did_before = false;
        }
        if (did_before) {
            throw;
        }
    }
}

void Session::edit(const std::string& what, const Json& scene) {
    Scene wanted = judged(scene);
    need_memory_of_items(wanted);
    m_is_first_view = m_is_first_view && scene.value("camera", Json()) == m_model.scene()["camera"];
    m_taken.reset();
    m_model.edit(what, std::move(wanted));
    // The longer its scenes, the fewer steps.
    m_model.keep_steps(std::max<std::size_t>(1, most_history_bytes / scene.dump().size()));
    edited(false);
}

void Session::check_size(const Scene& scene, const std::array<std::uint32_t, 2>& size) const {
    check_samples(scene, size);
    const auto n_pixels = [](const std::array<std::uint32_t, 2>& of) { return std::uint64_t{of[0]} * of[1]; };
    if (n_pixels(size) > n_pixels(view::size_of(m_model.scene()))) {
        need_memory(*m_served, picture_bytes(n_pixels(size)));
    }
}

void Session::need_memory_of_items(const Scene& scene) const {
    const std::size_t before = view::items_of(m_model.scene()).size(), after = view::items_of(scene).size();
    if (after > before) {
        need_memory(*m_served, item_bytes * (after - before));
    }
}

void Session::spare_memory() {
    constexpr std::size_t few = 10;
    const std::lock_guard lock(m_mutex);
    m_model.keep_steps(few);
    send({{"type", "error"},
          {"text", "the server is short of memory: what needs more is refused, and older steps of undo are gone"}});
    tell_state();
}

void Session::edited(bool is_moving) {
    changed(is_moving);
    tell_state();
}

Session::Json Session::set(const Json& message) {
    Json scene = m_model.scene();
    const auto pointer = message.at("pointer").get<std::string>();
    set_at(scene, pointer, message.value("value", Json()));
    edit(message.value("name", pointer), scene);
    return Json::object();
}

Session::Json Session::check(const Json& message) {
    Json scene = m_model.scene();
    set_at(scene, message.at("pointer").get<std::string>(), message.value("value", Json()));
    judged(scene);
    return Json::object();
}

Session::Json Session::merge(const Json& message) {
    Json scene = m_model.scene();
    scene.merge_patch(message.at("patch"));
    edit(message.value("name", "scene"), scene);
    return Json::object();
}

Session::Json Session::load(const Json& message) {
    Json scene = message.at("scene");
    if (scene.is_object() && !scene.contains("volume")) {
        scene["volume"] = m_model.scene()["volume"];
    }
    // Its size is the page's.
    if (scene.is_object() && scene.value("image", Json::object()).is_object()) {
        scene["image"]["size"] = m_model.scene()["image"]["size"];
    }
    m_model.end_gesture();
    edit("load a scene", scene);
    m_model.end_gesture();
    return Json::object();
}

Session::Json Session::undo(const Json&) {
    m_taken.reset();
    m_model.undo();
    edited(false);
    return Json::object();
}

Session::Json Session::redo(const Json&) {
    m_taken.reset();
    m_model.redo();
    edited(false);
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
    need_memory_of_items(scene);
    m_taken.reset();
    m_model.end_gesture();
    m_model.edit(what, std::move(scene));
    m_model.end_gesture();
    edited(false);
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
            {"scene", scene},
            {"items", std::move(items)},
            {"addable", std::move(addable)},
            {"undo", name_or_null(m_model.undo_name())},
            {"redo", name_or_null(m_model.redo_name())}};
}

Session::Json Session::hello() const { return {{"type", "hello"}, {"session", m_id}, {"volume", volume()}}; }

Session::Json Session::volume() const {
    const view::VolumeFacts& facts = m_served->facts;
    Json fields = Json::array();
    for (const view::FieldFacts& field : facts.fields) {
        fields.push_back({{"name", field.name}, {"unit", field.unit}, {"components", field.n_components}});
    }
    const Json usual = Json::parse(m_served->library.make_scene().transfer({0, 1}, facts.diagonal()));
    Json views = Json::array();
    for (const view::StandardView& view : view::standard_views()) {
        views.push_back(view.name);
    }
    return {{"path", std::filesystem::path(facts.path).filename().string()},
            {"dimension", facts.dimension},
            {"elements", facts.n_elements},
            {"bounds", facts.bounds},
            {"fields", std::move(fields)},
            {"flows", view::flows_of(facts)},
            {"displacements", view::displacements_of(facts)},
            {"groups", facts.boundary_groups},
            {"times", facts.times},
            {"views", std::move(views)},
            {"usual_density", usual["density"].back()[1]}};
}

} // namespace elvis::serve
