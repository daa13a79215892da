#include "session.hpp"
#include <apps/elvis/view/scene/first_scene.hpp>

#include <apps/elvis/render/output_endings.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <utility>

namespace elvis::view {

namespace {

nlohmann::json device_of(const context& library) { return nlohmann::json::parse(library.describe_device()); }

} // namespace

Session::Session(const context& library) : m_library(library) {
    m_library.describe_device(); // Says at the start if there is none.
}

DeviceUse Session::device_use() const {
    const nlohmann::json device = device_of(m_library);
    return {device["allocated_bytes"], device["n_buffers"], device["n_kernels"]};
}

std::vector<std::string> Session::validation_messages() const { return device_of(m_library)["validation_messages"]; }

std::string Session::kind_of(const std::string& path) const { return Json::parse(m_library.describe_file(path))["kind"]; }

Scene Session::read(const std::string& path) const { return Json::parse(m_library.read_scene(path).text()); }

VolumeFacts Session::open(const Scene& scene) {
    Json files = part_of(scene, "volume");
    files.erase("time_step");
    std::string key = files.dump();
    if (!m_data || key != m_key) {
        const elvis::scene shown = library_scene(scene);
        data opened = shown.open_volume();
        opened.prepare(shown);
        m_displaced.reset();
        m_data = std::move(opened);
        m_key = std::move(key);
    }
    VolumeFacts facts = facts_of(*m_data, m_library);
    add_further_volumes(facts, m_library, scene);
    return facts;
}

Scene Session::first_scene(const std::vector<std::string>& files) { return view::first_scene(m_library, opened(), files); }

Scene Session::with_whole_camera(const Scene& scene, const VolumeFacts& volume) const {
    elvis::scene complete = library_scene(scene);
    complete.complete_camera(volume.extent());
    return Json::parse(complete.text());
}

Camera Session::fitted(const Scene& scene, const Camera& camera, const VolumeFacts& volume) const {
    Scene wanted = scene;
    say_camera(wanted["camera"], camera);
    elvis::scene placed = library_scene(wanted);
    placed.fit_camera(volume.extent());
    return camera_of(Json::parse(placed.json("/camera")));
}

void Session::write(const Scene& scene, const std::string& path) const { library_scene(scene).write(path); }

Json Session::transfer(const Scene& scene, const std::array<double, 2>& range, double diagonal) const {
    return Json::parse(library_scene(scene).transfer(range, diagonal));
}

const data& Session::opened() const {
    if (!m_data) {
        throw Error("no volume is open");
    }
    return *m_data;
}

const data& Session::shown(const Scene& scene) {
    if (!scene.contains("warp")) {
        m_displaced.reset();
        return opened();
    }
    const Json& warp = scene["warp"];
    const std::string field = warp["field"], imaginary = warp.value("imaginary", "");
    auto how = detail::sized<elvis_warp>();
    how.time_step = time_step_of(scene);
    how.field = field.c_str();
    how.imaginary = detail::or_null(imaginary);
    how.factor = warp.value("factor", 1.0);
    how.phase = warp.value("phase", 0.0);
    m_displaced = opened().warp(how, m_watch);
    return *m_displaced;
}

elvis::scene Session::library_scene(const Scene& scene) const { return m_library.parse_scene(scene.dump()); }

std::string Session::text_of(const Scene& scene, const std::optional<std::string>& field) const {
    return library_scene(scene).expression(field.value_or(opened().field(0).name));
}

std::string Session::number_text(const Scene& scene, const data& volume, const std::string& field) const {
    const std::string text = text_of(scene, field);
    const elvis_string name = text.c_str();
    return volume.count_values(&name, 1) == 1 ? text : std::string("norm(").append(text).append(")");
}

Picture Session::draw(const Scene& scene, const FrameSchedule::Step& step) {
    auto options = detail::sized<elvis_screen_options>();
    options.flags =
        (step.stage != FrameStage::exact ? ELVIS_SCREEN_COARSE : 0u) | (step.with_lines ? 0u : ELVIS_SCREEN_NO_LINES);
    options.divisor = step.divisor;
    const elvis::picture drawn = opened().render_for_screen(library_scene(scene), options, m_watch);
    const elvis_picture_info info = drawn.info();
    Picture picture;
    picture.width = info.width;
    picture.height = info.height;
    picture.rgba = drawn.read<std::uint8_t>(ELVIS_CHANNEL_COLOR);
    picture.counts = nlohmann::json::parse(drawn.stats())["counts"];
    picture.milliseconds = info.render_milliseconds;
    picture.is_refinable = info.is_refinable != 0;
    picture.remarks = drawn.remarks();
    return picture;
}

std::vector<std::string> Session::save_picture(const Scene& scene, const std::string& path, int bits) {
    auto options = detail::sized<elvis_render_options>();
    options.flags = ELVIS_RENDER_COLOR_ONLY;
    const elvis::picture drawn = opened().render(library_scene(scene), options);
    commands::write_still(drawn, path, static_cast<std::uint32_t>(bits));
    std::vector<std::string> warnings;
    for (const elvis::picture::remark& remark : drawn.remarks()) {
        if (remark.is_warning) {
            warnings.push_back(remark.text);
        }
    }
    return warnings;
}

FieldRange Session::range(const Scene& scene, const std::optional<std::string>& field) {
    const elvis_range found = shown(scene).range(text_of(scene, field), time_step_of(scene));
    return {found.minimum, found.maximum};
}

Picked Session::pick(const Scene& scene, const PicturePoint& place) {
    return picked_of(nlohmann::json::parse(opened().pick(library_scene(scene), place[0], place[1])));
}

LineAnswer Session::along(const Scene& scene, const LineProbe& line) {
    commands::SampleWishes wishes;
    wishes.fields = {text_of(scene, line.field ? line.field : said<std::string>(scene, "field"))};
    wishes.time_step = time_step_of(scene);
    return answer_of(
        line, commands::sample(shown(scene), commands::points_along({line.from, line.to}, n_line_points), wishes, m_watch));
}

Numbers Session::numbers(const Scene& scene, const NumbersQuestion& question, const std::function<bool()>& is_stopped) {
    Numbers row;
    row.question = question;
    row.is_done = true;
    try {
        const data& volume = shown(scene);
        const std::string field = number_text(scene, volume, question.field);
        if (question.domain == ELVIS_DOMAIN_VOLUME) {
            row.extrema = volume.range(field, question.time_step);
        }
        const std::vector<elvis_string> groups = detail::c_strings(question.groups);
        auto wanted = detail::sized<elvis_integration>();
        wanted.domain = question.domain;
        wanted.field = field.c_str();
        wanted.groups = groups.data();
        wanted.n_groups = static_cast<std::uint32_t>(groups.size());
        wanted.time_step = question.time_step;
        std::ranges::copy(question.plane, wanted.plane);
        std::string level_field;
        if (question.domain == ELVIS_DOMAIN_ISOSURFACE) {
            level_field = number_text(scene, volume, question.level_field);
            wanted.level_field = level_field.c_str();
            wanted.isovalue = question.isovalue;
        }
        row.integral = volume.integrate(wanted, {{}, [&] { return m_control.is_cancelled() || is_stopped(); }});
    } catch (const cancelled&) {
        throw;
    } catch (const std::exception& error) {
        row.error = error.what();
    }
    return row;
}

WrittenReport Session::write_data(const Scene& scene, const DataFile& file, const task& watch) {
    const bool is_displaced = file.what.kind != Writable::Kind::lines;
    return write_data_file(m_library, is_displaced ? shown(scene) : opened(), library_scene(scene), file, watch);
}

std::vector<double> Session::samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece) {
    return opened().sample(library_scene(scene), field.value_or(opened().field(0).name), piece);
}

} // namespace elvis::view
