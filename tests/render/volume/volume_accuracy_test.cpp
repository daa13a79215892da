// What the comparison of drawn volumes with the oracle counts.
#include <core/oracle/samples/meshes.hpp>
#include <core/oracle/volume/transfers.hpp>
#include <tests/accuracy/volume_accuracy.hpp>
#include <tests/support/test_volumes.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

namespace elvis::oracle {
namespace {

// What the program would draw if it drew what the oracle does.
Frame frame_of(const VolumePicture& picture, const VolumeScene& scene, std::uint32_t size) {
    Frame frame;
    frame.width = frame.height = size;
    frame.color.resize(4 * picture.answers.size());
    frame.flags.resize(picture.answers.size());
    for (std::size_t i = 0; i < picture.answers.size(); ++i) {
        const Color color = color_over(picture.answers[i], scene.background);
        std::copy(color.begin(), color.end(), frame.color.begin() + static_cast<std::ptrdiff_t>(4 * i));
    }
    return frame;
}

} // namespace

TEST_CASE("errors of drawn volumes are counted by what explains them") {
    const TemporaryFile file("sphere.h5");
    VolumeScene scene = sphere_scene("hexahedron", true, 0.1, file.path());
    // Steps of colour in a dense volume, at which rounding of the field shows.
    scene.transfer = {{{0, 8}}, {{2, {0.9, 0.5, 0.1}}, {2, {0.1, 0.5, 0.9}}, {4, {0.1, 0.5, 0.9}}, {4, {0.2, 1, 0}}}};
    constexpr std::uint32_t size = 60;
    VolumeSettings settings;
    settings.size = size;
    const VolumeAccuracy exact = measure_volume(nullptr, scene, settings);
    const Model model(scene.data);
    const VolumeOptics optics{scalar_of_field(model.volume, 0), scene.transfer};
    const auto compared = [&](const Frame& frame, double rounding) {
        return compare(model, optics, scene.camera, scene.background, exact.exact, frame, 1e-3, rounding);
    };
    Frame frame = frame_of(exact.exact, scene, size);
    const VolumeComparison same = compared(frame, 1e-12);
    CHECK(same.n_pixels == size * size);
    CHECK(same.n_touched > 300);
    CHECK(same.error == 0);
    CHECK(same.n_above + same.n_flagged + same.n_wrong == 0);

    // A pixel that is off, one that says so, one that is no number.
    frame.color[4 * 1000 + 2] += 0.02;
    const VolumeComparison wrong = compared(frame, 2e-5);
    CHECK(wrong.error == Approx(0.02));
    CHECK(wrong.worst_pixel == 1000);
    CHECK(wrong.worst_channel == 2);
    CHECK(wrong.n_above == 1);
    CHECK(wrong.n_wrong == 1);
    CHECK(wrong.mean_error == Approx(0.02 / (size * size)));
    frame.flags[1000] = pixel_flag::volume_tolerance;
    const VolumeComparison flagged = compared(frame, 2e-5);
    CHECK(flagged.n_above == 1);
    CHECK(flagged.n_above_flagged == 1);
    CHECK(flagged.n_wrong == 0);
    CHECK(flagged.error == 0);
    CHECK(flagged.flagged_error == Approx(0.02));
    frame.color[4 * 7] = std::nan("");
    CHECK(compared(frame, 2e-5).n_wrong == 1);
    CHECK(std::isinf(compared(frame, 2e-5).error));

    // A field off by 2e-4 of its range, which is 18: explained by a rounding of 3e-4, not by one of 1e-8.
    VolumeScene moved = scene;
    for (auto& point : moved.transfer.density)
        point.value += 18 * 2e-4;
    for (auto& point : moved.transfer.color)
        point.value += 18 * 2e-4;
    const Frame other = frame_of(measure_volume(nullptr, moved, settings).exact, scene, size);
    const VolumeComparison rounded = compared(other, 3e-4), unexplained = compared(other, 1e-8);
    CHECK(rounded.n_above > 20);
    CHECK(rounded.n_above_rounding == rounded.n_above);
    CHECK(rounded.n_wrong == 0);
    CHECK(unexplained.n_above == rounded.n_above);
    CHECK(unexplained.n_wrong > 0);

    // Sums of two pictures.
    VolumeComparison sum = same;
    sum += wrong;
    CHECK(sum.n_pixels == 2 * size * size);
    CHECK(sum.n_wrong == 1);
    CHECK(sum.mean_error == Approx(0.01 / (size * size)));
}

TEST_CASE("pixels are chosen once each, by the seed") {
    const std::vector<std::size_t> pixels = sampled_pixels(1000, 100, 1);
    CHECK(pixels.size() == 100);
    CHECK(std::adjacent_find(pixels.begin(), pixels.end(), std::greater_equal<>()) == pixels.end());
    CHECK(pixels.back() < 1000);
    CHECK(pixels == sampled_pixels(1000, 100, 1));
    CHECK(pixels != sampled_pixels(1000, 100, 2));
    CHECK(sampled_pixels(10, 100, 1).size() == 10);
    // Of a picture in parts, and all of it.
    const TemporaryFile file("sphere.h5");
    const VolumeScene scene = sphere_scene("prism", false, 0.1, file.path());
    VolumeSettings settings;
    settings.size = 20;
    const VolumePicture all = measure_volume(nullptr, scene, settings).exact;
    settings.n_pixels = 50;
    const VolumePicture some = measure_volume(nullptr, scene, settings).exact;
    REQUIRE(some.pixels.size() == 50);
    // Points are found from the last one that the same thread found: answers differ by rounding.
    for (std::size_t i = 0; i < 50; ++i)
        CHECK(some.answers[i].rgb[0] == Approx(all.answers[some.pixels[i]].rgb[0]).margin(1e-14));
}

TEST_CASE("what hides a volume hides it from a depth on") {
    const TemporaryFile file("sphere.h5");
    const VolumeScene scene = sphere_scene("hexahedron", false, 0.1, file.path());
    const Model model(scene.data);
    const VolumeOptics optics{scalar_of_field(model.volume, 0), scene.transfer};
    std::vector<double> depths(100, std::nan(""));
    for (std::size_t pixel = 0; pixel < 50; ++pixel)
        depths[pixel] = pixel < 25 ? 0.5 : 8.5;
    const VolumePicture whole = draw_volume(model, optics, scene.camera, 10, 10);
    const VolumePicture cut = draw_volume(model, optics, scene.camera, 10, 10, {}, depths);
    VolumeTracer tracer(model, optics);
    std::size_t n_less = 0;
    for (std::size_t pixel = 0; pixel < 100; ++pixel) {
        const Line line = line_of(
            pixel_ray(scene.camera, 10, 10, static_cast<long double>(pixel % 10), static_cast<long double>(pixel / 10)));
        CAPTURE(pixel);
        const double expected = pixel < 25   ? 1
                                : pixel < 50 ? tracer.integrate(line, 8.5).transmittance
                                             : whole.answers[pixel].transmittance;
        CHECK(cut.answers[pixel].transmittance == Approx(expected).margin(1e-14));
        n_less += pixel >= 25 && cut.answers[pixel].transmittance > whole.answers[pixel].transmittance + 1e-3;
    }
    CHECK(n_less >= 5);
}

TEST_CASE("transfer functions of native volumes are read") {
    const TemporaryFile file("transfer.json");
    std::ofstream(file.path()) << R"({"color": [[0, 1, 0.5, 0]], "density": [[0, 1], [2, 0.25]]})";
    const TransferFunction transfer = read_transfer(file.path());
    REQUIRE(transfer.density.size() == 2);
    CHECK(transfer.density[1].value == 2);
    CHECK(transfer.density[1].density == 0.25);
    CHECK(transfer.color[0].rgb == std::array<double, 3>{1, 0.5, 0});
    std::ofstream(file.path()) << R"({"color": [[0, 1]]})";
    CHECK_THROWS_WITH(read_transfer(file.path()), Catch::Contains(file.path()));
    CHECK_THROWS_WITH(read_transfer("/no/such/file"), Catch::Contains("/no/such/file"));
}

} // namespace elvis::oracle
