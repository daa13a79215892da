#include "meshes.hpp"

#include <Eigen/Geometry>

namespace elvis::oracle {

using native::Shape;

namespace {

// Corner a of the shape (all coordinates -1) and the edges from there along each reference coordinate.
Map affine(const Vector& a, const Vector& u, const Vector& v, const Vector& w) {
    return [=](const Vector& xi) -> Vector { return a + 0.5 * ((1 + xi.x()) * u + (1 + xi.y()) * v + (1 + xi.z()) * w); };
}

std::vector<Map> split_unit_cell(Shape shape) {
    const Vector e[3] = {Vector::UnitX(), Vector::UnitY(), Vector::UnitZ()};
    std::vector<Map> maps;
    switch (shape) {
    case Shape::hexahedron:
        maps.push_back(affine(Vector::Zero(), e[0], e[1], e[2]));
        break;
    case Shape::prism:
        maps.push_back(affine(Vector::Zero(), e[0], e[1], e[2]));
        maps.push_back(affine(e[0] + e[2], -e[0], e[1], -e[2]));
        break;
    case Shape::pyramid: // a face each, and the middle
        for (int d = 0; d < 3; ++d) {
            const Vector& u = e[(d + 1) % 3];
            const Vector& v = e[(d + 2) % 3];
            const Vector middle = Vector::Constant(0.5);
            maps.push_back(affine(Vector::Zero(), u, v, middle));
            maps.push_back(affine(e[d], v, u, middle - e[d]));
        }
        break;
    default: // Kuhn's split: one for each order of the three directions on the way from (0,0,0) to (1,1,1)
        for (int d = 0; d < 3; ++d) {
            const Vector& u = e[d];
            const Vector& v = e[(d + 1) % 3];
            const Vector& w = e[(d + 2) % 3];
            maps.push_back(affine(Vector::Zero(), u, u + v, u + v + w));
            maps.push_back(affine(Vector::Zero(), v + u, v, u + v + w));
        }
    }
    return maps;
}

} // namespace

std::vector<Map> compose(const std::vector<Map>& maps, const std::function<Vector(const Vector&)>& outer) {
    std::vector<Map> composed;
    for (const Map& map : maps)
        composed.push_back([map, outer](const Vector& xi) -> Vector { return outer(map(xi)); });
    return composed;
}

std::vector<Map> split_cell(Shape shape, const Vector& lower, double size) {
    return compose(split_unit_cell(shape), [=](const Vector& x) -> Vector { return lower + size * x; });
}

std::vector<Map> cube(Shape shape, int n) {
    std::vector<Map> maps;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const std::vector<Map> cell = split_cell(shape, Vector(i, j, k) / n, 1.0 / n);
                maps.insert(maps.end(), cell.begin(), cell.end());
            }
    return maps;
}

Vector quadratic_bend(const Vector& x) {
    return {x.x() + 0.2 * x.y() * x.y() - 0.15 * x.z() * x.x(), x.y() + 0.2 * x.z() * x.z() - 0.2 * x.x() * x.x(),
            1.2 * x.z() - 0.2 * x.x() * x.y() + 0.15 * x.y() * x.y()};
}

VolumeData mixed_volume(int n, std::uint32_t field_order, const Function& function) {
    VolumeData data;
    std::int64_t next_number = 0;
    std::vector<std::vector<Map>> maps(4);
    std::vector<std::vector<std::int64_t>> numbers(4);
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const auto kind = static_cast<std::size_t>(i + 2 * j + 3 * k) % 4;
                for (const Map& map : split_cell(static_cast<Shape>(kind), Vector(i, j, k) / n, 1.0 / n)) {
                    maps[kind].push_back(map);
                    numbers[kind].push_back(next_number++);
                }
            }
    for (std::size_t kind = 0; kind < 4; ++kind) {
        const Shape shape = static_cast<Shape>(kind);
        data.classes.push_back(
            make_class(space_of(shape, 2), space_of(shape, field_order), compose(maps[kind], quadratic_bend), function));
        data.classes.back().numbers = numbers[kind];
    }
    return data;
}

} // namespace elvis::oracle
