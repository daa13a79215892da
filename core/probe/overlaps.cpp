// A point outside of the mesh is in no element. On a way from there to a point that two elements hold, the number of elements
// changes only where the way meets a face without neighbour: where it changes from one to two, that face lies in another
// element. So samples of such faces tell whether elements overlap at all, as long as Jacobian determinants are positive and
// neighbours lie on both sides of the face that they share. Only if they do, all faces of all elements are sampled, to know
// which.
#include <core/base/in_parts.hpp>
#include <core/base/vector3.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/probe/newton.hpp>
#include <core/probe/overlaps.hpp>
#include <core/probe/reference_shape.hpp>
#include <core/volume/segments/face_links.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <span>
#include <thread>
#include <utility>

namespace elvis {

namespace {

/** Elements that are linearized at once, between two looks at the wish to stop. */
constexpr std::uint64_t block = 16384;
/** That a thread looks at before it takes others. */
constexpr std::uint64_t elements_a_thread = 1024;
/** In reference coordinates: how deep in its own element a sample lies, and in the other one has to. More than coordinates in
 * single precision are off. */
constexpr double sample_depth = 4e-4, least_depth = 1e-4;
/** From corners and edges of the face, as a share of the way to its middle. */
constexpr double from_edges = 1e-3;
/** What the mapping linearized at the centroid may be off, in reference coordinates; points beyond are in no element that is
 * bent less. */
constexpr double clearly_outside = 0.5;
/** The same nearer to the point, after a step of Newton's method. */
constexpr double surely_outside = 0.1;
constexpr int most_steps = 12;
constexpr double converged_overlap_step = 1e-7;

using Jacobian = std::array<double, 9>;

Vector3 between(const Vector3& a, const Vector3& b, double share) { return plus(a, scaled(minus(b, a), share)); }

Vector3 middle(std::span<const Vector3> points) {
    Vector3 sum{};
    for (const Vector3& point : points) {
        sum = plus(sum, point);
    }
    return scaled(sum, 1 / static_cast<double>(points.size()));
}

/** Of a face, drawn into the element: its middle, and points near corners and middles of edges. */
std::vector<double> face_samples(elvis_shape shape, int face) {
    std::vector<Vector3> corners;
    for (const int index : native::face_corners(native::Shape{shape}, face)) {
        corners.push_back(native::corner(native::Shape{shape}, index));
    }
    const Vector3 centre = middle(corners);
    std::vector<Vector3> points{centre};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        points.push_back(between(centre, corners[i], 1 - from_edges));
        for (std::size_t j = 0; j < i; ++j) {
            const Vector3 halfway = between(corners[i], corners[j], 0.5);
            // Diagonals meet in the middle of the face.
            if (length(minus(halfway, centre)) > from_edges) {
                points.push_back(between(centre, halfway, 1 - from_edges));
            }
        }
    }
    std::vector<double> xi;
    for (const Vector3& point : points) {
        const Vector3 inside = between(point, reference_centroid(shape), sample_depth);
        xi.insert(xi.end(), inside.begin(), inside.end());
    }
    return xi;
}

/** One class, and the samples of its faces. */
struct SampledClass {
    ClassInfo info;
    std::vector<std::uint32_t> links;
    std::vector<std::vector<double>> faces;
};

/** An element, and a point that it may hold. */
using Candidate = std::pair<std::uint32_t, Vector3>;

/** Of the element that a thread looks at, and their positions, and which elements may hold them. */
struct Samples {
    std::vector<double> xi, positions;
    std::vector<std::uint32_t> found;
    std::vector<Candidate> candidates;
    std::vector<Vector3> points;
};

class OverlapSearch {
public:
    OverlapSearch(const RuntimeVolume& volume, std::span<const Hierarchy* const> hierarchies, Background& background,
                  const TaskControl* control);

    std::vector<std::uint64_t> find();

private:
    /** Of elements from `first` on, for look_at_links. */
    void linearize(const ClassInfo& info, std::uint64_t first, std::uint64_t count);
    void look_at_links(std::uint64_t element, elvis_shape shape, std::span<const std::uint32_t> links);
    void look_at_faces(const SampledClass& in, bool of_all);
    void look_at_faces(const SampledClass& in, std::uint64_t local, bool of_all, Samples& samples);
    void look_at_samples(std::uint64_t element, std::span<const std::uint32_t> links, Samples& samples);
    bool holds(std::uint64_t element, std::span<const Vector3> points) const;
    bool holds(std::uint64_t element, elvis_shape shape, const Vector3& start, const Vector3& point) const;
    elvis_shape shape_of(std::uint64_t element) const;
    bool is_marked(std::uint64_t element) { return std::atomic_ref(m_is_marked[element]).load(std::memory_order_relaxed) != 0; }
    void mark(std::uint64_t one, std::uint64_t other);

    const RuntimeVolume& m_volume;
    Background& m_background;
    const TaskControl* m_control;
    std::vector<SampledClass> m_classes;
    std::span<const Hierarchy* const> m_hierarchies;
    /** Positions, of elements that were linearized. */
    std::vector<Vector3> m_centroids;
    /** Of a block of elements, and its first one. */
    std::vector<Jacobian> m_jacobians;
    std::uint64_t m_first_linearized = 0;
    /** Written by several threads. */
    std::vector<std::uint8_t> m_is_marked;
    std::atomic<bool> m_has_any = false;
};

OverlapSearch::OverlapSearch(const RuntimeVolume& volume, std::span<const Hierarchy* const> hierarchies, Background& background,
                             const TaskControl* control)
    : m_volume(volume), m_background(background), m_control(control), m_hierarchies(hierarchies),
      m_centroids(volume.n_elements()), m_is_marked(volume.n_elements(), 0) {
    std::vector<std::vector<std::uint32_t>> links = read_face_links(volume);
    for (std::size_t index = 0; index < links.size(); ++index) {
        SampledClass sampled{volume.classes()[index], std::move(links[index]), {}};
        for (int face = 0; face < native::n_faces(native::Shape{sampled.info.shape}); ++face) {
            sampled.faces.push_back(face_samples(sampled.info.shape, face));
        }
        m_classes.push_back(std::move(sampled));
    }
}

std::vector<std::uint64_t> OverlapSearch::find() {
    for (const SampledClass& sampled : m_classes) {
        look_at_faces(sampled, false);
    }
    if (m_has_any) {
        for (const SampledClass& sampled : m_classes) {
            look_at_faces(sampled, true);
        }
    }
    std::vector<std::uint64_t> elements;
    for (std::uint64_t element = 0; element < m_is_marked.size(); ++element) {
        if (is_marked(element)) {
            elements.push_back(element);
        }
    }
    return elements;
}

void OverlapSearch::linearize(const ClassInfo& info, std::uint64_t first, std::uint64_t count) {
    const Vector3 centroid = reference_centroid(info.shape);
    m_first_linearized = first;
    m_jacobians.resize(count);
    in_parts(m_background, count, elements_a_thread, [&](std::uint64_t from, std::uint64_t n) {
        for (std::uint64_t at = from; at < from + n; ++at) {
            m_volume.evaluate_mapping(first + at, centroid, m_centroids[first + at], m_jacobians[at]);
        }
    });
}

/** Neighbours that lie on the same side of the face that they share. */
void OverlapSearch::look_at_links(std::uint64_t element, elvis_shape shape, std::span<const std::uint32_t> links) {
    const Vector3 centroid = reference_centroid(shape);
    const Vector3& position = m_centroids[element];
    const Jacobian inverse = invert_matrix(m_jacobians[element - m_first_linearized]);
    for (const std::uint32_t neighbour : links) {
        if (neighbour == no_link || neighbour >= element) {
            continue;
        }
        const Vector3& point = m_centroids[neighbour];
        const Vector3 prediction = plus(centroid, product(inverse, minus(point, position)));
        if (reference_excess(shape, prediction) < 0 && holds(element, shape, prediction, point)) {
            mark(element, neighbour);
        }
    }
}

void OverlapSearch::look_at_faces(const SampledClass& in, bool of_all) {
    for (std::uint64_t first = 0; first < in.info.n_elements; first += block) {
        if (m_control) {
            m_control->check();
        }
        const std::uint64_t count = std::min(block, in.info.n_elements - first);
        if (!of_all) {
            linearize(in.info, in.info.first_element + first, count);
        }
        in_parts(m_background, count, elements_a_thread, [&](std::uint64_t from, std::uint64_t n) {
            Samples samples;
            for (std::uint64_t local = first + from; local < first + from + n; ++local) {
                look_at_faces(in, local, of_all, samples);
            }
        });
    }
}

void OverlapSearch::look_at_faces(const SampledClass& in, std::uint64_t local, bool of_all, Samples& samples) {
    const std::uint64_t element = in.info.first_element + local;
    const auto links = std::span(in.links).subspan(links_an_element * local, in.faces.size());
    samples.xi.clear();
    for (std::size_t face = 0; face < in.faces.size(); ++face) {
        if (of_all || links[face] == no_link) {
            samples.xi.insert(samples.xi.end(), in.faces[face].begin(), in.faces[face].end());
        }
    }
    if (of_all) {
        const Vector3 centroid = reference_centroid(in.info.shape);
        samples.xi.insert(samples.xi.end(), centroid.begin(), centroid.end());
    } else {
        look_at_links(element, in.info.shape, links);
    }
    if (!samples.xi.empty()) {
        look_at_samples(element, links, samples);
    }
}

void OverlapSearch::look_at_samples(std::uint64_t element, std::span<const std::uint32_t> links, Samples& samples) {
    samples.positions.resize(samples.xi.size());
    m_volume.evaluate_mapping(element, samples.xi, samples.positions, {});
    samples.candidates.clear();
    for (std::size_t i = 0; i < samples.positions.size(); i += 3) {
        const Vector3 point{samples.positions[i], samples.positions[i + 1], samples.positions[i + 2]};
        for (std::size_t index = 0; index < m_classes.size(); ++index) {
            samples.found.clear();
            m_hierarchies[index]->find(point, 0, samples.found);
            for (const std::uint32_t local : samples.found) {
                const auto other = static_cast<std::uint32_t>(m_classes[index].info.first_element + local);
                if (other != element && std::ranges::find(links, other) == links.end()) {
                    samples.candidates.emplace_back(other, point);
                }
            }
        }
    }
    std::ranges::stable_sort(samples.candidates, {}, &Candidate::first);
    for (auto at = samples.candidates.begin(); at != samples.candidates.end();) {
        const std::uint32_t other = at->first;
        samples.points.clear();
        for (; at != samples.candidates.end() && at->first == other; ++at) {
            samples.points.push_back(at->second);
        }
        if (!(is_marked(element) && is_marked(other)) && holds(other, samples.points)) {
            mark(element, other);
        }
    }
}

/** Whether one of the points is inside by more than rounding. */
bool OverlapSearch::holds(std::uint64_t element, std::span<const Vector3> points) const {
    const elvis_shape shape = shape_of(element);
    const Vector3 centroid = reference_centroid(shape);
    Vector3 position{};
    Jacobian jacobian{};
    m_volume.evaluate_mapping(element, centroid, position, jacobian);
    const Jacobian inverse = invert_matrix(jacobian);
    return std::ranges::any_of(points, [&](const Vector3& point) {
        const Vector3 prediction = plus(centroid, product(inverse, minus(point, position)));
        return reference_excess(shape, prediction) < clearly_outside && holds(element, shape, prediction, point);
    });
}

/** Newton's method. It gives up early: a point that is missed in a strongly bent element is one of many. */
bool OverlapSearch::holds(std::uint64_t element, elvis_shape shape, const Vector3& start, const Vector3& point) const {
    Vector3 prediction = start;
    for (int step = 0; step < most_steps; ++step) {
        const Vector3 xi = project_into_shape(shape, prediction);
        Vector3 position{};
        Jacobian jacobian{};
        m_volume.evaluate_mapping(element, xi, position, jacobian);
        const Vector3 next = plus(xi, product(invert_matrix(jacobian), minus(point, position)));
        const double excess = reference_excess(shape, next);
        if (!(excess < surely_outside)) {
            return false;
        }
        if (length(minus(next, prediction)) < converged_overlap_step) {
            return excess < -least_depth;
        }
        prediction = next;
    }
    return false;
}

elvis_shape OverlapSearch::shape_of(std::uint64_t element) const {
    const auto holds_it = [&](const SampledClass& in) { return element < in.info.first_element + in.info.n_elements; };
    return std::ranges::find_if(m_classes, holds_it)->info.shape;
}

void OverlapSearch::mark(std::uint64_t one, std::uint64_t other) {
    for (const std::uint64_t element : {one, other}) {
        std::atomic_ref(m_is_marked[element]).store(1, std::memory_order_relaxed);
    }
    m_has_any = true;
}

} // namespace

bool can_find_overlaps(const RuntimeVolume& volume) {
    return volume.dimension() == 3 && volume.has_evaluation() && !volume.is_cut();
}

std::vector<std::uint64_t> overlapping_elements(const RuntimeVolume& volume, std::span<const Hierarchy* const> hierarchies,
                                                Background& background, const TaskControl* control) {
    assert(can_find_overlaps(volume) && hierarchies.size() == volume.classes().size());
    return OverlapSearch(volume, hierarchies, background, control).find();
}

std::vector<std::uint64_t> overlapping_elements(const RuntimeVolume& volume, const TaskControl* control) {
    std::vector<Hierarchy> hierarchies;
    std::vector<const Hierarchy*> pointers;
    hierarchies.reserve(volume.classes().size());
    std::vector<double> boxes;
    for (const ClassInfo& info : volume.classes()) {
        boxes.resize(6 * info.n_elements);
        if (!boxes.empty()) {
            volume.bounds(info.first_element, info.n_elements, boxes);
            hierarchies.emplace_back(boxes, Vector3{boxes[0], boxes[1], boxes[2]});
        } else {
            hierarchies.emplace_back();
        }
        pointers.push_back(&hierarchies.back());
    }
    Background background(std::max(1u, std::thread::hardware_concurrency()));
    return overlapping_elements(volume, pointers, background, control);
}

} // namespace elvis
