#include "picture.hpp"

#include "color.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

namespace elvis::oracle {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double least_color_difference = 1e-6;

// Whether the point moves into the element, or along its faces, on a step towards the viewer.
bool steps_inside(native::Shape shape, const Solution& solution, const Vector& direction, double inside) {
    const Vector motion = -(solution.jacobian.inverse() * direction);
    return std::ranges::all_of(face_constraints(shape), [&](const FaceConstraint& face) {
        const bool is_active = face.normal.dot(solution.xi) - face.offset >= -inside;
        // Along a face the derivative is zero but for rounding.
        return !is_active || face.normal.dot(motion) <= 1e-10 * motion.norm();
    });
}

double value_of(const Volume& volume, const FieldChoice& choice, const Candidate& candidate) {
    const std::vector<double> components = volume.field(candidate.element, candidate.solution.xi);
    if (choice.component >= 0)
        return components.at(static_cast<std::size_t>(choice.component));
    return Eigen::Map<const Eigen::VectorXd>(components.data(), static_cast<Eigen::Index>(components.size())).norm();
}

double largest_difference(const Color& a, const Color& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

class RowPainter {
public:
    RowPainter(const Model& model, const FrameRequest& request, double rounding, const ValueFunction& value, Picture& picture)
        : m_model(model), m_request(request), m_value(value), m_tolerance(rounding * model.diagonal), m_picture(picture),
          m_inverter(model.volume, model.enclosures) {}

    void paint(std::uint32_t row) {
        for (std::uint32_t column = 0; column < m_request.width; ++column)
            paint(row, column);
    }

    std::vector<Alternative> alternatives;
    const InversionCounts& counts() const { return m_inverter.counts(); }

private:
    void paint(std::uint32_t row, std::uint32_t column) {
        const std::size_t pixel = std::size_t{row} * m_request.width + column;
        const Ray ray = pixel_ray(m_request.camera, m_request.width, m_request.height, column, row);
        std::vector<long double> distances;
        for (const Surface& surface : m_request.surfaces)
            if (const auto distance = plane_distance(ray, std::get<CutPlane>(surface.geometry)))
                distances.push_back(*distance);
        std::sort(distances.begin(), distances.end());

        for (std::size_t i = 0; i < distances.size(); ++i) {
            const Vector x = (ray.origin + distances[i] * ray.direction).cast<double>();
            if (i == 0)
                m_picture.position[pixel] = x;
            const auto candidates = locate(m_model, m_inverter, x, ray.direction.cast<double>(), m_tolerance);
            if (candidates.empty() || candidates.front().solution.excess > inside_tolerance)
                continue;
            m_picture.position[pixel] = x;
            m_picture.depth[pixel] = static_cast<double>(distances[i]);
            paint(pixel, candidates);
            return;
        }
    }

    void paint(std::size_t pixel, const std::vector<Candidate>& candidates) {
        const Volume& volume = m_model.volume;
        m_picture.is_inside[pixel] = 1;
        m_picture.element[pixel] = volume.number(candidates.front().element);
        m_picture.value[pixel] = value_of(candidates.front());
        m_picture.color[pixel] = color_of(m_request.surfaces[0].colors, m_picture.value[pixel]);
        for (std::size_t i = 1; i < candidates.size(); ++i) {
            const double value = value_of(candidates[i]);
            const Color color = color_of(m_request.surfaces[0].colors, value);
            if (largest_difference(color, m_picture.color[pixel]) > least_color_difference)
                alternatives.push_back({pixel, volume.number(candidates[i].element), value, color});
        }
    }

    double value_of(const Candidate& candidate) const {
        return m_value ? m_value(m_model.volume, candidate.element, candidate.solution.xi)
                       : oracle::value_of(m_model.volume, m_request.surfaces[0].field, candidate);
    }

    const Model& m_model;
    const FrameRequest& m_request;
    const ValueFunction& m_value;
    double m_tolerance;
    Picture& m_picture;
    Inverter m_inverter;
};

} // namespace

Model::Model(VolumeData data)
    : volume(std::move(data)), enclosures(make_enclosures(volume)), tree(enclosures),
      diagonal((tree.upper() - tree.lower()).norm()) {}

std::vector<Candidate> locate(const Model& model, Inverter& inverter, const Vector& x, const Vector& direction,
                              double tolerance, double inside) {
    std::vector<Candidate> candidates;
    for (const std::size_t element : model.tree.find(x, tolerance)) {
        // A world length in reference units, by the largest stretching at the element's middle; curved and slender elements
        // vary, hence the factor.
        const double in_reference = 4 * tolerance * model.enclosures[element].to_reference.norm();
        const native::Shape shape = model.volume.shape(element);
        for (const Solution& solution : inverter.find(element, x, std::clamp(in_reference, inside, 1e-2)))
            candidates.push_back({element, solution, steps_inside(shape, solution, direction, inside) ? 0 : 1});
    }
    std::sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        const bool a_inside = a.solution.excess <= inside;
        const bool b_inside = b.solution.excess <= inside;
        if (a_inside != b_inside)
            return a_inside;
        if (!a_inside)
            return a.solution.excess < b.solution.excess;
        return std::pair(a.key, model.volume.number(a.element)) < std::pair(b.key, model.volume.number(b.element));
    });
    return candidates;
}

Picture draw(const Model& model, const FrameRequest& request, double rounding, const ValueFunction& value) {
    Picture picture;
    picture.width = request.width;
    picture.height = request.height;
    const std::size_t n = std::size_t{request.width} * request.height;
    picture.is_inside.assign(n, 0);
    picture.color.assign(n, request.background);
    picture.value.assign(n, nan);
    picture.depth.assign(n, nan);
    picture.element.assign(n, -1);
    picture.position.assign(n, Vector::Constant(nan));

    // Neighbouring rows go to the same thread, so that the last solution in an element is a good start for the next pixel.
    constexpr std::uint32_t n_threads = 2;
    constexpr std::uint32_t rows_at_once = 8;
    std::vector<RowPainter> painters;
    for (std::uint32_t i = 0; i < n_threads; ++i)
        painters.emplace_back(model, request, rounding, value, picture);
    {
        std::vector<std::jthread> threads;
        for (std::uint32_t i = 0; i < n_threads; ++i)
            threads.emplace_back([&, i] {
                for (std::uint32_t row = 0; row < request.height; ++row)
                    if (row / rows_at_once % n_threads == i)
                        painters[i].paint(row);
            });
    }
    for (const RowPainter& painter : painters) {
        picture.counts.queries += painter.counts().queries;
        picture.counts.subdivided += painter.counts().subdivided;
        picture.counts.unresolved += painter.counts().unresolved;
        picture.alternatives.insert(picture.alternatives.end(), painter.alternatives.begin(), painter.alternatives.end());
    }
    std::stable_sort(picture.alternatives.begin(), picture.alternatives.end(),
                     [](const Alternative& a, const Alternative& b) { return a.pixel < b.pixel; });
    return picture;
}

bool contains(const Model& model, Inverter& inverter, const Vector& x) {
    return std::ranges::any_of(model.tree.find(x, 0),
                               [&](std::size_t element) { return !inverter.find(element, x, inside_tolerance).empty(); });
}

double distance_to_edge(const Model& model, Inverter& inverter, const Vector& x) {
    const bool is_inside = contains(model, inverter, x);
    for (int exponent = -9; exponent <= -3; ++exponent) {
        const double relative = std::pow(10.0, exponent);
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const Vector offset(i, j, k);
                    if (offset.squaredNorm() == 0)
                        continue;
                    const Vector near = x + relative * model.diagonal * offset.normalized();
                    if (contains(model, inverter, near) != is_inside)
                        return relative;
                }
    }
    return std::numeric_limits<double>::infinity();
}

} // namespace elvis::oracle
