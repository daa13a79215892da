#include <core/volume/element_links.hpp>

#include <algorithm>
#include <bit>
#include <limits>

namespace elvis {

namespace {

constexpr std::uint32_t no_link = 0xffffffffu;
constexpr std::uint32_t faces_a_record = 8;
constexpr std::uint32_t place_of_curvature = 7;
constexpr std::uint32_t words_a_node = 4;
constexpr std::uint64_t faces_a_block = 1u << 16;

std::uint32_t n_faces_of(elvis_shape shape) {
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON: return 6;
    case ELVIS_SHAPE_TETRAHEDRON: return 4;
    case ELVIS_SHAPE_QUADRILATERAL: return 4;
    case ELVIS_SHAPE_TRIANGLE: return 3;
    default: return 5;
    }
}

std::vector<std::uint32_t> links_of(const RuntimeVolume& volume, const ClassInfo& info) {
    std::vector<std::uint32_t> links(faces_a_record * info.n_elements, no_link);
    const auto first_element = static_cast<std::int64_t>(info.first_element);
    const auto local = [&](std::int64_t element) { return static_cast<std::uint64_t>(element - first_element); };
    const auto is_in_class = [&](std::int64_t element) { return element >= first_element && local(element) < info.n_elements; };
    std::vector<elvis_face> faces;
    const std::uint64_t n_faces = volume.n_faces();
    for (std::uint64_t first = 0; first < n_faces; first += faces_a_block) {
        const std::uint64_t count = std::min(faces_a_block, n_faces - first);
        faces.assign(count, elvis_face{});
        volume.faces(first, count, faces);
        for (const elvis_face& face : faces) {
            if (is_in_class(face.element) && is_in_class(face.neighbour) && face.local_face >= 0 && face.neighbour_local_face >= 0) {
                links[faces_a_record * local(face.element) + static_cast<std::uint64_t>(face.local_face)] =
                    static_cast<std::uint32_t>(local(face.neighbour));
                links[faces_a_record * local(face.neighbour) + static_cast<std::uint64_t>(face.neighbour_local_face)] =
                    static_cast<std::uint32_t>(local(face.element));
            }
        }
    }
    return links;
}

} // namespace

ElementLinks make_element_links(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                const Hierarchy& hierarchy, std::span<const float> curvatures,
                                std::span<const double> ranges, Precision precision) {
    const ClassInfo& info = volume.classes()[element_class];
    std::vector<std::uint32_t> links = links_of(volume, info);
    for (std::uint64_t element = 0; element < info.n_elements; ++element) {
        links[faces_a_record * element + place_of_curvature] = std::bit_cast<std::uint32_t>(curvatures[element]);
    }
    ElementLinks result;
    result.links = std::make_unique<RecordBuffer>(device, RecordKind::uint, precision, info.n_elements, faces_a_record);
    result.links->write_uints(0, links);

    const std::vector<double> unknown(ranges.empty() ? 2 * info.n_elements : 0, std::numeric_limits<double>::quiet_NaN());
    const std::vector<NodeRange> node_ranges = hierarchy.node_ranges(ranges.empty() ? std::span<const double>(unknown) : ranges);
    const std::span<const HierarchyNode> nodes = hierarchy.nodes();
    std::vector<std::uint32_t> marks(words_a_node * nodes.size());
    // Children follow their parents.
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const HierarchyNode& node = nodes[i];
        std::uint32_t& is_open = marks[words_a_node * i + 2];
        if (node.is_leaf()) {
            const auto own = std::span(links).subspan(faces_a_record * std::size_t{node.child}, n_faces_of(info.shape));
            is_open = std::ranges::find(own, no_link) != own.end() ? 1 : 0;
        } else {
            is_open = marks[words_a_node * std::size_t{node.child} + 2] | marks[words_a_node * (std::size_t{node.child} + 1) + 2];
        }
        marks[words_a_node * i] = std::bit_cast<std::uint32_t>(node_ranges[i].lower);
        marks[words_a_node * i + 1] = std::bit_cast<std::uint32_t>(node_ranges[i].upper);
    }
    result.node_marks = std::make_unique<RecordBuffer>(device, RecordKind::uint, precision, nodes.size(), words_a_node);
    result.node_marks->write_uints(0, marks);
    return result;
}

} // namespace elvis
