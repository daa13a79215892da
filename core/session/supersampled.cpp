#include <core/session/supersampled.hpp>

#include <core/render/picture/count_pixels.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::size_t n_color_channels = 4;

/** Of n by n pixels of a band, from the first of them on. */
std::array<double, n_color_channels> mean(const Frame& band, std::size_t row, std::size_t column, std::uint32_t n) {
    std::array<double, n_color_channels> sum{};
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            const double* const color = &band.color[n_color_channels * ((row + i) * band.width + column + j)];
            for (std::size_t channel = 0; channel < 3; ++channel) {
                sum[channel] += color[3] * color[channel];
            }
            sum[3] += color[3];
        }
    }
    for (std::size_t channel = 0; channel < 3; ++channel) {
        sum[channel] = sum[3] > 0 ? sum[channel] / sum[3] : 0;
    }
    sum[3] /= n * n;
    return sum;
}

/** Rows of the fine picture that make up whole rows of the coarse one, about as many as fit, in some million pixels. */
std::uint32_t fine_rows(std::span<Renderer* const> renderers, const FrameRequest& fine, std::uint32_t n) {
    constexpr std::uint32_t most_pixels = 1u << 22;
    const std::uint32_t unit = part_rows * n;
    const std::uint32_t most = std::min(rows_a_band(renderers, fine), most_pixels / std::max(1u, fine.width));
    return std::max(unit, most / unit * unit);
}

} // namespace

FrameRequest finer(const FrameRequest& request, std::uint32_t n) {
    FrameRequest fine = request;
    fine.width *= n;
    fine.height *= n;
    fine.with_buffers = false;
    for (double& shift : fine.camera.image_shift) {
        shift *= n;
    }
    for (Surface& surface : fine.surfaces) {
        if (surface.contours) {
            surface.contours->style.width *= n;
        }
        if (surface.mesh_lines) {
            surface.mesh_lines->style.width *= n;
        }
        if (surface.lic) {
            surface.lic->length *= n;
            surface.lic->grain *= n;
        }
        if (auto* const wires = std::get_if<WireFrame>(&surface.geometry)) {
            wires->width *= n;
        }
    }
    return fine;
}

void take_means(const Frame& fine, const Rows& rows, std::uint32_t n, std::vector<double>& color) {
    const std::size_t width = fine.width / n;
    for (std::uint32_t row = rows.first / n; row < rows.end / n; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const std::array<double, n_color_channels> own = mean(fine, row * n - rows.first, column * n, n);
            std::copy(own.begin(), own.end(), &color[n_color_channels * (row * width + column)]);
        }
    }
}

void take_doubts(const Frame& fine, const Rows& rows, std::uint32_t n, Frame& frame) {
    constexpr std::uint32_t doubts = pixel_flag::newton_failure | pixel_flag::isosurface_undecided |
                                     pixel_flag::volume_tolerance | pixel_flag::undecided | pixel_flag::contour_undecided |
                                     pixel_flag::mesh_line_undecided | pixel_flag::work_limit | pixel_flag::estimated |
                                     pixel_flag::overlap;
    for (std::size_t sample = 0; sample < fine.flags.size(); ++sample) {
        if (const std::uint32_t flags = fine.flags[sample] & doubts; flags != 0) {
            const std::size_t row = (rows.first + sample / fine.width) / n, column = sample % fine.width / n;
            add_flags(frame, row * frame.width + column, flags);
        }
    }
}

SupersampledColors supersampled(std::span<Renderer* const> renderers, const FrameRequest& request, std::uint32_t n,
                                const TaskControl* control) {
    const FrameRequest fine = finer(request, n);
    SupersampledColors result;
    result.color.resize(n_color_channels * request.width * request.height);
    const auto take = [&](const Frame& band, const Rows& rows) { take_means(band, rows, n, result.color); };
    const Frame work = render_bands(renderers, fine, fine_rows(renderers, fine, n), control, take);
    result.render_milliseconds = work.render_milliseconds;
    result.device_milliseconds = work.device_milliseconds;
    return result;
}

} // namespace elvis
