/**
 * @file adf_container.hpp
 * The tree in a file of the older ADF kind, whose layout format.md gives in section 2.
 */
#pragma once

#include "node.hpp"

namespace elvis_cgns {

class AdfContainer final : public Container {
public:
    explicit AdfContainer(const std::string& path);

    /** Whether a file begins as ADF files do. False for files that cannot be read. */
    static bool is_adf(const std::string& path);

    Node root() const override;
    std::vector<Node> children(const Node& node) const override;
    Link link(const Node& node) const override;
    void read(const Node& node, std::uint64_t first, std::span<double> values) const override;
    void read(const Node& node, std::uint64_t first, std::span<std::int64_t> values) const override;
    std::string text(const Node& node) const override;

private:
    /** Where a run of a node's data lies. */
    struct Chunk {
        std::uint64_t begin;
        std::uint64_t end;
    };

    [[noreturn]] void fail(std::uint64_t address, const std::string& what) const;
    std::string bytes(std::uint64_t address, std::uint64_t size) const;
    void expect(std::uint64_t address, const std::string& tag) const;
    /** A number in hexadecimal digits. */
    std::uint64_t number(const std::string& digits, std::uint64_t address) const;
    /** Of 12 digits: the block of 4096 bytes, and the place in it. */
    std::uint64_t pointer(const std::string& digits, std::uint64_t address) const;
    Node read_node(std::uint64_t address, const Node* parent) const;
    std::vector<Chunk> chunks(const Node& node) const;
    /** Bytes of a node's data. */
    std::string data(const Node& node, std::uint64_t first, std::uint64_t size) const;
    template <class Number> void read_numbers(const Node& node, std::uint64_t first, std::span<Number> values) const;

    /** Open as long as this is. */
    class File {
    public:
        explicit File(const std::string& path);
        ~File();
        File(const File&) = delete;
        File& operator=(const File&) = delete;
        int descriptor() const { return m_descriptor; }

    private:
        int m_descriptor;
    };

    File m_file;
    std::uint64_t m_size = 0;
    std::uint64_t m_root = 0;
    bool m_is_big_endian = false;
};

} // namespace elvis_cgns
