/**
 * @file tree.hpp
 * The tree that a file and those it links to make.
 */
#pragma once

#include "node.hpp"

#include <map>
#include <optional>

namespace elvis_cgns {

/** How surely a file is one of CGNS, from 0 to 100. */
std::uint32_t probe(const std::string& path);

/** Any thread may read from its nodes; only one asks for them. */
class Tree {
public:
    explicit Tree(const std::string& path);

    Node root() const { return m_root; }
    const std::string& path() const { return m_root.container->path(); }

    /** Children in the order of their names, links followed. They are kept: a zone may have many. */
    const std::vector<Node>& children(const Node& node);
    /** Those of a label. */
    std::vector<Node> children(const Node& node, const std::string& label);
    /** The first one of a label; nothing if there is none. */
    std::optional<Node> child(const Node& node, const std::string& label);
    /** The one of a name. */
    std::optional<Node> named(const Node& node, const std::string& name);

private:
    std::shared_ptr<const Container> open(const std::string& path);
    Node follow(Node node, int depth);

    std::map<std::string, std::shared_ptr<const Container>> m_files;
    std::map<std::pair<const Container*, std::string>, std::vector<Node>> m_children;
    Node m_root;
};

/** All numbers of a node. */
std::vector<double> numbers(const Node& node);
std::vector<std::int64_t> integers(const Node& node);
/** A text without blanks and zeros at its end. */
std::string text(const Node& node);
/** Texts of a node of two dimensions: one a column. */
std::vector<std::string> texts(const Node& node);

} // namespace elvis_cgns
