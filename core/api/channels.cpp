#include "channels.hpp"
#include "call.hpp"

#include <core/scene/output/png_file.hpp>

#include <cstring>

namespace elvis::library {

namespace {

/** Copies numbers of a picture into the caller's array. */
class Rows {
public:
    Rows(std::uint32_t width, std::uint32_t height, const PixelArray& array)
        : m_width(width), m_height(height), m_array(array) {}

    /** `convert` makes a To of each of the picture's numbers. */
    template <class To, class From, class Convert>
    void copy(const std::vector<From>& from, std::size_t n_numbers, Convert convert) const {
        if (from.size() != std::size_t{m_width} * m_height * n_numbers) {
            throw InvalidArgument("channel", "the picture was drawn with ELVIS_RENDER_COLOR_ONLY");
        }
        const auto bytes = static_cast<std::ptrdiff_t>(n_numbers * sizeof(To));
        const std::ptrdiff_t step = m_array.pixel_stride != 0 ? m_array.pixel_stride : bytes;
        const std::ptrdiff_t row_step =
            m_array.row_stride != 0 ? m_array.row_stride : step * static_cast<std::ptrdiff_t>(m_width);
        const From* number = from.data();
        for (std::ptrdiff_t row = 0; row < static_cast<std::ptrdiff_t>(m_height); ++row) {
            for (std::ptrdiff_t column = 0; column < static_cast<std::ptrdiff_t>(m_width); ++column) {
                std::byte* at = static_cast<std::byte*>(m_array.destination) + row * row_step + column * step;
                for (std::size_t index = 0; index < n_numbers; ++index, ++number, at += sizeof(To)) {
                    const To value = convert(*number);
                    std::memcpy(at, &value, sizeof value);
                }
            }
        }
    }

private:
    std::uint32_t m_width, m_height;
    PixelArray m_array;
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

void copy_frame(const Rows& rows, const Frame& frame, elvis_channel channel, elvis_number number) {
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

void copy_screen(const ScreenPicture& picture, const PixelArray& array, elvis_channel channel, elvis_number number) {
    if (channel != ELVIS_CHANNEL_COLOR) {
        throw InvalidArgument("channel", "the picture was drawn for a screen: it has colours alone");
    }
    if (number != ELVIS_NUMBER_UINT8) {
        refuse_number();
    }
    if (array.row_stride == 0 && array.pixel_stride == 0) {
        std::memcpy(array.destination, picture.rgba.data(), picture.rgba.size());
        return;
    }
    Rows(picture.width, picture.height, array).copy<std::uint8_t>(picture.rgba, 4, [](std::uint8_t level) { return level; });
}

} // namespace

void copy_channel(const Picture& picture, const PixelArray& array, elvis_channel channel, elvis_number number) {
    if (const auto* const screen = std::get_if<ScreenPicture>(&picture.drawn)) {
        copy_screen(*screen, array, channel, number);
    } else {
        const Frame& frame = picture.frame();
        copy_frame(Rows(frame.width, frame.height, array), frame, channel, number);
    }
}

} // namespace elvis::library
