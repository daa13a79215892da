#include "call.hpp"
#include "channels.hpp"

#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/pdf_picture.hpp>
#include <core/session/svg_picture.hpp>

namespace elvis::library {

namespace {

nlohmann::ordered_json demand_json(const DemandWork& work) {
    return {{"elements", work.n_elements},
            {"elements_on_device", work.n_on_device},
            {"bands", work.n_bands},
            {"device_bytes", work.device_bytes},
            {"peak_memory_bytes", work.host_bytes},
            {"bounds_milliseconds", work.bounds_milliseconds}};
}

nlohmann::ordered_json bar_json(const ColorBar& bar) {
    const auto rgb = [](const Color& color) { return nlohmann::ordered_json{color[0], color[1], color[2]}; };
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const ColorTable::Point& point : bar.colors.points) {
        points.push_back({point.value, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    return {{"name", bar.name},
            {"unit", bar.unit},
            {"points", points},
            {"below", rgb(bar.colors.below)},
            {"above", rgb(bar.colors.above)},
            {"nan", rgb(bar.colors.nan)},
            {"logarithmic", bar.colors.is_logarithmic}};
}

/** A picture that is more than what a screen shows. */
const StillPicture& still_of(const elvis_picture& picture) {
    const auto* const still = std::get_if<StillPicture>(&picture.state.drawn);
    if (still == nullptr) {
        throw InvalidArgument("picture", "was drawn for a screen: its colours can be read, in 8 bits");
    }
    return *still;
}

int bits_of(std::uint32_t bits) {
    if (bits != 8 && bits != 16) {
        throw InvalidArgument("bits", "is neither 8 nor 16");
    }
    return static_cast<int>(bits);
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

void elvis_picture_release(elvis_picture* picture) { delete picture; }

elvis_result elvis_picture_get_info(const elvis_picture* picture, elvis_picture_info* info) {
    return call(picture, [&] {
        const Frame& frame = picture->state.frame();
        elvis_picture_info ours{};
        ours.width = frame.width;
        ours.height = frame.height;
        ours.n_remarks = static_cast<std::uint32_t>(picture->state.remarks().size());
        ours.n_hit_pixels = frame.counts.hit_pixels;
        ours.n_undecided_pixels = frame.counts.undecided_pixels;
        ours.render_milliseconds = frame.render_milliseconds;
        ours.device_milliseconds = frame.device_milliseconds;
        if (const auto* const screen = std::get_if<ScreenPicture>(&picture->state.drawn)) {
            ours.width = screen->width;
            ours.height = screen->height;
            ours.render_milliseconds = screen->milliseconds;
            ours.is_refinable = screen->is_refinable ? 1 : 0;
        }
        give(ours, info, "info");
    });
}

elvis_result elvis_picture_get_remark(const elvis_picture* picture, uint32_t remark, elvis_string* text, int32_t* is_warning) {
    return call(picture, [&] {
        need(text, "text");
        const std::vector<FrameRemark>& remarks = picture->state.remarks();
        if (remark >= remarks.size()) {
            throw InvalidArgument("remark", "the picture has " + std::to_string(remarks.size()));
        }
        *text = remarks[remark].text.c_str();
        if (is_warning != nullptr) {
            *is_warning = remarks[remark].is_warning ? 1 : 0;
        }
    });
}

elvis_result elvis_picture_get_stats(const elvis_picture* picture, char** text) {
    return call(picture, [&] {
        need(text, "text");
        auto stats = nlohmann::ordered_json::parse(picture->state.stats.json());
        if (picture->state.demand) {
            stats["demand"] = demand_json(*picture->state.demand);
        }
        *text = text_for_caller(stats.dump(2));
    });
}

elvis_result elvis_picture_get_color_bars(const elvis_picture* picture, char** text) {
    return call(picture, [&] {
        need(text, "text");
        const StillPicture& still = still_of(*picture);
        Data& data = *picture->state.data;
        const DataTask task(data, nullptr);
        SceneAnnotation bars_alone;
        bars_alone.has_axes = false;
        const AnnotationRequest request = make_annotation_request(bars_alone, still.request, still.frame, data.volume);
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const ColorBar& bar : request.color_bars) {
            list.push_back(bar_json(bar));
        }
        *text = text_for_caller(list.dump());
    });
}

elvis_result elvis_picture_read(const elvis_picture* picture, elvis_channel channel, elvis_number number, void* destination,
                                ptrdiff_t row_stride, ptrdiff_t pixel_stride) {
    return call(picture, [&] {
        need(destination, "destination");
        copy_channel(picture->state, {destination, row_stride, pixel_stride}, channel, number);
    });
}

elvis_result elvis_picture_write_png(const elvis_picture* picture, elvis_string path, uint32_t bits) {
    return call(picture, [&] {
        need(path, "path");
        write_png(still_of(*picture).frame, path, bits_of(bits));
    });
}

elvis_result elvis_picture_write_svg(const elvis_picture* picture, elvis_string path, uint32_t bits) {
    return call(picture, [&] {
        need(path, "path");
        write_svg_picture(still_of(*picture), path, bits_of(bits));
    });
}

elvis_result elvis_picture_write_pdf(const elvis_picture* picture, elvis_string path, uint32_t bits) {
    return call(picture, [&] {
        need(path, "path");
        write_pdf_picture(still_of(*picture), path, bits_of(bits));
    });
}

elvis_result elvis_picture_write_buffers(const elvis_picture* picture, elvis_string path) {
    return call(picture, [&] {
        need(path, "path");
        const StillPicture& still = still_of(*picture);
        if (still.frame.flags.empty()) {
            throw InvalidArgument("picture", "was drawn with ELVIS_RENDER_COLOR_ONLY");
        }
        const Picture& state = picture->state;
        const DataTask task(*state.data, nullptr);
        write_buffers(still.frame, still.request, state.data->volume, path, state.precision);
    });
}
