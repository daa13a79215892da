// Every data set against values that MFEM computed from the same files: the source and the converted volume.
#include "fixture.hpp"
#include "marking.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace {

using elvis::oracle::Matrix;
using elvis::oracle::Vector;

/** Largest errors, relative to the range of the field and to the extent of the mesh. */
struct Errors {
    double source = 0;
    double converted = 0;
    double source_position = 0;
    double converted_position = 0;
};

/** The reference point in a tetrahedron as the file has it, of a point in the same one turned by MFEM. */
Vector undo_marking(const elvis::SourceVolume& source, const ReferencePoint& point, double tolerance) {
    const Vector x = 0.5 * (point.xi + Vector::Ones());
    const std::array<double, 4> weights{1 - x.sum(), x[0], x[1], x[2]};
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
        const Vector xi = 2 * Vector(weights[order[1]], weights[order[2]], weights[order[3]]) - Vector::Ones();
        const std::array<double, 3> at{xi[0], xi[1], xi[2]};
        Vector position;
        source.evaluate_mapping(point.element, at, std::span(position.data(), 3));
        if ((position - point.x).norm() <= tolerance) {
            return xi;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    FAIL("no order of corners puts element " << point.element << " where MFEM has it");
    return point.xi;
}

/** An interior point of a local face. */
Vector point_on_face(elvis::native::Shape shape, int local_face) {
    constexpr std::array<double, 4> weights{0.3, 0.2, 0.4, 0.1};
    Vector xi = Vector::Zero();
    double sum = 0;
    std::size_t corner = 0;
    for (int index : elvis::native::face_corners(shape, local_face)) {
        const auto at = elvis::native::corner(shape, index);
        xi += weights[corner] * Vector(at[0], at[1], at[2]);
        sum += weights[corner++];
    }
    return xi / sum;
}

} // namespace

TEST_CASE("data sets of MFEM have the values that MFEM computes", "[mfem][data]") {
    const std::string name = GENERATE(
        "mfem/dg-fichera-q3-p4", "mfem/poisson-fichera-q3-p5", "mfem/poisson-toroid-hex-p5", "mfem/poisson-inline-tet-p6",
        "mfem/poisson-inline-wedge-p5", "mfem/poisson-toroid-wedge-p4", "mfem/dg-fichera-amr-p2", "mfem/advect-periodic-p6",
        "mfem/elast-beam-hex-p4", "mfem/maxwell-fichera-q3-nd3", "mfem/graddiv-fichera-rt2", "mfem/poisson-inline-pyramid-p3",
        "mfem-more/star-h1-p3", "mfem-more/star-q3-h1-p5-vec", "mfem-more/amr-quad-h1-p3", "mfem-more/klein-bottle-h1-p4",
        "mfem-more/periodic-hexagon-l2-p3", "mfem-more/inline-wedge-h1-p3", "mfem-more/rt2d-star-p2",
        "mfem-more/nd2d-star-mixed-p2");
    const auto data = [&](const char* file) { return elvis::test::data_file(name + file); };
    const auto source = open_mfem({data("/mesh.mesh"), data("/sol.gf")});
    const auto n_components = source.n_values();
    const elvis_transform transform = source.fields().at(0).transform;
    const auto points = read_reference(data("/sol.ref"), n_components);
    REQUIRE(points.size() > 50);
    const Converted converted = convert_mfem(source);

    double lower = std::numeric_limits<double>::max(), upper = -lower;
    Vector least = points.front().x, most = points.front().x;
    for (const ReferencePoint& point : points) {
        for (double value : point.value) {
            lower = std::min(lower, value);
            upper = std::max(upper, value);
        }
        least = least.cwiseMin(point.x);
        most = most.cwiseMax(point.x);
    }
    const double range = upper - lower, extent = (most - least).maxCoeff();

    Errors errors;
    for (const ReferencePoint& point : points) {
        const std::array<double, 3> xi{point.xi[0], point.xi[1], point.xi[2]};
        const std::size_t place = converted.place.at(point.element);
        Matrix jacobian;
        const Vector position = converted.volume.position(place, point.xi, &jacobian);
        errors.converted_position = std::max(errors.converted_position, (position - point.x).norm() / extent);
        Vector source_position;
        source.evaluate_mapping(point.element, xi, std::span(source_position.data(), 3));
        errors.source_position = std::max(errors.source_position, (source_position - point.x).norm() / extent);

        std::vector<double> value(n_components);
        source.sample(0, point.element, xi, value);
        if (transform != ELVIS_TRANSFORM_NONE) {
            const bool is_flat = n_components == 2;
            if (is_flat) {
                jacobian.col(2) = Vector::UnitZ();
            }
            const Vector pulled_back(value[0], value[1], is_flat ? 0 : value[2]);
            const Vector world = transform == ELVIS_TRANSFORM_COVARIANT
                                     ? Vector(jacobian.inverse().transpose() * pulled_back)
                                     : Vector(jacobian * pulled_back / jacobian.determinant());
            std::copy_n(world.data(), n_components, value.begin());
        }
        const std::vector<double> of_volume = converted.volume.field(place, point.xi);
        for (std::size_t c = 0; c < n_components; ++c) {
            errors.source = std::max(errors.source, std::abs(value[c] - point.value[c]) / range);
            errors.converted = std::max(errors.converted, std::abs(of_volume[c] - point.value[c]) / range);
        }
    }
    const elvis::FieldReport& field = converted.report.fields.at(0);
    INFO("residual " << field.residual << ", jump " << field.max_jump << ", unknown faces "
                     << converted.report.n_unknown_faces);
    WARN(name << ": source " << errors.source << ", converted " << errors.converted << ", positions " << errors.source_position
              << " and " << errors.converted_position << ", residual " << field.residual);
    CHECK(errors.source <= 1e-11);
    CHECK(errors.converted <= 1e-11);
    CHECK(errors.source_position <= 1e-13);
    CHECK(errors.converted_position <= 1e-13);
    CHECK(field.exact);
    // 8 digits, and 16.
    CHECK(field.mantissa_bits == (name.starts_with("mfem/") ? 27u : 53u));
    CHECK(converted.report.geometry_exact);
}

// The reference values of this set come from MFEM reading the mesh for refinement: it turns tetrahedra, numbers edges and faces
// anew, and so takes the coefficients for another function. On a mesh turned likewise the plugin finds just that function; on
// the mesh of the file it finds the solution.
TEST_CASE("hexahedra, prisms and tetrahedra in one mesh", "[mfem][data]") {
    const std::string mesh = mfem_data("poisson-fichera-mixed-p2-p3/mesh.mesh");
    const std::string solution = mfem_data("poisson-fichera-mixed-p2-p3/sol.gf");
    const auto points = read_reference(mfem_data("poisson-fichera-mixed-p2-p3/sol.ref"), 1);
    const TemporaryFolder folder;
    const auto source = open_mfem({mesh, solution});
    const auto turned = open_mfem({folder.write("turned.mesh", marked_mesh(read_file(mesh))), solution});
    const Converted converted = convert_mfem(source);
    const Converted converted_turned = convert_mfem(turned);

    double lower = 0, upper = 0;
    Errors errors;
    for (const ReferencePoint& point : points) {
        lower = std::min(lower, point.value[0]);
        upper = std::max(upper, point.value[0]);
    }
    constexpr double extent = 2;
    for (const ReferencePoint& point : points) {
        const Vector xi = point.geometry == 4 ? undo_marking(source, point, 1e-12) : point.xi;
        Vector position;
        source.evaluate_mapping(point.element, std::array{xi[0], xi[1], xi[2]}, std::span(position.data(), 3));
        errors.source_position = std::max(errors.source_position, (position - point.x).norm() / extent);
        const Vector of_volume = converted.volume.position(converted.place.at(point.element), xi);
        errors.converted_position = std::max(errors.converted_position, (of_volume - point.x).norm() / extent);

        std::array<double, 1> value;
        turned.sample(0, point.element, std::array{point.xi[0], point.xi[1], point.xi[2]}, value);
        errors.source = std::max(errors.source, std::abs(value[0] - point.value[0]) / (upper - lower));
        const auto converted_value = converted_turned.volume.field(converted_turned.place.at(point.element), point.xi);
        errors.converted = std::max(errors.converted, std::abs(converted_value[0] - point.value[0]) / (upper - lower));
    }
    WARN("poisson-fichera-mixed-p2-p3: source " << errors.source << ", converted " << errors.converted << ", positions "
                                                << errors.source_position << " and " << errors.converted_position);
    CHECK(errors.source <= 1e-11);
    CHECK(errors.converted <= 1e-11);
    CHECK(errors.source_position <= 1e-13);
    CHECK(errors.converted_position <= 1e-13);

    // The solution of the Poisson problem vanishes on the boundary; the function on the turned mesh does not.
    CHECK(converted.report.fields.at(0).exact);
    CHECK(converted.report.fields.at(0).max_jump <= 1e-14);
    double on_boundary = 0;
    std::size_t n_boundary = 0;
    for (std::uint64_t number = 0; number < source.info().n_elements; ++number) {
        elvis_source_element element{};
        element.struct_size = sizeof element;
        source.elements(number, 1, std::span(&element, 1));
        const auto shape = static_cast<elvis::native::Shape>(element.shape);
        for (int face = 0; face < elvis::native::n_faces(shape); ++face) {
            if (element.face_groups[face] == ELVIS_GROUP_NONE) {
                continue;
            }
            ++n_boundary;
            const Vector xi = point_on_face(shape, face);
            std::array<double, 1> value;
            source.sample(0, number, std::array{xi[0], xi[1], xi[2]}, value);
            on_boundary = std::max(on_boundary, std::abs(value[0]));
        }
    }
    CHECK(n_boundary == 480);
    CHECK(on_boundary <= 1e-15);
}
