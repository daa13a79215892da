/**
 * @file own_shape_checks.cpp
 * Checks of reference shapes that plugins bring themselves: elvis_inside, its gradient and its bounds.
 */
#include <core/conformance/checks/device_check_tools.hpp>
#include <core/probe/device_evaluator.hpp>
#include <elvis/native/space.hpp>

#include <random>

namespace elvis::conformance {

namespace {

/** Elements whose shared faces are looked at, and points of each of these. */
constexpr std::size_t max_shared_faces = 24;
constexpr std::size_t n_face_points = 40;

double sum_of(const Point& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }

std::vector<SamplePoint> of_cut_classes(const RuntimeVolume& volume, std::vector<SamplePoint> points) {
    std::erase_if(points, [&](const SamplePoint& point) { return !volume.is_cut(class_of(volume, point.element)); });
    return points;
}

void check_values(const RuntimeVolume& volume, const std::vector<SamplePoint>& points, const std::vector<Sample>& samples,
                  Complaints& complaints) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Sample& s = samples[i];
        if (!std::isfinite(s.inside) || !std::isfinite(sum_of(s.inside_gradient))) {
            complaints.add(place(volume, points[i]) + ": elvis_inside gives no finite numbers");
        }
        for (const double bound : s.inside_bounds) {
            if (!std::isfinite(bound) || bound < 0) {
                complaints.add(place(volume, points[i]) + ": elvis_inside_bounds gives " + text_of(bound));
            }
        }
    }
}

/** `all`: of the closed shape, n_points an element. */
void check_bounds(const RuntimeVolume& volume, const std::vector<SamplePoint>& all, const std::vector<Sample>& samples,
                  Complaints& complaints) {
    // Sums of a hundred terms in double precision.
    constexpr double room = 1 + 1e-10;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Sample& s = samples[i];
        if (sum_of(s.inside_gradient) > room * s.inside_bounds[0]) {
            complaints.add(place(volume, all[i]) + ": the derivatives of elvis_inside add up to " +
                           text_of(sum_of(s.inside_gradient)) + ", more than the bound " + text_of(s.inside_bounds[0]));
        }
        for (std::size_t j = i + 1; j < all.size() && all[j].element == all[i].element; ++j) {
            Point change{}, distance{};
            for (std::size_t k = 0; k < 3; ++k) {
                change[k] = samples[j].inside_gradient[k] - s.inside_gradient[k];
                distance[k] = std::abs(all[j].xi[k] - all[i].xi[k]);
            }
            // Integrated along the way between them, each second derivative counts at most with the largest coordinate of the
            // way.
            const double most = s.inside_bounds[1] * *std::max_element(distance.begin(), distance.end());
            if (sum_of(change) > room * most + 1e-10 * s.inside_bounds[0]) {
                complaints.add(place(volume, all[i]) + ": from there to " + text_of(all[j].xi) +
                               " the derivatives of elvis_inside change by " + text_of(sum_of(change)) +
                               ", more than the bound of second derivatives allows: " + text_of(most));
            }
        }
    }
}

void check_gradient(const RuntimeVolume& volume, const DeviceSampler& sampler, const std::vector<SamplePoint>& points,
                    Complaints& complaints) {
    const auto samples = sampler.sample(points);
    for (std::size_t j = 0; j < volume.dimension(); ++j) {
        const auto expected = differences_of(sampler, points, j, [](const Sample& s) { return std::vector{s.inside}; });
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double size = std::abs(samples[i].inside) + samples[i].inside_bounds[0];
            if (!(std::abs(samples[i].inside_gradient[j] - expected[i][0]) <= 1e-7 * size)) {
                complaints.add(place(volume, points[i]) + ": elvis_inside gives the derivative by xi_" + std::to_string(j) +
                               " as " + text_of(samples[i].inside_gradient[j]) + ", differences of its values say " +
                               text_of(expected[i][0]));
            }
        }
    }
}

void check_single(Context& context, const RuntimeVolume& volume, std::vector<SamplePoint> points, const DeviceSampler& exact,
                  Complaints& complaints) {
    DeviceSampler single(volume, context.subject().device, Precision::float32);
    single.select(0, 0);
    for (SamplePoint& point : points) {
        for (double& coordinate : point.xi) {
            coordinate = static_cast<double>(static_cast<float>(coordinate));
        }
    }
    const auto expected = exact.sample(points), found = single.sample(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        // What the core counts with (shaders/element/inside.glsl).
        const double most = 16 * 0x1p-24 * (std::abs(expected[i].inside) + expected[i].inside_bounds[0]);
        if (!(std::abs(found[i].inside - expected[i].inside) <= most)) {
            complaints.add(place(volume, points[i]) + ": elvis_inside is " + text_of(found[i].inside) + " in float32 and " +
                           text_of(expected[i].inside) + " in float64");
        }
    }
}

struct SharedFace {
    std::uint64_t element = 0, neighbour = 0;
    std::uint32_t local_face = 0;
};

/** Of cut elements. */
std::vector<SharedFace> shared_faces(const RuntimeVolume& volume, std::uint64_t seed) {
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    std::vector<SharedFace> shared;
    for (const elvis_face& face : faces) {
        const auto element = static_cast<std::uint64_t>(face.element), neighbour = static_cast<std::uint64_t>(face.neighbour);
        if (face.neighbour < 0) {
            continue;
        }
        if (volume.is_cut(class_of(volume, element))) {
            shared.push_back({element, neighbour, static_cast<std::uint32_t>(face.local_face)});
        }
        if (volume.is_cut(class_of(volume, neighbour))) {
            shared.push_back({neighbour, element, static_cast<std::uint32_t>(face.neighbour_local_face)});
        }
    }
    std::mt19937_64 random(seed);
    std::shuffle(shared.begin(), shared.end(), random);
    shared.resize(std::min(shared.size(), max_shared_faces));
    return shared;
}

/** Rays go on through shared faces: what is inside on one side must be so on the other. */
void check_neighbours(Context& context, const RuntimeVolume& volume, const DeviceSampler& sampler, Complaints& complaints) {
    std::vector<SamplePoint> points;
    std::vector<std::uint64_t> neighbours;
    std::mt19937_64 random(context.subject().seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const SharedFace& face : shared_faces(volume, context.subject().seed)) {
        const native::Shape shape{volume.classes()[class_of(volume, face.element)].shape};
        const auto local_face = static_cast<int>(face.local_face);
        if (local_face >= native::n_faces(shape)) {
            continue; // The check of faces says so.
        }
        const std::span<const int> corners = native::face_corners(shape, local_face);
        for (std::size_t i = 0; i < n_face_points; ++i) {
            // A convex combination of the corners; the power brings it near to edges, too.
            Point xi{};
            double sum = 0;
            for (const int index : corners) {
                const double weight = std::pow(uniform(random), 4);
                const Point corner = native::corner(shape, index);
                for (std::size_t k = 0; k < 3; ++k) {
                    xi[k] += weight * corner[k];
                }
                sum += weight;
            }
            for (double& coordinate : xi) {
                coordinate /= sum;
            }
            points.push_back({face.element, xi, 0});
            neighbours.push_back(face.neighbour);
        }
    }
    if (points.empty()) {
        return;
    }
    const auto samples = sampler.sample(points);
    std::vector<InversionQuery> queries;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point origin = sampler.origin(points[i].element);
        const Point& x = samples[i].position;
        queries.push_back({neighbours[i], {x[0] + origin[0], x[1] + origin[1], x[2] + origin[2]}});
    }
    DeviceEvaluator evaluator(volume, context.subject().device);
    const std::vector<Inversion> found = evaluator.invert(queries);
    for (std::size_t i = 0; i < points.size(); ++i) {
        // Nearer to the boundary rounding, and digits that a file does not keep, may decide.
        const bool is_near = std::abs(samples[i].inside) <= 1e-6 * samples[i].inside_bounds[0];
        const bool is_in_neighbour = found[i].outcome == Inversion::Outcome::inside;
        if (!is_near && is_in_neighbour != (samples[i].inside < 0)) {
            complaints.add(place(volume, points[i]) + ", on the face shared with element " + std::to_string(neighbours[i]) +
                           ": elvis_inside is " + text_of(samples[i].inside) + ", but there the neighbour says " +
                           (is_in_neighbour ? "inside" : "outside") + "; name no neighbour where both differ");
        }
    }
}

void check_own_shape(Context& context) {
    const RuntimeVolume volume = open_volume(context);
    if (!volume.is_cut()) {
        throw Skipped("the snippets bring no reference shape of their own");
    }
    DeviceSampler sampler(volume, context.subject().device, Precision::float64);
    sampler.select(0, 0);
    Complaints complaints(context);
    const std::uint64_t seed = context.subject().seed;
    context.progress("elvis_inside at points");
    const auto all = of_cut_classes(volume, sample_points(volume, seed, 1, false));
    const auto samples = sampler.sample(all);
    check_values(volume, all, samples, complaints);
    check_bounds(volume, all, samples, complaints);
    const auto interior = of_cut_classes(volume, sample_points(volume, seed, 1, true));
    context.progress("differences of elvis_inside");
    check_gradient(volume, sampler, interior, complaints);
    context.progress("elvis_inside in single precision");
    check_single(context, volume, interior, sampler, complaints);
    if (volume.n_faces() > 0 && volume.dimension() == 3) {
        context.progress("shared faces");
        check_neighbours(context, volume, sampler, complaints);
    }
    const auto n_inside = std::count_if(samples.begin(), samples.end(), [](const Sample& s) { return s.inside <= 0; });
    if (n_inside == 0) {
        complaints.add("elvis_inside is positive at all of " + std::to_string(samples.size()) +
                       " points: there is nothing of the elements (inside is where it is not positive)");
    }
    context.note(std::to_string(n_inside) + " of " + std::to_string(samples.size()) + " points inside");
}

} // namespace

std::vector<Check> own_shape_checks() {
    return {{"snippet-own-shape",
             "elvis_inside has the gradient that it says, its bounds hold, and neighbours agree on the faces that they share",
             check_own_shape}};
}

} // namespace elvis::conformance
