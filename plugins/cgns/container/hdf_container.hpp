/**
 * @file hdf_container.hpp
 * The tree in an HDF5 file: a group is a node, its attributes are name, label and type, a dataset in it is the data.
 */
#pragma once

#include "node.hpp"

#include <plugins/hdf5/file.hpp>

namespace elvis_cgns {

class HdfContainer final : public Container {
public:
    explicit HdfContainer(const std::string& path);

    /** Whether an HDF5 file is one of CGNS. */
    static bool is_cgns(const elvis::hdf5::File& file);

    Node root() const override;
    std::vector<Node> children(const Node& node) const override;
    Link link(const Node& node) const override;
    void read(const Node& node, std::uint64_t first, std::span<double> values) const override;
    void read(const Node& node, std::uint64_t first, std::span<std::int64_t> values) const override;
    std::string text(const Node& node) const override;

private:
    std::string attribute(const std::string& object, const std::string& name) const;
    std::string characters(const std::string& dataset) const;

    elvis::hdf5::File m_file;
};

} // namespace elvis_cgns
