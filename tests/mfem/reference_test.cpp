// Every data set against values that MFEM computed from the same files: the source and the converted volume.
#include "fixture.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace {

using elvis::oracle::Matrix;
using elvis::oracle::Vector;

struct ReferencePoint {
    std::size_t element = 0;
    int geometry = 0;
    Vector xi, x;
    std::vector<double> value;
};

std::vector<ReferencePoint> read_reference(const std::string& path, std::size_t n_components) {
    std::vector<ReferencePoint> points;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') {
            continue;
        }
        std::istringstream words(line);
        ReferencePoint point;
        std::array<double, 3> ip;
        words >> point.element >> point.geometry >> ip[0] >> ip[1] >> ip[2] >> point.x[0] >> point.x[1] >> point.x[2];
        const auto xi = from_mfem(point.geometry, ip);
        point.xi = {xi[0], xi[1], xi[2]};
        point.value.resize(n_components);
        for (double& value : point.value) {
            words >> value;
        }
        REQUIRE(words);
        points.push_back(point);
    }
    return points;
}

/** Largest errors, relative to the range of the field and to the extent of the mesh. */
struct Errors {
    double source = 0;
    double converted = 0;
    double source_position = 0;
    double converted_position = 0;
};

} // namespace

TEST_CASE("data sets of MFEM have the values that MFEM computes", "[mfem][data]") {
    const std::string name =
        GENERATE("dg-fichera-q3-p4", "poisson-fichera-q3-p5", "poisson-toroid-hex-p5", "poisson-inline-tet-p6",
                 "poisson-inline-wedge-p5", "poisson-toroid-wedge-p4", "poisson-fichera-mixed-p2-p3", "dg-fichera-amr-p2",
                 "advect-periodic-p6", "elast-beam-hex-p4", "maxwell-fichera-q3-nd3", "graddiv-fichera-rt2",
                 "poisson-inline-pyramid-p3");
    const auto source = open_mfem({mfem_data(name + "/mesh.mesh"), mfem_data(name + "/sol.gf")});
    const auto n_components = source.n_values();
    const elvis_transform transform = source.fields().at(0).transform;
    const auto points = read_reference(mfem_data(name + "/sol.ref"), n_components);
    REQUIRE(points.size() > 100);
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
            const Vector pulled_back(value[0], value[1], value[2]);
            const Vector world = transform == ELVIS_TRANSFORM_COVARIANT
                                     ? Vector(jacobian.inverse().transpose() * pulled_back)
                                     : Vector(jacobian * pulled_back / jacobian.determinant());
            std::copy_n(world.data(), 3, value.begin());
        }
        const std::vector<double> of_volume = converted.volume.field(place, point.xi);
        for (std::size_t c = 0; c < n_components; ++c) {
            errors.source = std::max(errors.source, std::abs(value[c] - point.value[c]) / range);
            errors.converted = std::max(errors.converted, std::abs(of_volume[c] - point.value[c]) / range);
        }
    }
    const elvis::FieldReport& field = converted.report.fields.at(0);
    INFO("residual " << field.residual << ", jump " << field.max_jump << ", unknown faces " << converted.report.n_unknown_faces);
    WARN(name << ": source " << errors.source << ", converted " << errors.converted << ", positions " << errors.source_position
              << " and " << errors.converted_position << ", residual " << field.residual);
    CHECK(errors.source <= 1e-11);
    CHECK(errors.converted <= 1e-11);
    CHECK(errors.source_position <= 1e-13);
    CHECK(errors.converted_position <= 1e-13);
    CHECK(field.exact);
    CHECK(field.mantissa_bits == 27);
    CHECK(converted.report.geometry_exact);
}
