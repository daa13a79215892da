#include "displaced.hpp"

namespace elvis::serve {

std::optional<data> displaced(const Served& served, const Scene& scene, const task& watch) {
    if (!scene.contains("warp")) {
        return {};
    }
    const nlohmann::json& warp = scene["warp"];
    const std::string field = warp["field"], imaginary = warp.value("imaginary", "");
    auto how = detail::sized<elvis_warp>();
    how.time_step = view::time_step_of(scene);
    how.field = field.c_str();
    how.imaginary = detail::or_null(imaginary);
    how.factor = warp.value("factor", 1.0);
    how.phase = warp.value("phase", 0.0);
    return served.volume.warp(how, watch);
}

} // namespace elvis::serve
