// Nek5000's own test of input and output has fields in closed form.
#include "nek5000_fixture.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace elvis;
using native::Point;

namespace {

using std::numbers::pi;

/** Velocity, pressure, temperature, two scalars: short_tests/io_test/io_test.usr of Nek5000. */
std::array<double, 7> closed_form(const Point& x) {
    const double r = std::hypot(x[0], x[1]), a = std::atan2(x[1], x[0]);
    return {std::sin(r * pi) * std::cos(2 * a) * std::sin(x[2] * pi),
            std::cos(r * pi) * std::sin(4 * a) * std::cos(x[2] * pi),
            x[2] * x[2] * std::sin(x[0] * pi) * std::cos(3 * x[1] * pi),
            x[0] * x[1] * x[2],
            r * std::cos(2 * a),
            r * std::cos(3 * a),
            r * std::cos(4 * a)};
}

/** Interpolation in barycentric form (Berrut & Trefethen, SIAM Rev. 46, 2004), in extended precision. */
std::vector<long double> weights_at(const std::vector<double>& nodes, long double x) {
    std::vector<long double> weights;
    long double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        long double weight = 1;
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            weight /= j == i ? 1 : static_cast<long double>(nodes[i]) - static_cast<long double>(nodes[j]);
        }
        weights.push_back(weight / (x - static_cast<long double>(nodes[i])));
        sum += weights.back();
    }
    for (long double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

struct Case {
    std::vector<std::string> files;
    std::size_t n;
    /** Of positions and values in the file. */
    double tolerance;
};

const std::vector<Case>& cases() {
    // Single precision: rounding of coordinates is multiplied by derivatives up to 3 pi, and interpolation adds at most its
    // Lebesgue constant of about 2 in each direction. Text has 7 digits.
    static const std::vector<Case> list{{{"m12io_test0.f00001"}, 6, 1e-6}, {{"m22io_test0.f00001"}, 10, 1e-6},
                                        {{"m22io_test0.f00002"}, 6, 1e-6}, {{"m22io_test1.f00003"}, 6, 1e-12},
                                        {{"fb2io_test.fld01"}, 6, 1e-6},   {{"fa2io_test.fld01"}, 6, 1e-5}};
    return list;
}

/** The vertices of the mesh are straight cells: corners in double precision tell all of the mapping. */
Point trilinear(const SourceVolume& exact, std::uint64_t element, const Point& xi) {
    Point x{};
    for (int corner = 0; corner < 8; ++corner) {
        const Point at = native::corner(native::Shape::hexahedron, corner);
        const Point position_of_corner = position(exact, element, at);
        const double weight = (1 + at[0] * xi[0]) * (1 + at[1] * xi[1]) * (1 + at[2] * xi[2]) / 8;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            x[axis] += weight * position_of_corner[axis];
        }
    }
    return x;
}

/** What the closed form is after interpolation through n nodes a direction. */
std::array<double, 7> interpolated(const SourceVolume& exact, std::uint64_t element, std::size_t n, const Point& xi) {
    std::vector<double> nodes(n);
    native::gauss_lobatto_legendre(nodes);
    std::array<std::vector<long double>, 3> weights;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        weights[axis] = weights_at(nodes, xi[axis]);
    }
    std::array<double, 7> values{};
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                const auto weight = static_cast<double>(weights[0][i] * weights[1][j] * weights[2][k]);
                const auto at_node = closed_form(trilinear(exact, element, {nodes[i], nodes[j], nodes[k]}));
                for (std::size_t value = 0; value < values.size(); ++value) {
                    values[value] += weight * at_node[value];
                }
            }
        }
    }
    return values;
}

/** Area of a plane volume, by Gauss points that integrate the Jacobian's determinant, of order up to 13, exactly. */
double area(const ConvertedVolume& volume) {
    std::vector<double> points(9), weights(9);
    native::gauss_legendre(points, weights);
    double sum = 0;
    for (std::uint64_t element = 0; element < volume.n_elements(); ++element) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (std::size_t j = 0; j < points.size(); ++j) {
                std::array<Point, 3> jacobian;
                volume.position(element, {points[i], points[j], 0}, &jacobian);
                sum += weights[i] * weights[j] * (jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0]);
            }
        }
    }
    return sum;
}

} // namespace

TEST_CASE("Fields at interior points are the closed form's interpolants, before and after conversion", "[nek5000]") {
    const SourceVolume exact = open_nek5000({sample_file("m22io_test0.f00003")});
    for (const Case& one : cases()) {
        const SourceVolume source = open_nek5000({sample_file(one.files.front())});
        REQUIRE(source.info().n_elements == 36);
        REQUIRE(source.n_values() == 7);
        const ConvertedVolume volume(source);
        double in_source = 0, in_volume = 0, in_position = 0;
        for (std::uint64_t element = 0; element < 36; ++element) {
            for (int repeat = 0; repeat < 3; ++repeat) {
                const Point xi = random_point(native::Shape::hexahedron);
                const auto expected = interpolated(exact, element, one.n, xi);
                const auto sampled = sample(source, 0, element, xi);
                for (std::size_t value = 0; value < 7; ++value) {
                    const std::size_t field = value < 3 ? 0 : value - 2;
                    const double converted = volume.value(element, field, xi, nullptr, value < 3 ? value : 0);
                    in_source = std::max(in_source, std::abs(sampled[value] - expected[value]));
                    in_volume = std::max(in_volume, std::abs(converted - expected[value]));
                }
                const Point x = trilinear(exact, element, xi), here = volume.position(element, xi);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    in_position = std::max(in_position, std::abs(x[axis] - here[axis]));
                }
            }
        }
        WARN(one.files.front() << ": largest error " << in_source << " in the source, " << in_volume
                               << " in the converted volume, position " << in_position);
        CHECK(in_source < one.tolerance);
        CHECK(in_volume < one.tolerance);
        CHECK(in_position < one.tolerance);
        CHECK(volume.report().geometry_exact);
        CHECK(volume.report().n_unknown_faces == 0);
        for (const FieldReport& field : volume.report().fields) {
            INFO(field.name << ", residual " << field.residual << ", jump " << field.max_jump);
            CHECK(field.exact);
            CHECK(field.continuity == ELVIS_CONTINUITY_CONTINUOUS);
        }
    }
}

TEST_CASE("Fields have names and the precision of the file", "[nek5000]") {
    const SourceVolume source = open_nek5000({sample_file("m12io_test0.f00001")});
    std::vector<std::string> names;
    for (const SourceField& field : source.fields()) {
        names.push_back(field.name);
    }
    CHECK(names == std::vector<std::string>{"velocity", "pressure", "temperature", "S01", "S02"});
    CHECK(source.fields()[0].n_components == 3);
    CHECK(source.info().dimension == 3);
    CHECK(source.info().mantissa_bits == 24);
    CHECK(source.times() == std::vector<double>{3.141592653590});
    CHECK(open_nek5000({sample_file("m22io_test0.f00003")}).info().mantissa_bits == 53);
}

TEST_CASE("Every part of a step opens all of it, once", "[nek5000]") {
    const SourceVolume one = open_nek5000({sample_file("m22io_test0.f00003")});
    const SourceVolume both = open_nek5000({sample_file("m22io_test1.f00003"), sample_file("m22io_test0.f00003")});
    CHECK(both.info().n_elements == 36);
    CHECK(both.times().size() == 1);
    for (std::uint64_t element = 0; element < 36; ++element) {
        CHECK(sample(one, 0, element, {0.2, -0.3, 0.4}) == sample(both, 0, element, {0.2, -0.3, 0.4}));
    }
}

TEST_CASE("Meshes of two dimensions are squares with fields of two components", "[nek5000]") {
    const SourceVolume lid = open_nek5000({sample_file("lid_mesh0.f00000")});
    CHECK(lid.info().dimension == 2);
    CHECK(lid.info().n_elements == 36);
    CHECK(lid.fields().at(0).n_components == 2);
    const ConvertedVolume volume(lid);
    CHECK(volume.report().elements.at("quadrilateral") == 36);
    CHECK(volume.report().geometry_exact);
    CHECK(volume.report().n_unknown_faces == 0);
    // Six squares a side.
    CHECK(volume.report().n_boundary_faces == 24);
    CHECK(area(volume) == Approx(1).margin(1e-6));

    const SourceVolume cylinder = open_nek5000({sample_file("cylinder_mesh0.f00000")});
    REQUIRE(cylinder.fields().size() == 1);
    CHECK(cylinder.fields()[0].name == "S01");
    const ConvertedVolume round(cylinder);
    CHECK(round.report().geometry_exact);
    CHECK(round.report().n_unknown_faces == 0);
    // A rectangle without a circle of radius 1/2, which elements of order 5 come near.
    CHECK(area(round) == Approx(40 * 30 - pi / 4).margin(1e-4));
    // The circle of radius 1/2, whose nodes lie within 2.3e-5 of it.
    double nearest = 1e9;
    for (std::uint64_t element = 0; element < cylinder.info().n_elements; ++element) {
        for (int corner = 0; corner < 4; ++corner) {
            const Point x = position(cylinder, element, native::corner(native::Shape::quadrilateral, corner));
            CHECK(x[2] == 0);
            nearest = std::min(nearest, std::hypot(x[0], x[1]));
        }
    }
    CHECK(nearest == Approx(0.5).margin(2.3e-5));
}
