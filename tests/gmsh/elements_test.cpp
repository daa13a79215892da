// Element types and orders: meshes of the gmsh program, straight and curved, against functions known beforehand.
#include "fixture.hpp"
#include "msh_mesh.hpp"
#include "msh_writer.hpp"
#include "reference.hpp"
#include "scripts.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <sstream>

namespace {

/** Largest differences from what is known. */
struct Errors {
    double mapping = 0;
    double node_data = 0;
    double element_node_data = 0;
    double converted = 0;
};

void raise(double& largest, double error) { largest = std::isnan(error) ? HUGE_VAL : std::max(largest, std::abs(error)); }

/** A polynomial of a degree in world coordinates, of size about 1 on the boxes. */
double polynomial(int degree, const Point& x) {
    return std::pow(0.15 * x[0] - 0.2 * x[1] + 0.3 * x[2] - 0.5, degree) + std::pow(0.09 * x[0] + 0.25 * x[1], degree) - x[2];
}

using NodesByType = std::map<int, std::vector<Point>>;

NodesByType reference_nodes(const MshMesh& straight, int dimension) {
    NodesByType nodes;
    for (const MshElement& element : straight.of_dimension(dimension)) {
        if (!nodes.contains(element.type)) {
            nodes[element.type] = nodes_from_straight(straight, element);
        }
    }
    return nodes;
}

/** Puts nodes exactly where they belong in straight elements: gmsh places those on edges to about 1e-12 only. */
void straighten(MshMesh& mesh, const NodesByType& nodes, int dimension) {
    for (const MshElement& element : mesh.of_dimension(dimension)) {
        const auto exact = straight_positions(mesh, element, nodes.at(element.type));
        for (std::size_t node = 0; node < exact.size(); ++node) {
            mesh.nodes.at(element.nodes[node]) = exact[node];
        }
    }
}

/** Bends a straight mesh. */
MshMesh bend(MshMesh mesh) {
    for (auto& [tag, x] : mesh.nodes) {
        x = {x[0] + 0.1 * std::sin(x[1] + x[2]), x[1] + 0.1 * x[0] * x[2] * x[2] / 8, x[2] + 0.1 * std::cos(2 * x[0])};
    }
    return mesh;
}

/**
 * Writes three views into a file of gmsh's (or, without name, one of the mesh given): positions and (on straight meshes) a
 * polynomial at nodes, and in each element another function of its space at the nodes' reference points. Compares at random
 * points.
 */
Errors check(const TemporaryFolder& folder, const std::string& name, const MshMesh& mesh, const NodesByType& nodes,
             int dimension, bool is_straight, std::set<int>& seen) {
    const std::vector<MshElement> elements = mesh.of_dimension(dimension);
    ViewText positions{.name = "positions", .n_components = 3}, values{.name = "polynomial"},
        in_elements{.section = "ElementNodeData", .name = "in elements"};
    int degree = 1;
    for (const MshElement& element : elements) {
        const TypeFacts type = facts(element.type);
        degree = type.is_serendipity ? 1 : type.order;
        seen.insert(element.type);
    }
    for (const auto& [tag, x] : mesh.nodes) {
        positions.records.push_back({tag, {x[0], x[1], x[2]}});
        values.records.push_back({tag, {polynomial(degree, x)}});
    }
    std::vector<SpaceFunction> functions;
    for (const MshElement& element : elements) {
        const SpaceFunction& function = functions.emplace_back(facts(element.type));
        std::vector<double> at_nodes;
        for (const Point& xi : nodes.at(element.type)) {
            at_nodes.push_back(function(xi));
        }
        in_elements.records.push_back({element.tag, at_nodes});
    }
    std::string text = name.empty() ? write_mesh(mesh, {}) : read_file(folder.path(name));
    for (const ViewText& view : {positions, values, in_elements}) {
        text += write_view(view, {.is_4 = mesh.is_4});
    }
    const auto source = open_msh({folder.write("views.msh", text)});
    REQUIRE(source.info().n_elements == elements.size());
    REQUIRE(source.n_values() == 5);
    const Converted converted(source);
    CHECK(converted.report().geometry_exact);
    for (const auto& field : converted.report().fields) {
        INFO(name << " " << field.name << " residual " << field.residual);
        CHECK(field.exact);
    }
    Errors errors;
    for (std::size_t index = 0; index < elements.size(); ++index) {
        const auto& at = nodes.at(elements[index].type);
        // The mapping passes through the nodes.
        for (std::size_t node = 0; node < at.size(); ++node) {
            const Point x = position(source, index, at[node]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                raise(errors.mapping, x[axis] - mesh.nodes.at(elements[index].nodes[node])[axis]);
            }
        }
        for (int trial = 0; trial < 10; ++trial) {
            const Point xi = random_point(shape_of(source, index));
            const Point x = position(source, index, xi);
            const std::vector<double> value = sample(source, index, xi);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                raise(errors.node_data, value[axis] - x[axis]);
            }
            if (is_straight) {
                raise(errors.node_data, value[3] - polynomial(degree, x));
            }
            raise(errors.element_node_data, value[4] - functions[index](xi));
            const Point y = converted.position(index, xi);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                raise(errors.converted, y[axis] - x[axis]);
                raise(errors.converted, converted.value(0, index, xi)[axis] - x[axis]);
            }
            if (is_straight) {
                raise(errors.converted, converted.value(1, index, xi)[0] - polynomial(degree, x));
            }
            raise(errors.converted, converted.value(2, index, xi)[0] - functions[index](xi));
        }
    }
    return errors;
}

void check_order(int order, bool is_serendipity, int dimension, std::set<int>& seen) {
    const TemporaryFolder folder;
    // Gmsh has no functions for serendipity pyramids above order 2.
    const int n_boxes = is_serendipity && order > 2 ? 3 : 4;
    std::ostringstream options_text;
    options_text << "-" << dimension << " -order " << order << " -setnumber n_boxes " << n_boxes
                 << " -setnumber Mesh.SecondOrderIncomplete " << is_serendipity;
    const std::string options = options_text.str();
    run_gmsh(folder, boxes_script, options + " -format msh41 -o straight.msh");
    MshMesh straight = read_mesh(folder.path("straight.msh"));
    const NodesByType nodes = reference_nodes(straight, dimension);
    straighten(straight, nodes, dimension);
    // The program takes long for hexahedra of high order.
    const bool gmsh_bends = order < 8 || is_serendipity || dimension == 2;
    if (gmsh_bends) {
        run_gmsh(folder, boxes_script, options + " -format msh41 -o curved.msh -setnumber curved 1");
    }
    const MshMesh curved = gmsh_bends ? read_mesh(folder.path("curved.msh")) : bend(straight);
    for (const bool is_straight : {true, false}) {
        const Errors errors = check(folder, is_straight || !gmsh_bends ? "" : "curved.msh", is_straight ? straight : curved,
                                    nodes, dimension, is_straight, seen);
        WARN(dimension << "D, order " << order << (is_serendipity ? ", serendipity" : "")
                       << (is_straight ? ", straight" : ", curved") << ": mapping " << errors.mapping << ", $NodeData "
                       << errors.node_data << ", $ElementNodeData " << errors.element_node_data << ", converted "
                       << errors.converted);
        CHECK(errors.mapping <= 1e-11);
        CHECK(errors.node_data <= 1e-11);
        CHECK(errors.element_node_data <= 1e-11);
        CHECK(errors.converted <= 1e-11);
    }
}

} // namespace

TEST_CASE("solid elements of order 1 to 6 are exact", "[gmsh]") {
    std::set<int> seen;
    for (int order = 1; order <= 6; ++order) {
        check_order(order, false, 3, seen);
    }
    for (const int type : {4, 5, 6, 7, 11, 12, 13, 14, 29, 92, 90, 118, 30, 93, 91, 119, 31, 94, 106, 120, 71, 95, 107, 121}) {
        INFO("element type " << type);
        CHECK(seen.contains(type));
    }
}

TEST_CASE("solid elements of order 7 to 9 are exact", "[gmsh]") {
    std::set<int> seen;
    for (int order = 7; order <= 9; ++order) {
        check_order(order, false, 3, seen);
    }
    for (const int type : {72, 73, 74, 96, 97, 98, 108, 109, 110, 122, 123, 124}) {
        INFO("element type " << type);
        CHECK(seen.contains(type));
    }
}

TEST_CASE("solid serendipity elements are exact", "[gmsh]") {
    std::set<int> seen;
    for (const int order : {2, 3, 4, 5, 7, 9}) {
        check_order(order, true, 3, seen);
    }
    for (const int type : {17, 18, 19, 137, 99, 111, 32, 100, 112, 33, 101, 113, 80, 82, 103, 105, 115, 117}) {
        INFO("element type " << type);
        CHECK(seen.contains(type));
    }
}

TEST_CASE("plane elements of order 1 to 9 are exact", "[gmsh]") {
    std::set<int> seen;
    for (int order = 1; order <= 9; ++order) {
        check_order(order, false, 2, seen);
        if (order > 1) {
            check_order(order, true, 2, seen);
        }
    }
    for (const int type : {2, 3, 9, 10, 16, 20, 21, 22, 24, 36, 39, 40, 41, 45, 50, 52, 53, 54, 55, 57, 58, 59, 60}) {
        INFO("element type " << type);
        CHECK(seen.contains(type));
    }
}
