#include "mesh_sections.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

namespace gmsh {

namespace {

constexpr std::size_t largest_count = 0xfffffffe;

void check_total(const Cursor& cursor, std::uint64_t total, const char* what) {
    if (total > largest_count) {
        cursor.fail("more than " + std::to_string(largest_count) + " " + what);
    }
}

std::uint64_t read_tag(Cursor& cursor, const char* what) {
    const std::size_t begin = cursor.next();
    const auto tag = cursor.value<std::uint64_t>();
    if (tag == 0) {
        cursor.fail_at(begin, std::string(what) + " tag 0, which Gmsh does not allow");
    }
    return tag;
}

/** A tag of MSH 2.2, an int. */
std::uint64_t read_int_tag(Cursor& cursor, const char* what) {
    const std::size_t begin = cursor.next();
    const auto tag = cursor.value<std::int32_t>();
    if (tag <= 0) {
        cursor.fail_at(begin, std::string(what) + " tag " + std::to_string(tag) + ", where Gmsh's tags are above 0");
    }
    return static_cast<std::uint64_t>(tag);
}

double read_coordinate(Cursor& cursor) {
    const std::size_t begin = cursor.next();
    const auto coordinate = cursor.value<double>();
    if (!std::isfinite(coordinate)) {
        cursor.fail_at(begin, "a coordinate is not finite");
    }
    return coordinate;
}

/** Tag of a physical group without its sign, which tells the orientation. */
std::int32_t unsigned_tag(std::int32_t tag) {
    return static_cast<std::int32_t>(std::abs(static_cast<std::int64_t>(tag)) & 0x7fffffff);
}

/** Passes a list of tags with its count in front. */
void skip_tags(Cursor& cursor) {
    const auto count = cursor.value<std::uint64_t>();
    cursor.check_count(count, 1, sizeof(std::int32_t), "tags");
    for (std::uint64_t index = 0; index < count; ++index) {
        cursor.value<std::int32_t>();
    }
}

void read_entity(Cursor& cursor, int dimension, bool is_partitioned, FileMesh& mesh) {
    const auto tag = cursor.value<std::int32_t>();
    // An interface between partitions inherits the groups of its parent, a solid: they do not make a boundary of it.
    bool has_own_groups = true;
    if (is_partitioned) {
        has_own_groups = cursor.value<std::int32_t>() == dimension;
        cursor.value<std::int32_t>(); // parent tag
        skip_tags(cursor);            // partitions
    }
    for (int number = 0; number < (dimension == 0 ? 3 : 6); ++number) {
        cursor.value<double>();
    }
    const auto n_groups = cursor.value<std::uint64_t>();
    cursor.check_count(n_groups, 1, sizeof(std::int32_t), "physical groups");
    for (std::uint64_t index = 0; index < n_groups; ++index) {
        const std::int32_t group = unsigned_tag(cursor.value<std::int32_t>());
        if (has_own_groups) {
            mesh.entity_groups[{dimension, tag}].push_back(group);
        }
    }
    if (dimension > 0) {
        skip_tags(cursor); // boundary
    }
}

void read_nodes_4(Cursor& cursor, FileMesh& mesh) {
    const auto n_blocks = cursor.value<std::uint64_t>();
    const auto n_nodes = cursor.value<std::uint64_t>();
    cursor.value<std::uint64_t>(); // smallest tag
    cursor.value<std::uint64_t>(); // largest tag
    cursor.check_count(n_nodes, 4, 32, "nodes");
    check_total(cursor, mesh.node_tags.size() + n_nodes, "nodes");
    std::uint64_t left = n_nodes;
    for (std::uint64_t block = 0; block < n_blocks; ++block) {
        const std::size_t begin = cursor.next();
        const auto dimension = cursor.value<std::int32_t>();
        cursor.value<std::int32_t>(); // entity
        const bool has_parameters = cursor.value<std::int32_t>() != 0;
        const auto count = cursor.value<std::uint64_t>();
        if (dimension < 0 || dimension > 3) {
            cursor.fail_at(begin, "an entity of dimension " + std::to_string(dimension));
        }
        if (count > left) {
            cursor.fail_at(begin, "blocks hold more nodes than the section's head says (" + std::to_string(n_nodes) + ")");
        }
        left -= count;
        for (std::uint64_t node = 0; node < count; ++node) {
            mesh.node_tags.push_back(read_tag(cursor, "node"));
        }
        for (std::uint64_t node = 0; node < count; ++node) {
            for (int axis = 0; axis < 3; ++axis) {
                mesh.positions.push_back(read_coordinate(cursor));
            }
            for (int parameter = 0; has_parameters && parameter < dimension; ++parameter) {
                cursor.value<double>();
            }
        }
    }
    if (left > 0) {
        cursor.fail("blocks hold " + std::to_string(left) + " nodes less than the section's head says");
    }
}

void read_nodes_2(Cursor& cursor, bool have_parameters, FileMesh& mesh) {
    const auto n_nodes = cursor.text<std::uint64_t>();
    cursor.end_of_line();
    cursor.check_count(n_nodes, 4, 28, "nodes");
    check_total(cursor, mesh.node_tags.size() + n_nodes, "nodes");
    for (std::uint64_t node = 0; node < n_nodes; ++node) {
        mesh.node_tags.push_back(read_int_tag(cursor, "node"));
        for (int axis = 0; axis < 3; ++axis) {
            mesh.positions.push_back(read_coordinate(cursor));
        }
        if (have_parameters) {
            // Curves give one, surfaces two; points and solids none.
            const auto dimension = cursor.value<std::int32_t>();
            cursor.value<std::int32_t>(); // entity
            for (int parameter = 0; parameter < (dimension == 1 || dimension == 2 ? dimension : 0); ++parameter) {
                cursor.value<double>();
            }
        }
    }
}

ElementType read_type(Cursor& cursor) {
    const std::size_t begin = cursor.next();
    const auto number = cursor.value<std::int32_t>();
    const std::optional<ElementType> type = element_type(number);
    if (!type) {
        cursor.fail_at(begin, "element type " + std::to_string(number) +
                                  " is not read (points, lines, and 2D and 3D Lagrange elements of order 1 to 9 or 10 are)");
    }
    return *type;
}

void read_elements_4(Cursor& cursor, FileMesh& mesh) {
    const auto n_blocks = cursor.value<std::uint64_t>();
    const auto n_elements = cursor.value<std::uint64_t>();
    cursor.value<std::uint64_t>(); // smallest tag
    cursor.value<std::uint64_t>(); // largest tag
    cursor.check_count(n_elements, 2, 16, "elements");
    check_total(cursor, mesh.element_tags.size() + n_elements, "elements");
    mesh.labels_are_entities = true;
    std::uint64_t left = n_elements;
    for (std::uint64_t block = 0; block < n_blocks; ++block) {
        const std::size_t begin = cursor.next();
        const auto entity_dimension = cursor.value<std::int32_t>();
        const auto entity = cursor.value<std::int32_t>();
        const ElementType type = read_type(cursor);
        const auto count = cursor.value<std::uint64_t>();
        if (entity_dimension != dimension(type.topology)) {
            cursor.fail_at(begin, "elements of type '" + name(type) + "' on an entity of dimension " +
                                      std::to_string(entity_dimension));
        }
        if (count > left) {
            cursor.fail_at(begin,
                           "blocks hold more elements than the section's head says (" + std::to_string(n_elements) + ")");
        }
        left -= count;
        const std::size_t n = n_nodes(type);
        cursor.check_count(count, n + 1, 8 * (n + 1), "elements of this type");
        for (std::uint64_t element = 0; element < count; ++element) {
            mesh.element_tags.push_back(read_tag(cursor, "element"));
            mesh.element_types.push_back(type);
            mesh.element_labels.push_back(entity);
            for (std::size_t node = 0; node < n; ++node) {
                mesh.element_nodes.push_back(cursor.value<std::uint64_t>());
            }
        }
    }
    if (left > 0) {
        cursor.fail("blocks hold " + std::to_string(left) + " elements less than the section's head says");
    }
}

/** What follows an element's tag, type and number of labels in MSH 2.2. */
void read_element_2(Cursor& cursor, std::uint64_t tag, const ElementType& type, std::int32_t n_labels, FileMesh& mesh) {
    std::int32_t group = 0;
    for (std::int32_t label = 0; label < n_labels; ++label) {
        const auto value = cursor.value<std::int32_t>();
        if (label == 0) {
            group = unsigned_tag(value);
        }
    }
    mesh.element_tags.push_back(tag);
    mesh.element_types.push_back(type);
    mesh.element_labels.push_back(group);
    for (std::size_t node = 0; node < n_nodes(type); ++node) {
        mesh.element_nodes.push_back(read_int_tag(cursor, "node"));
    }
}

std::int32_t read_label_count(Cursor& cursor) {
    const std::size_t begin = cursor.next();
    const auto count = cursor.value<std::int32_t>();
    if (count < 0) {
        cursor.fail_at(begin, "a negative number of element tags");
    }
    return count;
}

void read_elements_2(Cursor& cursor, FileMesh& mesh) {
    const auto n_elements = cursor.text<std::uint64_t>();
    cursor.end_of_line();
    cursor.check_count(n_elements, 4, 8, "elements");
    check_total(cursor, mesh.element_tags.size() + n_elements, "elements");
    if (!cursor.is_binary()) {
        for (std::uint64_t element = 0; element < n_elements; ++element) {
            const std::uint64_t tag = read_int_tag(cursor, "element");
            const ElementType type = read_type(cursor);
            const std::int32_t n_labels = read_label_count(cursor);
            read_element_2(cursor, tag, type, n_labels, mesh);
        }
        return;
    }
    for (std::uint64_t done = 0; done < n_elements;) {
        const std::size_t begin = cursor.next();
        const ElementType type = read_type(cursor);
        const auto count = cursor.value<std::int32_t>();
        const std::int32_t n_labels = read_label_count(cursor);
        if (count <= 0 || static_cast<std::uint64_t>(count) > n_elements - done) {
            cursor.fail_at(begin, "a block of " + std::to_string(count) + " elements where " +
                                      std::to_string(n_elements - done) + " are left");
        }
        for (std::int32_t element = 0; element < count; ++element) {
            read_element_2(cursor, read_int_tag(cursor, "element"), type, n_labels, mesh);
        }
        done += static_cast<std::uint64_t>(count);
    }
}

} // namespace

void read_physical_names(Cursor& cursor, FileMesh& mesh) {
    const auto count = cursor.text<std::uint64_t>();
    for (std::uint64_t index = 0; index < count; ++index) {
        const auto dimension = cursor.text<std::int32_t>();
        const auto tag = cursor.text<std::int32_t>();
        mesh.group_names[{dimension, tag}] = cursor.quoted();
    }
}

void read_entities(Cursor& cursor, bool are_partitioned, FileMesh& mesh) {
    if (are_partitioned) {
        cursor.value<std::uint64_t>(); // partitions
        const auto n_ghosts = cursor.value<std::uint64_t>();
        cursor.check_count(n_ghosts, 2, 8, "ghost entities");
        for (std::uint64_t ghost = 0; ghost < n_ghosts; ++ghost) {
            cursor.value<std::int32_t>();
            cursor.value<std::int32_t>();
        }
    }
    std::array<std::uint64_t, 4> counts{};
    for (std::uint64_t& count : counts) {
        count = cursor.value<std::uint64_t>();
    }
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::uint64_t entity = 0; entity < counts[static_cast<std::size_t>(dimension)]; ++entity) {
            read_entity(cursor, dimension, are_partitioned, mesh);
        }
    }
}

void read_nodes(Cursor& cursor, Version version, FileMesh& mesh) {
    version == Version::v4_1 ? read_nodes_4(cursor, mesh) : read_nodes_2(cursor, false, mesh);
}

void read_parametric_nodes(Cursor& cursor, FileMesh& mesh) { read_nodes_2(cursor, true, mesh); }

void read_elements(Cursor& cursor, Version version, FileMesh& mesh) {
    version == Version::v4_1 ? read_elements_4(cursor, mesh) : read_elements_2(cursor, mesh);
}

} // namespace gmsh
