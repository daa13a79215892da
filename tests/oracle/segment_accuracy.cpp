#include "segment_accuracy.hpp"

#include "box_tree.hpp"
#include "inversion.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>

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
        const auto face = std::ranges::max_element(faces, {}, [&](const FaceConstraint& f) { return f.normal.dot(xi) - f.offset; });
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

} // namespace

SegmentAccuracy measure_segments(const Device& device, const RuntimeVolume& volume, const Volume& model, Precision precision,
                                 std::size_t n_rays, std::size_t points_a_ray, unsigned seed) {
    DeviceVolume data(device, volume, precision, nullptr);
    data.select(0, 0, std::vector<double>(volume.fields()[0].n_components, 0.0));
    const SegmentPass pass(device, volume, data);
    const std::array<double, 6>& box = data.bounds();
    const Vector lower(box[0], box[1], box[2]), upper(box[3], box[4], box[5]), centre = convert(Vector3(data.centre()));
    const double size = (upper - lower).norm();
    const double promise = (precision == Precision::float64 ? 1e-13 : 1e-6) * size;

    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 1);
    std::normal_distribution<double> normal;
    std::vector<SegmentRay> rays;
    for (std::size_t k = 0; k < n_rays; ++k) {
        Vector point, direction;
        for (int i = 0; i < 3; ++i) {
            point[i] = lower[i] + coordinate(random) * (upper[i] - lower[i]);
            direction[i] = normal(random);
        }
        const Vector eye = point - 1.5 * size * direction.normalized();
        rays.push_back(near_centre(convert(eye), convert(point), data.centre(), precision));
    }
    SegmentAccuracy result;
    const std::vector<std::vector<Segment>> lists = pass.lists(rays, result.counts);

    const std::vector<Enclosure> enclosures = make_enclosures(model);
    const BoxTree tree(enclosures);
    Inverter inverter(model, enclosures);
    const ExactEnds exact(model, centre);
    result.n_rays = n_rays;
    for (std::size_t k = 0; k < n_rays; ++k) {
        const SegmentRay& ray = rays[k];
        const Vector origin = centre + convert(ray.origin), direction = convert(ray.direction);
        const std::vector<Segment>& list = lists[k];
        result.n_segments += list.size();
        for (std::size_t i = 0; i < list.size(); ++i) {
            const Segment& segment = list[i];
            const bool follows = i > 0;
            if (follows) {
                const double gap = segment.enter - list[i - 1].leave;
                result.n_joints += gap == 0;
                result.n_almost_joined += gap != 0 && gap < 10 * promise;
            }
            const std::vector<Solution> inside =
                inverter.find(segment.element, origin + 0.5 * (segment.enter + segment.leave) * direction, 1e-6);
            // A segment of rounding length has no middle to speak of.
            if (inside.empty()) {
                result.n_unsolved += segment.leave - segment.enter > 10 * promise + 2 * segment.error;
                continue;
            }
            for (const double t : {segment.enter, segment.leave}) {
                const Crossing crossing = exact.find(segment.element, ray, t, inside.front().xi);
                if (!crossing.is_solved) {
                    ++result.n_unsolved;
                    continue;
                }
                const double off = std::abs(t - crossing.t);
                result.end_error = std::max(result.end_error, off * crossing.facing / size);
                result.chord_error = std::max(result.chord_error, off * std::max(crossing.facing, 1e-3) / size);
                result.n_beyond += !segment.is_estimated && off * std::max(crossing.facing, 1e-3) > promise;
            }
        }
        for (std::size_t point = 0; point < points_a_ray; ++point) {
            const double t = (2 * coordinate(random) - 1) * 0.5 * size;
            const Vector x = origin + t * direction;
            bool is_near_end = false, is_in_segment = false;
            for (const Segment& segment : list) {
                const double margin = 10 * promise + segment.error;
                is_near_end = is_near_end || std::abs(t - segment.enter) < margin || std::abs(t - segment.leave) < margin;
                is_in_segment = is_in_segment || (t > segment.enter && t < segment.leave);
            }
            if (is_near_end)
                continue;
            bool is_inside = false, is_doubtful = false;
            for (const std::size_t element : tree.find(x, promise))
                for (const Solution& solution : inverter.find(element, x, 1e-4)) {
                    is_inside = is_inside || solution.excess <= 0;
                    is_doubtful = is_doubtful || std::abs(solution.excess) < (precision == Precision::float64 ? 1e-9 : 1e-4);
                }
            ++result.n_points;
            result.n_missed += is_inside && !is_doubtful && !is_in_segment;
            result.n_invented += !is_inside && !is_doubtful && is_in_segment;
        }
    }
    return result;
}

} // namespace elvis::oracle
