#include <core/session/pdf_picture.hpp>

#include <core/annotation/pdf.hpp>
#include <core/base/output_file.hpp>
#include <core/scene/output/png_file.hpp>

#include <algorithm>
#include <cstdint>

namespace elvis {

namespace {

/** The compressed rows of a PNG, each of which begins with its filter: as a PDF may have them, too. */
std::string rows_of_png(const std::vector<unsigned char>& png) {
    constexpr std::size_t signature = 8, around = 12;
    std::string rows;
    for (std::size_t at = signature; at + around <= png.size();) {
        const auto word = [&](std::size_t i) { return std::size_t{png[at + i]}; };
        const std::size_t size = word(0) << 24 | word(1) << 16 | word(2) << 8 | word(3);
        const auto* const type = reinterpret_cast<const char*>(&png[at + 4]);
        if (std::string_view(type, 4) == "IDAT") {
            rows.append(type + 4, size);
        }
        at += around + size;
    }
    return rows;
}

std::string image_entries(const Frame& frame, int bits, const char* color_space) {
    return std::string("/Type /XObject /Subtype /Image /Width ") + std::to_string(frame.width) + " /Height " +
           std::to_string(frame.height) + " /ColorSpace /" + color_space + " /BitsPerComponent " + std::to_string(bits);
}

/** How opaque the pixels are, most significant byte first; empty where all are opaque. */
std::string opacities_of(const Frame& frame, int bits) {
    const unsigned largest = bits == 8 ? 255 : 65535;
    std::string bytes;
    bool is_opaque = true;
    for (std::size_t at = 3; at < frame.color.size(); at += 4) {
        const unsigned level = level_of(frame.color[at], largest);
        is_opaque = is_opaque && frame.color[at] >= 1;
        if (bits == 16) {
            bytes += static_cast<char>(level >> 8);
        }
        bytes += static_cast<char>(level & 0xff);
    }
    return is_opaque ? std::string() : bytes;
}

int add_pixels(const Frame& frame, int bits, PdfFile& file) {
    std::string entries = image_entries(frame, bits, "DeviceRGB") +
                          " /Filter /FlateDecode /DecodeParms << /Predictor 15 /Colors 3 /BitsPerComponent " +
                          std::to_string(bits) + " /Columns " + std::to_string(frame.width) + " >>";
    const std::string opacities = opacities_of(frame, bits);
    Frame opaque;
    opaque.width = frame.width;
    opaque.height = frame.height;
    opaque.color = frame.color;
    for (std::size_t at = 3; at < opaque.color.size(); at += 4) {
        opaque.color[at] = 1;
    }
    if (!opacities.empty()) {
        entries +=
            std::string(" /SMask ") + pdf_reference(file.add_stream(image_entries(frame, bits, "DeviceGray"), opacities));
    }
    return file.add_stream_as_is(entries, rows_of_png(png_bytes(opaque, bits)));
}

} // namespace

std::string pdf_picture(const StillPicture& still, int bits) {
    constexpr double points_a_pixel = 72.0 / 96;
    const Frame bare = without_annotation(still);
    const double width = bare.width, height = bare.height;
    PdfFile file;
    const int pixels = add_pixels(bare, bits, file);
    const PdfDrawing annotation = pdf_drawing(still.annotation, bare, file);
    // In pixels, y downwards; images have y upwards.
    std::string page = pdf_numbers({points_a_pixel, 0, 0, -points_a_pixel, 0, points_a_pixel * height}) + "cm\nq ";
    page += pdf_numbers({width, 0, 0, -height, 0, height}) + "cm /Pixels Do Q\n" + annotation.operators;
    const int contents = file.add_stream("", page);
    // The next two objects refer to each other.
    const int pages = contents + 2;
    file.add(std::string("<< /Type /Page /Parent ") + pdf_reference(pages) + " /MediaBox [" +
             pdf_numbers({0, 0, points_a_pixel * width, points_a_pixel * height}) + "] /Contents " + pdf_reference(contents) +
             " /Group << /S /Transparency /CS /DeviceRGB >> /Resources << " + annotation.resources + " /XObject << /Pixels " +
             pdf_reference(pixels) + " " + annotation.objects + ">> >> >>");
    file.add(std::string("<< /Type /Pages /Kids [") + pdf_reference(pages - 1) + "] /Count 1 >>");
    return file.bytes(file.add(std::string("<< /Type /Catalog /Pages ") + pdf_reference(pages) + " >>"));
}

void write_pdf_picture(const StillPicture& still, const std::string& path, int bits) {
    write_text_file(path, pdf_picture(still, bits));
}

} // namespace elvis
