#include "message_values.hpp"
#include "session.hpp"

#include <apps/serve/answers/line_values.hpp>
#include <apps/serve/answers/palette.hpp>

#include <core/base/error.hpp>

#include <algorithm>

namespace elvis::serve {

namespace {

constexpr std::size_t most_tasks = 16;
constexpr std::uint32_t most_line_points = 5000, usual_line_points = 500;
constexpr std::size_t most_line_fields = 16;

} // namespace

void Session::post(const Json& message, std::string activity, Job job, bool is_awaited) {
    std::deque<Task>& tasks = is_awaited ? m_tasks : m_later;
    if (tasks.size() >= most_tasks) {
        throw Error("too much is being asked at once");
    }
    tasks.push_back({m_asker, {{"id", message.value("id", Json())}}, std::move(activity), m_model.scene(), std::move(job)});
    // Somebody waits for the answer; the exact picture is drawn again.
    m_cancelled = m_cancelled || (is_awaited && m_drawing && m_drawing->stage == FrameStage::exact);
    if (is_awaited) {
        cancel_long_task();
    }
    m_changed.notify_all();
}

Session::Json Session::pick(const Json& message) {
    const double column = pixels(message, "column"), row = pixels(message, "row");
    post(message, "picking", [served = m_served, column, row](const Scene& scene, const task& watch) -> Encoded {
        return {{{"picked", pick_at(*served, scene, column, row, watch)}}, {}};
    });
    return {};
}

std::string Session::field_of(const Json& message) const {
    return message.value("field",
                         view::said<std::string>(m_model.scene(), "field").value_or(m_served->facts.fields.at(0).name));
}

Session::Json Session::range(const Json& message) {
    post(message, "finding a range",
         [served = m_served, field = field_of(message)](const Scene& scene, const task&) -> Encoded {
             const std::string text = served->library_scene(scene).expression(field);
             const elvis_range found = served->volume.range(text, view::time_step_of(scene));
             return {{{"minimum", found.minimum}, {"maximum", found.maximum}}, {}};
         });
    return {};
}

Session::Json Session::transfer(const Json& message) {
    post(message, "reading a transfer function",
         [served = m_served, usual = field_of(message)](const Scene& scene, const task&) -> Encoded {
             const elvis::scene shown = served->library_scene(scene);
             const std::string field = view::part_of(scene, "volume_rendering").value("field", usual);
             const elvis_range found = served->volume.range(shown.expression(field), view::time_step_of(scene));
             const std::string text = shown.transfer({found.minimum, found.maximum}, served->facts.diagonal());
             return {{{"transfer", Json::parse(text)}}, {}};
         });
    return {};
}

Session::Json Session::histogram(const Json& message) {
    post(
        message, "sampling the field",
        [served = m_served, field = field_of(message)](const Scene& scene, const task& watch) -> Encoded {
            return {served->histograms.grow(*served, scene, field, watch), {}};
        },
        false);
    return {};
}

Session::Json Session::palette(const Json& message) {
    Json scene = m_model.scene();
    scene["color_map"] = message.at("color_map");
    // It may be in a file.
    post(
        message, "reading a colour map",
        [served = m_served, map = view::part_of(judged(scene), "color_map")](const Scene&, const task&) -> Encoded {
            return {{{"points", palette_of(*served, map)}}, {}};
        },
        false);
    return {};
}

Session::Json Session::line(const Json& message) {
    LineWishes wishes{vector_of(message, "from"), vector_of(message, "to"), {}, usual_line_points};
    wishes.fields = message.value("fields", std::vector<std::string>{field_of(message)});
    if (message.contains("count")) {
        wishes.count = static_cast<std::size_t>(number(message, "count", 2, most_line_points));
    }
    if (wishes.from == wishes.to) {
        throw Error("the ends of the line are the same point");
    }
    if (wishes.fields.empty() || wishes.fields.size() > most_line_fields) {
        throw Error("a line takes 1 to " + std::to_string(most_line_fields) + " fields");
    }
    post(message, "sampling a line", [served = m_served, wishes](const Scene& scene, const task& watch) -> Encoded {
        return {values_along(*served, scene, wishes, watch), {}};
    });
    return {};
}

Session::Json Session::undecided(const Json& message) {
    post(message, "looking for undecided pixels",
         [served = m_served](const Scene& scene, const task& watch) { return draw_undecided(*served, scene, watch); });
    return {};
}

Session::Json Session::save_scene(const Json&) {
    const std::string text = m_served->library_scene(m_model.scene()).text(m_served->folder);
    return {{"scene", Json::parse(text)}, {"text", text}};
}

} // namespace elvis::serve
