#include "call.hpp"

#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/picture_stats.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace elvis::library {

namespace {

Scene still_scene(const elvis_scene& scene, const elvis_render_options& options, const RuntimeVolume& volume) {
    Scene still = scene.state.scene;
    still.animation.reset();
    still.volume = volume.path();
    if ((options.width == 0) != (options.height == 0)) {
        throw InvalidArgument("options", "width and height are given together");
    }
    if (options.width != 0) {
        constexpr std::uint32_t most = 32768; // As in the schema of scenes.
        if (options.width > most || options.height > most) {
            throw InvalidArgument("options", "a picture has at most 32768 columns and rows");
        }
        still.size = {options.width, options.height};
    }
    return still;
}

/** Copies numbers of a picture into the caller's array. */
class Rows {
public:
    Rows(const Frame& frame, void* destination, std::ptrdiff_t row_stride, std::ptrdiff_t pixel_stride)
        : m_frame(frame), m_destination(static_cast<std::byte*>(destination)), m_row_stride(row_stride),
          m_pixel_stride(pixel_stride) {}

    /** `convert` makes a To of each of the picture's numbers. */
    template <class To, class From, class Convert>
    void copy(const std::vector<From>& from, std::size_t n_numbers, Convert convert) const {
        const std::size_t n_pixels = std::size_t{m_frame.width} * m_frame.height;
        if (from.size() != n_pixels * n_numbers) {
            throw InvalidArgument("channel", "the picture was drawn with ELVIS_RENDER_COLOR_ONLY");
        }
        const auto bytes = static_cast<std::ptrdiff_t>(n_numbers * sizeof(To));
        const std::ptrdiff_t step = m_pixel_stride != 0 ? m_pixel_stride : bytes;
        const std::ptrdiff_t row_step = m_row_stride != 0 ? m_row_stride : step * static_cast<std::ptrdiff_t>(m_frame.width);
        const From* number = from.data();
        for (std::ptrdiff_t row = 0; row < static_cast<std::ptrdiff_t>(m_frame.height); ++row) {
            for (std::ptrdiff_t column = 0; column < static_cast<std::ptrdiff_t>(m_frame.width); ++column) {
                std::byte* at = m_destination + row * row_step + column * step;
                for (std::size_t index = 0; index < n_numbers; ++index, ++number, at += sizeof(To)) {
                    const To value = convert(*number);
                    std::memcpy(at, &value, sizeof value);
                }
            }
        }
    }

private:
    const Frame& m_frame;
    std::byte* m_destination;
    std::ptrdiff_t m_row_stride, m_pixel_stride;
};

[[noreturn]] void refuse_number() { throw InvalidArgument("number", "the channel is not written in such numbers"); }

void copy_reals(const Rows& rows, const std::vector<double>& from, std::size_t n_numbers, elvis_number number) {
    if (number == ELVIS_NUMBER_FLOAT) {
        rows.copy<float>(from, n_numbers, [](double value) { return static_cast<float>(value); });
    } else if (number == ELVIS_NUMBER_DOUBLE) {
        rows.copy<double>(from, n_numbers, [](double value) { return value; });
    } else {
        refuse_number();
    }
}

void copy_colors(const Rows& rows, const Frame& frame, elvis_number number) {
    if (number == ELVIS_NUMBER_UINT8) {
        rows.copy<std::uint8_t>(frame.color, 4,
                                [](double channel) { return static_cast<std::uint8_t>(level_of(channel, 255)); });
    } else if (number == ELVIS_NUMBER_UINT16) {
        rows.copy<std::uint16_t>(frame.color, 4,
                                 [](double channel) { return static_cast<std::uint16_t>(level_of(channel, 65535)); });
    } else {
        copy_reals(rows, frame.color, 4, number);
    }
}

void copy_channel(const Rows& rows, const Frame& frame, elvis_channel channel, elvis_number number) {
    switch (channel) {
    case ELVIS_CHANNEL_COLOR:
        return copy_colors(rows, frame, number);
    case ELVIS_CHANNEL_VALUE:
        return copy_reals(rows, frame.value, 1, number);
    case ELVIS_CHANNEL_DEPTH:
        return copy_reals(rows, frame.depth, 1, number);
    case ELVIS_CHANNEL_NORMAL:
        return copy_reals(rows, frame.normal, 3, number);
    case ELVIS_CHANNEL_ELEMENT:
        return number == ELVIS_NUMBER_INT64
                   ? rows.copy<std::int64_t>(frame.element, 1, [](std::int64_t value) { return value; })
                   : refuse_number();
    case ELVIS_CHANNEL_FLAGS:
        return number == ELVIS_NUMBER_UINT32
                   ? rows.copy<std::uint32_t>(frame.flags, 1, [](std::uint32_t value) { return value; })
                   : refuse_number();
    default:
        throw InvalidArgument("channel", "there is no channel " + std::to_string(channel));
    }
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

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_render(elvis_data* data, const elvis_scene* scene, const elvis_render_options* options,
                          const elvis_task* task, elvis_picture** picture) {
    return call(data, [&] {
        need(picture, "picture");
        *picture = nullptr;
        need(scene, "scene");
        elvis_render_options known{};
        if (options != nullptr) {
            known = known_part(options, "options");
        }
        Data& state = *data->state;
        const Scene still = still_scene(*scene, known, state.volume);
        const DataTask running(state, task);
        auto drawn = std::make_unique<elvis_picture>();
        drawn->state.data = data->state;
        drawn->state.precision = still.precision.value_or(Precision::float32);
        Renderer& renderer = state.renderer(drawn->state.precision);
        StillOptions how;
        how.with_buffers = (known.flags & ELVIS_RENDER_COLOR_ONLY) == 0;
        drawn->state.still = draw_still(still, state.volume, renderer, how, state.control.get());
        drawn->state.stats =
            stats_json(state.context->device(), drawn->state.precision, drawn->state.still.frame, renderer, 0, 0, {}).dump(2);
        *picture = drawn.release();
    });
}

void elvis_picture_release(elvis_picture* picture) { delete picture; }

elvis_result elvis_picture_get_info(const elvis_picture* picture, elvis_picture_info* info) {
    return call(picture, [&] {
        const Frame& frame = picture->state.still.frame;
        elvis_picture_info ours{};
        ours.width = frame.width;
        ours.height = frame.height;
        ours.n_remarks = static_cast<std::uint32_t>(picture->state.still.remarks.size());
        ours.n_hit_pixels = frame.counts.hit_pixels;
        ours.n_undecided_pixels = frame.counts.undecided_pixels;
        ours.render_milliseconds = frame.render_milliseconds;
        ours.device_milliseconds = frame.device_milliseconds;
        give(ours, info, "info");
    });
}

elvis_result elvis_picture_get_remark(const elvis_picture* picture, uint32_t remark, elvis_string* text, int32_t* is_warning) {
    return call(picture, [&] {
        need(text, "text");
        const auto& remarks = picture->state.still.remarks;
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
        *text = text_for_caller(picture->state.stats);
    });
}

elvis_result elvis_picture_get_color_bars(const elvis_picture* picture, char** text) {
    return call(picture, [&] {
        need(text, "text");
        const Picture& state = picture->state;
        const DataTask task(*state.data, nullptr);
        SceneAnnotation bars_alone;
        bars_alone.has_axes = false;
        const AnnotationRequest request =
            make_annotation_request(bars_alone, state.still.request, state.still.frame, state.data->volume);
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
        const Frame& frame = picture->state.still.frame;
        copy_channel(Rows(frame, destination, row_stride, pixel_stride), frame, channel, number);
    });
}

elvis_result elvis_picture_write_png(const elvis_picture* picture, elvis_string path, uint32_t bits) {
    return call(picture, [&] {
        need(path, "path");
        if (bits != 8 && bits != 16) {
            throw InvalidArgument("bits", "is neither 8 nor 16");
        }
        write_png(picture->state.still.frame, path, static_cast<int>(bits));
    });
}

elvis_result elvis_picture_write_buffers(const elvis_picture* picture, elvis_string path) {
    return call(picture, [&] {
        need(path, "path");
        const Picture& state = picture->state;
        if (state.still.frame.flags.empty()) {
            throw InvalidArgument("picture", "was drawn with ELVIS_RENDER_COLOR_ONLY");
        }
        const DataTask task(*state.data, nullptr);
        write_buffers(state.still.frame, state.still.request, state.data->volume, path, state.precision);
    });
}
