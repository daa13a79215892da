#include "images.hpp"

#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/base/whole_file.hpp>

#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace elvis::serve {

namespace {

struct EndCompressor {
    void operator()(void* handle) const { tjDestroy(handle); }
};
struct FreeBytes {
    void operator()(unsigned char* bytes) const { tjFree(bytes); }
};

/** At the right and below fewer pixels may be left for the mean. */
std::vector<std::uint8_t> shrunk(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height,
                                 std::uint32_t shrink) {
    const std::uint32_t columns = (width + shrink - 1) / shrink, rows = (height + shrink - 1) / shrink;
    std::vector<std::uint8_t> result(std::size_t{4} * columns * rows);
    for (std::uint32_t row = 0; row < rows; ++row) {
        const std::uint32_t last_row = std::min(height, (row + 1) * shrink);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t last_column = std::min(width, (column + 1) * shrink);
            std::array<std::uint32_t, 4> sum{};
            std::uint32_t n = 0;
            for (std::uint32_t y = row * shrink; y < last_row; ++y) {
                for (std::uint32_t x = column * shrink; x < last_column; ++x, ++n) {
                    const std::uint8_t* const pixel = &rgba[4 * (std::size_t{y} * width + x)];
                    for (std::size_t i = 0; i < 4; ++i) {
                        sum[i] += pixel[i];
                    }
                }
            }
            for (std::size_t i = 0; i < 4; ++i) {
                result[4 * (std::size_t{row} * columns + column) + i] = static_cast<std::uint8_t>((sum[i] + n / 2) / n);
            }
        }
    }
    return result;
}

} // namespace

Jpeg jpeg_of(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, std::uint32_t shrink, int quality) {
    std::vector<std::uint8_t> small;
    if (shrink > 1) {
        small = shrunk(rgba, width, height, shrink);
        rgba = small;
    }
    Jpeg jpeg{(width + shrink - 1) / shrink, (height + shrink - 1) / shrink, {}};
    const std::unique_ptr<void, EndCompressor> compressor(tjInitCompress());
    unsigned char* bytes = nullptr;
    unsigned long n_bytes = 0;
    const int sampling = quality > 85 ? TJSAMP_444 : TJSAMP_420;
    const int result =
        compressor ? tjCompress2(compressor.get(), rgba.data(), static_cast<int>(jpeg.width), 0, static_cast<int>(jpeg.height),
                                 TJPF_RGBX, &bytes, &n_bytes, sampling, quality, TJFLAG_FASTDCT)
                   : -1;
    const std::unique_ptr<unsigned char, FreeBytes> own(bytes);
    if (result != 0) {
        throw Error("the picture cannot be compressed: " + std::string(tjGetErrorStr2(compressor.get())));
    }
    jpeg.bytes.assign(reinterpret_cast<const char*>(bytes), n_bytes);
    return jpeg;
}

PictureFormat picture_format(const std::string& name) {
    for (const auto& [format, known] :
         {std::pair{PictureFormat::png, "png"}, std::pair{PictureFormat::svg, "svg"}, std::pair{PictureFormat::pdf, "pdf"}}) {
        if (name == known) {
            return format;
        }
    }
    throw Error("pictures are saved as png, svg or pdf, not as '" + name.substr(0, 40) + "'");
}

const char* mime_of(PictureFormat format) {
    switch (format) {
    case PictureFormat::svg:
        return "image/svg+xml";
    case PictureFormat::pdf:
        return "application/pdf";
    case PictureFormat::png:
        break;
    }
    return "image/png";
}

std::string file_of(const picture& drawn, const std::string& folder, PictureFormat format) {
    const TemporaryFolder own(folder + "/picture-");
    const std::string path = own.path("picture");
    switch (format) {
    case PictureFormat::png:
        drawn.write_png(path);
        break;
    case PictureFormat::svg:
        drawn.write_svg(path);
        break;
    case PictureFormat::pdf:
        drawn.write_pdf(path);
        break;
    }
    return read_whole_file(path);
}

} // namespace elvis::serve
