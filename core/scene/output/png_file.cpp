#include <core/base/error.hpp>
#include <core/base/output_file.hpp>
#include <core/scene/output/png_file.hpp>

#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

namespace elvis {

namespace {

/** All rows, most significant byte first. */
std::vector<unsigned char> quantised(const Frame& frame, int bits, std::size_t n_channels) {
    const unsigned largest = bits == 8 ? 255 : 65535;
    const std::size_t n_pixels = std::size_t{frame.width} * frame.height;
    std::vector<unsigned char> bytes;
    bytes.reserve(n_pixels * n_channels * static_cast<std::size_t>(bits / 8));
    for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
        for (std::size_t channel = 0; channel < n_channels; ++channel) {
            const unsigned level = level_of(frame.color[4 * pixel + channel], largest);
            if (bits == 16) {
                bytes.push_back(static_cast<unsigned char>(level >> 8));
            }
            bytes.push_back(static_cast<unsigned char>(level & 0xff));
        }
    }
    return bytes;
}

/** libpng reports errors by jumping: nothing with a destructor may live between here and the jump. */
bool write_rows(std::FILE* file, const Frame& frame, int bits, std::size_t n_channels, const unsigned char* bytes) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, frame.width, frame.height, bits, n_channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    const std::size_t row_bytes = frame.width * n_channels * static_cast<std::size_t>(bits / 8);
    for (std::uint32_t row = 0; row < frame.height; ++row) {
        png_write_row(png, bytes + row * row_bytes);
    }
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

/** Calls write(number of channels, the rows' bytes). */
template <class Write> bool with_rows(const Frame& frame, int bits, const Write& write) {
    bool is_opaque = true;
    for (std::size_t at = 3; at < frame.color.size(); at += 4) {
        is_opaque = is_opaque && frame.color[at] >= 1;
    }
    const std::size_t n_channels = is_opaque ? 3 : 4;
    return write(n_channels, quantised(frame, bits, n_channels).data());
}

} // namespace

std::vector<unsigned char> png_bytes(const Frame& frame, int bits) {
    char* memory = nullptr;
    std::size_t size = 0;
    std::FILE* file = open_memstream(&memory, &size);
    const bool is_written = file != nullptr && with_rows(frame, bits, [&](std::size_t n_channels, const unsigned char* bytes) {
                                return write_rows(file, frame, bits, n_channels, bytes);
                            });
    const bool is_whole = file != nullptr && std::fclose(file) == 0 && is_written;
    const std::unique_ptr<char, decltype(&std::free)> held(memory, &std::free);
    if (!is_whole) {
        throw Error("picture", std::string("cannot be made a PNG: ") + std::strerror(errno));
    }
    return {memory, memory + size};
}

void write_png(const Frame& frame, const std::string& path, int bits) {
    OutputFile output(path);
    std::FILE* file = std::fopen(output.temporary().c_str(), "wb");
    if (!file) {
        throw Error(path, std::string("cannot be written: ") + std::strerror(errno));
    }
    const bool is_written = with_rows(frame, bits, [&](std::size_t n_channels, const unsigned char* bytes) {
        return write_rows(file, frame, bits, n_channels, bytes);
    });
    if (std::fclose(file) != 0 || !is_written) {
        throw Error(path, std::string("cannot be written: ") + std::strerror(errno));
    }
    output.commit();
}

} // namespace elvis
