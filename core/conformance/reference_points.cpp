#include <core/conformance/reference_points.hpp>

#include <core/conformance/scratch.hpp>
#include <core/volume/element/reference_corners.hpp>

#include <algorithm>
#include <set>

namespace elvis::conformance {

Point expand(elvis_shape shape, Point eta) {
    auto [x, y, z] = eta;
    switch (shape) {
    case ELVIS_SHAPE_PRISM:
        return {0.5 * (1 + x) * (1 - z) - 1, y, z};
    case ELVIS_SHAPE_PYRAMID:
        return {0.5 * (1 + x) * (1 - z) - 1, 0.5 * (1 + y) * (1 - z) - 1, z};
    case ELVIS_SHAPE_TETRAHEDRON:
        y = 0.5 * (1 + y) * (1 - z) - 1;
        return {0.5 * (1 + x) * (-y - z) - 1, y, z};
    case ELVIS_SHAPE_QUADRILATERAL:
        return {x, y, 0};
    case ELVIS_SHAPE_TRIANGLE:
        return {0.5 * (1 + x) * (1 - y) - 1, y, 0};
    default:
        return eta;
    }
}

std::uint32_t n_corners(elvis_shape shape) {
    constexpr std::uint32_t counts[] = {8, 6, 5, 4, 4, 3};
    return counts[shape];
}

std::uint32_t n_faces(elvis_shape shape) {
    constexpr std::uint32_t counts[] = {6, 5, 5, 4, 4, 3};
    return counts[shape];
}

const char* shape_name(elvis_shape shape) {
    constexpr const char* names[] = {"hexahedron", "prism", "pyramid", "tetrahedron", "quadrilateral", "triangle"};
    return names[shape];
}

std::vector<Point> points_in(elvis_shape shape, std::size_t count, std::uint64_t seed) {
    std::vector<Point> points;
    for (std::uint32_t corner = 0; corner < n_corners(shape) && points.size() < count; ++corner) {
        points.push_back(reference_corner(shape, corner));
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
