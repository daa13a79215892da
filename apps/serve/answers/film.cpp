#include "film.hpp"

#include <apps/elvis/render/film.hpp>

#include <core/base/error.hpp>

namespace elvis::serve {

nlohmann::json Film::begin(const Served& served, const Scene& scene) {
    if (!scene.contains("animation")) {
        throw Error("the scene has no animation");
    }
    animation made = served.volume.animate(served.library_scene(scene));
    const elvis_animation_info info = made.info();
    if (info.n_frames > most_film_pictures) {
        throw Error("the animation has " + std::to_string(info.n_frames) + " pictures, and a page takes " +
                    std::to_string(most_film_pictures) + " at most: save the scene for elvis render");
    }
    m_animation = std::move(made);
    return {{"n_pictures", info.n_frames}, {"frames_a_second", info.frames_a_second}};
}

Encoded Film::picture(const Served& served, std::uint32_t index, const task& watch) const {
    if (!m_animation) {
        throw Error("no film has been begun");
    }
    auto options = detail::sized<elvis_render_options>();
    options.flags = ELVIS_RENDER_COLOR_ONLY;
    const elvis::picture drawn = m_animation->render(index, options, watch);
    return {{{"name", commands::frame_name(index)}, {"mime", "image/png"}},
            file_of(drawn, served.pictures.path().string(), PictureFormat::png),
            drawn.info().render_milliseconds,
            false};
}

} // namespace elvis::serve
