// Files drawn as they are: what the runtime interface says of them, and the snippet against the native library's modes.
#include "direct_fixture.hpp"

#include <core/expression/expression.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/probe/device_evaluator.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace elvis;
using native::Basis;
using native::Shape;
using native::Space;
using nektar_writer::Point;

namespace {

std::vector<ReferencePoint> points_in(Shape shape, std::size_t n) {
    std::vector<ReferencePoint> points;
    const std::vector<double> eta = uniform_numbers(3 * n, 5, -1, 0.97);
    for (std::size_t at = 0; at < eta.size(); at += 3) {
        points.push_back({0, native::expand(shape, {eta[at], eta[at + 1], eta[at + 2]})});
    }
    return points;
}

double scale_of(const std::vector<double>& numbers) {
    double largest = 1;
    for (const double number : numbers) {
        largest = std::max(largest, std::abs(number));
    }
    return largest;
}

/** All bases and shapes, then further orders of them. */
const std::vector<Space> spaces{
    {Shape::hexahedron, Basis::modified, {2, 4, 3}},
    {Shape::hexahedron, Basis::orthogonal, {2, 4, 3}},
    {Shape::hexahedron, Basis::gll_lagrange, {3, 1, 5}},
    {Shape::hexahedron, Basis::gauss_lagrange, {4, 3, 2}},
    {Shape::prism, Basis::modified, {2, 4, 3}},
    {Shape::prism, Basis::orthogonal, {2, 4, 3}},
    {Shape::tetrahedron, Basis::modified, {3, 4, 6}},
    {Shape::tetrahedron, Basis::orthogonal, {3, 4, 6}},
    {Shape::pyramid, Basis::modified, {6, 6, 6}},
    {Shape::pyramid, Basis::orthogonal, {5, 5, 5}},
    {Shape::quadrilateral, Basis::modified, {3, 4, 0}},
    {Shape::quadrilateral, Basis::orthogonal, {3, 4, 0}},
    {Shape::quadrilateral, Basis::gll_lagrange, {4, 3, 0}},
    {Shape::triangle, Basis::modified, {3, 4, 0}},
    {Shape::triangle, Basis::orthogonal, {3, 4, 0}},
    {Shape::hexahedron, Basis::modified, {1, 1, 1}},
    {Shape::hexahedron, Basis::gauss_lagrange, {0, 0, 0}},
    {Shape::prism, Basis::modified, {1, 1, 1}},
    {Shape::tetrahedron, Basis::modified, {1, 1, 1}},
    {Shape::pyramid, Basis::modified, {2, 2, 2}},
    {Shape::pyramid, Basis::modified, {1, 1, 1}},
    {Shape::pyramid, Basis::orthogonal, {1, 1, 1}},
};
constexpr std::size_t n_bases = 15;

void check_sums(const Space& space) {
    CAPTURE(native::name(space.shape), native::name(space.basis), space.order[0], space.order[1], space.order[2]);
    const std::vector<double> coefficients = uniform_numbers(native::n_modes(space), 1);
    const TemporaryFolder folder;
    folder.write("one.fld", nektar_writer::field_file({block_of(space, coefficients)}));
    const RuntimeVolume volume = open_direct(folder.write("one.xml", bent_element(space.shape)));
    const std::vector<ReferencePoint> points = points_in(space.shape, 40);
    CpuEvaluator here(volume);
    DeviceEvaluator there(volume, {});
    const std::vector<FieldSample> wanted = here.evaluate(0, 0, points, true), found = there.evaluate(0, 0, points, true);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point xi{points[i].xi[0], points[i].xi[1], points[i].xi[2]};
        CHECK(wanted[i].values[0] == Approx(native::evaluate(space, coefficients, xi)).margin(1e-13));
        CHECK(found[i].values[0] == Approx(wanted[i].values[0]).margin(1e-12));
        CHECK_FALSE(found[i].gradient_is_estimated);
        if (volume.dimension() == 2) {
            // The CPU has no gradients in world coordinates on surfaces.
            continue;
        }
        const double scale = scale_of(wanted[i].gradients);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(found[i].gradients[k] == Approx(wanted[i].gradients[k]).margin(1e-11 * scale));
        }
    }
    if (volume.dimension() == 2) {
        return;
    }
    const auto laplacian = std::make_shared<Expression>("laplacian(u)", volume.fields(), volume.dimension());
    const auto second_wanted = here.evaluate(laplacian, 0, points, true),
               second_found = there.evaluate(laplacian, 0, points, true);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK_FALSE(second_found[i].value_is_estimated);
        // On the CPU second derivatives are differences, which are wrong where a pyramid's bend grows towards the apex.
        if (space.shape == Shape::pyramid && points[i].xi[2] > 0) {
            continue;
        }
        CHECK(second_found[i].value == Approx(second_wanted[i].value).epsilon(1e-5).margin(1e-4));
    }
}

} // namespace

TEST_CASE("the snippet sums the solver's own modes, in every basis and shape, derivatives included", "[nektarpp][direct]") {
    for (const Space& space : std::span(spaces).first(n_bases)) {
        check_sums(space);
    }
}

TEST_CASE("the snippet sums the solver's own modes of the lowest orders, and of others", "[.long]") {
    for (const Space& space : std::span(spaces).subspan(n_bases)) {
        check_sums(space);
    }
}

TEST_CASE("positions, values, bounds and ranges are those of the Nektar++ library", "[nektarpp][direct][data]") {
    // Pyramids of the library are off by their quadrature where a base is curved (README.md).
    const auto [name, tolerance] =
        GENERATE(table<std::string, double>({{"CubeAllElements", 1e-13}, {"cA", 3e-9}, {"Helmholtz3D_Tet_VarP", 1e-13}}));
    const RuntimeVolume volume = open_direct(sample_file(name + ".fld"));
    const std::uint64_t n = volume.n_elements();
    std::vector<double> bounds(6 * n);
    std::vector<FieldRange> ranges(n);
    CHECK(volume.bounds(0, n, bounds) == ELVIS_CERTIFIED);
    CHECK(volume.field_ranges(0, 0, 0, n, ranges) == ELVIS_CERTIFIED);
    std::vector<std::int64_t> numbers(n);
    volume.element_numbers(0, n, numbers);
    std::map<std::int64_t, std::uint64_t> position_of;
    for (std::uint64_t position = 0; position < n; ++position) {
        position_of[numbers[position]] = position;
    }
    std::ifstream file(sample_file(name + ".ref"));
    std::uint64_t element = 0;
    std::size_t n_points = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream text(line);
        if (line.starts_with("E ")) {
            std::int64_t id = 0;
            char tag = 0;
            text >> tag >> id;
            REQUIRE(position_of.contains(id));
            element = position_of[id];
            continue;
        }
        std::array<double, 3> xi{}, x{}, position{};
        double value = 0, found = 0;
        text >> xi[0] >> xi[1] >> xi[2] >> x[0] >> x[1] >> x[2] >> value;
        REQUIRE(text);
        volume.evaluate_mapping(element, xi, position, {});
        volume.evaluate_field(0, 0, element, xi, {&found, 1}, {});
        ++n_points;
        bool is_right = std::abs(found - value) <= 1e-12 && found >= ranges[element].lower && found <= ranges[element].upper;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            is_right = is_right && std::abs(position[axis] - x[axis]) <= tolerance &&
                       position[axis] >= bounds[6 * element + axis] && position[axis] <= bounds[6 * element + 3 + axis];
        }
        CHECK(is_right);
    }
    CHECK(n_points == 10 * n);
}

TEST_CASE("elements without data have NaN, the others their values", "[nektarpp][direct][data]") {
    const Space space{Shape::hexahedron, Basis::gll_lagrange, {2, 2, 2}};
    const std::vector<double> coefficients(native::n_modes(space), 3.0);
    const TemporaryFolder folder;
    std::filesystem::copy(sample_file("CubeAllElements.xml"), folder.path("s.xml"));
    folder.write("s.fld", nektar_writer::field_file({block_of(space, coefficients, "u", "70")}));
    const RuntimeVolume volume = open_direct(folder.path("s.xml"));
    CHECK(volume.classes().size() == 5);
    std::vector<std::int64_t> numbers(volume.n_elements());
    volume.element_numbers(0, numbers.size(), numbers);
    std::size_t n_known = 0;
    for (std::uint64_t position = 0; position < volume.n_elements(); ++position) {
        double value = 0;
        volume.evaluate_field(0, 0, position, std::vector<double>{-0.4, -0.4, -0.4}, {&value, 1}, {});
        CHECK(std::isnan(value) == (numbers[position] != 70));
        n_known += value == Approx(3) ? 1 : 0;
    }
    CHECK(n_known == 1);
}

TEST_CASE("faces join the elements that share them", "[nektarpp][direct][data]") {
    const RuntimeVolume volume = open_direct(sample_file("CubeAllElements.xml"));
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    CHECK(volume.boundary_groups().size() == 6);
    std::size_t n_boundary = 0;
    std::set<std::pair<std::int64_t, std::int32_t>> sides;
    for (const elvis_face& face : faces) {
        const auto shape_of = [&](std::int64_t element) {
            std::uint64_t first = 0;
            for (const ClassInfo& of : volume.classes()) {
                if (static_cast<std::uint64_t>(element) < first + of.n_elements) {
                    return static_cast<Shape>(of.shape);
                }
                first += of.n_elements;
            }
            return Shape::hexahedron;
        };
        // Corners in world coordinates.
        const auto corners = [&](std::int64_t element, std::int32_t local) {
            std::set<std::array<long, 3>> result;
            const Shape shape = shape_of(element);
            for (const int corner : native::face_corners(shape, local)) {
                std::array<double, 3> x{};
                const Point xi = native::corner(shape, corner);
                volume.evaluate_mapping(static_cast<std::uint64_t>(element), xi, x, {});
                result.insert({std::lround(x[0] * 1e9), std::lround(x[1] * 1e9), std::lround(x[2] * 1e9)});
            }
            return result;
        };
        CHECK(sides.emplace(face.element, face.local_face).second);
        if (face.neighbour == ELVIS_NEIGHBOUR_NONE) {
            ++n_boundary;
            CHECK(face.group != ELVIS_GROUP_NONE);
            continue;
        }
        CHECK(sides.emplace(face.neighbour, face.neighbour_local_face).second);
        CHECK(corners(face.element, face.local_face) == corners(face.neighbour, face.neighbour_local_face));
    }
    // 10 hexahedra, 36 prisms, 69 pyramids and 66 tetrahedra.
    CHECK(sides.size() == 10 * 6 + 36 * 5 + 69 * 5 + 66 * 4);
    CHECK(2 * faces.size() - n_boundary == sides.size());
}
