// Solution points of layout 0, which only their rule's name tells: a polynomial in the reference coordinates comes back.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>
#include <plugins/nodal/nodal_space.hpp>
#include <plugins/pyfr/points.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace elvis;
using Catch::Contains;

namespace {

/** One triangle with values at the points of a rule. */
std::vector<double> values_on_triangle(const std::vector<Coordinates>& points, const std::string& rule) {
    const TemporaryFolder folder;
    WrittenMesh mesh = plane_mesh();
    mesh.kinds.erase(mesh.kinds.begin());
    mesh.kinds[0].solution_points = points;
    WrittenSolution solution;
    solution.names = {"u"};
    solution.groups = {{"soln", {"u"}, 0}};
    solution.values = [](const std::string&, std::size_t, std::size_t, const Coordinates& x) { return 1 + x[0] - 3 * x[1]; };
    solution.rules = {{"tri", rule}};
    write_mesh(folder.path("t.pyfrm"), mesh, 0);
    write_solution(folder.path("t.pyfrs"), mesh, solution, 0);
    return sample(open_pyfr({folder.path("t.pyfrs")}), 0, {-0.3, -0.5, 0});
}

/** Points of one of PyFR's tables: the first three numbers of each line. */
std::vector<double> table(const std::string& name) {
    std::ifstream file(pyfr_data("points/" + name));
    std::vector<double> points;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        double x = 0, y = 0, z = 0;
        words >> x >> y >> z;
        points.insert(points.end(), {x, y, z});
    }
    return points;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0;
    for (std::size_t at = 0; at < a.size(); ++at) {
        largest = std::max(largest, std::abs(a[at] - b[at]));
    }
    return largest;
}

std::vector<double> points_of(const std::string& kind, const std::string& rule, std::size_t n) {
    return elvis_pyfr::solution_points(*elvis_pyfr::find_kind(kind), rule, n);
}

} // namespace

TEST_CASE("points are those of PyFR's tables, in their order", "[pyfr][data]") {
    CHECK(distance(points_of("pyr", "gauss-legendre", 55), table("gauss-legendre-n55-su.txt")) < 1e-15);
    CHECK(distance(points_of("tet", "shunn-ham", 35), table("shunn-ham-n35-d6-spu.txt")) == 0);
    CHECK(distance(points_of("pri", "williams-shunn~gauss-legendre", 75),
                   table("williams-shunn~gauss-legendre-n75-d7-pstu.txt")) < 1e-15);
    // gauss-legendre-lobatto-n14-su.txt begins with the apex.
    const std::vector<double> pyramid = points_of("pyr", "gauss-legendre-lobatto", 14);
    CHECK(distance({pyramid.begin(), pyramid.begin() + 9}, {0, 0, 1, -1, -1, -1, 0, -1, -1}) < 1e-15);
    CHECK(distance({pyramid.end() - 12, pyramid.end()}, {-0.5, -0.5, 0, 0.5, -0.5, 0, -0.5, 0.5, 0, 0.5, 0.5, 0}) < 1e-15);
}

TEST_CASE("points of every rule determine the functions of their order and lie inside", "[pyfr]") {
    const std::vector<std::pair<std::string, std::string>> rules = {{"hex", "gauss-legendre"},
                                                                    {"hex", "gauss-legendre-lobatto"},
                                                                    {"quad", "gauss-legendre"},
                                                                    {"quad", "gauss-legendre-lobatto"},
                                                                    {"pyr", "gauss-legendre"},
                                                                    {"pyr", "gauss-legendre-lobatto"},
                                                                    {"tri", "williams-shunn"},
                                                                    {"tri", "alpha-opt"},
                                                                    {"pri", "alpha-opt~gauss-legendre-lobatto"},
                                                                    {"pri", "williams-shunn~gauss-legendre"},
                                                                    {"tet", "shunn-ham"}};
    int n_known = 0;
    for (const auto& [name, rule] : rules) {
        const elvis_pyfr::Kind& kind = *elvis_pyfr::find_kind(name);
        for (std::uint32_t order = 0; order <= 8; ++order) {
            INFO(name << ", " << rule << ", order " << order);
            std::vector<double> xi;
            try {
                xi = elvis_pyfr::to_native(kind, points_of(name, rule, nodal::n_functions(kind.shape, order)));
            } catch (const std::invalid_argument&) {
                continue;
            }
            CHECK_NOTHROW(nodal::NodalSpace(kind.shape, order, xi));
            for (std::size_t point = 0; point < xi.size(); point += 3) {
                CHECK(native::is_inside(kind.shape, {xi[point], xi[point + 1], xi[point + 2]}, 1e-14));
            }
            ++n_known;
        }
    }
    // Tables of triangles have orders 1 to 8 and 1 to 6, of tetrahedra 0 to 6; what has formulas has all nine.
    CHECK(n_known == 6 * 9 + 8 + 6 + 6 + 8 + 7);
}

TEST_CASE("points in place of a rule's name are taken as they are", "[pyfr]") {
    const std::vector<Coordinates> points = {{-1, -1}, {1, -1}, {-1, 1}};
    CHECK(values_on_triangle(points, "-1 -1\n  1 -1\n  -1 1").at(0) == Approx(2.2));
    CHECK(values_on_triangle(points, "[(-1, -1), (1, -1), (-1, 1)]").at(0) == Approx(2.2));
    CHECK(values_on_triangle(points, "-1 -1 0.3\n  1 -1 0.3\n  -1 1 0.4").at(0) == Approx(2.2));
}

TEST_CASE("rules of triangles are known", "[pyfr]") {
    // First, second and last lines of PyFR's tables of three points.
    CHECK(values_on_triangle({{-1, 1}, {1, -1}, {-1, -1}}, "alpha-opt").at(0) == Approx(2.2));
    constexpr double a = -0.666666666666666, b = 0.333333333333332;
    CHECK(values_on_triangle({{a, b}, {b, a}, {a, a}}, "williams-shunn").at(0) == Approx(2.2));
}

TEST_CASE("a rule that is not known is named", "[pyfr]") {
    CHECK_THAT(
        [] {
            try {
                values_on_triangle({{-1, -1}, {1, -1}, {-1, 1}}, "unheard-of");
            } catch (const std::exception& error) {
                return std::string(error.what());
            }
            return std::string("no failure");
        }(),
        Contains("[solver-elements-tri] soln-pts") && Contains("3 points of 'unheard-of' on tri are not known"));
}
