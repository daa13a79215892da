#include "hdf_container.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>

namespace elvis_cgns {

namespace {

/** Names of objects in the file do not begin with '/'. */
std::string object_of(const Node& node) { return node.path.empty() ? "/" : node.path.substr(1); }
std::string data_of(const Node& node) { return object_of(node) + "/ data"; }

/** Texts are short: names, and lists of names of time steps. */
constexpr std::uint64_t most_characters = std::uint64_t{1} << 26;

/** Reads from `first` on. What is not a list is read by whole planes of the slowest index. */
template <class Number>
void read_flat(const elvis::hdf5::Dataset& dataset, const Node& node, std::uint64_t first, std::span<Number> values) {
    const std::vector<std::uint64_t>& shape = dataset.shape();
    const std::uint64_t size = node.size();
    if (first > size || values.size() > size - first) {
        node.fail("has " + std::to_string(size) + " numbers where " + std::to_string(first + values.size()) + " are needed");
    }
    if (values.empty()) {
        return;
    }
    std::uint64_t plane = 1;
    for (std::size_t axis = 1; axis < shape.size(); ++axis) {
        plane *= shape[axis];
    }
    const std::uint64_t from = first / plane, end = (first + values.size() - 1) / plane + 1;
    std::vector<std::uint64_t> start(shape.size(), 0), count = shape;
    start[0] = from;
    count[0] = end - from;
    if (plane == 1) {
        dataset.read(start, count, values);
        return;
    }
    std::vector<Number> planes((end - from) * plane);
    dataset.read(start, count, std::span(planes));
    std::copy_n(planes.begin() + static_cast<std::ptrdiff_t>(first - from * plane), values.size(), values.begin());
}

} // namespace

HdfContainer::HdfContainer(const std::string& path) : Container(path), m_file(path) {
    if (!is_cgns(m_file)) {
        m_file.fail("", "is an HDF5 file, but has no CGNSLibraryVersion: it is none of CGNS");
    }
}

bool HdfContainer::is_cgns(const elvis::hdf5::File& file) { return file.has("CGNSLibraryVersion"); }

std::string HdfContainer::attribute(const std::string& object, const std::string& name) const {
    if (!m_file.has_attribute(object, name)) {
        return "";
    }
    const std::vector<std::string> texts = m_file.texts_of_attribute(object, name);
    return texts.size() == 1 ? texts.front() : "";
}

std::string HdfContainer::characters(const std::string& name) const {
    const elvis::hdf5::Dataset dataset = m_file.dataset(name);
    std::uint64_t size = 1;
    for (const std::uint64_t extent : dataset.shape()) {
        size = extent > most_characters / std::max<std::uint64_t>(size, 1) ? most_characters + 1 : size * extent;
    }
    if (size > most_characters || !dataset.holds_numbers() || dataset.shape().empty()) {
        dataset.fail("is no text");
    }
    std::vector<std::int64_t> codes(size);
    dataset.read(std::vector<std::uint64_t>(dataset.shape().size(), 0), dataset.shape(), std::span(codes));
    std::string text;
    for (const std::int64_t code : codes) {
        text.push_back(static_cast<char>(code));
    }
    return text;
}

Node HdfContainer::root() const {
    Node root;
    root.type = "MT";
    root.container = shared_from_this();
    return root;
}

std::vector<Node> HdfContainer::children(const Node& parent) const {
    std::vector<Node> all;
    for (const std::string& name : m_file.names(object_of(parent))) {
        // What begins with a blank is of the container, not of the tree.
        if (name.empty() || name.front() == ' ') {
            continue;
        }
        Node node;
        node.name = name;
        node.path = parent.path + "/" + name;
        node.label = attribute(object_of(node), "label");
        node.type = attribute(object_of(node), "type");
        node.container = parent.container;
        if (node.type != "MT" && node.type != "LK" && m_file.has(data_of(node))) {
            const std::vector<std::uint64_t> shape = m_file.dataset(data_of(node)).shape();
            node.shape.assign(shape.rbegin(), shape.rend());
        }
        all.push_back(std::move(node));
    }
    return all;
}

Link HdfContainer::link(const Node& node) const {
    const auto text = [&](const std::string& name) {
        const std::string all = m_file.has(name) ? characters(name) : "";
        return all.substr(0, all.find('\0'));
    };
    return {text(object_of(node) + "/ file"), text(object_of(node) + "/ path")};
}

void HdfContainer::read(const Node& node, std::uint64_t first, std::span<double> values) const {
    if (!node.holds_numbers()) {
        node.fail("does not hold numbers");
    }
    read_flat(m_file.dataset(data_of(node)), node, first, values);
}

void HdfContainer::read(const Node& node, std::uint64_t first, std::span<std::int64_t> values) const {
    if (!node.holds_integers()) {
        node.fail("does not hold integers");
    }
    read_flat(m_file.dataset(data_of(node)), node, first, values);
}

std::string HdfContainer::text(const Node& node) const {
    if (node.type != "C1" || node.shape.empty()) {
        node.fail("is no text");
    }
    return characters(data_of(node));
}

} // namespace elvis_cgns
