// Volumes of two dimensions: points, lines, integrals, heights.

#include <elvis/extract.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>
#include <vector>

using namespace elvis;

namespace {

using FlatPoint = std::array<double, 2>;

/** Where (X, Y) of the rectangle [0, 2] x [0, 1.5] is. */
FlatPoint place(double a, double b) { return {a + 0.15 * b * b, b + 0.1 * a * a}; }
double p_at(const FlatPoint& x) { return x[0] * x[1] + x[0]; }
FlatPoint u_at(const FlatPoint& x) { return {p_at(x), x[0] * x[0]}; }

elvis_space space_of(std::uint32_t order, const std::vector<double>& nodes) {
    auto space = detail::sized<elvis_space>();
    space.basis = ELVIS_BASIS_MODIFIED;
    space.order[0] = space.order[1] = order;
    space.nodes = nodes.data();
    return space;
}

/** Evenly spaced, of a square or of the triangle below its diagonal. */
std::vector<double> nodes_of(bool is_square, int order) {
    std::vector<double> nodes;
    for (int j = 0; j <= order; ++j) {
        for (int i = 0; i <= (is_square ? order : order - j); ++i) {
            nodes.insert(nodes.end(), {2.0 * i / order - 1, 2.0 * j / order - 1, 0});
        }
    }
    return nodes;
}

/** Elements of one shape, as images of parts of the rectangle. */
struct Class {
    Class(bool is_square, const std::vector<std::array<FlatPoint, 3>>& corners)
        : geometry_nodes(nodes_of(is_square, 2)), field_nodes(nodes_of(is_square, 4)),
          geometry_space(space_of(2, geometry_nodes)) {
        for (const auto& [origin, along, up] : corners) {
            const auto at = [&, origin = origin, along = along, up = up](const std::vector<double>& nodes, std::size_t node) {
                const double s = 0.5 * (1 + nodes[3 * node]), t = 0.5 * (1 + nodes[3 * node + 1]);
                return place(origin[0] + s * along[0] + t * up[0], origin[1] + s * along[1] + t * up[1]);
            };
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::size_t node = 0; node < geometry_nodes.size() / 3; ++node) {
                    geometry.push_back(axis < 2 ? at(geometry_nodes, node)[axis] : 0);
                }
            }
            const std::size_t n = field_nodes.size() / 3;
            for (std::size_t node = 0; node < n; ++node) {
                p.push_back(p_at(at(field_nodes, node)));
            }
            for (std::size_t component = 0; component < 2; ++component) {
                for (std::size_t node = 0; node < n; ++node) {
                    u.push_back(u_at(at(field_nodes, node))[component]);
                }
            }
        }
        element_class = detail::sized<elvis_array_class>();
        element_class.shape = is_square ? ELVIS_SHAPE_QUADRILATERAL : ELVIS_SHAPE_TRIANGLE;
        element_class.n_elements = corners.size();
        element_class.geometry_space = &geometry_space;
        element_class.geometry = geometry.data();
    }
    Class(const Class&) = delete;
    Class& operator=(const Class&) = delete;

    std::vector<double> geometry_nodes, field_nodes, geometry, p, u;
    elvis_space geometry_space;
    elvis_array_class element_class{};
};

/** Bent quadrilaterals and triangles with p = xy + x and u = (p, x^2), both exact. */
data bent_rectangle(const context& library) {
    std::vector<std::array<FlatPoint, 3>> squares, triangles;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 4; ++i) {
            const double a = 0.5 * i, b = 0.5 * j;
            if ((i + j) % 2 == 0) {
                squares.push_back({FlatPoint{a, b}, {0.5, 0}, {0, 0.5}});
            } else {
                triangles.push_back({FlatPoint{a, b}, {0.5, 0}, {0, 0.5}});
                triangles.push_back({FlatPoint{a + 0.5, b + 0.5}, {-0.5, 0}, {0, -0.5}});
            }
        }
    }
    const Class square(true, squares), triangle(false, triangles);
    const std::array classes{square.element_class, triangle.element_class};
    const std::array spaces{space_of(4, square.field_nodes), space_of(4, triangle.field_nodes)};
    const std::array p{square.p.data(), triangle.p.data()}, u{square.u.data(), triangle.u.data()};
    std::array fields{detail::sized<elvis_array_field>(), detail::sized<elvis_array_field>()};
    fields[0].name = "p";
    fields[0].n_components = 1;
    fields[0].values = p.data();
    fields[1].name = "u";
    fields[1].n_components = 2;
    fields[1].values = u.data();
    fields[0].spaces = fields[1].spaces = spaces.data();
    auto arrays = detail::sized<elvis_arrays>();
    arrays.dimension = 2;
    arrays.n_classes = 2;
    arrays.n_fields = 2;
    arrays.classes = classes.data();
    arrays.fields = fields.data();
    return library.from_arrays(arrays, "rectangle");
}

context own_context() {
    auto options = detail::sized<elvis_context_options>();
    options.plugin_path = "";
    return context(options);
}

elvis_integration over(elvis_domain domain, const char* field, bool is_flux = false) {
    auto wanted = detail::sized<elvis_integration>();
    wanted.domain = domain;
    wanted.field = field;
    wanted.is_flux = is_flux ? 1 : 0;
    return wanted;
}

} // namespace

TEST_CASE("Arrows stand on elements of two dimensions") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    const auto drawn = [&](const char* arrows, const char* precision) {
        scene shown = library.make_scene();
        shown.set("/image/size", "[160, 120]");
        shown.set("/precision", precision);
        shown.set("/camera", R"({"eye": [1.2, 0.9, 5], "look_at": [1.2, 0.9, 0], "up": [0, 1, 0], "field_of_view": 30})");
        shown.set("/surfaces/-", R"({"type": "elements", "name": "all"})");
        shown.set("/surfaces/-", arrows);
        return flat.render(shown);
    };
    for (const char* const arrows : {R"({"type": "arrows", "vectors": "u", "field": "p", "spacing": 0.3})",
                                     R"({"type": "arrows", "vectors": "u", "field": "p", "spacing": 0.3, "on": "all"})"}) {
        const picture with = drawn(arrows, "\"float64\"");
        const std::vector<double> depths = with.read<double>(ELVIS_CHANNEL_DEPTH),
                                  normals = with.read<double>(ELVIS_CHANNEL_NORMAL),
                                  values = with.read<double>(ELVIS_CHANNEL_VALUE);
        const std::vector<std::int64_t> elements = with.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT);
        std::size_t n_arrow = 0, n_flat = 0;
        bool has_values = true;
        for (std::size_t pixel = 0; pixel < depths.size(); ++pixel) {
            if (elements[pixel] < 0) {
                continue;
            }
            // Arrows rise above the plane.
            const bool is_flat = std::abs(normals[3 * pixel + 2]) > 1 - 1e-12;
            n_flat += is_flat ? 1 : 0;
            n_arrow += is_flat ? 0 : 1;
            has_values = has_values && values[pixel] > -1e-9 && values[pixel] < 2.35 * 2.0 + 2.35;
        }
        std::cout << n_arrow << " pixels of arrows, " << n_flat << " of the plane\n";
        CHECK(has_values);
        CHECK(n_arrow > 100);
        CHECK(n_flat > 2 * n_arrow);
    }
}

TEST_CASE("Elements of two dimensions are a mesh, and lines on them contours") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    auto wanted = detail::sized<elvis_extraction>();
    wanted.domain = ELVIS_DOMAIN_BOUNDARY;
    const extracted all = extract(library, flat, wanted);
    CHECK(all.info.n_triangles > 12);
    CHECK(all.info.n_branching_edges == 0);
    CHECK(all.info.euler_number == 1);
    CHECK(all.info.surface_to_mesh <= all.info.tolerance);
    CHECK(std::abs(all.normals[2]) == 1);

    // x y + x = 1.
    wanted.domain = ELVIS_DOMAIN_ISOSURFACE;
    wanted.level_field = "p";
    wanted.isovalue = 1;
    const extracted line = extract(library, flat, wanted);
    REQUIRE(line.info.n_lines == 1);
    CHECK(line.info.n_triangles == 0);
    double off = 0;
    for (std::size_t i = 0; i < line.info.n_vertices; ++i) {
        const double x = line.positions[3 * i], y = line.positions[3 * i + 1];
        off = std::max(off, std::abs(x * y + x - 1));
    }
    CHECK(off < 1e-11);
    CHECK(line.info.surface_to_mesh <= line.info.tolerance);
}

TEST_CASE("Points of a plane are found in bent elements, with values and gradients") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    double largest = 0;
    for (int i = 0; i < 100; ++i) {
        const FlatPoint x = place(std::fmod(i * 0.731, 1.99), std::fmod(i * 0.517, 1.49));
        const probed found = flat.probe({x[0], x[1], 0}, {"p", "u", "norm(grad(p))"});
        REQUIRE(found.elements[0] >= 0);
        const std::array expected{p_at(x), u_at(x)[0], u_at(x)[1], std::hypot(x[1] + 1, x[0])};
        for (std::size_t value = 0; value < expected.size(); ++value) {
            largest = std::max(largest, std::abs(found.values[value] - expected[value]));
        }
        largest = std::max({largest, std::abs(found.gradients[0] - (x[1] + 1)), std::abs(found.gradients[1] - x[0]),
                            std::abs(found.gradients[2])});
    }
    std::cout << "largest error of values and gradients in the plane: " << largest << '\n';
    CHECK(largest < 1e-12);
    CHECK(flat.probe({1, 0.5, 0.01}, {"p"}).elements[0] < 0);
    CHECK(flat.probe({-0.1, 0.5, 0}, {"p"}).elements[0] < 0);
}

TEST_CASE("A line in the plane tells where it enters and leaves elements") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    const auto places = nlohmann::json::parse(flat.walk_line({-1, 0.62, 0}, {4, 0.93, 0}, {"p"}));
    REQUIRE(places.size() > 5);
    CHECK(places.front()["before"].is_null());
    CHECK(places.back()["after"].is_null());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const FlatPoint x{places[i]["position"][0], places[i]["position"][1]};
        for (const char* const side : {"before", "after"}) {
            if (!places[i][side].is_null()) {
                CHECK(places[i][side]["values"][0].get<double>() == Approx(p_at(x)).margin(1e-11));
            }
        }
        if (i > 0) {
            CHECK(places[i]["before"]["element"] == places[i - 1]["after"]["element"]);
        }
    }
    CHECK_THROWS_WITH(flat.walk_line({-1, 0.62, 0}, {4, 0.93, 1}, {"p"}), Catch::Contains("constant z"));
}

TEST_CASE("Areas, lengths of lines and contours, and fluxes through them are integrated in the plane") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    CHECK(flat.integrate(over(ELVIS_DOMAIN_VOLUME, "1")).value == Approx(3 - 0.135).epsilon(1e-9));
    const double source = flat.integrate(over(ELVIS_DOMAIN_VOLUME, "div(u)")).value;
    CHECK(flat.integrate(over(ELVIS_DOMAIN_BOUNDARY, "u", true)).value == Approx(source).epsilon(1e-9));

    elvis_integration circle = over(ELVIS_DOMAIN_ISOSURFACE, "1");
    circle.level_field = "sqrt((x - 1.08)^2 + (y - 0.85)^2)";
    circle.isovalue = 0.3;
    const elvis_integral length = flat.integrate(circle);
    CHECK(length.is_converged != 0);
    CHECK(length.value == Approx(0.6 * std::numbers::pi).epsilon(1e-8));
    circle.field = "x * grad(x)";
    circle.is_flux = 1;
    CHECK(flat.integrate(circle).value == Approx(0.09 * std::numbers::pi).epsilon(1e-8));

    elvis_integration line = over(ELVIS_DOMAIN_PLANE, "x^2");
    line.plane[1] = 1;
    line.plane[3] = -0.7;
    // From Y = 0.7 at X = 0, and from there to where X = 2.
    const double from = 0.15 * 0.49, to = 2 + 0.15 * 0.09;
    const elvis_integral along = flat.integrate(line);
    CHECK(along.measure == Approx(to - from).epsilon(1e-8));
    CHECK(along.value == Approx((std::pow(to, 3) - std::pow(from, 3)) / 3).epsilon(1e-8));
}

TEST_CASE("A number is a height above the plane, and the surface that it makes has its area") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    auto warp = detail::sized<elvis_warp>();
    warp.field = "p";
    warp.factor = 0.5;
    const data raised = flat.warp(warp);
    const double area = flat.integrate(over(ELVIS_DOMAIN_VOLUME, "sqrt(1 + 0.25 * norm(grad(p))^2)")).value;
    CHECK(raised.integrate(over(ELVIS_DOMAIN_VOLUME, "1")).value == Approx(area).epsilon(1e-8));
    const FlatPoint x = place(0.8, 0.9);
    CHECK(raised.probe({x[0], x[1], 0.5 * p_at(x)}, {"p"}).values[0] == Approx(p_at(x)).margin(1e-12));
    CHECK(raised.probe({x[0], x[1], 0}, {"p"}).elements[0] < 0);
    scene shown = library.make_scene();
    shown.set("/image/size", "[60, 45]");
    shown.set("/camera", R"({"eye": [1, -4, 4], "look_at": [1, 0.8, 0.5], "up": [0, 0, 1]})");
    const std::size_t n_hit = raised.render(shown).info().n_hit_pixels;
    CHECK(n_hit > 100);
    shown.set("/warp", R"({"field": "p", "factor": 0.5})");
    CHECK(flat.render(shown).info().n_hit_pixels == n_hit);
}

TEST_CASE("A picture that nobody has placed a camera for shows all undeformed edges beside what is displaced") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    scene shown = library.make_scene();
    shown.set("/image/size", "[80, 160]");
    // To negative x, while the edges stay at positive x.
    shown.set("/warp", R"({"field": "u", "factor": -2})");
    shown.set("/surfaces/-", R"({"type": "wireframe", "color": [1, 0, 0], "undeformed": true})");
    const std::vector<double> color = flat.render(shown).read<double>(ELVIS_CHANNEL_COLOR);
    std::size_t n_edges = 0, n_at_border = 0;
    for (std::size_t pixel = 0; pixel < color.size() / 4; ++pixel) {
        const std::size_t column = pixel % 80, row = pixel / 80;
        const bool is_edge = color[4 * pixel] == 1 && color[4 * pixel + 1] == 0;
        n_edges += is_edge;
        n_at_border += is_edge && (column == 0 || column == 79 || row == 0 || row == 159);
    }
    CHECK(n_edges > 10);
    CHECK(n_at_border == 0);
}

TEST_CASE("A pixel of a plane is asked, and percentiles of its values are told") {
    const context library = own_context();
    const data flat = bent_rectangle(library);
    scene shown = library.make_scene();
    shown.set("/image/size", "[64, 48]");
    shown.set("/field", "\"p\"");
    const auto picked = nlohmann::json::parse(flat.pick(shown, 32.5, 24.5));
    REQUIRE(picked["hit"] == true);
    const FlatPoint x{picked["position"][0], picked["position"][1]};
    CHECK(picked["fields"][0]["values"][0].get<double>() == Approx(p_at(x)).margin(1e-9));
    CHECK(picked["order"] == 4);
    CHECK(picked["jacobian"].is_null());
    const std::vector<double> bounds = flat.percentiles(shown, {0.1, 0.9});
    CHECK(bounds[0] > 0);
    CHECK(bounds[1] > bounds[0]);
}
