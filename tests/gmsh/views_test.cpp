// Views: time steps, components, parts of the mesh without values, several files.
#include "fixture.hpp"
#include "msh_mesh.hpp"
#include "msh_writer.hpp"
#include "reference.hpp"
#include "scripts.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using Catch::Contains;

namespace {

/** One tetrahedron of order 2 beside another, with a triangle on its face. */
MshMesh two_tetrahedra() {
    MshMesh mesh;
    const double corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    // Sparse tags in no order of place.
    const std::int64_t tags[5] = {70, 20, 500, 3, 41};
    for (int corner = 0; corner < 5; ++corner) {
        mesh.nodes[tags[corner]] = {corners[corner][0], corners[corner][1], corners[corner][2]};
    }
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> middles;
    const auto middle = [&](std::int64_t a, std::int64_t b) {
        const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), 100000 + static_cast<std::int64_t>(middles.size()));
        if (is_new) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                mesh.nodes[found->second][axis] = (mesh.nodes.at(a)[axis] + mesh.nodes.at(b)[axis]) / 2;
            }
        }
        return found->second;
    };
    const auto tetrahedron = [&](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
        return std::vector<std::int64_t>{
            a, b, c, d, middle(a, b), middle(b, c), middle(c, a), middle(d, a), middle(d, c), middle(d, b)};
    };
    mesh.elements.push_back({.tag = 9, .type = 2, .label = 4, .nodes = {20, 500, 3}});
    mesh.elements.push_back({.tag = 1000000, .type = 11, .label = 1, .nodes = tetrahedron(70, 20, 500, 3)});
    mesh.elements.push_back({.tag = 12, .type = 11, .label = 1, .nodes = tetrahedron(41, 20, 3, 500)});
    return mesh;
}

double linear(const std::array<double, 3>& x) { return 1 + 2 * x[0] - x[1] + 3 * x[2]; }

std::string with(const MshMesh& mesh, const std::vector<ViewText>& views) {
    std::string text = write_mesh(mesh, {});
    for (const ViewText& view : views) {
        text += write_view(view, {});
    }
    return text;
}

ViewText constant(const std::string& name, int step, double time, double value) {
    return {
        .section = "ElementData", .name = name, .time = time, .step = step, .records = {{12, {value}}, {1000000, {value + 1}}}};
}

const Point inside{-0.5, -0.6, -0.7};

} // namespace

TEST_CASE("time steps of views become time steps", "[gmsh]") {
    const TemporaryFolder folder;
    const MshMesh mesh = two_tetrahedra();
    // Steps in no order, one view that has just one, and one that lacks a step.
    const auto source = open_msh(
        {folder.write("mesh.msh", with(mesh, {constant("a", 2, 0.9, 30), constant("a", 0, 0.1, 10), constant("a", 1, 0.4, 20),
                                              constant("b", 0, 0.0, 5), constant("c", 0, 0.1, 1), constant("c", 2, 0.9, 2)}))});
    REQUIRE(source.times() == std::vector<double>{0.1, 0.4, 0.9});
    REQUIRE(source.fields().size() == 3);
    for (std::uint32_t step = 0; step < 3; ++step) {
        const std::vector<double> values = sample(source, 1, inside, step);
        CHECK(values[0] == 10 * (step + 1));
        CHECK(values[1] == 5);
        CHECK((step == 1 ? std::isnan(values[2]) : values[2] == (step == 0 ? 1 : 2)));
        CHECK(sample(source, 0, inside, step)[0] == 10 * (step + 1) + 1);
    }
    const Converted converted(source);
    CHECK(converted.volume().times() == source.times());
    CHECK(converted.value(0, 1, inside, 2)[0] == Approx(30).epsilon(1e-13));
    CHECK(converted.report().fields[2].n_not_finite == 2);
}

TEST_CASE("time steps may come in files of their own", "[gmsh]") {
    const TemporaryFolder folder;
    const MshMesh mesh = two_tetrahedra();
    const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    const std::string first = folder.write("0.msh", with(mesh, {constant("a", 0, 0.5, 1)}));
    const std::string second = folder.write("1.msh", head + write_view(constant("a", 1, 0.6, 2), {}));
    // A file may repeat the mesh.
    const std::string third = folder.write("2.msh", with(mesh, {constant("a", 2, 0.7, 3)}));
    const auto source = open_msh({first, second, third});
    CHECK(source.times() == std::vector<double>{0.5, 0.6, 0.7});
    CHECK(sample(source, 1, inside, 2)[0] == 3);
    MshMesh other = mesh;
    other.nodes[70][0] = 0.25;
    CHECK_THAT(failure({first, folder.write("other.msh", with(other, {}))}), Contains("other.msh") && Contains("another mesh"));
}

TEST_CASE("values at some nodes or elements only", "[gmsh]") {
    const TemporaryFolder folder;
    const MshMesh mesh = two_tetrahedra();
    ViewText corners{.name = "corners"}, half{.name = "half"}, in_corners{.section = "ElementNodeData", .name = "in corners"},
        one{.section = "ElementNodeData", .name = "one"},
        surface{.section = "ElementData", .name = "surface", .records = {{9, {1}}}},
        tensor{.section = "ElementData", .name = "tensor", .n_components = 9, .records = {{12, {1, 2, 3, 4, 5, 6, 7, 8, 9}}}};
    for (const auto& [tag, x] : mesh.nodes) {
        if (tag < 100000) {
            corners.records.push_back({tag, {linear(x)}});
        }
    }
    for (const std::int64_t node : mesh.elements[1].nodes) {
        half.records.push_back({node, {linear(mesh.nodes.at(node))}});
    }
    for (const MshElement& element : {mesh.elements[1], mesh.elements[2]}) {
        std::vector<double> values;
        for (std::size_t corner = 0; corner < 4; ++corner) {
            values.push_back(linear(mesh.nodes.at(element.nodes[corner])));
        }
        in_corners.records.push_back({element.tag, values});
        one.records.push_back({element.tag, {static_cast<double>(element.tag)}});
    }
    const auto source = open_msh({folder.write("mesh.msh", with(mesh, {corners, half, in_corners, one, surface, tensor}))});
    std::vector<std::string> names;
    for (const auto& field : source.fields()) {
        names.push_back(field.name);
    }
    // The view on the surface has no value in a solid.
    REQUIRE(names == std::vector<std::string>{"corners", "half", "in corners", "one", "tensor"});
    for (std::uint64_t element = 0; element < 2; ++element) {
        const Point x = position(source, element, inside);
        const std::vector<double> values = sample(source, element, inside);
        CHECK(values[0] == Approx(linear(x)).epsilon(1e-13));
        CHECK((element == 0 ? values[1] == Approx(linear(x)).epsilon(1e-13) : std::isnan(values[1])));
        CHECK(values[2] == Approx(linear(x)).epsilon(1e-13));
        CHECK(values[3] == (element == 0 ? 1000000 : 12));
        CHECK((element == 0 ? std::isnan(values[12]) : values[12] == 9));
        std::vector<elvis_source_space> space(1);
        const std::uint32_t orders[5] = {1, element == 0 ? 2u : 0u, 1, 0, 0};
        for (std::uint32_t field = 0; field < 5; ++field) {
            source.spaces(field, element, 1, space);
            INFO(names[field]);
            CHECK(space[0].order[0] == orders[field]);
            CHECK(space[0].is_contained == 1);
        }
    }
}

TEST_CASE("views of one name stay apart", "[gmsh]") {
    const TemporaryFolder folder;
    ViewText nodes{.name = "a"};
    const MshMesh mesh = two_tetrahedra();
    for (const auto& [tag, x] : mesh.nodes) {
        nodes.records.push_back({tag, {linear(x)}});
    }
    const auto source =
        open_msh({folder.write("mesh.msh", with(mesh, {constant("a", 0, 0, 1), nodes, constant("a", 0, 0, 7)}))});
    REQUIRE(source.fields().size() == 3);
    CHECK(source.fields()[1].name == "a (2)");
    CHECK(sample(source, 1, inside)[2] == 7);
}
