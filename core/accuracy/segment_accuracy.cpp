#include "segment_accuracy.hpp"

#include <core/oracle/element/box_tree.hpp>
#include <core/oracle/element/inversion.hpp>

#include <Eigen/Dense>
#include <core/base/bounds.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>

namespace elvis::oracle {
namespace {

Vector convert(const Vector3& v) { return {v[0], v[1], v[2]}; }
Vector3 convert(const Vector& v) { return {v.x(), v.y(), v.z()}; }

/** Where a ray crosses a face of an element, near where it is said to. */
struct Crossing {
    bool is_solved = false;
    double t = 0;
    /** |n.d| */
    double facing = 0;
};

class ExactEnds {
public:
    ExactEnds(const Volume& volume, const Vector& centre) : m_volume(volume), m_centre(centre) {}

    /** xi: a point of the element on the ray. */
    Crossing find(std::size_t element, const SegmentRay& ray, double t, Vector xi) const {
        const Vector origin = m_centre + convert(ray.origin), direction = convert(ray.direction);
        Crossing crossing;
        Matrix jacobian;
        for (int turn = 0; turn < 50; ++turn) {
            const Vector step = (jacobian_at(element, xi, jacobian, origin + t * direction)).eval();
            xi += step.lpNorm<Eigen::Infinity>() > 0.5 ? Vector(0.5 * step / step.lpNorm<Eigen::Infinity>()) : step;
            if (step.lpNorm<Eigen::Infinity>() < 1e-13)
                break;
        }
        const auto faces = face_constraints(m_volume.shape(element));
        const auto face =
            std::ranges::max_element(faces, {}, [&](const FaceConstraint& f) { return f.normal.dot(xi) - f.offset; });
        crossing.t = t;
        for (int turn = 0; turn < 30; ++turn) {
            const Vector position = m_volume.position(element, xi, &jacobian);
            Eigen::Matrix4d system = Eigen::Matrix4d::Zero();
            system.block<3, 3>(0, 0) = jacobian;
            system.block<3, 1>(0, 3) = -direction;
            system.block<1, 3>(3, 0) = face->normal.transpose();
            Eigen::Vector4d residual;
            residual << origin + crossing.t * direction - position, face->offset - face->normal.dot(xi);
            const Eigen::Vector4d step = system.fullPivLu().solve(residual);
            if (!step.allFinite() || step.head<3>().norm() > 1)
                return crossing;
            xi += step.head<3>();
            crossing.t += step[3];
            if (step.lpNorm<Eigen::Infinity>() < 1e-14)
                break;
        }
        m_volume.position(element, xi, &jacobian);
        const Vector normal = (jacobian.inverse().transpose() * face->normal).normalized();
        crossing.facing = std::abs(normal.dot(direction)) / direction.norm();
        crossing.is_solved = excess(m_volume.shape(element), xi) < 1e-4;
        return crossing;
    }

private:
    Vector jacobian_at(std::size_t element, const Vector& xi, Matrix& jacobian, const Vector& target) const {
        const Vector residual = target - m_volume.position(element, xi, &jacobian);
        return jacobian.inverse() * residual;
    }

    const Volume& m_volume;
    Vector m_centre;
};

/** Rays whose lists are in memory at once; rays that a thread takes at once. */
constexpr std::size_t rays_a_batch = 1u << 17, rays_at_once = 256;

struct Judged {
    const Volume& model;
    const std::vector<Enclosure>& enclosures;
    const BoxTree& tree;
    Vector centre;
    double size, promise;
    bool is_double;
};

/** For one thread. */
class SegmentJudge {
public:
    explicit SegmentJudge(const Judged& judged)
        : m(judged), m_inverter(judged.model, judged.enclosures), m_exact(judged.model, judged.centre) {}

    void judge(const SegmentRay& ray, const std::vector<Segment>& list) {
        m_result.n_segments += list.size();
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (i > 0) {
                const double gap = list[i].enter - list[i - 1].leave;
                m_result.n_joints += gap == 0;
                m_result.n_almost_joined += gap != 0 && gap < 10 * m.promise;
            }
            judge_ends(ray, list[i]);
        }
    }

    void judge_points(const SegmentRay& ray, const SegmentList& list, std::size_t n_points, std::mt19937& random) {
        std::uniform_real_distribution<double> coordinate(0, 1);
        for (std::size_t point = 0; point < n_points; ++point)
            judge_point(ray, list, (2 * coordinate(random) - 1) * 0.5 * m.size);
    }

    const SegmentAccuracy& result() const { return m_result; }

private:
    Vector at(const SegmentRay& ray, double t) const { return m.centre + convert(ray.origin) + t * convert(ray.direction); }

    void judge_ends(const SegmentRay& ray, const Segment& segment) {
        const std::vector<Solution> inside =
            m_inverter.find(segment.element, at(ray, 0.5 * (segment.enter + segment.leave)), 1e-6);
        // A segment of rounding length has no middle to speak of.
        if (inside.empty()) {
            m_result.n_unsolved += segment.leave - segment.enter > 10 * m.promise + 2 * segment.error;
            return;
        }
        for (const double t : {segment.enter, segment.leave}) {
            const Crossing crossing = m_exact.find(segment.element, ray, t, inside.front().xi);
            if (!crossing.is_solved) {
                ++m_result.n_unsolved;
                continue;
            }
            const double off = std::abs(t - crossing.t), chord = off * std::max(crossing.facing, 1e-3);
            m_result.end_error = std::max(m_result.end_error, off * crossing.facing / m.size);
            m_result.chord_error = std::max(m_result.chord_error, chord / m.size);
            m_result.n_beyond += !segment.is_estimated && chord > m.promise;
        }
    }

    void judge_point(const SegmentRay& ray, const SegmentList& list, double t) {
        const Vector x = at(ray, t);
        bool is_near_end = false, is_in_segment = false;
        for (const Segment& segment : list.segments) {
            const double margin = 10 * m.promise + segment.error;
            is_near_end = is_near_end || std::abs(t - segment.enter) < margin || std::abs(t - segment.leave) < margin;
            is_in_segment = is_in_segment || (t > segment.enter && t < segment.leave);
        }
        if (is_near_end)
            return;
        bool is_inside = false, is_uncertain = false;
        for (const std::size_t element : m.tree.find(x, m.promise))
            for (const Solution& solution : m_inverter.find(element, x, 1e-4)) {
                is_inside = is_inside || solution.excess <= 0;
                is_uncertain = is_uncertain || std::abs(solution.excess) < (m.is_double ? 1e-9 : 1e-4);
            }
        ++m_result.n_points;
        m_result.n_missed += is_inside && !is_uncertain && !is_in_segment && !list.is_undecided;
        m_result.n_invented += !is_inside && !is_uncertain && is_in_segment;
    }

    const Judged& m;
    Inverter m_inverter;
    ExactEnds m_exact;
    SegmentAccuracy m_result;
};

/** Rays along outer faces. */
class Tangents {
public:
    Tangents(const Volume& model, double size, unsigned seed)
        : m_model(model), m_size(size), m_enclosures(make_enclosures(model)), m_tree(m_enclosures),
          m_inverter(model, m_enclosures), m_random(seed) {}

    /** A point of it, and its direction. */
    std::pair<Vector, Vector> next() {
        std::uniform_int_distribution<std::size_t> any_element(0, m_model.n_elements() - 1);
        std::uniform_real_distribution<double> coordinate(-1, 1), exponent(-5, -2);
        std::normal_distribution<double> normal_distribution;
        while (true) {
            const std::size_t element = any_element(m_random);
            const auto faces = face_constraints(m_model.shape(element));
            const FaceConstraint& face = faces[m_random() % faces.size()];
            Vector xi(coordinate(m_random), coordinate(m_random), coordinate(m_random));
            xi += (face.offset - face.normal.dot(xi)) / face.normal.squaredNorm() * face.normal;
            if (excess(m_model.shape(element), xi) > 1e-12)
                continue;
            Matrix jacobian;
            const Vector point = m_model.position(element, xi, &jacobian);
            const Vector outward = (jacobian.inverse().transpose() * face.normal).normalized();
            if (!outward.allFinite() || is_inside(point + 1e-4 * m_size * outward))
                continue;
            const Vector any(normal_distribution(m_random), normal_distribution(m_random), normal_distribution(m_random));
            return {point - std::pow(10, exponent(m_random)) * m_size * outward, outward.cross(any).normalized()};
        }
    }

private:
    bool is_inside(const Vector& point) {
        return std::ranges::any_of(m_tree.find(point, 0),
                                   [&](std::size_t element) { return !m_inverter.find(element, point, 0).empty(); });
    }

    const Volume& m_model;
    double m_size;
    std::vector<Enclosure> m_enclosures;
    BoxTree m_tree;
    Inverter m_inverter;
    std::mt19937 m_random;
};

} // namespace

SegmentAccuracy& SegmentAccuracy::operator+=(const SegmentAccuracy& other) {
    for (const auto member : {&SegmentAccuracy::n_rays, &SegmentAccuracy::n_segments, &SegmentAccuracy::n_joints,
                              &SegmentAccuracy::n_beyond, &SegmentAccuracy::n_almost_joined, &SegmentAccuracy::n_points,
                              &SegmentAccuracy::n_missed, &SegmentAccuracy::n_invented, &SegmentAccuracy::n_unsolved})
        this->*member += other.*member;
    for (const auto member : {&SegmentAccuracy::end_error, &SegmentAccuracy::chord_error})
        this->*member = std::max(this->*member, other.*member);
    return *this;
}

struct SegmentMeasure::State {
    State(const Device& device, const RuntimeVolume& volume, const Volume& model, Precision precision)
        : data(device, volume, precision, nullptr), pass(device, volume, selected(data, volume)),
          enclosures(make_enclosures(model)),
          tree(enclosures), judged{model,
                                   enclosures,
                                   tree,
                                   convert(Vector3(data.centre())),
                                   diagonal_of(data.bounds()),
                                   (precision == Precision::float64 ? 1e-13 : 1e-6) * diagonal_of(data.bounds()),
                                   precision == Precision::float64},
          judges(std::max(1u, std::thread::hardware_concurrency()), SegmentJudge(judged)) {}

    static DeviceVolume& selected(DeviceVolume& data, const RuntimeVolume& volume) {
        data.select(0, 0, std::vector<double>(volume.fields()[0].n_components, 0.0));
        return data;
    }

    DeviceVolume data;
    SegmentPass pass;
    std::vector<Enclosure> enclosures;
    BoxTree tree;
    Judged judged;
    std::vector<SegmentJudge> judges;
    std::size_t n_rays = 0;
    SegmentCounts counts;
};

SegmentMeasure::SegmentMeasure(const Device& device, const RuntimeVolume& volume, const Volume& model, Precision precision)
    : m_state(std::make_unique<State>(device, volume, model, precision)) {}

SegmentMeasure::~SegmentMeasure() = default;

const DeviceVolume& SegmentMeasure::data() const { return m_state->data; }

void SegmentMeasure::add(std::span<const SegmentRay> rays, std::size_t points_a_ray, unsigned seed) {
    const std::vector<SegmentList> lists = m_state->pass.lists(rays, m_state->counts);
    m_state->n_rays += rays.size();
    std::atomic<std::size_t> next = 0;
    std::vector<std::jthread> threads;
    for (SegmentJudge& judge : m_state->judges)
        threads.emplace_back([&] {
            for (std::size_t begin = next.fetch_add(rays_at_once); begin < rays.size(); begin = next.fetch_add(rays_at_once)) {
                std::mt19937 points(static_cast<unsigned>(seed + begin));
                for (std::size_t k = begin; k < std::min(rays.size(), begin + rays_at_once); ++k) {
                    judge.judge(rays[k], lists[k].segments);
                    judge.judge_points(rays[k], lists[k], points_a_ray, points);
                }
            }
        });
}

SegmentAccuracy SegmentMeasure::result() const {
    SegmentAccuracy result;
    for (const SegmentJudge& judge : m_state->judges)
        result += judge.result();
    result.n_rays = m_state->n_rays;
    result.counts = m_state->counts;
    return result;
}

SegmentAccuracy measure_segments(const Device& device, const RuntimeVolume& volume, const Volume& model, Precision precision,
                                 std::size_t n_rays, std::size_t points_a_ray, unsigned seed) {
    SegmentMeasure measure(device, volume, model, precision);
    const std::array<double, 6>& box = measure.data().bounds();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 1);
    std::normal_distribution<double> normal;
    for (std::size_t first = 0; first < n_rays; first += rays_a_batch) {
        std::vector<SegmentRay> rays;
        for (std::size_t k = first; k < std::min(n_rays, first + rays_a_batch); ++k) {
            Vector point, direction;
            for (std::size_t i = 0; i < 3; ++i) {
                point[static_cast<Eigen::Index>(i)] = box[i] + coordinate(random) * (box[i + 3] - box[i]);
                direction[static_cast<Eigen::Index>(i)] = normal(random);
            }
            const Vector eye = point - 1.5 * diagonal_of(box) * direction.normalized();
            rays.push_back(near_centre(convert(eye), convert(point), measure.data().centre(), precision));
        }
        measure.add(rays, points_a_ray, static_cast<unsigned>(seed + first));
    }
    return measure.result();
}

SegmentAccuracy measure_grazing_segments(const Device& device, const RuntimeVolume& volume, const Volume& model,
                                         Precision precision, std::size_t n_rays, std::size_t points_a_ray, unsigned seed) {
    SegmentMeasure measure(device, volume, model, precision);
    const double size = diagonal_of(measure.data().bounds());
    Tangents tangents(model, size, seed);
    std::vector<SegmentRay> rays;
    while (rays.size() < n_rays) {
        const auto [point, direction] = tangents.next();
        rays.push_back(
            near_centre(convert(point - 1.5 * size * direction), convert(point), measure.data().centre(), precision));
    }
    measure.add(rays, points_a_ray, seed);
    return measure.result();
}

} // namespace elvis::oracle
