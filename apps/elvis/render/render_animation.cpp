#include "render_animation.hpp"
#include "film.hpp"
#include "output_endings.hpp"
#include "say_remarks.hpp"
#include <apps/elvis/long_task.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/base/output_file.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <filesystem>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/** One entry of --stats. */
ordered_json entry_of(std::uint32_t frame, const fs::path& file, std::uint32_t time_step, const picture& drawn) {
    const auto stats = ordered_json::parse(drawn.stats());
    return {{"frame", frame},
            {"file", file.string()},
            {"time_step", time_step},
            {"render_milliseconds", stats["milliseconds"]["render"]},
            {"device_milliseconds", stats["milliseconds"]["device"]},
            {"counts", stats["counts"]}};
}

/** Draws pictures into a folder. */
class Pictures {
public:
    Pictures(const RenderArguments& arguments, const animation& of)
        : m_arguments(arguments), m_animation(of), m_n_frames(of.info().n_frames), m_folder(arguments.output) {
        m_options.flags = sharing_of(arguments) | ELVIS_RENDER_COLOR_ONLY;
    }

    void draw_all() {
        fs::create_directories(m_folder);
        TaskControl control;
        const InterruptGuard interrupts(control);
        const ProgressBar progress(control);
        for (std::uint32_t frame = 0; frame < m_n_frames; ++frame) {
            if (m_arguments.resume && fs::exists(m_folder / frame_name(frame))) {
                ++m_n_kept;
                continue;
            }
            control.progress(static_cast<double>(frame) / m_n_frames, frame_name(frame));
            draw(frame, control);
        }
        spdlog::info("{} in {}, {} of them kept", counted(m_n_frames, "picture"), m_folder.string(), m_n_kept);
    }

    std::uint32_t n_frames() const { return m_n_frames; }
    std::uint32_t n_kept() const { return m_n_kept; }
    /** Those that were drawn, as --stats has them. */
    const ordered_json& entries() const { return m_entries; }

private:
    void draw(std::uint32_t frame, TaskControl& control) {
        const picture drawn = m_animation.render(frame, m_options, {{}, [&] { return control.is_cancelled(); }});
        drawn.write_png((m_folder / frame_name(frame)).string(), static_cast<std::uint32_t>(m_arguments.bits));
        say(drawn.remarks(), frame_name(frame) + ": ");
        m_entries.push_back(entry_of(frame, frame_name(frame), m_animation.time_step(frame), drawn));
    }

    const RenderArguments& m_arguments;
    const animation& m_animation;
    elvis_render_options m_options = detail::sized<elvis_render_options>();
    std::uint32_t m_n_frames, m_n_kept = 0;
    fs::path m_folder;
    ordered_json m_entries = ordered_json::array();
};

} // namespace

void check_animation(const RenderArguments& arguments) {
    for (const auto& [option, is_given] :
         {std::pair{"--buffers", !arguments.buffers.empty()}, std::pair{"--repeat", arguments.repeat > 0}}) {
        if (is_given) {
            throw UsageError(option, "is for one picture, not for an animation");
        }
    }
    if (fs::exists(arguments.output) && !fs::is_directory(arguments.output)) {
        throw UsageError("--output", "'" + arguments.output + "' is a file; an animation goes into a folder");
    }
    if (fs::path(arguments.output).extension() == ".png") {
        throw UsageError("--output", "'" + arguments.output + "' is the name of one picture; an animation goes into a folder");
    }
    if (!arguments.film.empty()) {
        need_film_ending("--film", arguments.film);
        require_film_maker();
    }
}

void render_animation(const RenderArguments& arguments, const scene& shown, const data& volume, const context& library) {
    const animation frames = volume.animate(shown);
    Pictures pictures(arguments, frames);
    pictures.draw_all();
    // Pictures that were kept may show anything.
    if (pictures.n_kept() == 0) {
        for (const std::string remark : ordered_json::parse(frames.remarks())) {
            spdlog::warn("in all pictures, {}", remark);
        }
    }
    if (!arguments.stats.empty()) {
        const std::string device = ordered_json::parse(library.describe_device())["name"];
        const ordered_json root = {{"device", device}, {"n_frames", pictures.n_frames()}, {"frames", pictures.entries()}};
        write_text_file(arguments.stats, root.dump(2) + "\n");
    }
    if (!arguments.film.empty()) {
        make_film(fs::path(arguments.output) / frame_pattern, frames.info().frames_a_second, arguments.film);
    }
}

} // namespace elvis::commands
