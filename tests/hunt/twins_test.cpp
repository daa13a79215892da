#include "judge.hpp"
#include "sums.hpp"
#include "twins.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/oracle/isosurface/scalar.hpp>
#include <core/oracle/samples/random.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <map>

namespace elvis::hunt {
namespace {

constexpr const char* mixed =
    R"({"generator": 1, "mesh": "box", "shape": "mixed", "elements": [4, 2, 1], "order": 3, "field": "waves"})";

std::vector<elvis_face> faces_of(const RuntimeVolume& volume) {
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    return faces;
}

FrameRequest cut(std::uint32_t width, std::uint32_t height) {
    FrameRequest request;
    request.width = width;
    request.height = height;
    request.camera.eye = {2, 3, 1.5};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 40;
    Surface surface;
    surface.geometry = CutPlane{{1, 2, 0.3, 0.05}};
    surface.colors.points = {{-9, {0, 0.1, 0.9}}, {9, {1, 0.8, 0.1}}};
    request.surfaces = {surface};
    return request;
}

} // namespace

TEST_CASE("A split volume has each element in one of two classes, and the same values") {
    const TemporaryFile file("mixed.h5"), split_file("split.h5");
    oracle::generate(mixed, file.path());
    split_classes(file.path(), split_file.path(), true);
    const native::Reader reader(file.path()), split_reader(split_file.path());
    const auto &classes = reader.description().classes, &split = split_reader.description().classes;
    REQUIRE(split.size() == 2 * classes.size());
    for (std::size_t c = 0; c < classes.size(); ++c) {
        CHECK(split[2 * c].fields[0] == classes[c].fields[0]);
        CHECK(split[2 * c + 1].fields[0].order[0] == classes[c].fields[0].order[0] + 1);
        CHECK(split[2 * c + 1].geometry.order[0] == classes[c].geometry.order[0] + 1);
    }
    const oracle::Volume volume(oracle::read_volume(file.path(), 0, 0)), other(oracle::read_volume(split_file.path(), 0, 0));
    std::map<std::int64_t, std::size_t> by_number;
    for (std::size_t element = 0; element < other.n_elements(); ++element)
        by_number[other.number(element)] = element;
    REQUIRE(by_number.size() == volume.n_elements());
    const oracle::Scalar scalar = oracle::scalar_of_field(volume, 0);
    oracle::Random random(3);
    for (std::size_t element = 0; element < volume.n_elements(); ++element) {
        const oracle::Vector eta = random.in_cube();
        const native::Point xi = native::expand(volume.shape(element), {eta.x(), eta.y(), eta.z()});
        const oracle::Vector at(xi[0], xi[1], xi[2]);
        const std::size_t same = by_number.at(volume.number(element));
        CHECK((volume.position(element, at) - other.position(same, at)).norm() < 1e-13);
        CHECK(std::abs(scalar(volume, element, at, nullptr) - scalar(other, same, at, nullptr)) < 1e-13);
    }
}

TEST_CASE("A smaller picture has rays of the larger one") {
    const FrameRequest larger = cut(60, 45);
    const std::optional<FrameRequest> smaller = smaller_picture(larger);
    REQUIRE(smaller);
    CHECK(smaller->width == 20);
    CHECK(smaller->height == 15);
    for (std::size_t pixel = 0; pixel < 20 * 15; ++pixel) {
        const std::size_t same = pixel_with_same_ray(larger, *smaller, pixel);
        CHECK(2 * (same % 60) + 1 == 3 * (2 * (pixel % 20) + 1));
        CHECK(2 * (same / 60) + 1 == 3 * (2 * (pixel / 20) + 1));
    }
    CHECK_FALSE(smaller_picture(cut(64, 48)));
}

TEST_CASE("Smaller pictures and split volumes are judged by the answers of the picture and the volume") {
    const TemporaryFile file("mixed.h5"), split_file("split.h5");
    oracle::generate(mixed, file.path());
    split_classes(file.path(), split_file.path(), false);
    const RuntimeVolume volume = oracle::open_volume(file.path()), split = oracle::open_volume(split_file.path());
    oracle::SceneVolume answers(file.path(), faces_of(volume));
    const FrameRequest request = cut(60, 45), smaller = *smaller_picture(request);
    std::string reason;
    Judge judge(answers, request, reason);
    judge.draw();
    const Judge judge_of_smaller(judge, smaller);
    Renderer renderer(test::device(), volume, Precision::float64), split_renderer(test::device(), split, Precision::float64);
    const auto check = [&](const Judge& by, Frame frame, std::uint64_t n_pixels) {
        const Tally tally = by.judge(frame, Precision::float64).tally;
        CHECK(tally.pixels == n_pixels);
        CHECK(tally.hits > n_pixels / 10);
        CHECK(tally.far + tally.near == 0);
        // One wrong pixel is found.
        std::size_t pixel = frame.width * (frame.height / 2) + frame.width / 2;
        REQUIRE(frame.element[pixel] >= 0);
        frame.color[4 * pixel] += 1e-8;
        CHECK(by.judge(frame, Precision::float64).findings.size() == 1);
    };
    check(judge_of_smaller, renderer.render(smaller), 20 * 15);
    check(judge, split_renderer.render(request), 60 * 45);
}

TEST_CASE("Sums that are written are added when they are read") {
    const TemporaryFile file("sums.json");
    Tally tally;
    tally.pixels = 300;
    tally.far = 1;
    tally.silent[buffer::color] = 1;
    write_sums({{{"plane", "float32"}, tally}}, file.path());
    Sums sums;
    add_sums(file.path(), sums);
    add_sums(file.path(), sums);
    REQUIRE(sums.size() == 1);
    CHECK(sums.begin()->second.pixels == 600);
    CHECK(sums.begin()->second.silent.at(buffer::color) == 2);
    CHECK(has_silent(sums));
}

TEST_CASE("Endless surfaces that are shown outside of elements hang on the volume's bounds") {
    FrameRequest request;
    Surface surface;
    const std::array<double, 3> gray{0.5, 0.5, 0.5};
    for (const auto& [geometry, is_endless] : {std::pair<SurfaceGeometry, bool>{CutPlane{{0, 0, 1, 0}}, true},
                                               {CutShape(Quadric{{1, 1, -1}}), true},
                                               {CutShape(Torus{}), false},
                                               {BoundaryFaces{}, false}}) {
        surface.geometry = geometry;
        surface.outside = gray;
        request.surfaces = {surface};
        CHECK(hangs_on_bounds(request) == is_endless);
        request.surfaces[0].outside.reset();
        CHECK_FALSE(hangs_on_bounds(request));
    }
}

} // namespace elvis::hunt
