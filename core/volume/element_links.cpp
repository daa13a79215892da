#include <core/volume/element_links.hpp>

#include <core/volume/face_links.hpp>

#include <bit>
#include <limits>

namespace elvis {

namespace {

constexpr std::uint32_t place_of_curvature = 7;
constexpr std::uint32_t words_a_node = 4;

} // namespace

ElementLinks make_element_links(const Device& device, const RuntimeVolume& volume, std::uint32_t element_class,
                                const Hierarchy& hierarchy, std::span<const float> curvatures,
                                std::span<const double> ranges, Precision precision) {
    const ClassInfo& info = volume.classes()[element_class];
    std::vector<std::uint32_t> links = links_in_class(read_face_links(volume)[element_class], info);
    for (std::uint64_t element = 0; element < info.n_elements; ++element) {
        links[links_an_element * element + place_of_curvature] = std::bit_cast<std::uint32_t>(curvatures[element]);
    }
    ElementLinks result;
    result.links = std::make_unique<RecordBuffer>(device, RecordKind::uint, precision, info.n_elements, links_an_element);
    result.links->write_uints(0, links);

    const std::vector<double> unknown(ranges.empty() ? 2 * info.n_elements : 0, std::numeric_limits<double>::quiet_NaN());
    const std::vector<NodeRange> node_ranges = hierarchy.node_ranges(ranges.empty() ? std::span<const double>(unknown) : ranges);
    const std::span<const HierarchyNode> nodes = hierarchy.nodes();
    std::vector<std::uint32_t> marks(words_a_node * nodes.size());
    const bool is_cut = volume.is_cut(element_class);
    // Children follow their parents.
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const HierarchyNode& node = nodes[i];
        std::uint32_t& is_open = marks[words_a_node * i + 2];
        if (node.is_leaf()) {
            is_open = is_cut || has_open_face(links, info, node.child) ? 1 : 0;
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
