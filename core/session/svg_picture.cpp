#include <core/session/svg_picture.hpp>

#include <core/base/output_file.hpp>
#include <core/scene/output/png_file.hpp>

#include <algorithm>
#include <cstdint>
#include <span>

namespace elvis {

namespace {

/** RFC 4648. */
std::string base64(std::span<const unsigned char> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            group = group << 8 | (i < count ? bytes[at + i] : 0u);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            text += i <= count ? digits[group >> (18 - 6 * i) & 63u] : '=';
        }
    }
    return text;
}

} // namespace

std::string svg_picture(const StillPicture& still, int bits) {
    const Frame bare = without_annotation(still);
    const std::string width = std::to_string(bare.width), height = std::to_string(bare.height);
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
                       "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"";
    text.append(width)
        .append("\" height=\"")
        .append(height)
        .append("\" viewBox=\"0 0 ")
        .append(width)
        .append(" ")
        .append(height);
    text.append("\">\n<image width=\"").append(width).append("\" height=\"").append(height);
    text.append("\" xlink:href=\"data:image/png;base64,").append(base64(png_bytes(bare, bits))).append("\"/>\n");
    text += svg_elements(still.annotation, bare);
    return text + "</svg>\n";
}

void write_svg_picture(const StillPicture& still, const std::string& path, int bits) {
    write_text_file(path, svg_picture(still, bits));
}

} // namespace elvis
