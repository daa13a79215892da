#include <core/annotation/mask.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

std::size_t index_of(const PixelBox& box, int column, int row) {
    return static_cast<std::size_t>(row - box.top) * static_cast<std::size_t>(box.width()) +
           static_cast<std::size_t>(column - box.left);
}

/**
 * Adds the part of an edge that lies in one row of pixels: `down` is its signed height in the row, x0 <= x1 its ends. Each
 * entry gets the change of coverage from the pixel on its left, so that a running sum over the row gives the area to the right
 * of all edges: the scheme of FreeType's smooth rasterizer.
 */
void add_edge(std::span<double> change, double x0, double x1, double down) {
    const auto first = static_cast<std::size_t>(x0);
    const auto last = static_cast<std::size_t>(x1);
    if (first == last) {
        const double covered = 1 - (0.5 * (x0 + x1) - static_cast<double>(first));
        change[first] += down * covered;
        change[first + 1] += down * (1 - covered);
        return;
    }
    // Area to the right of the edge in each pixel that it crosses; before is what the pixels so far have been given.
    double before = 0;
    const double slope = down / (x1 - x0);
    for (std::size_t pixel = first; pixel <= last; ++pixel) {
        const double begin = std::max(x0, static_cast<double>(pixel));
        const double end = std::min(x1, static_cast<double>(pixel) + 1);
        const double here = slope * (end - begin);
        const double passed = slope * (begin - x0);
        const double covered = passed + here * (static_cast<double>(pixel) + 1 - 0.5 * (begin + end));
        change[pixel] += covered - before;
        before = covered;
    }
    change[last + 1] += down - before;
}

} // namespace

PixelBox united(const PixelBox& a, const PixelBox& b) {
    if (a.is_empty() || b.is_empty()) {
        return a.is_empty() ? b : a;
    }
    return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

PixelBox moved(const PixelBox& box, int right, int down) {
    return {box.left + right, box.top + down, box.right + right, box.bottom + down};
}

PixelBox grown(const PixelBox& box, int by) { return {box.left - by, box.top - by, box.right + by, box.bottom + by}; }

Mask empty_mask(const PixelBox& box) {
    const std::size_t n = box.is_empty() ? 0 : static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height());
    return {box, std::vector<float>(n), {}, {}};
}

bool is_on_pixels(const Mask& mask) {
    return mask.polygon.size() == 4 && std::ranges::all_of(mask.coverage, [](float part) { return part == 1.0f; });
}

void unite(Mask& onto, const Mask& other) {
    const PixelBox common = {std::max(onto.box.left, other.box.left), std::max(onto.box.top, other.box.top),
                             std::min(onto.box.right, other.box.right), std::min(onto.box.bottom, other.box.bottom)};
    for (int row = common.top; row < common.bottom; ++row) {
        for (int column = common.left; column < common.right; ++column) {
            float& value = onto.coverage[index_of(onto.box, column, row)];
            value = std::max(value, other.coverage[index_of(other.box, column, row)]);
        }
    }
}

Mask polygon_mask(std::span<const Point2> points) {
    if (points.size() < 3) {
        return {};
    }
    Point2 least = points[0], most = points[0];
    for (const Point2& point : points) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            least[axis] = std::min(least[axis], point[axis]);
            most[axis] = std::max(most[axis], point[axis]);
        }
    }
    Mask mask = empty_mask({static_cast<int>(std::floor(least[0])), static_cast<int>(std::floor(least[1])),
                            static_cast<int>(std::ceil(most[0])), static_cast<int>(std::ceil(most[1]))});
    if (mask.box.is_empty()) {
        return {};
    }
    for (const Point2& point : points) {
        mask.polygon.push_back({point[0] - mask.box.left, point[1] - mask.box.top});
    }
    const auto width = static_cast<std::size_t>(mask.box.width());
    // An edge on the right side of the box writes two entries further.
    const std::size_t stride = width + 2;
    std::vector<double> changes(stride * static_cast<std::size_t>(mask.box.height()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        Point2 from = points[i], to = points[(i + 1) % points.size()];
        const double sign = from[1] < to[1] ? 1 : -1;
        if (sign < 0) {
            std::swap(from, to);
        }
        for (auto row = static_cast<int>(std::floor(from[1])); row < to[1] && from[1] < to[1]; ++row) {
            const double begin = std::max(from[1], static_cast<double>(row));
            const double end = std::min(to[1], static_cast<double>(row) + 1);
            const auto x_at = [&](double y) {
                const double t = (y - from[1]) / (to[1] - from[1]);
                return std::clamp((1 - t) * from[0] + t * to[0], least[0], most[0]) - mask.box.left;
            };
            const double x0 = x_at(begin), x1 = x_at(end);
            add_edge(std::span(changes).subspan(static_cast<std::size_t>(row - mask.box.top) * stride, stride),
                     std::min(x0, x1), std::max(x0, x1), sign * (end - begin));
        }
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(mask.box.height()); ++row) {
        double sum = 0;
        for (std::size_t column = 0; column < width; ++column) {
            sum += changes[row * stride + column];
            mask.coverage[row * width + column] = static_cast<float>(std::min(1.0, std::abs(sum)));
        }
    }
    return mask;
}

Mask grown_mask(const Mask& mask, double radius) {
    if (mask.box.is_empty() || !(radius > 0)) {
        return mask;
    }
    const auto reach = static_cast<int>(std::ceil(radius));
    Mask result = empty_mask(grown(mask.box, reach));
    for (int down = -reach; down <= reach; ++down) {
        for (int right = -reach; right <= reach; ++right) {
            // A disc with a soft rim of one pixel.
            const auto weight = static_cast<float>(std::clamp(radius + 0.5 - std::hypot(down, right), 0.0, 1.0));
            if (weight == 0) {
                continue;
            }
            for (int row = mask.box.top; row < mask.box.bottom; ++row) {
                for (int column = mask.box.left; column < mask.box.right; ++column) {
                    float& value = result.coverage[index_of(result.box, column + right, row + down)];
                    value = std::max(value, weight * mask.coverage[index_of(mask.box, column, row)]);
                }
            }
        }
    }
    return result;
}

} // namespace elvis
