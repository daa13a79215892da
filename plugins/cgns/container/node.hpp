/**
 * @file node.hpp
 * CGNS files are trees of nodes, each with a name, a label that says what it is, and numbers or text (format.md, section 1).
 */
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elvis_cgns {

class Container;

struct Node {
    std::string name;
    std::string label;
    /** MT (nothing), C1 (text), I4, I8, U4, U8, R4, R8, or LK, a link. */
    std::string type;
    /** The first index is the fastest; empty where there is no data. */
    std::vector<std::uint64_t> shape;
    /** From the root of the file. */
    std::string path;
    /** Of the node in its file, where that needs one. */
    std::uint64_t address = 0;
    std::shared_ptr<const Container> container;

    /** Numbers or characters in all; 0 where there is no data. */
    std::uint64_t size() const;
    bool holds_numbers() const;
    bool holds_integers() const;

    /** Ends with an error about this node. */
    [[noreturn]] void fail(const std::string& what) const;
};

/** Another node, of another file unless that has no name. */
struct Link {
    std::string file;
    std::string path;
};

/** A file that holds a tree. Any thread may read. */
class Container : public std::enable_shared_from_this<Container> {
public:
    explicit Container(std::string path) : m_path(std::move(path)) {}
    virtual ~Container() = default;
    Container(const Container&) = delete;
    Container& operator=(const Container&) = delete;

    const std::string& path() const { return m_path; }

    virtual Node root() const = 0;
    /** In the order of their names; links as they are. */
    virtual std::vector<Node> children(const Node& node) const = 0;
    virtual Link link(const Node& node) const = 0;

    /** Numbers from a place on, counted with the first index the fastest. Integers are read from integers only. */
    virtual void read(const Node& node, std::uint64_t first, std::span<double> values) const = 0;
    virtual void read(const Node& node, std::uint64_t first, std::span<std::int64_t> values) const = 0;
    virtual std::string text(const Node& node) const = 0;

private:
    std::string m_path;
};

} // namespace elvis_cgns
