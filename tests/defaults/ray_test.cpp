/*
 * The default ray/element intersection: against segments found by dense sampling on curved elements of every shape, and as a
 * tiling of the ray on the analytic plugin.
 */
#include "points.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace elvis;
using test::Point;

namespace {

struct Ray {
    Point origin;
    Point direction;
    std::uint32_t element = 0;
    std::uint32_t unused = 0;
};

struct Segments {
    std::uint32_t count;
    std::uint32_t flags;
    double enter[4];
    double leave[4];
};

std::vector<Segments> intersect(const SnippetInstance& instance, Precision precision, const std::vector<Ray>& rays) {
    KernelRequest request;
    request.name = "ray intersection";
    request.kernel = "ray_test.comp";
    request.kernel_text = R"(
layout(local_size_x = 8) in;
#include "segments/ray_intersection.glsl"
struct core_ray { double o[3]; double d[3]; uint element; uint unused; };
struct core_answer { uint count; uint flags; double enter[4]; double leave[4]; };
layout(set = 0, binding = 0, std430) readonly buffer core_rays_block { core_ray core_rays[]; };
layout(set = 0, binding = 1, std430) writeonly buffer core_answers_block { core_answer core_answers[]; };
layout(push_constant) uniform core_parameters { uint core_n_rays; };
void main() {
    const uint index = gl_GlobalInvocationID.x;
    if (index >= core_n_rays) {
        return;
    }
    const elvis_vec3 origin = elvis_vec3(core_rays[index].o[0], core_rays[index].o[1], core_rays[index].o[2]);
    const elvis_vec3 direction = elvis_vec3(core_rays[index].d[0], core_rays[index].d[1], core_rays[index].d[2]);
    const core_ray_segments segments = core_intersect_ray(core_rays[index].element, origin, direction);
    core_answers[index].count = segments.count;
    core_answers[index].flags = segments.flags;
    for (uint i = 0u; i < 4u; ++i) {
        core_answers[index].enter[i] = i < segments.count ? double(segments.enter[i]) : 0.0;
        core_answers[index].leave[i] = i < segments.count ? double(segments.leave[i]) : 0.0;
    }
}
)";
    request.precision = precision;
    request.instances = {instance};
    request.bindings = {{0, BindingType::storage_buffer}, {1, BindingType::storage_buffer}};
    request.push_constant_bytes = 4;
    const ComposedKernel kernel(test::validated_device(), request);
    const Buffer input(test::validated_device(), rays.size() * sizeof(Ray));
    const Buffer output(test::validated_device(), rays.size() * sizeof(Segments));
    input.write_items(std::span<const Ray>(rays));
    const auto n = static_cast<std::uint32_t>(rays.size());
    const std::array<const Buffer*, 2> bindings{&input, &output};
    kernel.dispatch(bindings, std::as_bytes(std::span(&n, 1)), (n + 7) / 8);
    return output.read_items<Segments>(rays.size());
}

/** Rays through random points of a cube, that start outside of it, at points exact in float32. */
std::vector<Ray> random_rays(int count, double spread) {
    std::mt19937 random(11);
    const auto number = [&random] { return 2 * static_cast<double>(random()) / 4294967296.0 - 1; };
    std::vector<Ray> rays;
    while (static_cast<int>(rays.size()) < count) {
        Ray ray;
        Point target, from;
        for (std::size_t d = 0; d < 3; ++d) {
            target[d] = spread * number();
            from[d] = number();
        }
        const double length = std::sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
        if (length < 0.2 || length > 1) {
            continue;
        }
        for (std::size_t d = 0; d < 3; ++d) {
            ray.direction[d] = -from[d] / length;
            ray.origin[d] = static_cast<double>(static_cast<float>(target[d] + 5 * from[d] / length));
        }
        rays.push_back(ray);
    }
    return rays;
}

/** x1 = xi1 + c xi2^2 / 10, x2 = xi2 - c xi3^2 / 10, x3 = xi3: curved, and inverted at once. */
SnippetInstance bent(elvis_shape shape, int c) {
    SnippetInstance instance;
    instance.shape = shape;
    instance.constants = {{"BENT_TENTHS", c}};
    instance.snippet = {0,
                        "bent",
                        {{"bent.glsl", "elvis_vec3 elvis_mapping(uint element, elvis_vec3 xi) {\n"
                                       "    const elvis_real c = elvis_real(BENT_TENTHS) / elvis_real(10);\n"
                                       "    return elvis_vec3(xi.x + c * xi.y * xi.y, xi.y - c * xi.z * xi.z, xi.z);\n"
                                       "}\n"
                                       "elvis_mat3 elvis_jacobian(uint element, elvis_vec3 xi) {\n"
                                       "    const elvis_real c = elvis_real(BENT_TENTHS) / elvis_real(5);\n"
                                       "    return elvis_mat3(1, 0, 0, c * xi.y, 1, 0, 0, -c * xi.z, 1);\n"
                                       "}\n"
                                       "elvis_real elvis_field_value(uint element, elvis_vec3 xi, uint component) {\n"
                                       "    return xi.x;\n"
                                       "}\n"}}};
    return instance;
}

/** Largest face constraint of the bent element at a world position: <= 0 inside. */
double bent_excess(elvis_shape shape, double c, Point x) {
    const double z = x[2];
    const double y = x[1] + c * z * z;
    const double u = x[0] - c * y * y;
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return std::max({std::abs(u), std::abs(y), std::abs(z)}) - 1;
    case ELVIS_SHAPE_PRISM:
        return std::max({-1 - u, std::abs(y) - 1, -1 - z, u + z});
    case ELVIS_SHAPE_PYRAMID:
        return std::max({-1 - u, -1 - y, -1 - z, u + z, y + z});
    default:
        return std::max({-1 - u, -1 - y, -1 - z, u + y + z + 1});
    }
}

struct Interval {
    double enter, leave;
};

/** Segments by sampling a thousand points a unit length, and bisection. */
std::vector<Interval> sampled_segments(const Ray& ray, elvis_shape shape, double c) {
    const auto excess = [&](double t) {
        Point x;
        for (std::size_t d = 0; d < 3; ++d) {
            x[d] = ray.origin[d] + t * ray.direction[d];
        }
        return bent_excess(shape, c, x);
    };
    const auto root = [&](double outside, double inside) {
        for (int i = 0; i < 60; ++i) {
            const double middle = (outside + inside) / 2;
            (excess(middle) > 0 ? outside : inside) = middle;
        }
        return inside;
    };
    std::vector<Interval> segments;
    double before = 0;
    for (int i = 1; i <= 10000; ++i) {
        const double t = i * 1e-3;
        const bool was_inside = excess(before) <= 0;
        const bool is_inside = excess(t) <= 0;
        if (is_inside && !was_inside) {
            segments.push_back({root(before, t), 0});
        }
        if (was_inside && !is_inside) {
            segments.back().leave = root(t, before);
        }
        before = t;
    }
    return segments;
}

struct Tally {
    int rays = 0, hits = 0, twice = 0, flagged = 0, wrong_in_silence = 0;
    double error = 0;
};

std::vector<std::vector<Interval>> sampled_segments(const std::vector<Ray>& rays, elvis_shape shape, double c) {
    std::vector<std::vector<Interval>> segments;
    for (const Ray& ray : rays) {
        segments.push_back(sampled_segments(ray, shape, c));
    }
    return segments;
}

Tally compare(elvis_shape shape, int tenths, Precision precision, const std::vector<Ray>& rays,
              const std::vector<std::vector<Interval>>& reference) {
    const std::vector<Segments> found = intersect(bent(shape, tenths), precision, rays);
    Tally tally;
    tally.rays = static_cast<int>(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        std::vector<Interval> wanted = reference[i];
        std::vector<Interval> got;
        for (std::uint32_t k = 0; k < found[i].count; ++k) {
            got.push_back({found[i].enter[k], found[i].leave[k]});
        }
        // Shorter than the samples are apart: the reference may not see them.
        std::erase_if(got, [](const Interval& segment) { return segment.leave - segment.enter < 2e-3; });
        std::erase_if(wanted, [](const Interval& segment) { return segment.leave - segment.enter < 2e-3; });
        tally.hits += !wanted.empty();
        tally.twice += wanted.size() > 1;
        if (found[i].flags != 0) {
            ++tally.flagged;
            continue;
        }
        if (got.size() != wanted.size()) {
            ++tally.wrong_in_silence;
            continue;
        }
        for (std::size_t k = 0; k < got.size(); ++k) {
            tally.error =
                std::max({tally.error, std::abs(got[k].enter - wanted[k].enter), std::abs(got[k].leave - wanted[k].leave)});
        }
    }
    return tally;
}

} // namespace

TEST_CASE("rays through curved elements are cut where they enter and leave") {
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_PYRAMID, ELVIS_SHAPE_TETRAHEDRON}) {
        for (const int tenths : {0, 2, 4}) {
            const std::vector<Ray> rays = random_rays(1000, 1.2);
            const auto reference = sampled_segments(rays, shape, tenths / 10.0);
            for (const Precision precision : {Precision::float64, Precision::float32}) {
                const bool is_double = precision == Precision::float64;
                const Tally tally = compare(shape, tenths, precision, rays, reference);
                std::cout << test::shape_name(shape) << ", bent by " << tenths / 10.0
                          << (is_double ? ", float64: " : ", float32: ") << tally.hits << " of " << tally.rays << " rays hit, "
                          << tally.twice << " twice, " << tally.flagged << " flagged, " << tally.wrong_in_silence
                          << " wrong in silence, error " << tally.error << "\n";
                CHECK(tally.wrong_in_silence == 0);
                CHECK(tally.flagged <= tally.rays / 100);
                CHECK(tally.error < (is_double ? 1e-9 : 1e-3));
            }
        }
    }
}

TEST_CASE("rays that leave through an edge or a corner are neither lost nor counted twice") {
    for (const elvis_shape shape : {ELVIS_SHAPE_HEXAHEDRON, ELVIS_SHAPE_PRISM, ELVIS_SHAPE_PYRAMID, ELVIS_SHAPE_TETRAHEDRON}) {
        for (const int tenths : {0, 1}) {
            std::mt19937 random(5);
            const auto bend = [&](Point xi) {
                const double c = tenths / 10.0;
                return Point{xi[0] + c * xi[1] * xi[1], xi[1] - c * xi[2] * xi[2], xi[2]};
            };
            std::vector<Ray> rays;
            // A curved face may already have been passed; then the ray only touches the edge.
            std::vector<bool> leaves_at_target;
            for (const Point& inner : test::points_in(shape, 300, false)) {
                Point eta;
                for (double& coordinate : eta) {
                    coordinate = random() % 2 == 0 ? 1 : -1;
                }
                if (random() % 3 != 0) {
                    eta[random() % 3] = static_cast<double>(random() % 1000) / 500 - 1;
                }
                const Point target = bend(native::expand(native::Shape{shape}, eta));
                const Point through = bend(inner);
                Point d;
                double length = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    d[k] = target[k] - through[k];
                    length += d[k] * d[k];
                }
                length = std::sqrt(length);
                Ray ray;
                for (std::size_t k = 0; k < 3; ++k) {
                    ray.direction[k] = d[k] / length;
                    ray.origin[k] = target[k] - 5 * ray.direction[k];
                }
                rays.push_back(ray);
                Point before;
                for (std::size_t k = 0; k < 3; ++k) {
                    before[k] = target[k] - 1e-4 * ray.direction[k];
                }
                leaves_at_target.push_back(bent_excess(shape, tenths / 10.0, before) < 0);
            }
            for (const Precision precision : {Precision::float64, Precision::float32}) {
                const std::vector<Segments> found = intersect(bent(shape, tenths), precision, rays);
                int n_flagged = 0, n_wrong = 0;
                double error = 0;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    if (found[i].flags != 0) {
                        ++n_flagged;
                    } else if (!leaves_at_target[i]) {
                        continue;
                    } else if (found[i].count == 0) {
                        ++n_wrong;
                    } else {
                        double nearest = 10;
                        for (std::uint32_t k = 0; k < found[i].count; ++k) {
                            nearest = std::min(nearest, std::abs(found[i].leave[k] - 5));
                        }
                        error = std::max(error, nearest);
                    }
                }
                const bool is_double = precision == Precision::float64;
                std::cout << test::shape_name(shape) << ", bent by " << tenths / 10.0 << (is_double ? ", float64" : ", float32")
                          << ": edges and corners " << n_flagged << " flagged, " << n_wrong << " lost of " << rays.size()
                          << ", error " << error << "\n";
                CHECK(n_wrong == 0);
                CHECK(n_flagged <= 6);
                // Where the ray is nearly tangent, t is no better than the square root of the rounding error.
                CHECK(error < (is_double ? 1e-7 : 2e-3));
            }
        }
    }
}

TEST_CASE("the segments of the analytic plugin's elements tile a ray without gap or overlap") {
    const RuntimeVolume volume(Plugin::load(ELVIS_ANALYTIC_PLUGIN), ELVIS_ANALYTIC_SAMPLES "/twisted_box.txt");
    DeviceVolume on_device(test::validated_device(), volume, Precision::float64, nullptr);
    on_device.select(0, 0, {0});
    std::vector<Ray> rays;
    constexpr std::uint32_t n_elements = 27;
    for (Ray ray : random_rays(300, 0.6)) {
        for (ray.element = 0; ray.element < n_elements; ++ray.element) {
            rays.push_back(ray);
        }
    }
    const std::vector<Segments> found = intersect(on_device.instance(0), Precision::float64, rays);
    double largest = 0;
    int n_broken = 0;
    for (std::size_t first = 0; first < rays.size(); first += n_elements) {
        std::vector<Interval> segments;
        bool is_doubtful = false;
        for (std::size_t i = first; i < first + n_elements; ++i) {
            is_doubtful = is_doubtful || found[i].flags != 0;
            for (std::uint32_t k = 0; k < found[i].count; ++k) {
                segments.push_back({found[i].enter[k], found[i].leave[k]});
            }
        }
        std::sort(segments.begin(), segments.end(), [](const Interval& a, const Interval& b) { return a.enter < b.enter; });
        // The twisted box may be left and entered again near an edge of its own; not among these rays.
        double gap = segments.empty() ? 1 : 0;
        for (std::size_t i = 1; i < segments.size(); ++i) {
            gap = std::max(gap, std::abs(segments[i].enter - segments[i - 1].leave));
        }
        n_broken += is_doubtful || gap > 1e-9;
        largest = is_doubtful ? largest : std::max(largest, gap);
    }
    std::cout << "tiling by 27 elements: largest gap or overlap " << largest << ", broken or flagged " << n_broken << " of "
              << rays.size() / n_elements << " rays\n";
    CHECK(n_broken == 0);
}
