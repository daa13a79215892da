/*
 * Volumes from arrays, through the shared library.
 */
#include <elvis/elvis.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace {

using Point = std::array<double, 3>;

elvis_context_options no_plugins() {
    auto options = elvis::detail::sized<elvis_context_options>();
    options.plugin_path = "";
    return options;
}

/** Reference tetrahedron's corners and middles of edges: nodes of quadratic functions. */
const std::vector<double>& tetrahedron_nodes() {
    static const std::vector<double> nodes{-1, -1, -1, 1,  -1, -1, -1, 1,  -1, -1, -1, 1, 0,  -1, -1,
                                           0,  0,  -1, -1, 0,  -1, -1, -1, 0,  0,  -1, 0, -1, 0,  0};
    return nodes;
}

elvis_space quadratic(bool with_nodes) {
    auto space = elvis::detail::sized<elvis_space>();
    space.basis = ELVIS_BASIS_MODIFIED;
    std::fill(space.order, space.order + 3, 2u);
    space.nodes = with_nodes ? tetrahedron_nodes().data() : nullptr;
    return space;
}

/** A cube of six tetrahedra, whose places are bent a little; one field, values of a function at the nodes. */
class Cube {
public:
    explicit Cube(const std::function<double(const Point&)>& function) {
        const std::array<Point, 8> corners{Point{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1},      {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        for (const auto& tetrahedron :
             {std::array{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}) {
            std::array<std::vector<double>, 3> positions;
            std::vector<double> at_nodes;
            for (std::size_t node = 0; node < 10; ++node) {
                Point x{};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const Point xi{tetrahedron_nodes()[3 * node], tetrahedron_nodes()[3 * node + 1],
                                   tetrahedron_nodes()[3 * node + 2]};
                    const std::array weights{-0.5 * (1 + xi[0] + xi[1] + xi[2]), 0.5 * (1 + xi[0]), 0.5 * (1 + xi[1]),
                                             0.5 * (1 + xi[2])};
                    for (std::size_t corner = 0; corner < 4; ++corner) {
                        x[axis] += weights[corner] * corners[static_cast<std::size_t>(tetrahedron[corner])][axis];
                    }
                }
                x[2] += 0.1 * x[0] * x[1];
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    positions[axis].push_back(x[axis]);
                }
                at_nodes.push_back(function(x));
            }
            for (const std::vector<double>& of_axis : positions) {
                geometry.insert(geometry.end(), of_axis.begin(), of_axis.end());
            }
            values.insert(values.end(), at_nodes.begin(), at_nodes.end());
        }
        element_class = elvis::detail::sized<elvis_array_class>();
        element_class.shape = ELVIS_SHAPE_TETRAHEDRON;
        element_class.n_elements = 6;
        element_class.geometry_space = &space;
        element_class.geometry = geometry.data();
        field = elvis::detail::sized<elvis_array_field>();
        field.n_components = 1;
        field.name = "p";
        field.spaces = &space;
        field.values = &value_list;
        value_list = values.data();
        arrays = elvis::detail::sized<elvis_arrays>();
        arrays.dimension = 3;
        arrays.n_classes = 1;
        arrays.n_fields = 1;
        arrays.classes = &element_class;
        arrays.fields = &field;
    }
    Cube(const Cube&) = delete;
    Cube& operator=(const Cube&) = delete;

    std::vector<double> geometry, values;
    elvis_space space = quadratic(true);
    elvis_array_class element_class{};
    elvis_array_field field{};
    const double* value_list = nullptr;
    elvis_arrays arrays{};
};

} // namespace

TEST_CASE("A volume from values at nodes has them at the nodes, and knows its faces") {
    const elvis::context context(no_plugins());
    const Cube cube([](const Point& x) { return 2 * x[0] - 3 * x[1] + 0.5; });
    const elvis::data data = context.from_arrays(cube.arrays, "cube");
    CHECK(data.info().n_elements == 6);
    // Twelve triangles outside, six inside.
    CHECK_THAT(data.describe_briefly(), Catch::Contains("\"n_faces\": 18"));
    const elvis::probed found = data.probe({0.3, 0.4, 0.6, 0.9, 0.2, 0.1}, {"p"});
    CHECK(found.values[0] == Approx(2 * 0.3 - 3 * 0.4 + 0.5).margin(1e-12));
    CHECK(found.values[1] == Approx(2 * 0.9 - 3 * 0.2 + 0.5).margin(1e-12));
    elvis::scene scene = context.make_scene();
    scene.set("/image/size", "[64, 48]");
    scene.set("/surfaces/-", R"({"type": "boundary"})");
    const elvis::picture picture = data.render(scene);
    CHECK(picture.info().n_hit_pixels > 500);
    CHECK(picture.info().n_undecided_pixels == 0);
}

TEST_CASE("Values of a field are replaced, in pictures, at points and in ranges") {
    const elvis::context context(no_plugins());
    const Cube cube([](const Point&x) { return x[0]; }), other([](const Point&x) { return 5 - x[2]; });
    elvis::data data = context.from_arrays(cube.arrays);
    const elvis::data fresh = context.from_arrays(other.arrays);
    elvis::scene scene = context.make_scene();
    scene.set("/image/size", "[48, 36]");
    scene.set("/surfaces/-", R"({"type": "plane", "plane": [1, 1, 1, -1.2]})");
    data.render(scene);
    data.range("p");
    // What only samples on the device tell.
    CHECK(data.range("p + 1").maximum == Approx(2).epsilon(0.01));
    data.update_field(0, 0, 0, other.values.data());
    CHECK(data.render(scene).read<double>(ELVIS_CHANNEL_COLOR) == fresh.render(scene).read<double>(ELVIS_CHANNEL_COLOR));
    CHECK(data.probe({0.2, 0.3, 0.4}, {"p"}).values[0] == fresh.probe({0.2, 0.3, 0.4}, {"p"}).values[0]);
    CHECK(data.range("p").maximum == Approx(5).epsilon(1e-6));
    CHECK(data.range("p + 1").maximum == Approx(6).epsilon(0.01));
    CHECK_THROWS_WITH(data.update_field(1, 0, 0, other.values.data()), Catch::Contains("1 field"));
}

TEST_CASE("Arrays that make no volume are refused with the reason") {
    const elvis::context context(no_plugins());
    const auto zero = [](const Point&) { return 0.0; };
    const auto refused = [&](const Cube& cube, const std::string& reason) {
        CHECK_THROWS_WITH(context.from_arrays(cube.arrays), Catch::Contains(reason));
    };
    Cube cube(zero);
    cube.element_class.geometry = nullptr;
    refused(cube, "class 0: is NULL");
    Cube twice(zero);
    std::vector<double> nodes = tetrahedron_nodes();
    std::copy_n(nodes.begin(), 3, nodes.begin() + 3);
    twice.space.nodes = nodes.data();
    refused(twice, "do not determine");
    Cube outside(zero);
    nodes = tetrahedron_nodes();
    nodes[3] = 4;
    outside.space.nodes = nodes.data();
    refused(outside, "node 1 lies outside");
    Cube basis(zero);
    elvis_space lagrange = basis.space;
    lagrange.basis = ELVIS_BASIS_GLL_LAGRANGE;
    basis.element_class.geometry_space = &lagrange;
    refused(basis, "class 0");
    Cube corners(zero);
    const std::vector<std::int64_t> ids(24, -7);
    corners.element_class.corners = ids.data();
    refused(corners, "corner id -7");
    Cube high(zero);
    elvis_space of_high_order = high.space;
    std::fill(of_high_order.order, of_high_order.order + 3, 40u);
    high.element_class.geometry_space = &of_high_order;
    refused(high, "class 0");
}
