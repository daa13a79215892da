#include "tree.hpp"

#include "adf_container.hpp"
#include "hdf_container.hpp"
#include "trimmed.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace elvis_cgns {

namespace {

/** Links to links: more than this only go round in circles. */
constexpr int most_links = 16;

} // namespace

std::uint32_t probe(const std::string& path) {
    const bool is_named = std::filesystem::path(path).extension() == ".cgns";
    // Damaged files of this name are this plugin's to refuse.
    const std::uint32_t by_name = is_named ? 60 : 0;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return 0;
    }
    if (AdfContainer::is_adf(path)) {
        return 100;
    }
    if (!elvis::hdf5::is_hdf5(path)) {
        return by_name;
    }
    try {
        return HdfContainer::is_cgns(elvis::hdf5::File(path)) ? 100 : by_name;
    } catch (const elvis::api::Error&) {
        return by_name;
    }
}

Tree::Tree(const std::string& path) : m_root(open(path)->root()) {}

std::shared_ptr<const Container> Tree::open(const std::string& path) {
    std::shared_ptr<const Container>& file = m_files[path];
    if (!file) {
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(path, ignored)) {
            throw elvis::api::Error(ELVIS_ERROR_FILE, path, "there is no such file");
        }
        if (AdfContainer::is_adf(path)) {
            file = std::make_shared<AdfContainer>(path);
        } else if (elvis::hdf5::is_hdf5(path)) {
            file = std::make_shared<HdfContainer>(path);
        } else {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "is no CGNS file: it begins neither as HDF5 nor as ADF files do");
        }
    }
    return file;
}

Node Tree::follow(Node node, int depth) {
    if (node.type != "LK") {
        return node;
    }
    if (depth == most_links) {
        node.fail("is a link that leads in a circle");
    }
    const Link link = node.container->link(node);
    std::shared_ptr<const Container> file = node.container;
    if (!link.file.empty()) {
        const std::filesystem::path folder = std::filesystem::path(file->path()).parent_path();
        const std::string other = (folder / link.file).string();
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(other, ignored)) {
            node.fail("is a link to the file " + link.file + ", which is not there");
        }
        file = open(other);
    }
    Node at = file->root();
    for (const auto& part : std::filesystem::path(link.path)) {
        if (part == "/" || part.empty()) {
            continue;
        }
        const std::vector<Node> all = file->children(at);
        const auto found = std::ranges::find(all, part.string(), &Node::name);
        if (found == all.end()) {
            node.fail("is a link to " + link.path + ", which " + file->path() + " does not have");
        }
        at = follow(*found, depth + 1);
        file = at.container;
    }
    // It goes by the name that it has here.
    at.name = node.name;
    return at;
}

const std::vector<Node>& Tree::children(const Node& node) {
    const std::pair key(node.container.get(), node.path);
    const auto known = m_children.find(key);
    if (known != m_children.end()) {
        return known->second;
    }
    std::vector<Node> all = node.container->children(node);
    for (Node& child : all) {
        child = follow(std::move(child), 0);
    }
    return m_children.emplace(key, std::move(all)).first->second;
}

std::vector<Node> Tree::children(const Node& node, const std::string& label) {
    std::vector<Node> all;
    std::ranges::copy_if(children(node), std::back_inserter(all), [&](const Node& child) { return child.label == label; });
    return all;
}

std::optional<Node> Tree::child(const Node& node, const std::string& label) {
    const std::vector<Node>& all = children(node);
    const auto found = std::ranges::find(all, label, &Node::label);
    return found == all.end() ? std::nullopt : std::optional(*found);
}

std::optional<Node> Tree::named(const Node& node, const std::string& name) {
    const std::vector<Node>& all = children(node);
    const auto found = std::ranges::find(all, name, &Node::name);
    return found == all.end() ? std::nullopt : std::optional(*found);
}

std::vector<double> numbers(const Node& node) {
    std::vector<double> values(node.size());
    node.container->read(node, 0, std::span(values));
    return values;
}

std::vector<std::int64_t> integers(const Node& node) {
    std::vector<std::int64_t> values(node.size());
    node.container->read(node, 0, std::span(values));
    return values;
}

std::string text(const Node& node) { return trimmed(node.container->text(node)); }

std::vector<std::string> texts(const Node& node) {
    const std::string all = node.container->text(node);
    if (node.shape.size() < 2 || node.shape[0] == 0) {
        return {trimmed(all)};
    }
    std::vector<std::string> columns;
    for (std::size_t at = 0; at + node.shape[0] <= all.size(); at += node.shape[0]) {
        columns.push_back(trimmed(all.substr(at, node.shape[0])));
    }
    return columns;
}

} // namespace elvis_cgns
