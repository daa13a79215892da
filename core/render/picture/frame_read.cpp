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

template <class T> std::span<const T> as(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/** Samples, marks and normals of all pixels. */
template <class Real>
void fill_buffers(std::span<const Sample<Real>> samples, std::span<const Mark> marks, std::span<const Real> normals,
                  const std::vector<SurfaceFacts>& facts, Frame& frame) {
    const std::size_t n_pixels = marks.size();
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

SurfaceFacts surface_facts(const SurfaceDrawing& drawing) {
    SurfaceFacts facts{drawing.offset(), {}};
    if (drawing.traits().plane != nullptr) {
        facts.normal = drawing.rays().normal;
    }
    return facts;
}

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

LayerRead::LayerRead(const Layer& from, Precision precision, bool with_buffers)
    : m_from(from), m_precision(precision), m_with_buffers(with_buffers),
      m_colors(4 * from.n_pixels() * real_bytes(precision)) {
    if (with_buffers) {
        m_marks.resize(from.n_pixels() * sizeof(Mark));
        m_samples.resize(from.n_pixels() * sample_bytes(precision));
        m_normals.resize(3 * from.n_pixels() * real_bytes(precision));
    }
}

std::vector<Buffer::Read> LayerRead::reads() {
    return {{&m_from.colors, m_colors}, {&m_from.marks, m_marks}, {&m_from.samples, m_samples}, {&m_from.normals, m_normals}};
}

void LayerRead::fill(const std::vector<SurfaceFacts>& facts, Frame& frame) const {
    with_real(m_precision, [&]<class Real>(Real) {
        const std::span<const Real> colors = as<Real>(m_colors);
        frame.color.assign(colors.begin(), colors.end());
        if (m_with_buffers) {
            fill_buffers(as<Sample<Real>>(m_samples), as<Mark>(m_marks), as<Real>(m_normals), facts, frame);
        }
    });
}

} // namespace elvis
