#include "message_values.hpp"
#include "session.hpp"

#include <apps/serve/answers/integrals.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <chrono>

namespace elvis::serve {

namespace {

constexpr std::uint64_t most_saved_pixels = 64u << 20u;
constexpr std::size_t most_groups = 1000;
constexpr std::chrono::milliseconds between_progress{100};

elvis_domain domain_of(const std::string& name) {
    constexpr std::array<std::pair<const char*, elvis_domain>, 4> domains = {{{"volume", ELVIS_DOMAIN_VOLUME},
                                                                              {"boundary", ELVIS_DOMAIN_BOUNDARY},
                                                                              {"plane", ELVIS_DOMAIN_PLANE},
                                                                              {"isosurface", ELVIS_DOMAIN_ISOSURFACE}}};
    for (const auto& [known, domain] : domains) {
        if (name == known) {
            return domain;
        }
    }
    throw Error("integrals are over volume, boundary, plane or isosurface, not over '" + name.substr(0, 40) + "'");
}

IntegralWishes integral_wishes(const nlohmann::json& message) {
    IntegralWishes wishes;
    wishes.domain = domain_of(message.at("domain").get<std::string>());
    wishes.field = message.value("field", "");
    wishes.groups = message.value("groups", std::vector<std::string>());
    wishes.is_flux = message.value("flux", false);
    if (wishes.groups.size() > most_groups) {
        throw Error("these are too many groups");
    }
    if (wishes.is_flux && (wishes.field.empty() || wishes.domain == ELVIS_DOMAIN_VOLUME)) {
        throw Error("a flux is that of a vector field, through a surface");
    }
    if (wishes.domain == ELVIS_DOMAIN_PLANE) {
        const auto plane = message.at("plane").get<std::vector<double>>();
        if (plane.size() != wishes.plane.size()) {
            throw Error("a plane has four numbers");
        }
        std::ranges::copy(plane, wishes.plane.begin());
    }
    if (wishes.domain == ELVIS_DOMAIN_ISOSURFACE) {
        wishes.isovalue = number(message, "isovalue", -1e300, 1e300);
        wishes.level_field = message.value("level_field", "");
        if (wishes.level_field.empty()) {
            wishes.level_field = wishes.is_flux ? "" : wishes.field;
        }
        if (wishes.level_field.empty()) {
            throw Error("an isosurface of which field? 'level_field' says it");
        }
    }
    if (message.contains("tolerance")) {
        // As the option of elvis integrate.
        wishes.tolerance = number(message, "tolerance", 1e-14, 0.5);
    }
    return wishes;
}

} // namespace

void Session::post_long(const Json& message, std::string activity, Job job) {
    if (m_long) {
        throw Error("busy " + m_long->task.activity + ": stop it, or wait");
    }
    const Json answer = {{"id", message.value("id", Json())}};
    m_long = LongTask{{m_asker, answer, std::move(activity), m_model.scene(), std::move(job)}};
    m_changed.notify_all();
}

bool Session::may_do_long_task(Clock::time_point now) const {
    return m_long && now >= m_long->not_before && now - m_last_change >= FrameSchedule::rest;
}

void Session::cancel_long_task() { m_cancelled = m_cancelled || (m_long && m_long->is_running); }

std::function<void(double, const char*)> Session::progress_of(const Task& task) {
    return [this, from = task.from, id = task.answer["id"], last = Clock::time_point()](double fraction, const char*) mutable {
        const Clock::time_point now = Clock::now();
        if (now - last < between_progress) {
            return;
        }
        // Without waiting: who holds the lock may wait for the volume.
        const std::unique_lock lock(m_mutex, std::try_to_lock);
        if (lock.owns_lock()) {
            last = now;
            send_to(from, {{"type", "progress"}, {"of", id}, {"fraction", fraction}});
        }
    };
}

void Session::do_long_task(std::unique_lock<std::mutex>& lock) {
    m_long->is_running = true;
    const Task task = m_long->task;
    const bool may_yield = m_long->n_yields < most_yields;
    send({{"type", "activity"}, {"text", task.activity}});
    lock.unlock();
    std::atomic<bool> has_yielded = false;
    const auto yields = [&] {
        if (may_yield && m_served->n_urgent > 0) {
            has_yielded = true;
        }
        return has_yielded.load();
    };
    Json message = task.answer;
    Encoded result{Json::object(), {}};
    bool is_cancelled = false;
    try {
        result = watched([&](const elvis::task& watch) { return task.job(task.scene, watch); }, {progress_of(task), yields});
        message["type"] = "answer";
        message.update(result.facts);
    } catch (const cancelled&) {
        is_cancelled = true;
    } catch (const std::exception& error) {
        message["type"] = "error";
        message["text"] = error.what();
    }
    lock.lock();
    send({{"type", "activity"}, {"text", ""}});
    m_long->is_running = false;
    if (is_cancelled && !m_long->is_stopped) {
        m_long->n_yields += has_yielded ? 1 : 0;
        m_long->not_before = Clock::now() + FrameSchedule::rest;
        return;
    }
    if (is_cancelled) {
        message["type"] = "error";
        message["text"] = "stopped";
    }
    m_long.reset();
    send_to(task.from, message, result.bytes);
}

void Session::need_no_film() const {
    // One that could not be begun is none.
    if (m_film && (m_long || m_film->film->has_begun())) {
        throw Error("busy making a film: stop it, or wait");
    }
}

void Session::stop_long_of(Member asker) {
    if (m_film && m_film->from == asker) {
        m_film.reset();
    }
    if (!m_long || m_long->task.from != asker) {
        return;
    }
    m_long->is_stopped = true;
    if (m_long->is_running) {
        m_cancelled = true;
        return;
    }
    Json message = m_long->task.answer;
    m_long.reset();
    message.update({{"type", "error"}, {"text", "stopped"}});
    send_to(asker, message);
}

Session::Json Session::stop_long(const Json&) {
    stop_long_of(m_asker);
    return Json::object();
}

Session::Json Session::integrate(const Json& message) {
    need_no_film();
    post_long(message, "integrating",
              [served = m_served, wishes = integral_wishes(message)](const Scene& scene, const task& watch) -> Encoded {
                  return {integral_of(*served, scene, wishes, watch), {}};
              });
    return {};
}

Session::Json Session::extrema(const Json& message) {
    need_no_film();
    post_long(message, "finding extrema",
              [served = m_served, field = field_of(message)](const Scene& scene, const task& watch) -> Encoded {
                  return {extrema_of(*served, scene, field, watch), {}};
              });
    return {};
}

std::array<std::uint32_t, 2> Session::saved_size(const Json& message) const {
    const std::array<std::uint32_t, 2> size = size_of(message);
    if (std::uint64_t{size[0]} * size[1] > most_saved_pixels) {
        throw Error("the picture would have more than 64 million pixels");
    }
    check_size(m_model.scene(), size);
    return size;
}

Session::Json Session::save_picture(const Json& message) {
    need_no_film();
    const std::array<std::uint32_t, 2> size = saved_size(message);
    const PictureFormat format = picture_format(message.value("format", "png"));
    post_long(message, "drawing a picture to save", [served = m_served, size, format](const Scene& scene, const task& watch) {
        return draw_exactly(*served, view::resized(scene, size), watch, format);
    });
    return {};
}

Session::Json Session::film(const Json& message) {
    need_no_film();
    const std::array<std::uint32_t, 2> size = saved_size(message);
    const auto film = std::make_shared<Film>();
    post_long(message, "beginning a film", [served = m_served, size, film](const Scene& scene, const task&) -> Encoded {
        return {film->begin(*served, view::resized(scene, size)), {}};
    });
    m_film = BegunFilm{m_asker, film};
    return {};
}

Session::Json Session::film_picture(const Json& message) {
    const auto index = static_cast<std::uint32_t>(number(message, "index", 0, most_film_pictures - 1));
    if (!m_film || m_film->from != m_asker) {
        throw Error("no film has been begun");
    }
    post_long(message, "drawing a film", [served = m_served, index, film = m_film->film](const Scene&, const task& watch) {
        return film->picture(*served, index, watch);
    });
    return {};
}

} // namespace elvis::serve
