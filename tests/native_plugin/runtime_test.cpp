/*
 * The C side of the plugin, through the ABI: structure, bounds, ranges, evaluation, errors.
 */
#include "volume_fixture.hpp"

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

using namespace elvis;
using test::ClassPlan;
using test::TestVolume;

namespace {

native::Field scalar_field(const std::string& name) { return {name, "Pa", 1, native::Continuity::continuous, {}, 0.25}; }
native::Field vector_field(const std::string& name, native::Transform transform) {
    return {name, "", 3, native::Continuity::discontinuous, transform, std::nan("")};
}

/** A class for each shape and basis, with orders that differ between geometry and fields. */
std::vector<ClassPlan> all_classes(std::uint32_t geometry_order, std::uint32_t field_order, std::size_t n_fields) {
    const std::vector<native::Space> geometry = test::spaces_of_order(geometry_order);
    const std::vector<native::Space> field = test::spaces_of_order(field_order);
    std::vector<ClassPlan> classes;
    for (std::size_t i = 0; i < geometry.size(); ++i)
        classes.push_back({geometry[i], std::vector<native::Space>(n_fields, field[i])});
    return classes;
}

std::vector<double> random_points(native::Shape shape, std::size_t n, test::Random& random) {
    std::vector<double> points;
    for (std::size_t i = 0; i < n; ++i) {
        const native::Point xi = random.point(shape);
        points.insert(points.end(), xi.begin(), xi.end());
    }
    return points;
}

} // namespace

TEST_CASE("the plugin tells what is in the file") {
    const TestVolume file(all_classes(2, 3, 2), {scalar_field("p"), vector_field("u", native::Transform::none)}, {0.5, 1.5});
    const RuntimeVolume volume = file.open();
    CHECK(volume.dimension() == 3);
    CHECK(volume.n_elements() == 33);
    REQUIRE(volume.classes().size() == 11);
    CHECK(volume.classes()[4].shape == ELVIS_SHAPE_PRISM);
    CHECK(volume.classes()[4].geometry_order[1] == 2);
    CHECK(volume.class_field(4, 1).order[2] == 3);
    CHECK(volume.fields()[0].name == "p");
    CHECK(volume.fields()[0].unit == "Pa");
    CHECK(volume.fields()[0].max_jump == 0.25);
    CHECK(volume.fields()[0].continuity == ELVIS_CONTINUITY_CONTINUOUS);
    CHECK(volume.fields()[1].n_components == 3);
    CHECK(volume.times() == std::vector<double>{0.5, 1.5});
    CHECK(volume.boundary_groups() == std::vector<std::string>{"wall", "inflow"});
    const std::vector<std::pair<std::string, std::string>>& notes = volume.notes();
    CHECK(std::find(notes.begin(), notes.end(), std::pair<std::string, std::string>("source file", "random")) != notes.end());

    std::vector<std::int64_t> numbers(33);
    volume.element_numbers(0, 33, numbers);
    for (std::size_t i = 0; i < 33; ++i)
        CHECK(numbers[i] == static_cast<std::int64_t>(32 - i));
}

TEST_CASE("faces name elements by their position, class by class") {
    const TestVolume file(all_classes(1, 1, 1), {scalar_field("p")});
    const RuntimeVolume volume = file.open();
    std::vector<elvis_face> faces(1);
    faces[0].struct_size = sizeof(elvis_face);
    volume.faces(0, 1, faces);
    const native::Face written = TestVolume::example_face();
    // Numbers run backwards.
    CHECK(faces[0].element == 32 - written.element);
    CHECK(faces[0].neighbour == 32 - written.neighbour);
    CHECK(faces[0].local_face == written.local_face);
    CHECK(faces[0].neighbour_local_face == written.neighbour_local_face);
    CHECK(faces[0].group == written.group);
}

TEST_CASE("only straight tetrahedra are known to be affine") {
    const TestVolume file(all_classes(1, 1, 1), {scalar_field("p")});
    const RuntimeVolume straight_volume = file.open();
    REQUIRE(straight_volume.classes().size() == 11);
    for (const ClassInfo& info : straight_volume.classes())
        CHECK(info.is_affine == (info.shape == ELVIS_SHAPE_TETRAHEDRON));
    const TestVolume curved(all_classes(2, 1, 1), {scalar_field("p")});
    const RuntimeVolume curved_volume = curved.open();
    for (const ClassInfo& info : curved_volume.classes())
        CHECK_FALSE(info.is_affine);
}

TEST_CASE("evaluation gives the functions in the file, and positions stay inside the certified bounds") {
    const std::uint32_t order = GENERATE(0u, 1u, 2u, 5u, 9u);
    const TestVolume file(all_classes(std::clamp(order, 1u, 4u), order, 2),
                          {scalar_field("p"), vector_field("u", native::Transform::none)}, {0.0, 1.0}, 100);
    const RuntimeVolume volume = file.open();
    test::Random random(5);
    for (std::size_t i = 0; i < volume.classes().size(); ++i) {
        const native::Space& geometry = file.description().classes[i].geometry;
        const native::Space& space = file.description().classes[i].fields[1];
        INFO(test::describe(space));
        for (std::uint64_t local = 0; local < 3; ++local) {
            const std::uint64_t element = file.first_element(i) + local;
            constexpr std::size_t n = 30;
            const std::vector<double> xi = random_points(space.shape, n, random);
            std::vector<double> positions(3 * n), jacobians(9 * n), values(3 * n), gradients(9 * n);
            volume.evaluate_mapping(element, xi, positions, jacobians);
            volume.evaluate_field(1, 1, element, xi, values, gradients);
            std::array<double, 6> box{};
            CHECK(volume.bounds(element, 1, box) == ELVIS_CERTIFIED);
            std::array<FieldRange, 3> ranges;
            CHECK(volume.field_ranges(1, 1, element, 1, ranges) == ELVIS_CERTIFIED);
            for (std::size_t k = 0; k < n; ++k) {
                const native::Point at{xi[3 * k], xi[3 * k + 1], xi[3 * k + 2]};
                for (std::size_t c = 0; c < 3; ++c) {
                    native::Point gradient;
                    CHECK(positions[3 * k + c] ==
                          Approx(native::evaluate(geometry, file.geometry(i, local, c), at, gradient)).epsilon(1e-13));
                    for (std::size_t j = 0; j < 3; ++j)
                        CHECK(jacobians[9 * k + 3 * c + j] == Approx(gradient[j]).margin(1e-10));
                    CHECK((box[c] <= positions[3 * k + c] && positions[3 * k + c] <= box[c + 3]));
                    CHECK(values[3 * k + c] ==
                          Approx(native::evaluate(space, file.field(1, 1, i, local, c), at, gradient)).margin(1e-12));
                    for (std::size_t j = 0; j < 3; ++j)
                        CHECK(gradients[9 * k + 3 * c + j] == Approx(gradient[j]).margin(1e-9));
                    // An evaluation may round beyond the exact range.
                    CHECK(ranges[c].lower <= values[3 * k + c] + 1e-13);
                    CHECK(values[3 * k + c] <= ranges[c].upper + 1e-13);
                }
            }
            // Elements are about 2 wide. Bernstein coefficients exaggerate the bend of 0.02, tenfold a direction at order 4.
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(box[c + 3] - box[c] < (geometry.order[2] <= 2 ? 4 : 60));
        }
    }
}

TEST_CASE("vector fields with a transform are given in world components, with exact derivatives") {
    const bool covariant = GENERATE(true, false);
    const native::Transform transform = covariant ? native::Transform::covariant : native::Transform::contravariant;
    const TestVolume file(all_classes(3, 3, 1), {vector_field("u", transform)});
    const RuntimeVolume volume = file.open();
    test::Random random(6);
    double largest_error = 0;
    for (std::size_t i = 0; i < volume.classes().size(); ++i) {
        const native::Space& geometry = file.description().classes[i].geometry;
        const native::Space& space = file.description().classes[i].fields[0];
        INFO(test::describe(space));
        CHECK(volume.class_field(static_cast<std::uint32_t>(i), 0).order[0] == -1);
        const std::uint64_t element = file.first_element(i);
        const auto exact = [&](const native::Point& xi) {
            Eigen::Matrix3d jacobian;
            Eigen::Vector3d hat;
            for (Eigen::Index c = 0; c < 3; ++c) {
                const auto component = static_cast<std::size_t>(c);
                native::Point row;
                native::evaluate(geometry, file.geometry(i, 0, component), xi, row);
                jacobian.row(c) = Eigen::Map<Eigen::RowVector3d>(row.data());
                hat[c] = native::evaluate(space, file.field(0, 0, i, 0, component), xi);
            }
            return covariant ? Eigen::Vector3d(jacobian.transpose().partialPivLu().solve(hat))
                             : Eigen::Vector3d(jacobian * hat / jacobian.determinant());
        };
        std::array<FieldRange, 3> ranges;
        CHECK(volume.field_ranges(0, 0, element, 1, ranges) == ELVIS_ESTIMATED);
        for (int k = 0; k < 10; ++k) {
            // Away from the faces, so that the differences below stay inside.
            native::Point xi = random.point(space.shape);
            for (double& coordinate : xi)
                coordinate = 0.9 * coordinate - (space.shape == native::Shape::hexahedron ? 0 : 0.03);
            std::array<double, 3> values{};
            std::array<double, 9> gradients{};
            volume.evaluate_field(0, 0, element, xi, values, gradients);
            const Eigen::Vector3d expected = exact(xi);
            for (std::size_t j = 0; j < 3; ++j) {
                // Fourth-order central difference: error about h^4 times the fifth derivative, and 1e-16/h of rounding.
                const double h = 1e-3;
                const auto shifted = [&](double s) {
                    native::Point at = xi;
                    at[j] += s * h;
                    return exact(at);
                };
                const Eigen::Vector3d slope = (8 * (shifted(1) - shifted(-1)) - (shifted(2) - shifted(-2))) / (12 * h);
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto row = static_cast<Eigen::Index>(c);
                    CHECK(values[c] == Approx(expected[row]).margin(1e-12));
                    const double error = std::abs(gradients[3 * c + j] - slope[row]) / (1 + slope.norm());
                    // Pyramids near the apex have large higher derivatives.
                    CHECK(error < (space.shape == native::Shape::pyramid ? 1e-6 : 1e-8));
                    largest_error = std::max(largest_error, error);
                }
            }
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(ranges[c].lower < ranges[c].upper);
        }
    }
    std::cout << (covariant ? "covariant" : "contravariant") << " derivatives against differences: " << largest_error << "\n";
}

TEST_CASE("vector fields of the plane with a transform have the components of the plane, with exact derivatives") {
    const bool covariant = GENERATE(true, false);
    const native::Shape shape = GENERATE(native::Shape::quadrilateral, native::Shape::triangle);
    const native::Space space{shape, native::Basis::modified, {3, 3, 0}};
    native::Field of_plane = vector_field("u", covariant ? native::Transform::covariant : native::Transform::contravariant);
    of_plane.n_components = 2;
    const TestVolume file({{space, {space}}}, {of_plane});
    const RuntimeVolume volume = file.open();
    const auto exact = [&](const native::Point& xi) {
        Eigen::Matrix2d jacobian;
        Eigen::Vector2d hat;
        for (Eigen::Index c = 0; c < 2; ++c) {
            native::Point row;
            native::evaluate(space, file.geometry(0, 0, static_cast<std::size_t>(c)), xi, row);
            jacobian.row(c) << row[0], row[1];
            hat[c] = native::evaluate(space, file.field(0, 0, 0, 0, static_cast<std::size_t>(c)), xi);
        }
        return covariant ? Eigen::Vector2d(jacobian.transpose().inverse() * hat)
                         : Eigen::Vector2d(jacobian * hat / jacobian.determinant());
    };
    test::Random random(6);
    for (int k = 0; k < 10; ++k) {
        native::Point xi = random.point(shape);
        for (double& coordinate : xi)
            coordinate = 0.9 * coordinate - (shape == native::Shape::triangle ? 0.03 : 0);
        std::array<double, 2> values{};
        std::array<double, 6> gradients{};
        volume.evaluate_field(0, 0, file.first_element(0), xi, values, gradients);
        for (std::size_t j = 0; j < 2; ++j) {
            const double h = 1e-3;
            const auto shifted = [&](double s) {
                native::Point at = xi;
                at[j] += s * h;
                return exact(at);
            };
            const Eigen::Vector2d slope = (8 * (shifted(1) - shifted(-1)) - (shifted(2) - shifted(-2))) / (12 * h);
            for (std::size_t c = 0; c < 2; ++c) {
                CHECK(values[c] == Approx(exact(xi)[static_cast<Eigen::Index>(c)]).margin(1e-12));
                CHECK(gradients[3 * c + j] == Approx(slope[static_cast<Eigen::Index>(c)]).margin(1e-8 * (1 + slope.norm())));
            }
        }
    }
}

TEST_CASE("buffers filled in pieces are the buffer filled at once, and offsets are subtracted") {
    const TestVolume file(all_classes(2, 3, 1), {vector_field("u", native::Transform::none)}, {0.0}, 50);
    const RuntimeVolume volume = file.open();
    const std::vector<double> origins(3 * volume.n_elements(), 50.0);
    const std::array<double, 3> offset{1, -2, 3};
    for (std::uint32_t buffer = 0; buffer < volume.n_buffers(); ++buffer) {
        const BufferInfo info = volume.buffer(buffer, 0);
        const auto fill = [&](std::uint64_t first, std::uint64_t count, const double* field_offset,
                              const double* element_origins) {
            std::vector<double> numbers(count * info.record_size);
            const elvis_fill_request request{
                sizeof(elvis_fill_request), buffer, 0, 0, first, count, field_offset, element_origins};
            volume.fill_buffer(request, numbers.data());
            return numbers;
        };
        const std::vector<double> whole = fill(0, 3, offset.data(), origins.data());
        std::vector<double> pieces = fill(0, 1, offset.data(), origins.data());
        const std::vector<double> rest = fill(1, 2, offset.data(), origins.data());
        pieces.insert(pieces.end(), rest.begin(), rest.end());
        CHECK(whole == pieces);
        // The constant function comes first, and nothing else changes.
        const std::array<double, 3> zero{};
        const std::vector<double> plain = fill(0, 3, zero.data(), nullptr);
        const bool is_geometry = info.name == "geometry";
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const std::size_t place = i % info.record_size;
            const std::size_t stride = is_geometry ? 1 : info.record_size / 3;
            const std::size_t component = place / stride;
            const bool is_constant = place % stride == 0 && component < 3;
            const double expected = is_constant ? (is_geometry ? 50 : offset[component]) : 0;
            CHECK(plain[i] - whole[i] == Approx(expected).margin(1e-12));
        }
    }
}

TEST_CASE("a bad file is refused with a message that names it") {
    const auto message = [](const std::string& path) {
        try {
            const RuntimeVolume volume(test::native_plugin(), path);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const auto confidence = [](const std::string& path) {
        const elvis_host host{};
        std::uint32_t answer = 77;
        REQUIRE(test::native_plugin()->runtime()->probe(&host, path.c_str(), &answer) == ELVIS_OK);
        return answer;
    };

    const TemporaryFolder folder;
    const std::string missing = folder.path("missing.h5");
    CHECK(confidence(missing) == 0);
    CHECK_THAT(message(missing), Catch::Contains(missing) && Catch::Contains("does not exist"));

    const std::string text = folder.write("volume.txt", "not a volume\n");
    CHECK(confidence(text) == 0);
    CHECK_THAT(message(text), Catch::Contains(text) && !Catch::Contains("accepted"));

    const TestVolume file(all_classes(2, 3, 1), {scalar_field("p")});
    CHECK(confidence(file.path()) == 100);
    const std::string cut = folder.path("cut.h5");
    std::filesystem::copy_file(file.path(), cut);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
    CHECK_THAT(message(cut), Catch::Contains(cut));

    const native::Space high{native::Shape::hexahedron, native::Basis::modified, {2, 2, 17}};
    const native::Space low{native::Shape::hexahedron, native::Basis::modified, {1, 1, 1}};
    const TestVolume too_high({{low, {high}, 1}}, {scalar_field("p")});
    CHECK_THAT(message(too_high.path()),
               Catch::Contains(too_high.path()) && Catch::Contains("'p'") && Catch::Contains("order 17"));
}

TEST_CASE("a NaN in the geometry is an error that names the element, one in a field an unbounded range") {
    const native::Space space{native::Shape::prism, native::Basis::modified, {2, 2, 2}};
    const TemporaryFile file("volume.h5");
    native::Description description;
    description.classes = {{space, {space}, 2}};
    description.fields = {scalar_field("p")};
    std::vector<double> geometry(2 * 3 * native::n_modes(space), 1.0);
    std::vector<double> field(2 * native::n_modes(space), 1.0);
    geometry.back() = std::nan("");
    field.front() = std::nan("");
    const std::array<std::int64_t, 2> numbers{1, 0};
    native::Writer writer(file.path(), description);
    writer.write_geometry(0, 0, 2, geometry);
    writer.write_field(0, 0, 0, 0, 2, field);
    writer.write_numbers(0, 0, 2, numbers);
    writer.commit();

    const RuntimeVolume volume(test::native_plugin(), file.path());
    std::array<double, 12> boxes{};
    CHECK_THROWS_WITH(volume.bounds(0, 2, boxes), Catch::Contains(file.path()) && Catch::Contains("element 0"));
    std::array<FieldRange, 2> ranges;
    CHECK(volume.field_ranges(0, 0, 0, 2, ranges) == ELVIS_CERTIFIED);
    CHECK(ranges[0].lower == -std::numeric_limits<double>::infinity());
    CHECK(ranges[0].upper == std::numeric_limits<double>::infinity());
    CHECK(std::isfinite(ranges[1].upper));
}
