#include "surface_fixture.hpp"

#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

namespace elvis::oracle {

namespace {

template <class Real>
void read(const Buffer& samples, const Buffer& normals, const Buffer& bending, const std::vector<Mark>& marks,
          SurfacePicture& picture) {
    const std::size_t n = marks.size();
    const auto read_samples = samples.read_items<Sample<Real>>(n);
    const auto read_normals = normals.read_items<Real>(3 * n);
    const auto read_bending = bending.read_items<Real>(n);
    for (std::size_t i = 0; i < n; ++i) {
        // As picture/color.comp does: on a face that no other element shares the domain may end.
        const bool is_at_edge = (marks[i].owner & 2u) != 0 && (marks[i].owner & 4u) == 0;
        picture.flags[i] = marks[i].flags | (is_at_edge ? pixel_flag::undecided : 0);
        if (marks[i].surface() == 0)
            continue;
        picture.value[i] = static_cast<double>(read_samples[i].value);
        picture.depth[i] = static_cast<double>(read_samples[i].depth);
        picture.element[i] =
            read_samples[i].number == no_number ? outside_element : static_cast<std::int64_t>(read_samples[i].number);
        picture.bending[i] = static_cast<double>(read_bending[i]);
        picture.normal[i] = Eigen::Matrix<Real, 3, 1>(read_normals.data() + 3 * i).template cast<double>();
    }
}

// Across the view, through the middle of the bounds.
CutPlane plane_across(const Camera& camera, const std::array<double, 6>& bounds) {
    CutPlane plane;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        plane.plane[axis] = camera.look_at[axis] - camera.eye[axis];
        plane.plane[3] -= plane.plane[axis] * 0.5 * (bounds[axis] + bounds[axis + 3]);
    }
    return plane;
}

LongVector at(const Ray& ray, long double t) { return ray.origin + t * ray.direction; }

} // namespace

SurfaceScene::SurfaceScene(const std::string& path, Precision precision)
    : m_precision(precision), m_volume(open_volume(path)), m_data(device(), m_volume, precision, nullptr) {
    m_data.select(0, 0, {0.0});
    m_pass.emplace(device(), m_volume, m_data);
    m_pass->provide_elements();
}

SurfacePicture SurfaceScene::draw(const SurfaceSolver& solver, const CutShape& shape, const Camera& camera, std::uint32_t width,
                                  std::uint32_t height, const std::vector<double>& beyond, bool shows_outside) {
    const std::size_t n = std::size_t{width} * height;
    const Layer layer(device(), m_precision, width, height);
    std::optional<Buffer> behind;
    if (!beyond.empty()) {
        behind.emplace(device(), n * real_bytes(m_precision));
        write_reals(*behind, m_precision, beyond);
    }
    layer.marks.fill(0);
    SurfacePicture picture;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    picture.value.assign(n, nan);
    picture.depth.assign(n, nan);
    picture.bending.assign(n, nan);
    picture.normal.assign(n, Vector::Constant(nan));
    picture.element.assign(n, -1);
    picture.flags.assign(n, 0);
    const CutPlaneGeometry view =
        cut_plane_geometry(plane_across(camera, m_data.bounds()), camera, width, height, m_data.centre());
    m_pass->draw(view, solver, shape, 1, {0, 1, false}, shows_outside, {layer, behind ? &*behind : nullptr}, picture.counts);
    const auto read_marks = layer.marks.read_items<Mark>(n);
    if (m_precision == Precision::float64)
        read<double>(layer.samples, layer.normals, m_pass->bending(), read_marks, picture);
    else
        read<float>(layer.samples, layer.normals, m_pass->bending(), read_marks, picture);
    return picture;
}

std::vector<double> crossings(const Ray& ray, const LevelFunction& function, double from, double to, int n) {
    const long double step = (static_cast<long double>(to) - from) / n;
    const auto value = [&](long double t) { return function(at(ray, t)); };
    const auto bisect = [&](long double low, long double high) {
        const bool is_positive = value(low) > 0;
        for (int i = 0; i < 70; ++i) {
            const long double middle = (low + high) / 2;
            ((value(middle) > 0) == is_positive ? low : high) = middle;
        }
        return static_cast<double>((low + high) / 2);
    };
    std::vector<double> found;
    long double before = value(from), here = before;
    for (int i = 0; i < n; ++i) {
        const long double t = from + i * step;
        const long double next = value(t + step);
        if ((here > 0) != (next > 0)) {
            found.push_back(bisect(t, t + step));
        } else if (i > 0 && (before > 0) == (here > 0) && std::abs(here) <= std::abs(before) &&
                   std::abs(here) <= std::abs(next)) {
            // Towards the other sign, by thirds.
            const long double sign = here > 0 ? 1 : -1;
            long double low = t - step, high = t + step;
            for (int k = 0; k < 80; ++k) {
                const long double a = low + (high - low) / 3, b = high - (high - low) / 3;
                const long double at_a = sign * value(a), at_b = sign * value(b);
                if (std::min(at_a, at_b) <= 0) {
                    const long double beyond = at_a < at_b ? a : b;
                    found.push_back(bisect(t - step, beyond));
                    found.push_back(bisect(beyond, t + step));
                    break;
                }
                (at_a < at_b ? high : low) = at_a < at_b ? b : a;
            }
        }
        before = here;
        here = next;
    }
    std::sort(found.begin(), found.end());
    return found;
}

VolumeData two_blocks() {
    // Bent in y and z, where the map keeps the box.
    const auto bend = [](const Vector& q) -> Vector {
        return {q.x(), q.y() + 0.15 * (1 - q.y() * q.y()) * q.z(), q.z() - 0.1 * (1 - q.z() * q.z()) * q.y()};
    };
    std::vector<Map> maps = boxes({-1, -1, -1}, {-0.3, 1, 1}, {1, 3, 3});
    const std::vector<Map> right = boxes({0.3, -1, -1}, {1, 1, 1}, {1, 3, 3});
    maps.insert(maps.end(), right.begin(), right.end());
    VolumeData data;
    data.classes.push_back(make_class(space_of(native::Shape::hexahedron, 2), space_of(native::Shape::hexahedron, 4),
                                      compose(maps, bend), field_of));
    return data;
}

bool is_in_two_blocks(const Vector& x) { return x.cwiseAbs().maxCoeff() <= 1 && std::abs(x.x()) >= 0.3; }

double field_of(const Vector& x) { return 1 + x.x() - 0.5 * x.y() + 0.3 * x.z() * x.y() + 0.4 * x.x() * x.x(); }

SurfaceComparison compare(const SurfacePicture& picture, const Camera& camera, std::uint32_t width, std::uint32_t height,
                          const Crossings& crossings_of, const std::function<Vector(const Vector&)>& gradient,
                          const Membership& is_inside) {
    SurfaceComparison result;
    const double size = 2 * std::sqrt(3.0);
    for (std::uint32_t row = 0; row < height; ++row)
        for (std::uint32_t column = 0; column < width; ++column) {
            const std::size_t pixel = std::size_t{row} * width + column;
            const Ray ray = pixel_ray(camera, width, height, column, row);
            // The part of the ray in the box.
            long double from = 1e-9L, to = 1e9L;
            for (int axis = 0; axis < 3; ++axis) {
                const long double one = (-1 - ray.origin[axis]) / ray.direction[axis];
                const long double other = (1 - ray.origin[axis]) / ray.direction[axis];
                from = std::max(from, std::min(one, other));
                to = std::min(to, std::max(one, other));
            }
            double t = std::numeric_limits<double>::quiet_NaN();
            if (from < to)
                for (const double candidate : crossings_of(ray, static_cast<double>(from), static_cast<double>(to)))
                    if (is_inside(at(ray, candidate).cast<double>())) {
                        t = candidate;
                        break;
                    }
            if ((picture.flags[pixel] & pixel_flag::estimated) != 0)
                ++result.estimated;
            if ((picture.flags[pixel] & pixel_flag::undecided) != 0) {
                ++result.undecided;
                continue;
            }
            const bool is_hit = picture.element[pixel] >= 0;
            if (std::isnan(t) || !is_hit) {
                result.missed += !std::isnan(t) ? 1 : 0;
                result.extra += is_hit ? 1 : 0;
                if (is_hit || !std::isnan(t))
                    result.worst = pixel;
                continue;
            }
            ++result.hits;
            const Vector x = at(ray, t).cast<double>();
            const Vector normal = gradient(x).normalized();
            const double facing = std::abs(normal.dot(ray.direction.cast<double>()));
            const double off = std::abs(picture.depth[pixel] - t) / size;
            if (facing >= 0.05 && off > result.depth_error) {
                result.depth_error = off;
                result.worst = pixel;
            }
            if (facing < 0.05)
                result.distance_error = std::max(result.distance_error, off * facing);
            result.value_error = std::max(result.value_error, std::abs(picture.value[pixel] - field_of(x)));
            result.normal_error = std::max(result.normal_error, 1 - std::abs(picture.normal[pixel].dot(normal)));
        }
    return result;
}

std::string to_text(const SurfaceComparison& comparison) {
    std::ostringstream text;
    text << comparison.hits << " hits, " << comparison.missed << " missed, " << comparison.extra << " extra, "
         << comparison.undecided << " undecided, " << comparison.estimated << " estimated, depth " << comparison.depth_error
         << ", distance " << comparison.distance_error << ", value " << comparison.value_error << ", normal "
         << comparison.normal_error << ", worst pixel " << comparison.worst;
    return text.str();
}

void check_no_gaps(const std::string& volume, const CutShape& shape, const Eigen::AngleAxisd& turn, std::uint32_t side,
                   double height, const std::string& what) {
    Camera camera;
    const Vector middle(0.65, 0, 0), eye = middle + turn * Vector(4, 0, 0), up = turn * Vector(0, 0, 1);
    camera.eye = {eye.x(), eye.y(), eye.z()};
    camera.look_at = {middle.x(), middle.y(), middle.z()};
    camera.up = {up.x(), up.y(), up.z()};
    camera.orthographic = true;
    camera.height = height;
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        SurfaceScene scene(volume, precision);
        const SurfaceSolver solver(device(), precision, shape, scene.data().bounds());
        const SurfacePicture picture = scene.draw(solver, shape, camera, side, side);
        std::size_t missed = 0, undecided = 0;
        for (std::size_t pixel = 0; pixel < picture.element.size(); ++pixel) {
            missed += picture.element[pixel] < 0 ? 1 : 0;
            undecided += (picture.flags[pixel] & pixel_flag::undecided) != 0 ? 1 : 0;
        }
        WARN("tilt " << turn.angle() << (precision == Precision::float32 ? ", float32: " : ", float64: ")
                     << picture.element.size() << ' ' << what << ", " << missed << " missed, " << undecided << " undecided");
        CHECK(missed == 0);
        CHECK(undecided == 0);
    }
}

Camera camera_at(const Vector3& eye, double field_of_view, const Vector3& look_at) {
    Camera camera;
    camera.look_at = look_at;
    camera.eye = eye;
    camera.up = {0.1, 0.2, 1};
    camera.field_of_view = field_of_view;
    return camera;
}

} // namespace elvis::oracle
