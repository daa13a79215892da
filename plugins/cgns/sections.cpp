#include "sections.hpp"

#include <algorithm>
#include <stdexcept>

namespace elvis_cgns {

namespace {

/** Numbers that are read at a time. */
constexpr std::uint64_t block_size = std::uint64_t{1} << 20;

/** The integers of a node, one after the other. */
class Stream {
public:
    explicit Stream(const Node& node) : m_node(node), m_size(node.size()) {}

    bool is_at_end() const { return m_next == m_size; }

    std::int64_t next() {
        if (is_at_end()) {
            m_node.fail("ends before its elements do");
        }
        if (m_next == m_first + m_block.size()) {
            m_first = m_next;
            m_block.resize(std::min(block_size, m_size - m_next));
            m_node.container->read(m_node, m_first, std::span(m_block));
        }
        return m_block[m_next++ - m_first];
    }

private:
    const Node& m_node;
    std::uint64_t m_size;
    std::uint64_t m_first = 0;
    std::uint64_t m_next = 0;
    std::vector<std::int64_t> m_block;
};

const ElementType& type_of(const Node& section, std::int64_t number) {
    try {
        return element_type(number);
    } catch (const std::invalid_argument& error) {
        section.fail(std::string("holds ") + error.what());
    }
}

Section read_section(Tree& tree, const Node& node) {
    Section section;
    section.node = node;
    const std::vector<std::int64_t> head = integers(node);
    const auto range = tree.child(node, "IndexRange_t");
    if (head.empty() || !range) {
        node.fail("does not say the type and the range of its elements");
    }
    section.type = head[0];
    if (section.type != mixed_number) {
        type_of(node, section.type);
    }
    const std::vector<std::int64_t> ends = integers(*range);
    if (ends.size() != 2 || ends[0] < 1 || ends[1] < ends[0]) {
        range->fail("is no range of elements");
    }
    section.first = static_cast<std::uint64_t>(ends[0]);
    section.last = static_cast<std::uint64_t>(ends[1]);
    return section;
}

} // namespace

std::vector<Section> read_sections(Tree& tree, const Zone& zone) {
    std::vector<Section> sections;
    for (const Node& node : tree.children(zone.node, "Elements_t")) {
        sections.push_back(read_section(tree, node));
    }
    std::ranges::sort(sections, {}, &Section::first);
    for (std::size_t index = 1; index < sections.size(); ++index) {
        if (sections[index].first <= sections[index - 1].last) {
            sections[index].node.fail("has numbers of elements that " + sections[index - 1].node.name + " has, too");
        }
    }
    return sections;
}

void read_elements(Tree& tree, const Zone& zone, const Section& section, const TakeElement& take) {
    const auto connectivity = tree.named(section.node, "ElementConnectivity");
    if (!connectivity) {
        section.node.fail("has no ElementConnectivity");
    }
    Stream stream(*connectivity);
    std::vector<std::uint32_t> nodes;
    std::int64_t previous = -1;
    for (std::uint64_t element = section.first; element <= section.last; ++element) {
        const std::int64_t number = section.type == mixed_number ? stream.next() : section.type;
        if (number != previous) {
            nodes.resize(n_nodes(type_of(section.node, number)));
            previous = number;
        }
        for (std::uint32_t& node : nodes) {
            const std::int64_t vertex = stream.next();
            if (vertex < 1 || static_cast<std::uint64_t>(vertex) > zone.n_all_vertices()) {
                connectivity->fail("names vertex " + std::to_string(vertex) + " in element " + std::to_string(element) +
                                   "; the zone has " + std::to_string(zone.n_all_vertices()));
            }
            node = static_cast<std::uint32_t>(vertex - 1);
        }
        take(number, nodes);
    }
    if (!stream.is_at_end()) {
        connectivity->fail("does not end with the last element");
    }
}

} // namespace elvis_cgns
