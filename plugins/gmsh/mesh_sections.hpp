/**
 * @file mesh_sections.hpp
 * Reads the sections that hold a mesh, of MSH 2.2 and 4.1, as they stand in the file.
 */
#pragma once

#include "cursor.hpp"
#include "element_type.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gmsh {

enum class Version { v2_2, v4_1 };

/** A mesh by the tags of its file. */
struct FileMesh {
    std::vector<std::uint64_t> node_tags;
    /** x y z by node. */
    std::vector<double> positions;

    std::vector<std::uint64_t> element_tags;
    std::vector<ElementType> element_types;
    /** Tag of the physical group (0: none) in MSH 2.2, of the model entity in MSH 4.1. */
    std::vector<std::int32_t> element_labels;
    /** Tags of the nodes, element after element. */
    std::vector<std::uint64_t> element_nodes;

    bool labels_are_entities = false;
    /** (dimension, tag) of a model entity to the tags of its physical groups. */
    std::map<std::pair<int, std::int32_t>, std::vector<std::int32_t>> entity_groups;
    /** (dimension, tag) of a physical group to its name. */
    std::map<std::pair<int, std::int32_t>, std::string> group_names;

    bool is_empty() const { return node_tags.empty() && element_tags.empty(); }
    friend bool operator==(const FileMesh&, const FileMesh&) = default;
};

void read_physical_names(Cursor& cursor, FileMesh& mesh);
/** $Entities, or $PartitionedEntities. */
void read_entities(Cursor& cursor, bool are_partitioned, FileMesh& mesh);
void read_nodes(Cursor& cursor, Version version, FileMesh& mesh);
/** $ParametricNodes, which stands for $Nodes in MSH 2.2 files made with Mesh.SaveParametric. */
void read_parametric_nodes(Cursor& cursor, FileMesh& mesh);
void read_elements(Cursor& cursor, Version version, FileMesh& mesh);

} // namespace gmsh
