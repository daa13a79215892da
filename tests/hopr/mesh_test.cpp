// HOPR meshes: those of HORSES3D and SELF, and mortars, which no sample has.
#include "fixture.hpp"
#include "writer.hpp"

#include <catch2/catch.hpp>
#include <core/oracle/element/volume.hpp>

#include <Eigen/LU>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace elvis;

namespace {

std::map<std::string, int> faces_by_group(const SourceVolume& source) {
    std::map<std::string, int> n_faces;
    for (const elvis_source_element& element : all_elements(source)) {
        for (const std::int32_t group : element.face_groups) {
            if (group >= 0) {
                ++n_faces[source.boundary_groups()[static_cast<std::size_t>(group)]];
            }
        }
    }
    return n_faces;
}

/** The volume by three Gauss points a direction: exact for Jacobians of order 5 in each. */
double volume_of(const oracle::Volume& volume, std::size_t n_points) {
    std::vector<double> points(n_points), weights(n_points);
    native::gauss_legendre(points, weights);
    double sum = 0;
    for (std::size_t element = 0; element < volume.n_elements(); ++element) {
        for (std::size_t at = 0; at < n_points * n_points * n_points; ++at) {
            const std::size_t i = at % n_points, j = at / n_points % n_points, k = at / n_points / n_points;
            oracle::Matrix jacobian;
            volume.position(element, {points[i], points[j], points[k]}, &jacobian);
            sum += weights[i] * weights[j] * weights[k] * jacobian.determinant();
        }
    }
    return sum;
}

} // namespace

TEST_CASE("a box of cubes is read", "[hopr][data]") {
    const SourceVolume source = open_hopr({hopr_data("Box27.h5")});
    REQUIRE(source.info().n_elements == 27);
    // Cubes of width 1 in [-1, 2] x [-1, 2] x [0, 3], six sides of nine.
    CHECK(faces_by_group(source) ==
          std::map<std::string, int>{{"left", 9}, {"right", 9}, {"front", 9}, {"back", 9}, {"bottom", 9}, {"top", 9}});
    std::set<std::array<long, 3>> centres;
    for (std::uint64_t element = 0; element < 27; ++element) {
        const auto low = position(source, element, {-1, -1, -1}), high = position(source, element, {1, 1, 1});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(high[axis] - low[axis] == Approx(1).epsilon(1e-14));
        }
        centres.insert({std::lround(low[0]), std::lround(low[1]), std::lround(low[2])});
        CHECK(sample(source, element, {0, 0, 0}) == std::vector<double>{0});
    }
    CHECK(centres.size() == 27);
    CHECK(*centres.begin() == std::array<long, 3>{-1, -1, 0});
    CHECK(*centres.rbegin() == std::array<long, 3>{1, 1, 2});
}

TEST_CASE("the volume of a curved cylinder is pi", "[hopr][data]") {
    const SourceVolume source = open_hopr({hopr_data("Circle_mesh.h5")});
    REQUIRE(source.info().n_elements == 56);
    std::map<std::uint32_t, int> n_of_order;
    for (const elvis_source_element& element : all_elements(source)) {
        ++n_of_order[element.geometry_order[0]];
    }
    // Those in the middle are straight.
    CHECK(n_of_order[1] + n_of_order[6] == 56);
    CHECK(n_of_order[6] > 20);
    const TemporaryFolder folder;
    const ConvertReport report = convert(source, folder.path("circle.h5"), {}, {});
    CHECK(report.geometry_exact);
    CHECK(report.n_unknown_faces == 0);
    const double volume = volume_of(oracle::Volume(oracle::read_volume(folder.path("circle.h5"))), 10);
    std::printf("volume of the cylinder: pi + %.1e\n", volume - std::numbers::pi);
    // As measured, with two digits to spare: polynomials of order 6 through points of short arcs.
    CHECK(std::abs(volume - std::numbers::pi) < 1e-11);
    const auto groups = faces_by_group(source);
    CHECK(groups.at("LowerZ_BC") == 56);
    CHECK(groups.at("UpperZ_BC") == 56);
    for (std::uint64_t element = 0; element < 56; ++element) {
        const elvis_source_element described = all_elements(source)[element];
        for (int face = 0; face < 6; ++face) {
            if (described.face_groups[face] >= 0 &&
                source.boundary_groups()[static_cast<std::size_t>(described.face_groups[face])] == "outer") {
                for (const int corner : native::face_corners(native::Shape::hexahedron, face)) {
                    const auto x = position(source, element, native::corner(native::Shape::hexahedron, corner));
                    CHECK(std::hypot(x[0], x[1]) == Approx(1).epsilon(1e-12));
                }
            }
        }
    }
}

TEST_CASE("conditions between elements leave no boundary, periodic ones do", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), two_cubes());
    const SourceVolume source = open_hopr({folder.path("mesh.h5")});
    CHECK(faces_by_group(source) == std::map<std::string, int>{{"inflow", 1}, {"outflow", 1}, {"periodic", 4}});
    const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
    CHECK(report.n_boundary_faces == 10);
    CHECK(report.n_unknown_faces == 0);
}

TEST_CASE("sides behind a mortar belong to the next face", "[hopr]") {
    const TemporaryFolder folder;
    write_mesh(folder.path("mesh.h5"), mortar());
    const SourceVolume source = open_hopr({folder.path("mesh.h5")});
    const auto elements = all_elements(source);
    CHECK(std::vector<std::int32_t>(elements[0].face_groups, elements[0].face_groups + 6) ==
          std::vector<std::int32_t>{0, 0, -1, 0, 1, 0});
    CHECK(faces_by_group(source).at("right") == 4);
    const ConvertReport report = convert(source, folder.path("volume.h5"), {}, {});
    CHECK(report.n_unknown_faces > 0);
    CHECK(report.geometry_exact);
}
