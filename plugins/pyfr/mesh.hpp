/**
 * @file mesh.hpp
 * A mesh: sets of elements of one kind each, whose geometry is read by ranges.
 */
#pragma once

#include "kind.hpp"
#include "partitions.hpp"

#include <plugins/hdf5/file.hpp>
#include <plugins/nodal/nodal_space.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace elvis_pyfr {

/** All elements of a kind. */
struct ElementSet {
    const Kind* kind = nullptr;
    /** Number of its first element in the mesh. */
    std::uint64_t first = 0;
    std::uint64_t count = 0;
    /** Nodes of the geometry. */
    std::shared_ptr<const elvis::nodal::NodalSpace> nodes;
    /** Those that are corners, in ElVis's order. */
    std::vector<std::size_t> corners;
    /** Of layout 0: how many elements each partition has. */
    std::vector<PartSize> parts;
};

/** Corners and boundary groups of some elements. */
struct Topology {
    /** [element][corner in ElVis's order]; empty if the file has no numbers of nodes. */
    std::vector<std::int64_t> corners;
    /** [element][PyFR's face]: index of the group, or -1. */
    std::vector<std::int32_t> groups;
};

/** Any thread may read. */
class Mesh {
public:
    virtual ~Mesh() = default;
    Mesh(const Mesh&) = delete;
    Mesh& operator=(const Mesh&) = delete;

    const std::string& path() const { return m_file.path(); }
    const std::string& uuid() const { return m_uuid; }
    const std::vector<ElementSet>& sets() const { return m_sets; }
    const std::vector<std::string>& groups() const { return m_groups; }
    std::uint64_t n_elements() const;
    std::uint32_t dimension() const;
    /** Numbers of corners are below this; 0 if there are none. */
    virtual std::uint64_t n_corner_ids() const = 0;

    /** Positions of nodes: [element][node][x, y, z]. */
    virtual std::vector<double> read_nodes(const ElementSet& set, std::uint64_t first, std::uint64_t count) const = 0;
    virtual Topology read_topology(const ElementSet& set, std::uint64_t first, std::uint64_t count) const = 0;

protected:
    Mesh(elvis::hdf5::File file, std::string uuid) : m_file(std::move(file)), m_uuid(std::move(uuid)) {}

    /** Adds a set whose nodes are those; `place` is the dataset that says so. */
    void add_set(const Kind& kind, std::uint64_t count, std::vector<double> nodes, const std::string& place);
    /** Index of a boundary group, which is new if there is none of that name. */
    std::int32_t group(const std::string& name);
    /** Ends with an error if there are no elements, or not all of one dimension. */
    void check_sets() const;

    elvis::hdf5::File m_file;
    std::vector<ElementSet> m_sets;

private:
    std::string m_uuid;
    std::vector<std::string> m_groups;
};

/** Whether a file is a mesh, of any layout. */
bool is_mesh(const elvis::hdf5::File& file);
/** The id that a mesh and its solutions share; empty if the file has none. */
std::string find_uuid(const elvis::hdf5::File& file);
/** 0, 1 or 2 (format.md); an error for later ones. */
int find_layout(const elvis::hdf5::File& file);

std::unique_ptr<const Mesh> open_mesh(elvis::hdf5::File file);

} // namespace elvis_pyfr
