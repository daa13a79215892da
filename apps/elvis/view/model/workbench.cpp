#include "workbench.hpp"

#include <apps/elvis/render/output_endings.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

namespace elvis::view {

namespace {

constexpr std::size_t most_frame_times = 60;

double seconds_between(Workbench::Clock::time_point from, Workbench::Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

} // namespace

double MotionStatistics::frames_per_second() const {
    const double sum = std::accumulate(frame_seconds.begin(), frame_seconds.end(), 0.0);
    return sum > 0 ? static_cast<double>(frame_seconds.size()) / sum : 0;
}

Workbench::Workbench(std::unique_ptr<Session> session) : m_session(session.get()), m_worker(std::move(session)) {}

Workbench::~Workbench() { m_writing.cancel(); }

void Workbench::say(Message::Kind kind, std::string text) {
    constexpr std::size_t most_messages = 500;
    m_messages.push_back({kind, std::move(text)});
    if (m_messages.size() > most_messages) {
        m_messages.erase(m_messages.begin());
    }
}

void Workbench::open_files(const std::vector<std::string>& paths, bool asks) {
    const std::string& path = paths.front();
    if (!std::filesystem::exists(path)) {
        say(Message::Kind::error, Error(path, "there is no such file").what());
        return;
    }
    m_worker.post(
        "opening " + std::filesystem::path(path).filename().string(),
        [this, paths, path, asks](Session& session) -> FrameWorker::Answer {
            const std::string kind = paths.size() == 1 ? session.kind_of(path) : "foreign";
            if (asks && kind == "foreign") {
                return [this, path] { foreign_file = path; };
            }
            const bool is_scene = kind == "scene";
            const Scene scene = is_scene ? session.read(path) : scene_of_files(paths);
            VolumeFacts facts = session.open(scene);
            return [this, scene = is_scene ? scene : session.first_scene(paths), facts = std::move(facts),
                    file = is_scene ? path : std::string(),
                    path]() mutable { show(std::move(scene), std::move(facts), file, path); };
        },
        [this](const std::string& error) { say(Message::Kind::error, error); });
}

void Workbench::show(Scene scene, VolumeFacts facts, const std::string& file, const std::string& path) {
    // A camera that is placed to see all of the volume does so in the window's picture.
    if (file.empty() || !is_placed(scene)) {
        scene["image"]["size"] = size_of(m_model.scene());
    }
    ++m_volume_number;
    m_ranges.clear();
    m_histograms.clear();
    m_picked.reset();
    line.reset();
    m_line_answer.reset();
    m_line_key.clear();
    stop_numbers();
    m_numbers.clear();
    for (ShownView& view : m_views) {
        view.picture = {};
        view.stage = FrameStage::none;
    }
    m_second.turn_off();
    say(Message::Kind::info,
        "opened " + path + ": " + counted(facts.n_elements, "element") + ", " + counted(facts.fields.size(), "field"));
    try {
        Scene whole = m_session->with_whole_camera(scene, facts);
        m_model.open(std::move(whole), std::move(facts), file);
    } catch (const std::exception& error) {
        say(Message::Kind::error, error.what());
    }
    if (on_file) {
        on_file(path);
    }
}

void Workbench::save_scene(const std::string& path) {
    try {
        m_session->write(m_model.scene(), path);
        m_model.saved(path);
        say(Message::Kind::info, "saved the scene as " + path);
        if (on_file) {
            on_file(path);
        }
    } catch (const std::exception& error) {
        say(Message::Kind::error, error.what());
    }
}

void Workbench::save_picture(const std::string& path, const std::array<std::uint32_t, 2>& size, int bits) {
    try {
        commands::need_still_ending("the picture", path);
    } catch (const std::exception& error) {
        say(Message::Kind::error, error.what());
        return;
    }
    m_worker.post(
        "drawing " + std::filesystem::path(path).filename().string(),
        [this, scene = resized(m_model.scene(), size), path, bits](Session& session) -> FrameWorker::Answer {
            std::vector<std::string> remarks = session.save_picture(scene, path, bits);
            return [this, path, remarks = std::move(remarks), size = size_of(scene)] {
                say(Message::Kind::info,
                    "saved the picture as " + path + ", " + std::to_string(size[0]) + "x" + std::to_string(size[1]));
                for (const std::string& remark : remarks) {
                    say(Message::Kind::warning, remark);
                }
            };
        },
        [this](const std::string& error) { say(Message::Kind::error, error); });
}

void Workbench::write_data(const DataFile& file) {
    m_writing.begin();
    const auto end = [this](Message::Kind kind, const std::string& text) {
        m_writing.end();
        say(kind, text);
    };
    m_worker.post(
        "writing " + std::filesystem::path(file.path).filename().string(),
        [this, scene = m_model.scene(), file, end](Session& session) -> FrameWorker::Answer {
            try {
                return [this, file, end, report = session.write_data(scene, file, m_writing.watch())] {
                    end(Message::Kind::info, "wrote " + file.what.what.of + " to " + file.path);
                    for (const std::string& fact : report.facts) {
                        say(Message::Kind::info, fact);
                    }
                    for (const std::string& doubt : report.doubts) {
                        say(Message::Kind::warning, doubt);
                    }
                };
            } catch (const cancelled&) {
                return [file, end] { end(Message::Kind::info, "nothing was written to " + file.path); };
            }
        },
        [end](const std::string& error) { end(Message::Kind::error, error); });
}

void Workbench::pick(const PicturePoint& place, std::size_t view) {
    const Scene& scene = scene_of(view);
    m_worker.post(
        "picking",
        [this, scene, place, number = m_volume_number](Session& session) -> FrameWorker::Answer {
            Picked picked = session.pick(scene, place);
            return [this, picked = std::move(picked), number] {
                if (number == m_volume_number) {
                    m_picked = picked;
                }
            };
        },
        [this](const std::string& error) { say(Message::Kind::error, error); });
}

void Workbench::convert(const std::string& input, const std::string& output) {
    if (m_conversion.is_running()) {
        say(Message::Kind::error, "another conversion is still at work");
        return;
    }
    m_conversion.start({input}, output);
}

void Workbench::turn_on_second() {
    if (m_model.volume()) {
        m_second.turn_on(m_model);
        m_views[1] = {};
    }
}

void Workbench::turn_off_second() {
    m_second.turn_off();
    m_views[1] = {};
}

void Workbench::take(DrawAnswer answer, double showing_milliseconds) {
    ShownView& view = m_views[answer.of.view];
    if (answer.of.view >= n_views()) {
        return;
    }
    if (!answer.error.empty()) {
        if (view.error != answer.error) {
            say(Message::Kind::error, answer.error);
        }
        view.error = answer.error;
        view.failed_revision = answer.revision;
        return;
    }
    view.error.clear();
    view.picture = std::move(answer.picture);
    const FrameSchedule::Step& step = answer.of.step;
    view.schedule.drawn(step, view.picture.is_refinable, view.picture.milliseconds + showing_milliseconds);
    view.stage = step.stage == FrameStage::full && !view.picture.is_refinable ? FrameStage::exact : step.stage;
    view.divisor = step.divisor;
    view.shown_revision = answer.revision;
    note_motion(answer.of.view, step.stage, Clock::now());
}

void Workbench::note_motion(std::size_t view, FrameStage drawn, Clock::time_point now) {
    if (view != 0) {
        return;
    }
    if (m_was_moving) {
        if (m_last_moving_picture) {
            m_motion.frame_seconds.push_back(seconds_between(*m_last_moving_picture, now));
            if (m_motion.frame_seconds.size() > most_frame_times) {
                m_motion.frame_seconds.pop_front();
            }
        }
        m_last_moving_picture = now;
    } else if (m_rest_since) {
        if (drawn == FrameStage::full) {
            m_motion.rest_to_full_seconds = seconds_between(*m_rest_since, now);
        }
        if (m_views[0].stage == FrameStage::exact) {
            m_motion.rest_to_exact_seconds = seconds_between(*m_rest_since, now);
            m_rest_since.reset();
        }
    }
}

void Workbench::take(const ConversionResult& result) {
    if (result.was_cancelled) {
        say(Message::Kind::info, "the conversion was cancelled");
        return;
    }
    if (!result.error.empty()) {
        say(Message::Kind::error, result.error);
        return;
    }
    if (!result.said.empty()) {
        say(Message::Kind::warning, result.said);
    }
    for (const Json& field : result.report["fields"]) {
        const bool is_exact = field["exact"];
        const double residual = field["residual"].is_number() ? field["residual"].get<double>() : std::nan("");
        char text[200];
        std::snprintf(text, sizeof text, "field %s: %s, residual %.3g of its range", field["name"].get<std::string>().c_str(),
                      is_exact ? "exact but for round-off" : "NOT exact", residual);
        say(is_exact ? Message::Kind::info : Message::Kind::warning, text);
    }
    open(result.output);
}

void Workbench::follow(std::size_t view, bool is_moving, Clock::time_point now) {
    ShownView& shown = m_views[view];
    if (revision_of(view) != shown.scheduled_revision) {
        shown.scheduled_revision = revision_of(view);
        // One change after the other is a movement, too: the window's edge is dragged.
        const bool goes_on = now - std::exchange(shown.last_change, now) < FrameSchedule::rest;
        if (is_moving || goes_on) {
            shown.schedule.touch(now);
        } else {
            shown.schedule.change();
        }
    }
    if (m_was_moving && !is_moving) {
        shown.schedule.release();
    }
}

void Workbench::follow(bool is_moving) {
    const Clock::time_point now = Clock::now();
    if (m_second.is_on()) {
        m_second.follow(m_model);
    }
    for (std::size_t view = 0; view < n_views(); ++view) {
        follow(view, is_moving, now);
    }
    if (m_was_moving && !is_moving) {
        m_rest_since = now;
        m_last_moving_picture.reset();
    } else if (is_moving) {
        m_rest_since.reset();
    }
    if (now - m_views[0].last_change > FrameSchedule::rest) {
        // The hand holds still: what comes next is no measure of how many pictures can be drawn.
        m_last_moving_picture.reset();
    }
    m_was_moving = is_moving;
}

std::optional<std::size_t> Workbench::collect(double showing_milliseconds) {
    std::optional<DrawAnswer> answer = m_worker.collect();
    const std::optional<std::size_t> view = answer ? std::optional(answer->of.view) : std::nullopt;
    if (answer) {
        take(std::move(*answer), showing_milliseconds);
    }
    if (const std::optional<ConversionResult> result = m_conversion.collect()) {
        take(*result);
    }
    return view;
}

std::optional<DrawnStep> Workbench::next_step(Clock::time_point now) const {
    std::optional<DrawnStep> next;
    for (std::size_t i = 1; i <= n_views(); ++i) {
        const std::size_t view = (m_last_view + i) % n_views();
        if (m_views[view].failed_revision == revision_of(view)) {
            continue;
        }
        const std::optional<FrameSchedule::Step> step = m_views[view].schedule.next(now);
        // What moves goes before what is refined.
        if (step && (!next || step->stage < next->step.stage)) {
            next = {view, *step};
        }
    }
    return next;
}

bool Workbench::is_outdated(const DrawnStep& drawing, Clock::time_point now) const {
    if (drawing.view >= n_views() || m_views[drawing.view].schedule.is_outdated(drawing.step, now)) {
        return true;
    }
    const std::optional<DrawnStep> next = next_step(now);
    return next && next->view != drawing.view && next->step.stage < drawing.step.stage;
}

void Workbench::go_on(bool is_moving) {
    follow(is_moving);
    if (!m_model.volume()) {
        return;
    }
    const Clock::time_point now = Clock::now();
    const std::optional<DrawnStep> drawing = m_worker.drawing();
    const bool is_old = drawing && is_outdated(*drawing, now);
    if (is_old) {
        m_worker.cancel_drawing();
    }
    if (!drawing || is_old) {
        if (const std::optional<DrawnStep> next = next_step(now)) {
            m_last_view = next->view;
            m_worker.draw({scene_of(next->view), *next, revision_of(next->view)});
        }
    }
}

bool Workbench::is_settled() const {
    if (!m_worker.is_idle() || m_conversion.is_running()) {
        return false;
    }
    for (std::size_t view = 0; m_model.volume() && view < n_views(); ++view) {
        if (!m_views[view].is_done(revision_of(view))) {
            return false;
        }
    }
    return true;
}

std::string Workbench::activity() const { return m_worker.activity(); }

std::vector<Message> Workbench::picture_messages() const {
    std::vector<Message> messages;
    if (stage() != FrameStage::exact) {
        return messages;
    }
    for (const elvis::picture::remark& remark : picture().remarks) {
        messages.push_back({remark.is_warning ? Message::Kind::warning : Message::Kind::info, remark.text});
    }
    return messages;
}

} // namespace elvis::view
