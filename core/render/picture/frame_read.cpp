#include <core/render/picture/frame_read.hpp>

#include <algorithm>
#include <limits>

namespace elvis {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Real> void read_as(const Layer& from, const std::vector<SurfaceFacts>& facts, bool with_buffers, Frame& frame) {
    const std::size_t n_pixels = frame.counts.pixels;
    const std::vector<Real> colors = from.colors.read_items<Real>(4 * n_pixels);
    frame.color.assign(colors.begin(), colors.end());
    if (!with_buffers) {
        return;
    }
    const std::vector<Mark> marks = from.marks.read_items<Mark>(n_pixels);
    const std::vector<Sample<Real>> samples = from.samples.read_items<Sample<Real>>(n_pixels);
    const std::vector<Real> normals = from.normals.read_items<Real>(3 * n_pixels);
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
