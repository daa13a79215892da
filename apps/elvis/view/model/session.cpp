#include "session.hpp"
#include "first_scene.hpp"

#include <core/base/error.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/scene/write/write_scene.hpp>

#include <utility>

namespace elvis::view {

namespace {

/** A file that is not there: paths of scenes are seen from the working directory. */
constexpr const char* no_file = "scene";

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
    drawn.write_png(path, static_cast<std::uint32_t>(bits));
    std::vector<std::string> warnings;
    for (const elvis::picture::remark& remark : drawn.remarks()) {
        if (remark.is_warning) {
            warnings.push_back(remark.text);
        }
    }
    return warnings;
}

FieldRange Session::range(const Scene& scene, const std::optional<std::string>& field) {
    const elvis_range found = opened().range(text_of(scene, field), scene.time_step);
    return {found.minimum, found.maximum};
}

Scene Session::first_scene(const std::string& path) { return view::first_scene(m_library, opened(), path); }

Picked Session::pick(const Scene& scene, const PicturePoint& place) {
    return picked_of(nlohmann::json::parse(opened().pick(library_scene(scene), place[0], place[1])));
}

std::vector<double> Session::samples(const Scene& scene, const std::optional<std::string>& field, unsigned piece) {
    return opened().sample(library_scene(scene), field.value_or(opened().field(0).name), piece);
}

} // namespace elvis::view
