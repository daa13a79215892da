#include "message_values.hpp"
#include "session.hpp"

#include <apps/elvis/view/scene/camera_motion.hpp>
#include <apps/elvis/view/scene/handles.hpp>

#include <core/base/error.hpp>

#include <cmath>

namespace elvis::serve {

namespace {

using nlohmann::json;

constexpr std::size_t most_marked_points = 16;

json place_json(const Camera& camera, const PictureSize& size, const Vector3& point) {
    const std::optional<PicturePoint> place = view::project(camera, size, point);
    return place ? json(*place) : json();
}

/** The direction in the picture in which a handle goes that moves along a line; null where it is seen from its end. */
json way_json(const view::Handle& handle, const Camera& camera, const PictureSize& size) {
    if (handle.kind != view::Handle::Kind::along) {
        return {};
    }
    constexpr double pixels_farther = 20;
    const double step = pixels_farther * view::pixel_length(camera, size, handle.position);
    const auto from = view::project(camera, size, handle.position);
    const auto to = view::project(camera, size, plus(handle.position, scaled(handle.direction, step)));
    if (!from || !to) {
        return {};
    }
    const std::array<double, 2> way = {(*to)[0] - (*from)[0], (*to)[1] - (*from)[1]};
    const double distance = std::hypot(way[0], way[1]);
    return distance > 1 ? json{way[0] / distance, way[1] / distance} : json();
}

} // namespace

Session::Json Session::overlay_json() const {
    const Camera camera = m_model.camera();
    const PictureSize size = view::picture_size(m_model.scene());
    Json handles = Json::array();
    if (const auto item = m_model.selection()) {
        for (const view::Handle& handle : view::handles_of(m_model.scene(), *item, m_served->facts)) {
            handles.push_back({{"name", handle.name},
                               {"help", handle.help},
                               {"at", place_json(camera, size, handle.position)},
                               {"tied_to", handle.tied_to ? place_json(camera, size, *handle.tied_to) : Json()},
                               {"way", way_json(handle, camera, size)}});
        }
    }
    Json points = Json::array();
    for (const Vector3& point : m_marked) {
        points.push_back(place_json(camera, size, point));
    }
    return {{"version", m_overlay_version}, {"handles", std::move(handles)}, {"points", std::move(points)}};
}

Session::Json Session::overlay(const Json& message) {
    if (message.contains("item")) {
        m_model.select(message["item"].is_null() ? std::nullopt : std::optional(item_of(message["item"])));
        m_taken.reset();
    }
    if (message.contains("points")) {
        std::vector<Vector3> points;
        for (const Json& point : message["points"]) {
            points.push_back(vector_of(point));
        }
        if (points.size() > most_marked_points) {
            throw Error("that are too many points to mark");
        }
        m_marked = std::move(points);
    }
    ++m_overlay_version;
    return overlay_json();
}

Session::Json Session::drag(const Json& message) {
    const std::optional<view::ItemId> item = m_model.selection();
    if (!item) {
        throw Error("no item is selected");
    }
    const Scene& before = m_taken ? *m_taken : m_model.scene();
    const std::vector<view::Handle> handles = view::handles_of(before, *item, m_served->facts);
    const auto index = static_cast<std::size_t>(number(message, "handle", 0, 100));
    if (index >= handles.size()) {
        throw Error("the item has no such handle");
    }
    const Vector3 position = view::dragged_to(handles[index], m_model.camera(), view::picture_size(m_model.scene()),
                                              place_of(message, "from"), place_of(message, "to"));
    if (!std::isfinite(dot(position, position))) {
        throw Error("the handle would be too far away");
    }
    Scene scene = m_model.as_seen(view::with_moved_handle(before, *item, m_served->facts, index, position));
    const std::string what = "move " + view::item_kind_name(scene, *item);
    if (!m_taken) {
        m_taken = m_model.scene();
    }
    m_model.edit(what, std::move(scene));
    edited(true);
    return Json::object();
}

} // namespace elvis::serve
