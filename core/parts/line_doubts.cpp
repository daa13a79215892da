#include <core/camera/camera_ray.hpp>
#include <core/parts/line_doubts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace elvis {

namespace {

/** Of the widest lines, in pixels; 0 if there are none. */
double width_of_lines(const FrameRequest& request) {
    double width = 0;
    for (const Surface& surface : request.surfaces) {
        width = surface.contours ? std::max(width, surface.contours->style.width) : width;
        width = surface.mesh_lines ? std::max(width, surface.mesh_lines->style.width) : width;
    }
    return width;
}

std::uint32_t open_lines(const FrameRequest& request) {
    std::uint32_t flags = 0;
    for (const Surface& surface : request.surfaces) {
        flags |= surface.contours ? pixel_flag::contour_undecided : 0;
        flags |= surface.mesh_lines ? pixel_flag::mesh_line_undecided : 0;
    }
    return flags;
}

} // namespace

std::uint32_t reach_of_fold(const FrameRequest& request) {
    return open_lines(request) != 0 ? static_cast<std::uint32_t>(line_reach(width_of_lines(request))) : 0;
}

/** Elements that a part shows in a block: layer by layer, -1 where there is none. */
struct LineDoubts::PartLayers {
    PartLayers(std::size_t n_pixels, const PartPixels& part) {
        std::vector<std::uint32_t> n_layers(n_pixels, 0);
        for (const PartPixel& pixel : part.pixels) {
            if (std::isnan(pixel.depth)) {
                continue;
            }
            const std::uint32_t layer = n_layers[pixel.pixel]++;
            if (layer == layers.size()) {
                layers.emplace_back(n_pixels, -1);
            }
            layers[layer][pixel.pixel] = pixel.element;
        }
    }

    std::int64_t element(std::uint32_t layer, std::size_t pixel) const {
        return layer < layers.size() ? layers[layer][pixel] : -1;
    }
    bool is_anywhere(std::int64_t element, std::size_t pixel) const {
        return std::ranges::any_of(layers, [&](const std::vector<std::int64_t>& layer) { return layer[pixel] == element; });
    }

    std::vector<std::vector<std::int64_t>> layers;
};

LineDoubts::LineDoubts(const FrameRequest& request, const PixelBlock& block, std::span<const PartPixels> parts)
    : m_request(request), m_block(block), m_parts(parts), m_width(width_of_lines(request)), m_reach(line_reach(m_width)),
      m_flags(open_lines(request)) {}

void LineDoubts::flag(std::span<const LayerOfPart> sources, Frame& frame) const {
    for (std::size_t index = 0; are_possible() && index < m_parts.size(); ++index) {
        const PartLayers seen(sources.size(), m_parts[index]);
        for (std::size_t pixel = 0; pixel < sources.size(); ++pixel) {
            if (sources[pixel].part == m_parts[index].part && is_open(seen, sources[pixel].layer, pixel, frame)) {
                frame.flags[pixel] = settled_lines(frame.flags[pixel] | m_flags);
            }
        }
    }
}

/** In another layer of the part is good enough for lines of one pixel: what is in front of it there the part has looked at. */
bool LineDoubts::is_open(const PartLayers& seen, std::uint32_t layer, std::size_t pixel, const Frame& frame) const {
    const auto width = static_cast<std::ptrdiff_t>(m_block.width), height = static_cast<std::ptrdiff_t>(m_block.height);
    const auto place = static_cast<std::ptrdiff_t>(pixel);
    const std::ptrdiff_t column = place % width, row = place / width;
    for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(0, row - m_reach); y <= std::min(height - 1, row + m_reach); ++y) {
        for (std::ptrdiff_t x = std::max<std::ptrdiff_t>(0, column - m_reach); x <= std::min(width - 1, column + m_reach);
             ++x) {
            const auto there = static_cast<std::size_t>(y * width + x);
            const std::int64_t element = frame.element[there];
            const bool is_seen =
                seen.element(layer, there) == element || (m_width <= 1 && element >= 0 && seen.is_anywhere(element, there));
            if (!is_seen && (m_width > 1 || may_be_one_surface(pixel, there, frame))) {
                return true;
            }
        }
    }
    return false;
}

Vector3 LineDoubts::point_seen(std::size_t pixel, const Frame& frame) const {
    const PicturePart part = m_request.place();
    const PictureSize size{static_cast<double>(m_request.width), static_cast<double>(part.of_height)};
    const PicturePoint place{static_cast<double>(m_block.first_column + pixel % m_block.width) + 0.5,
                             static_cast<double>(part.first_row + m_block.first_row + pixel / m_block.width) + 0.5};
    return ray_through(m_request.camera, size, place).at(frame.depth[pixel]);
}

/** Not where the way from one point to the other leads out of the surface rather than along it. */
bool LineDoubts::may_be_one_surface(std::size_t pixel, std::size_t other, const Frame& frame) const {
    constexpr double steepest = 0.7; // More than surfaces bend within a pixel, unless they are hardly resolved.
    if (frame.element[other] < 0) {
        return true;
    }
    const Vector3 way = minus(point_seen(other, frame), point_seen(pixel, frame));
    const Vector3 normal{frame.normal[3 * pixel], frame.normal[3 * pixel + 1], frame.normal[3 * pixel + 2]};
    return !(std::abs(dot(normal, way)) > steepest * length(way));
}

} // namespace elvis
