#include "session.hpp"
#include "first_scene.hpp"

#include <apps/elvis/render/output_endings.hpp>

#include <core/base/error.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/scene/write/write_scene.hpp>

#include <algorithm>
#include <utility>

namespace elvis::view {

namespace {

/** A file that is not there: paths of scenes are seen from the working directory. */
constexpr const char* no_file = "scene";

/** A number that stands for a field or expression: of a vector its magnitude. */
std::string number_text(const data& volume, const std::string& field) {
    const elvis_string name = field.c_str();
    return volume.count_values(&name, 1) == 1 ? field : std::string("norm(").append(field).append(")");
}

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

bool Session::is_foreign(const std::string& path) const {
    return nlohmann::json::parse(m_library.describe_file(path))["kind"] == "foreign";
}

VolumeFacts Session::open(const Scene& scene) {
    std::vector<std::string> files{scene.volume};
    files.insert(files.end(), scene.more_files.begin(), scene.more_files.end());
    std::string key;
    for (const std::string& file : files) {
        key += file + '\n';
    }
    key += '\n' + scene.plugin + '\n' + scene.plugin_options;
    if (!m_data || key != m_key) {
        if (scene.volume.empty()) {
            throw Error("the scene names no volume");
        }
        data opened = m_library.open(files, scene.plugin, scene.plugin_options);
        opened.prepare(library_scene(scene));
        m_displaced.reset();
        m_data = std::move(opened);
        m_key = std::move(key);
    }
    return facts_of(*m_data, m_library);
}

const data& Session::opened() const {
    if (!m_data) {
        throw Error("no volume is open");
    }
    return *m_data;
}

const data& Session::shown(const Scene& scene) {
    if (!scene.warp) {
        m_displaced.reset();
        return opened();
    }
    auto how = detail::sized<elvis_warp>();
    how.time_step = scene.time_step;
    how.field = scene.warp->field.c_str();
    how.imaginary = scene.warp->imaginary ? scene.warp->imaginary->c_str() : nullptr;
    how.factor = scene.warp->factor;
    how.phase = scene.warp->phase;
    m_displaced = opened().warp(how, m_watch);
    return *m_displaced;
}

elvis::scene Session::library_scene(const Scene& scene) const {
    return m_library.parse_scene(scene_json(scene, no_file).dump());
}

std::string Session::text_of(const Scene& scene, const std::optional<std::string>& field) const {
    return with_distances(field.value_or(opened().field(0).name), scene.surfaces);
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
    const auto channel_bits = static_cast<std::uint32_t>(bits);
    commands::is_svg(path) ? drawn.write_svg(path, channel_bits) : drawn.write_png(path, channel_bits);
    std::vector<std::string> warnings;
    for (const elvis::picture::remark& remark : drawn.remarks()) {
        if (remark.is_warning) {
            warnings.push_back(remark.text);
        }
    }
    return warnings;
}

FieldRange Session::range(const Scene& scene, const std::optional<std::string>& field) {
    const elvis_range found = shown(scene).range(text_of(scene, field), scene.time_step);
    return {found.minimum, found.maximum};
}

Scene Session::first_scene(const std::string& path) { return view::first_scene(m_library, opened(), path); }

Picked Session::pick(const Scene& scene, const PicturePoint& place) {
    return picked_of(nlohmann::json::parse(opened().pick(library_scene(scene), place[0], place[1])));
}

LineAnswer Session::along(const Scene& scene, const LineProbe& line) {
    commands::SampleWishes wishes;
    wishes.fields = {text_of(scene, line.field ? line.field : scene.field)};
    wishes.time_step = scene.time_step;
    return answer_of(
        line, commands::sample(shown(scene), commands::points_along({line.from, line.to}, n_line_points), wishes, m_watch));
}

Numbers Session::numbers(const Scene& scene, const NumbersQuestion& question, const std::function<bool()>& is_stopped) {
    Numbers row;
    row.question = question;
    row.is_done = true;
    try {
        const data& volume = shown(scene);
        const std::string field = number_text(volume, with_distances(question.field, scene.surfaces));
        if (question.domain == ELVIS_DOMAIN_VOLUME) {
            row.extrema = volume.range(field, question.time_step);
        }
        std::vector<elvis_string> groups;
        for (const std::string& group : question.groups) {
            groups.push_back(group.c_str());
        }
        auto wanted = detail::sized<elvis_integration>();
        wanted.domain = question.domain;
        wanted.field = field.c_str();
        wanted.groups = groups.data();
        wanted.n_groups = static_cast<std::uint32_t>(groups.size());
        wanted.time_step = question.time_step;
        std::ranges::copy(question.plane, wanted.plane);
        std::string level_field;
        if (question.domain == ELVIS_DOMAIN_ISOSURFACE) {
            level_field = number_text(volume, with_distances(question.level_field, scene.surfaces));
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

std::vector<double> Session::samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece) {
    return opened().sample(library_scene(scene), field.value_or(opened().field(0).name), piece);
}

} // namespace elvis::view
