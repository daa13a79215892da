#include <core/base/error.hpp>
#include <core/convert/blocks.hpp>
#include <core/convert/topology/hanging_faces.hpp>
#include <core/convert/topology/topology.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

constexpr std::uint64_t face_block_size = 8192;

/** Rounding of positions: below this part of the largest coordinate two maps are the same. */
constexpr double round_off = 1e-13;

struct Record {
    FaceKey key;
    FaceSide side;
};

/** Pairs faces with the same corners. */
void pair_by_corners(Topology& topology) {
    std::vector<Record> records;
    std::size_t n_sides = 0;
    for (const elvis_shape shape : topology.shapes) {
        n_sides += static_cast<std::size_t>(native::n_faces(static_cast<native::Shape>(shape)));
    }
    records.reserve(n_sides);
    for (std::uint64_t element = 0; element < topology.shapes.size(); ++element) {
        const auto shape = static_cast<native::Shape>(topology.shapes[element]);
        for (int local = 0; local < native::n_faces(shape); ++local) {
            records.push_back({face_key(shape, local, topology.corners.of_element[element]), face_side(element, local)});
        }
    }
    std::ranges::sort(records,
                      [](const Record& a, const Record& b) { return a.key != b.key ? a.key < b.key : a.side < b.side; });
    for (std::size_t first = 0, last = 0; first < records.size(); first = last) {
        while (last < records.size() && records[last].key == records[first].key) {
            ++last;
        }
        for (std::size_t index = first; index < last && last - first > 1; ++index) {
            const FaceSide side = records[index].side;
            std::uint32_t& neighbour = topology.neighbour[side / 8][side % 8];
            if (last - first > 2) {
                neighbour = Topology::unknown_neighbour;
                continue;
            }
            const FaceSide other = records[first + last - 1 - index].side;
            neighbour = static_cast<std::uint32_t>(other / 8);
            topology.neighbour_face[side / 8][side % 8] = static_cast<std::uint8_t>(other % 8);
        }
    }
}

/** Checks that paired faces have the same map. Sides are compared as they come; the first waits for the second. */
class PairCheck {
public:
    PairCheck(const SourceVolume& source, Topology& topology, const TaskControl& control)
        : m_source(source), m_topology(topology), m_control(control), m_points(all_face_points()) {}

    void run() {
        const std::uint64_t n_elements = m_topology.shapes.size();
        std::vector<std::vector<std::vector<double>>> positions(n_workers());
        const auto last = [&](std::uint64_t block) { return std::min((block + 1) * face_block_size, n_elements); };
        for_each_block((n_elements + face_block_size - 1) / face_block_size,
                       [&](std::uint64_t block, unsigned worker) {
                           m_control.check();
                           positions[worker].resize(face_block_size);
                           for (std::uint64_t element = block * face_block_size; element < last(block); ++element) {
                               std::vector<double>& of_element = positions[worker][element - block * face_block_size];
                               const std::vector<double>& xi = m_points[m_topology.shapes[element]].xi();
                               of_element.resize(xi.size());
                               m_source.evaluate_mapping(element, xi, of_element);
                           }
                       },
                       [&](std::uint64_t block, unsigned worker) {
                           m_control.progress(static_cast<double>(last(block)) / static_cast<double>(n_elements),
                                              "matching faces");
                           for (std::uint64_t element = block * face_block_size; element < last(block); ++element) {
                               add(element, positions[worker][element - block * face_block_size]);
                           }
                       });
    }

private:
    void add(std::uint64_t element, const std::vector<double>& positions) {
        const FacePoints& points = m_points[m_topology.shapes[element]];
        const int n_faces = native::n_faces(static_cast<native::Shape>(m_topology.shapes[element]));
        for (int local = 0; local < n_faces; ++local) {
            if (!m_topology.is_shared(element, local)) {
                continue;
            }
            std::vector<double> of_face;
            for (const std::uint8_t point : points.order(local, m_topology.corners.of_element[element])) {
                const double* x = positions.data() + 3 * (points.first_point(local) + point);
                of_face.insert(of_face.end(), x, x + 3);
            }
            const FaceSide side = face_side(element, local);
            const FaceSide other = m_topology.other_side(element, local);
            if (other > side) {
                m_waiting.emplace(side, std::move(of_face));
                continue;
            }
            const auto found = m_waiting.find(other);
            compare(side, of_face, other, found->second);
            m_waiting.erase(found);
        }
    }

    void compare(FaceSide side, const std::vector<double>& here, FaceSide other, const std::vector<double>& there) {
        double distance = 0;
        double size = 0;
        std::vector<double> steps(here.size());
        for (std::size_t at = 0; at < here.size(); at += 3) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                steps[at + axis] = there[at + axis] - here[at + axis];
            }
            distance = std::max(distance, std::hypot(steps[at], steps[at + 1], steps[at + 2]));
            size = std::max(size, std::hypot(here[at] - here[0], here[at + 1] - here[1], here[at + 2] - here[2]));
        }
        if (distance <= round_off * m_topology.corners.largest_coordinate) {
            return;
        }
        if (distance <= 10 * m_topology.corners.tolerance) {
            m_topology.steps.emplace(side, std::move(steps));
            return;
        }
        const std::size_t centre = 3 * centre_of_face(here.size() / 3);
        const double apart = std::hypot(steps[centre], steps[centre + 1], steps[centre + 2]);
        const std::uint32_t code = apart > 0.5 * size ? Topology::no_neighbour : Topology::unknown_neighbour;
        m_topology.neighbour[side / 8][side % 8] = code;
        m_topology.neighbour[other / 8][other % 8] = code;
    }

    const SourceVolume& m_source;
    Topology& m_topology;
    const TaskControl& m_control;
    std::array<FacePoints, native::n_shapes> m_points;
    std::unordered_map<FaceSide, std::vector<double>> m_waiting;
};

/** Sides without neighbour that belong to no boundary group. */
std::vector<FaceSide> unexplained(const SourceVolume& source, const Topology& topology) {
    std::vector<FaceSide> sides;
    std::vector<elvis_source_element> elements;
    const std::uint64_t n_elements = topology.shapes.size();
    for (std::uint64_t first = 0; first < n_elements; first += face_block_size) {
        elements.resize(std::min(face_block_size, n_elements - first));
        source.elements(first, elements.size(), elements);
        for (std::uint64_t element = first; element < first + elements.size(); ++element) {
            for (int local = 0; local < native::n_faces(static_cast<native::Shape>(topology.shapes[element])); ++local) {
                if (topology.neighbour[element][static_cast<std::size_t>(local)] == Topology::no_neighbour &&
                    elements[element - first].face_groups[local] < 0) {
                    sides.push_back(face_side(element, local));
                }
            }
        }
    }
    return sides;
}

void count_faces(Topology& topology) {
    std::uint64_t n_shared_sides = 0;
    for (std::uint64_t element = 0; element < topology.shapes.size(); ++element) {
        for (int local = 0; local < native::n_faces(static_cast<native::Shape>(topology.shapes[element])); ++local) {
            const std::uint32_t neighbour = topology.neighbour[element][static_cast<std::size_t>(local)];
            topology.n_boundary += neighbour == Topology::no_neighbour ? 1 : 0;
            topology.n_unknown += neighbour == Topology::unknown_neighbour ? 1 : 0;
            n_shared_sides += neighbour < Topology::unknown_neighbour ? 1 : 0;
        }
    }
    topology.n_faces = topology.n_boundary + topology.n_unknown + n_shared_sides / 2;
}

} // namespace

Topology find_topology(const SourceVolume& source, std::vector<elvis_shape> shapes, const TaskControl& control) {
    if (shapes.size() >= Topology::unknown_neighbour) {
        throw Error(source.paths().front(), "has more than 4294967293 elements");
    }
    Topology topology;
    topology.shapes = std::move(shapes);
    control.progress(-1, "finding corners");
    topology.corners = number_corners(source, topology.shapes, control);
    std::array<std::uint32_t, 6> none;
    none.fill(Topology::no_neighbour);
    topology.neighbour.assign(topology.shapes.size(), none);
    topology.neighbour_face.assign(topology.shapes.size(), {});
    control.check();
    pair_by_corners(topology);
    PairCheck(source, topology, control).run();
    control.check();
    const std::vector<FaceSide> unpaired = unexplained(source, topology);
    mark_hanging_faces(source, unpaired, topology, control);
    count_faces(topology);
    return topology;
}

} // namespace elvis
