#include <core/base/error.hpp>
#include <core/convert/face_points.hpp>
#include <core/convert/topology.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace elvis {

namespace {

constexpr std::uint64_t block_size = 16384;
using Positions = std::array<double, 3 * n_face_points>;

struct KeyHash {
    std::size_t operator()(const FaceKey& key) const {
        std::uint64_t value = 0;
        for (const std::int64_t number : key) {
            value = (value ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
            value ^= value >> 31;
        }
        return value;
    }
};

struct OpenFace {
    std::uint32_t face = 0;
    int n_sides = 1;
    Positions positions{};
};

double largest_distance(const Positions& a, const Positions& b) {
    double largest = 0;
    for (std::size_t at = 0; at < a.size(); at += 3) {
        largest = std::max(largest, std::hypot(a[at] - b[at], a[at + 1] - b[at + 1], a[at + 2] - b[at + 2]));
    }
    return largest;
}

} // namespace

Topology find_topology(const SourceVolume& source, const std::vector<elvis_shape>& shapes, const TaskControl& control) {
    const std::uint64_t n_elements = shapes.size();
    Topology topology;
    topology.corners = number_corners(source, shapes, control);
    const double tolerance = 10 * topology.corners.tolerance;
    std::array<std::uint32_t, 6> none{};
    none.fill(Topology::no_face);
    topology.of_element.assign(n_elements, none);

    std::unordered_map<FaceKey, OpenFace, KeyHash> open;
    std::vector<elvis_source_element> elements;
    for (std::uint64_t first = 0; first < n_elements; first += block_size) {
        control.check();
        control.progress(static_cast<double>(first) / static_cast<double>(n_elements), "matching faces");
        elements.resize(std::min(block_size, n_elements - first));
        source.elements(first, elements.size(), elements);
        for (std::uint64_t element = first; element < first + elements.size(); ++element) {
            const auto shape = static_cast<native::Shape>(shapes[element]);
            for (int local = 0; local < native::n_faces(shape); ++local) {
                const OrientedFace oriented = oriented_face(shape, local, topology.corners.of_element[element]);
                const auto points = face_points(shape, oriented);
                Positions positions{};
                source.evaluate_mapping(element, std::span<const double>(points.front().data(), positions.size()), positions);

                const auto index = static_cast<std::uint32_t>(topology.faces.size());
                const auto [found, is_new] = open.try_emplace(oriented.key, OpenFace{index, 1, positions});
                OpenFace& other = found->second;
                const bool is_partner =
                    !is_new && ++other.n_sides == 2 && largest_distance(positions, other.positions) <= tolerance;
                if (is_partner) {
                    native::Face& face = topology.faces[other.face];
                    face.neighbour = static_cast<std::int64_t>(element);
                    face.neighbour_local_face = local;
                    topology.of_element[element][static_cast<std::size_t>(local)] = other.face;
                    continue;
                }
                native::Face face;
                face.element = static_cast<std::int64_t>(element);
                face.local_face = local;
                face.neighbour = is_new ? ELVIS_NEIGHBOUR_NONE : ELVIS_NEIGHBOUR_UNKNOWN;
                face.group = elements[element - first].face_groups[local];
                if (!is_new) {
                    native::Face& first_side = topology.faces[other.face];
                    first_side.neighbour = ELVIS_NEIGHBOUR_UNKNOWN;
                    first_side.neighbour_local_face = -1;
                }
                if (index == Topology::no_face) {
                    throw Error(source.paths().front(), "has more faces than can be counted");
                }
                topology.faces.push_back(face);
                topology.of_element[element][static_cast<std::size_t>(local)] = index;
            }
        }
    }
    topology.n_unknown =
        static_cast<std::uint64_t>(std::count_if(topology.faces.begin(), topology.faces.end(), [](const native::Face& face) {
            return face.neighbour == ELVIS_NEIGHBOUR_UNKNOWN;
        }));
    return topology;
}

} // namespace elvis
