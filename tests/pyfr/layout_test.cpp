// What no sample shows: the plane, several partitions, single precision, time steps, averages, gradients, elements without
// values.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace elvis;
using Catch::Contains;

namespace {

/** Of degree 2 in the reference coordinates of each element, and not the same in any two. */
double value(const std::string& kind, std::size_t element, std::size_t variable, const Coordinates& x) {
    const double number = static_cast<double>(element) + (kind == "tri" ? 10 : 0);
    return number + static_cast<double>(variable + 1) * (x[0] + 0.5 * x[1] * x[0] - 0.25 * x[1] * x[1]);
}

/** Which element of which kind the source's elements 0 to 3 are: layout 0 has triangle 1 in partition 0, in front of triangle
 * 0. */
std::vector<std::pair<std::string, std::size_t>> order_of(int layout) {
    return layout == 0 ? std::vector<std::pair<std::string, std::size_t>>{{"quad", 0}, {"quad", 1}, {"tri", 1}, {"tri", 0}}
                       : std::vector<std::pair<std::string, std::size_t>>{{"quad", 0}, {"quad", 1}, {"tri", 0}, {"tri", 1}};
}

struct Written {
    TemporaryFolder folder;
    std::string mesh = folder.path("plane.pyfrm"), solution = folder.path("plane.pyfrs");
};

void write(const Written& files, const WrittenSolution& solution, int layout) {
    write_mesh(files.mesh, plane_mesh(), layout);
    write_solution(files.solution, plane_mesh(), solution, layout);
}

WrittenSolution two_variables() {
    WrittenSolution solution;
    solution.values = value;
    return solution;
}

} // namespace

TEST_CASE("meshes of the plane are read in all layouts", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files;
    write(files, two_variables(), layout);
    const SourceVolume source = open_pyfr({files.mesh, files.solution});
    CHECK(source.info().dimension == 2);
    REQUIRE(source.info().n_elements == 4);
    CHECK(field_names(source) == std::vector<std::string>{"rho", "E"});
    const auto order = order_of(layout);
    const std::array<double, 3> xi = {-0.3, -0.6, 0};
    for (std::size_t number = 0; number < 4; ++number) {
        INFO("layout " << layout << ", element " << number);
        const auto& [kind, element] = order[number];
        const std::vector<double> values = sample(source, number, xi);
        CHECK(values[0] == Approx(value(kind, element, 0, {xi[0], xi[1]})).epsilon(1e-13));
        CHECK(values[1] == Approx(value(kind, element, 1, {xi[0], xi[1]})).epsilon(1e-13));
    }
    const auto x = position(source, 1, xi);
    const Coordinates expected = bent(0.35, 1.2);
    CHECK(std::abs(x[0] - expected[0]) < 1e-14);
    CHECK(std::abs(x[1] - expected[1]) < 1e-14);
    CHECK(x[2] == 0);
}

TEST_CASE("elements of several partitions keep theirs", "[pyfr]") {
    const int layout = GENERATE(0, 1);
    const Written files;
    write(files, two_variables(), layout);
    const SourceVolume source = open_pyfr({files.mesh, files.solution});
    REQUIRE(source.n_parts() == (layout == 0 ? 2 : 0));
    if (layout == 0) {
        std::vector<std::uint32_t> parts(2);
        source.parts(2, parts);
        CHECK(parts == std::vector<std::uint32_t>{0, 1});
    }
}

TEST_CASE("edges of the plane keep their boundary groups", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files;
    write(files, two_variables(), layout);
    const SourceVolume source = open_pyfr({files.mesh, files.solution});
    const auto name = [&](int group) { return group < 0 ? "" : source.boundary_groups()[static_cast<std::size_t>(group)]; };
    const WrittenMesh mesh = plane_mesh();
    const auto elements = all_elements(source);
    const auto order = order_of(layout);
    for (std::size_t number = 0; number < 4; ++number) {
        const WrittenKind& kind = mesh.kinds[order[number].first == "tri" ? 1 : 0];
        const std::vector<std::string>& groups = kind.boundary[order[number].second];
        for (std::size_t face = 0; face < groups.size(); ++face) {
            // Faces of quadrilaterals and triangles have the same order in PyFR and here.
            CHECK(name(elements[number].face_groups[face]) == groups[face]);
        }
    }
}

TEST_CASE("meshes of the plane convert exactly", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files;
    write(files, two_variables(), layout);
    const SourceVolume source = open_pyfr({files.solution});
    const ConvertReport report = convert(source, files.folder.path("plane.h5"), {}, {});
    CHECK(report.geometry_exact);
    CHECK(report.n_unknown_faces == 0);
    CHECK(report.n_boundary_faces == 8);
    CHECK(report.fields.at(0).exact);
    CHECK(report.fields.at(1).exact);
}

TEST_CASE("several solutions are time steps, in the order of their times", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files;
    WrittenSolution solution = two_variables();
    write(files, solution, layout);
    solution.time = 0.25;
    solution.values = [](const std::string&, std::size_t, std::size_t, const Coordinates&) { return 7.0; };
    const std::string later = files.folder.path("later.pyfrs");
    write_solution(later, plane_mesh(), solution, layout);
    const SourceVolume source = open_pyfr({later, files.solution});
    CHECK(source.times() == std::vector<double>{0, 0.25});
    CHECK(sample(source, 2, {-0.3, -0.6, 0}, 1)[0] == Approx(7));
    CHECK(sample(source, 0, {0, 0, 0}, 0)[0] == Approx(0).margin(1e-14));
    solution.names = {"rho", "rhou"};
    solution.groups = {{"soln", {"rho", "rhou"}, 0}};
    write_solution(later, plane_mesh(), solution, layout);
    CHECK_THAT(failure({files.solution, later}), Contains("later.pyfrs") && Contains("other variables"));
}

TEST_CASE("single precision is told to the host", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files;
    WrittenSolution solution = two_variables();
    solution.is_single = true;
    write(files, solution, layout);
    const SourceVolume source = open_pyfr({files.solution});
    CHECK(source.info().mantissa_bits == 24);
    CHECK(sample(source, 1, {-0.3, -0.6, 0})[1] == Approx(value("quad", 1, 1, {-0.3, -0.6})).epsilon(1e-6));
    CHECK(convert(source, files.folder.path("plane.h5"), {}, {}).fields.at(0).exact);
}

TEST_CASE("elements without values are not a number", "[pyfr]") {
    const int layout = GENERATE(1, 2);
    const Written files;
    WrittenSolution solution = two_variables();
    solution.only = {{"quad", {1}}, {"tri", {}}};
    write(files, solution, layout);
    const SourceVolume source = open_pyfr({files.solution});
    CHECK(std::isnan(sample(source, 0, {0.1, 0.2, 0})[0]));
    CHECK(sample(source, 1, {-0.3, -0.6, 0})[0] == Approx(value("quad", 1, 0, {-0.3, -0.6})));
    CHECK(std::isnan(sample(source, 3, {-0.3, -0.6, 0})[1]));
    CHECK(convert(source, files.folder.path("plane.h5"), {}, {}).fields.at(0).n_not_finite == 3);
}

TEST_CASE("averages and gradients have the same names in layouts 1 and 2", "[pyfr]") {
    const int layout = GENERATE(1, 2);
    const Written files;
    WrittenSolution solution = two_variables();
    solution.prefix = "tavg";
    solution.names = {"avg-u", "std-u", "fun-avg-uu", "std-fun-avg-uu"};
    solution.groups = {{"avg", {"u"}, 0}, {"avg-std", {"u"}, 0}, {"fun-avg", {"uu"}, 0}, {"fun-avg-std", {"uu"}, 0}};
    write(files, solution, layout);
    CHECK(field_names(open_pyfr({files.solution})) == solution.names);

    solution.prefix = "soln";
    solution.names = {"p", "u", "grad_p_x", "grad_p_y", "grad_u_x", "grad_u_y"};
    solution.groups = {{"soln", {"p", "u"}, 0}, {"grad", {"p", "u"}, 2}};
    write(files, solution, layout);
    const SourceVolume source = open_pyfr({files.solution});
    CHECK(field_names(source) == solution.names);
    const std::vector<double> values = sample(source, 3, {-0.3, -0.6, 0});
    for (std::size_t variable = 0; variable < 6; ++variable) {
        CHECK(values[variable] == Approx(value("tri", 1, variable, {-0.3, -0.6})));
    }
}

TEST_CASE("elements that are straight are linear in the volume", "[pyfr]") {
    const int layout = GENERATE(0, 1, 2);
    const Written files;
    WrittenMesh mesh = plane_mesh();
    // Of order 2 still, but a parallelogram.
    for (std::size_t node = 0; node < 9; ++node) {
        const Coordinates& x = mesh.kinds[0].shape_points[node];
        mesh.kinds[0].elements[0][node] = {5 + x[0] + 0.1 * x[1], x[1]};
    }
    write_mesh(files.mesh, mesh, layout);
    const SourceVolume source = open_pyfr({files.mesh});
    CHECK(sample(source, 0, {0, 0, 0})[0] == 0);
    CHECK(sample(source, 1, {0, 0, 0})[0] == 1);
    const auto elements = all_elements(source);
    CHECK(elements[0].geometry_order[0] == 1);
    CHECK(elements[1].geometry_order[0] == 2);
}
