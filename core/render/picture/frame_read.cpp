#include <core/render/picture/frame_read.hpp>
#include <core/render/picture/screen_pass.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace elvis {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Real> void read_as(const Layer& from, const std::vector<SurfaceFacts>& facts, bool with_buffers, Frame& frame) {
    const std::size_t n_pixels = frame.counts.pixels;
    const std::size_t n_read = with_buffers ? n_pixels : 0;
    std::vector<Real> colors(4 * n_pixels), normals(3 * n_read);
    std::vector<Mark> marks(n_read);
    std::vector<Sample<Real>> samples(n_read);
    Buffer::read_together({{&from.colors, std::as_writable_bytes(std::span(colors))},
                           {&from.marks, std::as_writable_bytes(std::span(marks))},
                           {&from.samples, std::as_writable_bytes(std::span(samples))},
                           {&from.normals, std::as_writable_bytes(std::span(normals))}});
    frame.color.assign(colors.begin(), colors.end());
    if (!with_buffers) {
        return;
    }
    frame.value.assign(n_pixels, not_a_number);
    frame.depth.assign(n_pixels, not_a_number);
    frame.normal.assign(3 * n_pixels, not_a_number);
    frame.element.assign(n_pixels, -1);
    frame.flags.resize(n_pixels);
    for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
        const Mark& mark = marks[pixel];
        frame.flags[pixel] = mark.flags;
        if (mark.surface() != 0) {
            // A picture of one surface may number its classes of faces.
            const SurfaceFacts& surface = facts[std::min<std::size_t>(mark.surface(), facts.size()) - 1];
            frame.value[pixel] = static_cast<double>(samples[pixel].value) + surface.offset;
            frame.depth[pixel] = static_cast<double>(samples[pixel].depth);
            const std::uint32_t number = samples[pixel].number;
            frame.element[pixel] = number == no_number ? -1 : static_cast<std::int64_t>(number);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                frame.normal[3 * pixel + axis] =
                    surface.normal ? (*surface.normal)[axis] : static_cast<double>(normals[3 * pixel + axis]);
            }
        }
    }
}

} // namespace

Frame background_frame(const FrameRequest& request) {
    Frame frame;
    frame.width = request.width;
    frame.height = request.height;
    const std::size_t n_pixels = std::size_t{request.width} * request.height;
    frame.counts.pixels = n_pixels;
    if (request.for_screen) {
        const std::array<std::uint8_t, 4> rgba = on_screen(request.background);
        for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
            frame.screen.insert(frame.screen.end(), rgba.begin(), rgba.end());
        }
        return frame;
    }
    frame.color.reserve(4 * n_pixels);
    for (std::size_t pixel = 0; pixel < n_pixels; ++pixel) {
        frame.color.insert(frame.color.end(), request.background.begin(), request.background.end());
    }
    if (request.with_buffers) {
        frame.value.assign(n_pixels, not_a_number);
        frame.depth.assign(n_pixels, not_a_number);
        frame.normal.assign(3 * n_pixels, not_a_number);
        frame.element.assign(n_pixels, -1);
        frame.flags.assign(n_pixels, 0);
    }
    return frame;
}

void read_frame(const Layer& from, Precision precision, const std::vector<SurfaceFacts>& facts, bool with_buffers,
                Frame& frame) {
    with_real(precision, [&]<class Real>(Real) { read_as<Real>(from, facts, with_buffers, frame); });
}

} // namespace elvis
