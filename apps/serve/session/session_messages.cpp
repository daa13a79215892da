#include "message_values.hpp"
#include "session.hpp"

#include <apps/elvis/view/scene/camera_motion.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace elvis::serve {

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
                                                            {"check", &Session::check},
                                                            {"merge", &Session::merge},
                                                            {"load", &Session::load},
                                                            {"undo", &Session::undo},
                                                            {"redo", &Session::redo},
                                                            {"add", &Session::add},
                                                            {"remove", &Session::remove},
                                                            {"show", &Session::show},
                                                            {"copy", &Session::copy},
                                                            {"overlay", &Session::overlay},
                                                            {"drag", &Session::drag},
                                                            {"pick", &Session::pick},
                                                            {"line", &Session::line},
                                                            {"histogram", &Session::histogram},
                                                            {"palette", &Session::palette},
                                                            {"range", &Session::range},
                                                            {"transfer", &Session::transfer},
                                                            {"undecided", &Session::undecided},
                                                            {"save scene", &Session::save_scene},
                                                            {"save picture", &Session::save_picture},
                                                            {"integrate", &Session::integrate},
                                                            {"extrema", &Session::extrema},
                                                            {"film", &Session::film},
                                                            {"film picture", &Session::film_picture},
                                                            {"stop", &Session::stop_long},
                                                            {"shown", &Session::shown}};
    const auto found = handlers.find(type);
    if (found == handlers.end()) {
        throw Error("there is no message of type '" + type.substr(0, 40) + "'");
    }
    return found->second;
}

void Session::receive(Member from, std::string_view text) {
    const std::lock_guard lock(m_mutex);
    if (!is_member(from)) {
        return;
    }
    m_asker = from;
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
            send_to(from, answer);
        }
    } catch (const std::exception& error) {
        send_to(from, {{"type", "error"}, {"id", id}, {"text", error.what()}});
    }
}

Session::Json Session::resize(const Json& message) {
    check_size(m_model.scene(), size_of(message));
    if (view::size_of(m_model.scene()) == size_of(message)) {
        return Json::object();
    }
    m_model.set_size(size_of(message));
    if (m_is_first_view && !m_served->is_placed) {
        m_model.set_camera(fitted(m_model.camera()));
    }
    changed(false);
    tell_state();
    return Json::object();
}

Camera Session::fitted(const Camera& camera) const {
    Scene scene = m_model.scene();
    view::say_camera(scene["camera"], camera);
    elvis::scene placed = m_served->library_scene(scene);
    placed.fit_camera(m_served->facts.extent());
    return view::camera_of(Json::parse(placed.json("/camera")));
}

void Session::set_camera(const Camera& camera, bool is_moving) {
    m_model.set_camera(camera);
    m_is_first_view = false;
    changed(is_moving);
    tell_camera();
}

void Session::move_camera(const Camera& camera) {
    const double diagonal = m_served->facts.diagonal();
    const double distance = length(minus(camera.look_at, camera.eye));
    const bool is_near = distance > 1e-9 * diagonal && distance < 1e6 * diagonal;
    const bool has_height = !camera.orthographic || (camera.height > 1e-9 * diagonal && camera.height < 1e6 * diagonal);
    if (!is_near || !has_height || !std::isfinite(dot(camera.up, camera.up)) || !std::isfinite(dot(camera.eye, camera.eye))) {
        throw Error("the camera would be too near, or too far away");
    }
    set_camera(camera, true);
}

Session::Json Session::orbit(const Json& message) {
    move_camera(
        view::orbited(m_model.camera(), view::picture_size(m_model.scene()), {pixels(message, "dx"), pixels(message, "dy")}));
    return Json::object();
}

Session::Json Session::pan(const Json& message) {
    move_camera(
        view::panned(m_model.camera(), view::picture_size(m_model.scene()), {pixels(message, "dx"), pixels(message, "dy")}));
    return Json::object();
}

Session::Json Session::zoom(const Json& message) {
    move_camera(view::zoomed(m_model.camera(), view::picture_size(m_model.scene()),
                             {pixels(message, "x"), pixels(message, "y")}, number(message, "factor", 0.01, 100)));
    return Json::object();
}

Session::Json Session::roll(const Json& message) {
    move_camera(view::rolled(m_model.camera(), number(message, "degrees", -360, 360)));
    return Json::object();
}

Session::Json Session::look_from(const Json& message) {
    const auto name = message.at("name").get<std::string>();
    if (name == "all") {
        set_camera(fitted(m_model.camera()), false);
        return Json::object();
    }
    const auto& views = view::standard_views();
    const auto found = std::ranges::find(views, name, &view::StandardView::name);
    if (found == views.end()) {
        throw Error("there is no view '" + name.substr(0, 40) + "'");
    }
    set_camera(fitted(view::from_standard_view(m_model.camera(), *found)), false);
    return Json::object();
}

Session::Json Session::project(const Json& message) {
    set_camera(view::with_projection(m_model.camera(), message.at("orthographic").get<bool>()), false);
    tell_state();
    return Json::object();
}

Session::Json Session::place_camera(const Json& message) {
    Json scene = m_model.scene();
    scene["camera"].merge_patch(message.at("camera"));
    move_camera(view::camera_of(judged(scene)["camera"]));
    return Json::object();
}

Session::Json Session::release(const Json&) {
    m_model.end_gesture();
    m_taken.reset();
    m_schedule.release();
    m_changed.notify_all();
    return Json::object();
}

} // namespace elvis::serve
