#include <core/conformance/reference_points.hpp>

#include <core/conformance/random.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <set>

namespace elvis::conformance {

namespace {

/** From the cube into the shape. */
Point expand(elvis_shape shape, Point eta) {
    if (native::dimension(native::Shape{shape}) == 2) {
        eta[2] = 0;
    }
    return native::expand(native::Shape{shape}, eta);
}

} // namespace

std::string shape_name(elvis_shape shape) { return std::string(native::name(native::Shape{shape})); }

std::vector<Point> points_in(elvis_shape shape, std::size_t count, std::uint64_t seed) {
    std::vector<Point> points;
    for (int corner = 0; corner < native::n_corners(native::Shape{shape}) && points.size() < count; ++corner) {
        points.push_back(native::corner(native::Shape{shape}, corner));
    }
    Random random(seed);
    while (points.size() < count) {
        Point eta;
        for (double& coordinate : eta) {
            const double inside = random.uniform(-1, 1);
            const std::uint64_t place = random.below(8);
            coordinate = place == 0 ? -1 : place == 1 ? 1 : inside;
        }
        points.push_back(expand(shape, eta));
    }
    return points;
}

std::vector<Point> interior_points(elvis_shape shape, std::size_t count, std::uint64_t seed) {
    std::vector<Point> points;
    Random random(seed);
    while (points.size() < count) {
        points.push_back(expand(shape, {random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9)}));
    }
    return points;
}

std::vector<double> flat(const std::vector<Point>& points) {
    std::vector<double> numbers;
    numbers.reserve(3 * points.size());
    for (const Point& point : points) {
        numbers.insert(numbers.end(), point.begin(), point.end());
    }
    return numbers;
}

std::uint32_t class_of(const RuntimeVolume& volume, std::uint64_t element) {
    const auto& classes = volume.classes();
    const auto after = std::upper_bound(classes.begin(), classes.end(), element,
                                        [](std::uint64_t e, const ClassInfo& c) { return e < c.first_element; });
    return static_cast<std::uint32_t>(std::prev(after) - classes.begin());
}

std::vector<std::uint64_t> some_elements(const RuntimeVolume& volume, std::size_t count, std::uint64_t seed) {
    std::set<std::uint64_t> elements;
    Random random(seed);
    for (const ClassInfo& info : volume.classes()) {
        if (info.n_elements == 0) {
            continue;
        }
        elements.insert(info.first_element);
        elements.insert(info.first_element + info.n_elements - 1);
        for (std::size_t i = 2; i < count; ++i) {
            elements.insert(info.first_element + random.below(info.n_elements));
        }
    }
    return {elements.begin(), elements.end()};
}

} // namespace elvis::conformance
