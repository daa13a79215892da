/*
 * The plugin as the host sees it: its file, what it says of elements, and its snippet against its own evaluation.
 */
#include <core/expression/expression.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/probe.hpp>
#include <core/render/renderer.hpp>
#include <tests/support/error_of.hpp>
#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <random>

using namespace elvis;
using Catch::Matchers::Contains;
using test::TemporaryFolder;

namespace {

RuntimeVolume open(const std::string& path) { return RuntimeVolume(Plugin::load(DUBINER_PLUGIN), path); }

/** Two straight tetrahedra of orders 1 and 0 with a common face, and one field. */
const std::string two = "field u 1 K\n"
                        "element 1 1 0 1 2 3  0 0 0  1 0 0  0 1 0  0 0 1\n"
                        "element 0 1 4 1 2 3  1 1 1  1 0 0  0 1 0  0 0 1\n"
                        "boundary wall 2 0 1\n"
                        "time 2\nmodes u 0 1 2 3 4\nmodes u 1 5\n";

std::string error_for(const std::string& content) {
    const TemporaryFolder folder;
    const std::string path = folder.write("bad.ddg", "dubiner-dg 1\n" + content);
    const std::string text = test::error_of([&] { open(path); });
    CHECK_THAT(text, Contains(path));
    return text;
}

std::vector<std::array<double, 3>> random_positions(int n) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-0.9, 0.9);
    std::vector<std::array<double, 3>> positions;
    for (int i = 0; i < n; ++i) {
        positions.push_back({uniform(random), uniform(random), uniform(random)});
    }
    return positions;
}

} // namespace

TEST_CASE("a file of Dubiner modes is read as it is written") {
    const TemporaryFolder folder;
    const RuntimeVolume volume = open(folder.write("two.ddg", "dubiner-dg 1\n" + two));
    CHECK(volume.n_elements() == 2);
    REQUIRE(volume.classes().size() == 2);
    CHECK(volume.classes()[0].is_affine);
    CHECK(volume.class_field(0, 0).order[0] == 0);
    CHECK(volume.class_field(1, 0).order[0] == 1);
    std::vector<std::int64_t> numbers(2);
    volume.element_numbers(0, 2, numbers);
    CHECK(numbers == std::vector<std::int64_t>{1, 0});
    // The constant mode has norm 1 over the reference tetrahedron's volume, 4/3.
    std::vector<double> value(1), xi{-0.5, -0.5, -0.5};
    volume.evaluate_field(0, 0, 0, xi, value, {});
    CHECK(value[0] == Approx(5 * std::sqrt(0.75)));
    std::vector<double> position(3), jacobian(9);
    volume.evaluate_mapping(1, xi, position, jacobian);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(position[i] == Approx(0.25));
        for (std::size_t j = 0; j < 3; ++j) {
            CHECK(jacobian[3 * i + j] == Approx(i == j ? 0.5 : 0).margin(1e-15));
        }
    }
}

TEST_CASE("a bad file of Dubiner modes is refused with its line") {
    const std::string element = "element 1 1 0 1 2 3 0 0 0 1 0 0 0 1 0 0 0 1\n";
    CHECK_THAT(error_for("field u\n"), Contains("line 2: the number of components is missing"));
    CHECK_THAT(error_for("field u 17\n"), Contains("line 2") && Contains("from 1 to 16"));
    CHECK_THAT(error_for("field u 1\nfield u 1\n"), Contains("line 3: there is a field 'u'"));
    CHECK_THAT(error_for("element 9 1 0 1 2 3\n"), Contains("line 2: the order must be from 0 to 8, and is 9"));
    CHECK_THAT(error_for("element 1 0 0 1 2 3\n"), Contains("line 2: the order of the geometry"));
    CHECK_THAT(error_for("element 1 1 0 1 2 2 0\n"), Contains("line 2: an element has four different vertices"));
    CHECK_THAT(error_for("element 1 1 0 1 2 3 0 0 nan\n"), Contains("line 2: 'nan' is no coordinate"));
    CHECK_THAT(error_for("element 1 1 0 1 2 3 0 0 0 1 0 0 0 1 0 0 0\n"), Contains("line 2: coordinate is missing"));
    CHECK_THAT(error_for(element + "time 0\n" + element), Contains("line 4: elements come before"));
    CHECK_THAT(error_for(element + "time 0\nfield u 1\n"), Contains("line 4: fields come before"));
    CHECK_THAT(error_for("modes u 0 1\n"), Contains("line 2: modes before any time"));
    CHECK_THAT(error_for("field u 1\ntime 0\nmodes u 0 1\n"), Contains("line 4: modes before any element"));
    CHECK_THAT(error_for("field u 1\n" + element + "time 0\nmodes v 0 1\n"), Contains("line 5: there is no field 'v'"));
    CHECK_THAT(error_for("field u 1\n" + element + "time 0\nmodes u 1 1\n"), Contains("line 5: the element must be"));
    CHECK_THAT(error_for("field u 1\n" + element + "time 0\nmodes u 0 1 2 3\n"), Contains("line 5: coefficient is missing"));
    CHECK_THAT(error_for("field u 1\n" + element + "time 0\nmodes u 0 1 2 3 4 5\n"), Contains("line 5: '5' is too much"));
    CHECK_THAT(error_for(two + "modes u 1 6\n"), Contains("stand above"));
    CHECK_THAT(error_for(two + "time 1\n"), Contains("times ascend"));
    CHECK_THAT(error_for(two + "time 3\nmodes u 0 1 2 3 4\n"), Contains("lacks modes of field 'u' in element 1"));
    CHECK_THAT(error_for("field u 1\n" + element), Contains("there is no time"));
    CHECK_THAT(error_for("mesh\n"), Contains("line 2: unknown keyword 'mesh'"));
    CHECK_THAT(error_for("field u 1\n" + element + "boundary wall 0 1 4\ntime 0\nmodes u 0 1 2 3 4\n"),
               Contains("no element has the boundary face with vertices 0 1 4"));
    CHECK_THAT(error_for("field u 1\n" + element + element + element + "time 0\nmodes u 0 1 2 3 4\nmodes u 1 1 2 3 4\n" +
                         "modes u 2 1 2 3 4\n"),
               Contains("elements 0, 1 and 2 share the face with vertices 0 1 2"));
}

TEST_CASE("the sample's faces are matched, and its bounds hold") {
    const RuntimeVolume volume = open(DUBINER_SAMPLE);
    CHECK(volume.n_elements() == 48);
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    std::map<std::int32_t, int> of_group;
    for (const elvis_face& face : faces) {
        CHECK((face.neighbour == ELVIS_NEIGHBOUR_NONE) == (face.group != ELVIS_GROUP_NONE));
        ++of_group[face.group];
    }
    CHECK(of_group.size() == 7);
    CHECK(of_group[ELVIS_GROUP_NONE] == 72);
    std::vector<double> bounds(6 * 48), positions(3), jacobian(9);
    CHECK(volume.bounds(0, 48, bounds) == ELVIS_CERTIFIED);
    for (std::uint64_t element = 0; element < 48; ++element) {
        for (double t = 0; t <= 1; t += 0.1) {
            const std::vector<double> xi{-1 + 2 * t, -t, -t};
            volume.evaluate_mapping(element, xi, positions, jacobian);
            for (std::size_t d = 0; d < 3; ++d) {
                CHECK(positions[d] >= bounds[6 * element + d]);
                CHECK(positions[d] <= bounds[6 * element + 3 + d]);
            }
        }
    }
}

TEST_CASE("the snippet on the device agrees with the plugin's evaluation, derivatives included") {
    const RuntimeVolume volume = open(DUBINER_SAMPLE);
    ProbeOptions on_device;
    on_device.evaluation = ProbeOptions::Evaluation::device;
    const std::vector<std::array<double, 3>> positions = random_positions(60);
    const std::vector<std::shared_ptr<const Expression>> expressions{
        std::make_shared<Expression>("laplacian(p)", volume.fields(), volume.dimension()),
        std::make_shared<Expression>("norm(curl(velocity))", volume.fields(), volume.dimension())};
    const auto here = Prober(volume).probe(positions, 0, {{}, expressions});
    const auto there = Prober(volume, on_device).probe(positions, 0, {{}, expressions});
    double largest = 0, of_second = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        REQUIRE(here[i].element.has_value());
        REQUIRE(there[i].element == here[i].element);
        for (std::size_t field = 0; field < 2; ++field) {
            const FieldSample &a = here[i].fields[field], &b = there[i].fields[field];
            CHECK_FALSE(b.gradient_is_estimated);
            for (std::size_t k = 0; k < a.values.size(); ++k) {
                largest = std::max(largest, std::abs(a.values[k] - b.values[k]));
            }
            for (std::size_t k = 0; k < a.gradients.size(); ++k) {
                largest = std::max(largest, std::abs(a.gradients[k] - b.gradients[k]));
            }
        }
        for (std::size_t k = 0; k < expressions.size(); ++k) {
            CHECK_FALSE(there[i].expressions[k].value_is_estimated);
            of_second = std::max(of_second, std::abs(here[i].expressions[k].value - there[i].expressions[k].value));
        }
    }
    CAPTURE(largest, of_second);
    CHECK(largest < 1e-12);
    // On this side second derivatives are differences.
    CHECK(of_second < 1e-5);
}

TEST_CASE("pictures in single precision agree with those in double precision") {
    const RuntimeVolume volume = open(DUBINER_SAMPLE);
    FrameRequest request;
    request.width = 64;
    request.height = 48;
    request.camera.eye = {3, 2, 4};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    Surface surface;
    surface.geometry = CutPlane{{0.2, 0.3, 1, 0.05}};
    surface.colors.points = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
    request.surfaces = {surface};
    const Device device{};
    const Frame coarse = Renderer(device, volume, Precision::float32).render(request);
    const Frame fine = Renderer(device, volume, Precision::float64).render(request);
    CHECK(fine.counts.hit_pixels > 300);
    CHECK(fine.counts.newton_failures == 0);
    double largest = 0;
    std::size_t n_same = 0;
    for (std::size_t i = 0; i < fine.value.size(); ++i) {
        if (fine.element[i] >= 0 && fine.element[i] == coarse.element[i]) {
            ++n_same;
            largest = std::max(largest, std::abs(fine.value[i] - coarse.value[i]));
        }
    }
    CAPTURE(largest);
    CHECK(n_same + 5 > fine.counts.hit_pixels);
    CHECK(largest < 2e-6);
}
