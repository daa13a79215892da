#include "draw.hpp"

#include <algorithm>
#include <chrono>

namespace elvis::serve {

namespace {

using nlohmann::json;

double since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

json remarks_json(const picture& drawn) {
    json list = json::array();
    for (const picture::remark& remark : drawn.remarks()) {
        list.push_back({{"text", remark.text}, {"warning", remark.is_warning}});
    }
    return list;
}

json facts_of_picture(const picture& drawn, const elvis_picture_info& info) {
    return {{"size", {info.width, info.height}},
            {"counts", json::parse(drawn.stats())["counts"]},
            {"remarks", remarks_json(drawn)}};
}

} // namespace

Encoded draw_for_screen(const Served& served, const Scene& scene, const FrameSchedule::Step& step, const Line& line,
                        const task& watch) {
    auto options = detail::sized<elvis_screen_options>();
    options.flags = ELVIS_SCREEN_COARSE | (step.with_lines ? 0u : ELVIS_SCREEN_NO_LINES);
    options.divisor = step.divisor;
    const picture drawn = served.volume.render_for_screen(served.library_scene(scene), options, watch);
    const elvis_picture_info info = drawn.info();
    const auto start = std::chrono::steady_clock::now();
    Jpeg jpeg = jpeg_of(drawn.read<std::uint8_t>(ELVIS_CHANNEL_COLOR), info.width, info.height, line.shrink, line.quality);
    json facts = {{"size", view::size_of(scene)}, {"image", {jpeg.width, jpeg.height}}, {"mime", "image/jpeg"}};
    return {std::move(facts), std::move(jpeg.bytes), info.render_milliseconds + since(start), info.is_refinable != 0};
}

Encoded draw_exactly(const Served& served, const Scene& scene, const task& watch, PictureFormat format) {
    auto options = detail::sized<elvis_render_options>();
    options.flags = ELVIS_RENDER_COLOR_ONLY;
    const picture drawn = served.volume.render(served.library_scene(scene), options, watch);
    const elvis_picture_info info = drawn.info();
    json facts = facts_of_picture(drawn, info);
    facts["image"] = facts["size"];
    facts["mime"] = mime_of(format);
    return {std::move(facts), file_of(drawn, served.pictures.path().string(), format), info.render_milliseconds, false};
}

Encoded draw_undecided(const Served& served, const Scene& scene, const task& watch) {
    const picture drawn = served.volume.render(served.library_scene(scene), detail::sized<elvis_render_options>(), watch);
    const elvis_picture_info info = drawn.info();
    const std::vector<std::uint32_t> flags = drawn.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS);
    std::string bits((flags.size() + 7) / 8, '\0');
    std::size_t n_undecided = 0;
    for (std::size_t i = 0; i < flags.size(); ++i) {
        if ((flags[i] & ELVIS_PIXEL_DOUBTS) != 0) {
            bits[i / 8] = static_cast<char>(static_cast<unsigned char>(bits[i / 8]) | (0x80u >> (i % 8)));
            ++n_undecided;
        }
    }
    json facts = facts_of_picture(drawn, info);
    facts["n_undecided"] = n_undecided;
    return {std::move(facts), std::move(bits), info.render_milliseconds, false};
}

json pick_at(const Served& served, const Scene& scene, double column, double row, const task& watch) {
    return json::parse(served.volume.pick(served.library_scene(scene), column, row, watch));
}

} // namespace elvis::serve
