#include "random_volumes.hpp"

#include "meshes.hpp"
#include "random.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace elvis::oracle {
namespace {

using native::Shape;

// Sum of c T_i(x) T_j(y) T_k(z).
class Polynomial {
public:
    // Of total order `order`, or of that order in each direction; coefficients shrink by `decay` with each order.
    Polynomial(Random& random, int order, bool is_tensor, double decay) : m_order(order) {
        for (int k = 0; k <= order; ++k)
            for (int j = 0; j <= order; ++j)
                for (int i = 0; i <= order; ++i) {
                    const double c = random.between(-1, 1) * std::pow(decay, i + j + k);
                    m_coefficients.push_back(is_tensor || i + j + k <= order ? c : 0);
                }
    }

    double operator()(const Vector& x) const {
        std::array<std::array<double, 12>, 3> values{};
        for (std::size_t d = 0; d < 3; ++d) {
            const double s = x[static_cast<Eigen::Index>(d)];
            values[d][0] = 1;
            values[d][1] = s;
            for (std::size_t i = 2; i < values[d].size(); ++i)
                values[d][i] = 2 * s * values[d][i - 1] - values[d][i - 2];
        }
        double sum = 0;
        auto c = m_coefficients.begin();
        const auto n = static_cast<std::size_t>(m_order);
        for (std::size_t k = 0; k <= n; ++k)
            for (std::size_t j = 0; j <= n; ++j)
                for (std::size_t i = 0; i <= n; ++i)
                    sum += *c++ * values[0][i] * values[1][j] * values[2][k];
        return sum;
    }

private:
    int m_order;
    std::vector<double> m_coefficients;
};

using Bend = std::function<Vector(const Vector&)>;

// Of the cube [-1,1]^3; `strength` is the 2-norm of what the derivative differs from 1 by, at its largest among samples.
Bend random_bend(Random& random, int order, bool is_tensor, double strength) {
    std::vector<Polynomial> parts;
    for (int d = 0; d < 3; ++d)
        parts.emplace_back(random, order, is_tensor, 0.8);
    const auto off = [parts](const Vector& x) -> Vector { return {parts[0](x), parts[1](x), parts[2](x)}; };
    double largest = 0;
    constexpr int n = 8;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const Vector x = Vector(i, j, k) * 2.0 / n - Vector::Ones();
                Matrix slope;
                // Exact for cubic polynomials but for rounding of the second difference.
                constexpr double h = 1e-3;
                for (Eigen::Index d = 0; d < 3; ++d)
                    slope.col(d) = (off(x + h * Vector::Unit(d)) - off(x - h * Vector::Unit(d))) / (2 * h);
                largest = std::max(largest, Eigen::JacobiSVD<Matrix>(slope).singularValues()[0]);
            }
    const double factor = strength / largest;
    return [off, factor](const Vector& x) -> Vector { return x + factor * off(x); };
}

struct Group {
    Shape shape;
    std::vector<Map> maps;
};

// Cells of a box within [-1,1]^3, of one shape or, for kind 4, of all in turn.
std::vector<Group> random_mesh(Random& random, int kind) {
    const int largest = kind == 0 || kind == 4 ? 2 : 1;
    std::array<int, 3> n{};
    for (int& cells : n)
        cells = random.whole(1, largest);
    if (kind == 4)
        n = {2, 2, 1};
    std::vector<Group> groups;
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const auto shape = static_cast<Shape>(kind == 4 ? i + 2 * j : kind);
                const double size = 2.0 / std::max({n[0], n[1], n[2]});
                const std::vector<Map> maps = split_cell(shape, size * Vector(i, j, k) - Vector::Ones(), size);
                const auto same = std::ranges::find(groups, shape, &Group::shape);
                if (same == groups.end())
                    groups.push_back({shape, maps});
                else
                    same->maps.insert(same->maps.end(), maps.begin(), maps.end());
            }
    return groups;
}

Vector random_xi(Random& random, Shape shape) {
    for (;;) {
        const Vector xi = random.in_cube();
        if (excess(shape, xi) <= 0)
            return xi;
    }
}

Camera random_camera(Random& random, const Volume& volume, const Vector& centre, double size) {
    const auto array = [](const Vector& v) { return Vector3{v.x(), v.y(), v.z()}; };
    Camera camera;
    const Vector direction = random.direction();
    camera.look_at = array(centre + 0.05 * size * random.in_cube());
    const double distance = random.between(0.6, 2) * size;
    camera.eye = array(centre + distance * direction);
    // The ball around the volume, or a part of it, fills the picture.
    camera.field_of_view = random.between(0.6, 1) * std::atan(0.5 * size / distance) * 360 / std::numbers::pi;
    if (random.one_in(8)) {
        const auto element = static_cast<std::size_t>(random.whole(0, static_cast<int>(volume.n_elements()) - 1));
        camera.eye = array(volume.position(element, random_xi(random, volume.shape(element))));
        camera.look_at = array(volume.position(element, random_xi(random, volume.shape(element))));
        camera.field_of_view = random.between(50, 100);
    }
    camera.up = array(direction.unitOrthogonal());
    camera.orthographic = random.one_in(6);
    camera.height = random.between(0.5, 1) * size;
    return camera;
}

} // namespace

RandomVolume random_volume(std::uint64_t seed) {
    static const char* const kinds[] = {"hexahedra", "prisms", "pyramids", "tetrahedra", "all shapes"};
    Random random(seed * 0x9E3779B97F4A7C15ull + 1);
    const int kind = random.whole(0, 4);
    const int field_order = random.whole(2, 10);
    const int geometry_order = random.whole(1, 3);
    const bool is_continuous = random.one_in(2);
    // The coordinate directions of prisms, pyramids and tetrahedra mix.
    const bool is_tensor = kind == 0;
    const double decay = random.between(0.55, 1);

    const double strength = random.between(0.3, 0.75);
    const Bend bend = random_bend(random, geometry_order, is_tensor, strength);
    const auto shared = std::make_shared<Polynomial>(random, field_order, is_tensor, decay);
    RandomVolume result;
    std::int64_t number = 0;
    for (const Group& group : random_mesh(random, kind)) {
        const auto order = static_cast<std::uint32_t>(field_order);
        const native::Space geometry = space_of(group.shape, static_cast<std::uint32_t>(geometry_order)),
                            field = space_of(group.shape, order);
        ClassData data = make_class(
            geometry, space_of(group.shape, 1), compose(group.maps, bend), [](const Vector&) { return 0.0; }, number);
        number += static_cast<std::int64_t>(group.maps.size());
        data.field = field;
        data.field_coefficients.clear();
        const Fit fit(field);
        for (const Map& map : group.maps) {
            const std::vector<double> c = is_continuous ? fit([&](const Vector& xi) { return (*shared)(map(xi)); })
                                                        : fit(Polynomial(random, field_order, is_tensor, decay));
            data.field_coefficients.insert(data.field_coefficients.end(), c.begin(), c.end());
        }
        result.data.classes.push_back(std::move(data));
    }

    const Volume volume(result.data);
    std::vector<double> samples;
    Vector lower = Vector::Constant(1e30), upper = -lower;
    for (std::size_t element = 0; element < volume.n_elements(); ++element)
        for (int i = 0; i < 200; ++i) {
            const Vector xi = random_xi(random, volume.shape(element));
            const Vector x = volume.position(element, xi);
            lower = lower.cwiseMin(x);
            upper = upper.cwiseMax(x);
            samples.push_back(volume.component(element, xi, 0));
        }
    std::sort(samples.begin(), samples.end());
    const int n_values = random.one_in(3) ? random.whole(2, 3) : 1;
    for (int k = 0; k < n_values; ++k)
        result.values.push_back(
            samples[static_cast<std::size_t>(random.between(0.02, 0.98) * static_cast<double>(samples.size()))]);
    std::sort(result.values.begin(), result.values.end());
    const Vector centre = 0.5 * (lower + upper);
    const double size = (upper - lower).norm();
    result.camera = random_camera(random, volume, centre, size);
    if (random.one_in(6)) {
        const Vector normal = random.direction();
        result.clip.push_back({normal.x(), normal.y(), normal.z(), -normal.dot(centre + 0.1 * size * random.in_cube())});
    }
    result.description = std::string(kinds[kind]) + ", " + std::to_string(number) + " elements, geometry of order " +
                         std::to_string(geometry_order) + ", " + (is_continuous ? "" : "dis") + "continuous field of order " +
                         std::to_string(field_order) + ", " + std::to_string(n_values) + " isovalues" +
                         (result.camera.orthographic ? ", orthographic" : "") + (result.clip.empty() ? "" : ", clipped");
    return result;
}

} // namespace elvis::oracle
