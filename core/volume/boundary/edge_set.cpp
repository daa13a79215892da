#include <core/base/vector3.hpp>
#include <core/volume/boundary/edge_set.hpp>
#include <core/volume/element/chebyshev.hpp>
#include <core/vulkan/real_array.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>

namespace elvis {

namespace {

constexpr std::uint32_t edge_group_size = 32;
constexpr std::uint64_t edges_a_dispatch = 65536;
/** Positions agree to this share of the volume's size if they are the same. */
constexpr double same_point = 1e-5;

struct EdgeParameters {
    std::uint32_t n_edges, n_points;
};

struct LocalEdge {
    std::uint64_t element = 0;
    std::uint32_t number = 0;
    Vector3 from{}, to{};
};

/** Reference coordinates of order + 1 points from one end to the other (Chebyshev-Lobatto). */
std::vector<double> points_of(const LocalEdge& edge, std::uint32_t order) {
    std::vector<double> points;
    for (std::uint32_t k = 0; k <= order; ++k) {
        const double s = 0.5 - 0.5 * std::cos(std::numbers::pi * k / order);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            points.push_back(edge.from[axis] + s * (edge.to[axis] - edge.from[axis]));
        }
    }
    return points;
}

/** Of a face, in order around it; none of a face that the shape lacks. An element in two dimensions is a face itself. */
std::vector<int> corners_around(native::Shape shape, std::uint32_t local_face) {
    if (native::dimension(shape) == 2) {
        std::vector<int> corners(static_cast<std::size_t>(native::n_corners(shape)));
        std::iota(corners.begin(), corners.end(), 0);
        return corners;
    }
    const int face = static_cast<int>(local_face);
    const auto corners = face < native::n_faces(shape) ? native::face_corners(shape, face) : std::span<const int>();
    return {corners.begin(), corners.end()};
}

/** Of the faces of one class, each edge of an element once. */
std::vector<LocalEdge> local_edges(const ClassInfo& info, const RuntimeVolume& volume, std::span<const ElementFace> faces) {
    const native::Shape shape{info.shape};
    std::vector<LocalEdge> edges;
    std::set<std::array<int, 2>> of_element;
    std::uint64_t element = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const ElementFace& face = faces[i];
        if (i == 0 || face.element != element) {
            of_element.clear();
            element = face.element;
        }
        const std::vector<int> corners = corners_around(shape, face.local_face);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            std::array<int, 2> ends = {corners[k], corners[(k + 1) % corners.size()]};
            std::ranges::sort(ends);
            if (of_element.insert(ends).second) {
                std::array<std::int64_t, 1> number{};
                volume.element_numbers(element, 1, number);
                edges.push_back({element, static_cast<std::uint32_t>(number[0]), native::corner(shape, ends[0]),
                                 native::corner(shape, ends[1])});
            }
        }
    }
    return edges;
}

/** Positions of the points of each edge, as the device computes them. */
std::vector<double> sample(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                           std::uint32_t element_class, std::uint32_t order, std::span<const LocalEdge> edges) {
    const std::uint64_t block = std::min<std::uint64_t>(edges.size(), edges_a_dispatch);
    const std::uint32_t n_points = order + 1;
    KernelRequest request;
    request.name = "edge_samples of element class " + std::to_string(element_class);
    request.kernel = "boundary/edge_samples.comp";
    request.precision = data.precision();
    request.instances = {data.instance(element_class)};
    request.bindings = buffer_bindings({.storage = 3});
    request.push_constant_bytes = sizeof(EdgeParameters);
    const ComposedKernel kernel(device, request);
    const std::uint64_t point_bytes = 3 * block * n_points * real_bytes(data.precision());
    const Buffer output(device, point_bytes), input(device, point_bytes), elements(device, block * sizeof(std::uint32_t));
    const std::array<const Buffer*, 3> bindings = {&output, &input, &elements};
    std::vector<double> positions, points;
    std::vector<std::uint32_t> local;
    for (std::size_t first = 0; first < edges.size(); first += block) {
        const std::span<const LocalEdge> own = edges.subspan(first, std::min<std::size_t>(block, edges.size() - first));
        points.clear();
        local.clear();
        for (const LocalEdge& edge : own) {
            local.push_back(static_cast<std::uint32_t>(edge.element - volume.classes()[element_class].first_element));
            std::ranges::copy(points_of(edge, order), std::back_inserter(points));
        }
        elements.write_items(std::span<const std::uint32_t>(local));
        const auto n = static_cast<std::uint32_t>(own.size() * n_points);
        const EdgeParameters parameters{static_cast<std::uint32_t>(own.size()), n_points};
        write_reals(input, data.precision(), points);
        kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), (n + edge_group_size - 1) / edge_group_size);
        const std::vector<double> read = read_reals(output, data.precision(), std::size_t{3} * n);
        positions.insert(positions.end(), read.begin(), read.end());
    }
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        const Vector3 origin = data.origin(edges[edge].element);
        for (std::size_t at = 3 * edge * n_points; at < 3 * (edge + 1) * n_points; ++at) {
            positions[at] += origin[at % 3];
        }
    }
    return positions;
}

/** The same from the plugin, which computes in double precision. */
std::vector<double> sample(const RuntimeVolume& volume, std::uint32_t order, std::span<const LocalEdge> edges) {
    std::vector<double> positions;
    for (const LocalEdge& edge : edges) {
        const std::vector<double> points = points_of(edge, order);
        positions.resize(positions.size() + points.size());
        volume.evaluate_mapping(edge.element, points, std::span(positions).last(points.size()), {});
    }
    return positions;
}

/** What turns positions at Chebyshev-Lobatto points into coefficients (discrete cosine transform). */
std::vector<double> transform(std::uint32_t order) {
    const std::size_t size = std::size_t{order} + 1;
    std::vector<double> matrix(size * size);
    for (std::size_t m = 0; m < size; ++m) {
        for (std::size_t k = 0; k < size; ++k) {
            // The points run from -1 to 1.
            const double angle = std::numbers::pi * static_cast<double>(m * (order - k)) / order;
            const double ends = (k == 0 || k == order ? 0.5 : 1.0) * (m == 0 || m == order ? 0.5 : 1.0);
            matrix[m * size + k] = 2.0 / order * ends * std::cos(angle);
        }
    }
    return matrix;
}

/** Around the elements of faces. */
std::array<double, 6> bounds_around(const RuntimeVolume& volume, std::span<const ElementFace> faces) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 6> bounds{infinity, infinity, infinity, -infinity, -infinity, -infinity};
    for (const ElementFace& face : faces) {
        std::array<double, 6> box{};
        volume.bounds(face.element, 1, box);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bounds[axis] = std::min(bounds[axis], box[axis]);
            bounds[axis + 3] = std::max(bounds[axis + 3], box[axis + 3]);
        }
    }
    return bounds;
}

double longest_side(const std::array<double, 6>& bounds) {
    return std::max({bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]});
}

/** Edges whose middles are known. */
class KnownMiddles {
public:
    explicit KnownMiddles(const std::array<double, 6>& bounds) : m_bounds(bounds), m_size(same_point * longest_side(bounds)) {}

    /**
     * Whether it was not known. Middles of edges of neighbours are the same but for rounding. One at the border between two
     * cells of this lattice is drawn twice, which does no harm.
     */
    bool add(const Vector3& middle) {
        std::array<std::int64_t, 3> cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell[axis] = std::llround((middle[axis] - m_bounds[axis]) / m_size);
        }
        return m_cells.insert(cell).second;
    }

private:
    std::array<double, 6> m_bounds;
    double m_size;
    std::set<std::array<std::int64_t, 3>> m_cells;
};

} // namespace

EdgeSet::EdgeSet(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                 std::span<const ElementFace> faces, const TaskControl* control)
    : m_rounding((data.precision() == Precision::float64 ? 1e-15 : 1e-6) * longest_side(data.bounds())) {
    add(volume, faces, data.bounds(), control, [&](std::uint32_t element_class, std::uint32_t order, auto edges) {
        return sample(device, volume, data, element_class, order, edges);
    });
}

EdgeSet::EdgeSet(const RuntimeVolume& volume, std::span<const ElementFace> faces, const TaskControl* control) {
    const std::array<double, 6> bounds = bounds_around(volume, faces);
    m_rounding = 1e-15 * longest_side(bounds);
    add(volume, faces, bounds, control,
        [&](std::uint32_t, std::uint32_t order, auto edges) { return sample(volume, order, edges); });
}

template <class Sampler>
void EdgeSet::add(const RuntimeVolume& volume, std::span<const ElementFace> faces, const std::array<double, 6>& bounds,
                  const TaskControl* control, const Sampler& sampled) {
    KnownMiddles known(bounds);
    std::size_t first = 0;
    for (std::uint32_t index = 0; index < volume.classes().size(); ++index) {
        const ClassInfo& info = volume.classes()[index];
        std::size_t end = first;
        while (end < faces.size() && faces[end].element < info.first_element + info.n_elements) {
            ++end;
        }
        if (end == first) {
            continue;
        }
        if (control) {
            control->check();
        }
        const std::vector<LocalEdge> edges = local_edges(info, volume, faces.subspan(first, end - first));
        first = end;
        const std::uint32_t given = std::max({info.geometry_order[0], info.geometry_order[1], info.geometry_order[2]});
        // Twice the order: the plugin's geometry may be no polynomial.
        const std::uint32_t order = info.is_affine ? 1 : 2 * std::max(given, 1u);
        const std::vector<double> positions = sampled(index, order, std::span<const LocalEdge>(edges));
        const std::vector<double> matrix = transform(order);
        const std::vector<double> middle = chebyshev_values(static_cast<int>(order), 0.0);
        const std::size_t n_points = std::size_t{order} + 1;
        for (std::size_t edge = 0; edge < edges.size(); ++edge) {
            const std::size_t begin = m_coefficients.size();
            Vector3 x{};
            for (std::size_t m = 0; m < n_points; ++m) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    double sum = 0;
                    for (std::size_t k = 0; k < n_points; ++k) {
                        sum += matrix[m * n_points + k] * positions[3 * (edge * n_points + k) + axis];
                    }
                    m_coefficients.push_back(sum);
                    x[axis] += middle[m] * sum;
                }
            }
            const bool is_finite = std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
            if (is_finite && known.add(x)) {
                m_edges.push_back({edges[edge].number, begin, order});
            } else {
                m_coefficients.resize(begin);
            }
        }
    }
}

} // namespace elvis
