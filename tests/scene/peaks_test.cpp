// Peaks: triangles of density that add up.

#include "fixture.hpp"

#include <core/scene/color/transfer.hpp>

#include <numeric>

using namespace elvis;
using namespace elvis::test;

namespace {

double triangle(const ScenePeak& peak, double value) {
    return peak.density * std::max(0.0, 1 - std::abs(value - peak.value) / (0.5 * peak.width));
}

/** Density and density times colour, straight from their definition. */
struct Sum {
    double density = 0;
    Rgb emission{};
};

Sum sum_at(const TransferFunction& base, const std::vector<ScenePeak>& peaks, double value) {
    Sum sum;
    const auto add = [&](double density, const Rgb& rgb) {
        sum.density += density;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            sum.emission[channel] += density * rgb[channel];
        }
    };
    const Rgb of_base = {color_at(base, value, 0), color_at(base, value, 1), color_at(base, value, 2)};
    add(base.density.empty() ? 0 : density_at(base, value), of_base);
    for (const ScenePeak& peak : peaks) {
        add(triangle(peak, value), peak.color.value_or(of_base));
    }
    return sum;
}

/** Largest error of the density; and of the emission, as a part of the density, or of the largest where there is hardly any. */
std::pair<double, double> errors(const TransferFunction& base, const std::vector<ScenePeak>& peaks) {
    TransferFunction transfer = base;
    add_peaks(peaks, transfer);
    cut_at_breakpoints(transfer);
    double largest = 0, of_density = 0, of_emission = 0;
    for (const auto& point : transfer.density) {
        largest = std::max(largest, point.density);
    }
    std::mt19937 random(11);
    std::uniform_real_distribution<double> anywhere(-3, 4);
    for (int sample = 0; sample < 3000; ++sample) {
        const double value = anywhere(random);
        const Sum exact = sum_at(base, peaks, value);
        const double density = density_at(transfer, value);
        of_density = std::max(of_density, std::abs(density - exact.density) / largest);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double emission = density * color_at(transfer, value, channel);
            of_emission =
                std::max(of_emission, std::abs(emission - exact.emission[channel]) / std::max(density, 1e-3 * largest));
        }
    }
    return {of_density, of_emission};
}

} // namespace

TEST_CASE("Peaks without colours leave the colours as they are") {
    TransferFunction transfer;
    transfer.color = {{0, {0, 0, 1}}, {1, {1, 0, 0}}};
    const std::vector<ScenePeak> one = {{0.5, 0.2, 7, std::nullopt}};
    add_peaks(one, transfer);
    REQUIRE(transfer.density.size() == 3);
    CHECK((transfer.density[0].value == 0.4 && transfer.density[0].density == 0));
    CHECK((transfer.density[1].value == 0.5 && transfer.density[1].density == 7));
    CHECK((transfer.density[2].value == 0.6 && transfer.density[2].density == 0));
    CHECK(transfer.color.size() == 2);
}

TEST_CASE("No peaks change nothing") {
    TransferFunction transfer{{{0, 1}, {0, 2}}, {{0, {0, 0, 1}}}};
    add_peaks({}, transfer);
    CHECK(transfer.density.size() == 2);
    CHECK(transfer.color.size() == 1);
}

TEST_CASE("A peak with a colour has that colour everywhere") {
    TransferFunction transfer;
    for (int i = 0; i <= 10; ++i) {
        transfer.color.push_back({i / 10.0, {i / 10.0, i % 2 * 1.0, 0}});
    }
    const std::vector<ScenePeak> one = {{0.53, 0.3, 7, Rgb{0.2, 0.9, 0.4}}};
    add_peaks(one, transfer);
    const TransferTable table = cut_at_breakpoints(transfer);
    // The colours of the map are not seen, and cost nothing.
    CHECK(table.breakpoints == std::vector<double>{0.53 - 0.15, 0.53, 0.53 + 0.15});
    for (const std::size_t piece : {1, 2}) {
        CHECK(table.pieces[piece].rgb == Rgb{0.2, 0.9, 0.4});
        CHECK(table.pieces[piece].rgb_slope == Rgb{0, 0, 0});
    }
}

TEST_CASE("Peaks in one place have their mean colour, up to where all of them end") {
    TransferFunction transfer;
    transfer.color = {{0, {0, 0, 0}}};
    const std::vector<ScenePeak> same = {{1, 0.5, 3, Rgb{1, 0, 0}}, {1, 0.5, 1, Rgb{0, 1, 0}}};
    add_peaks(same, transfer);
    for (double value = 0.75; value < 1.25; value += 1.0 / 64) {
        CHECK(color_at(transfer, value, 0) == Approx(0.75));
        CHECK(color_at(transfer, value, 1) == Approx(0.25));
    }
    CHECK(cut_at_breakpoints(transfer).breakpoints == std::vector<double>{0.75, 1, 1.25});
}

TEST_CASE("Peaks add up, with each other and with the density given besides") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(-1.5, 2.5), part(0, 1);
    std::uniform_int_distribution<int> count(1, 5), coin(0, 1);
    double of_density = 0, of_emission = 0;
    std::size_t most_points = 0;
    for (int round = 0; round < 150; ++round) {
        TransferFunction base;
        base.color = {{-1, {0, 0.5, 1}}, {0.25, {0.25, 0.5, 0}}, {0.25, {1, 0, 0}}, {2, {0, 1, 0}}};
        if (coin(random) == 1) {
            base.density = {{-1, 0}, {0, 2}, {1, 2}, {1, 0.5}, {2, 0}};
        }
        std::vector<ScenePeak> peaks;
        for (int i = count(random); i > 0; --i) {
            ScenePeak peak{value(random), 0.01 + part(random), 5 * part(random), {}};
            // Some meet in one value.
            peak.value = i % 2 == 0 ? std::round(4 * peak.value) / 4 : peak.value;
            if (coin(random) == 1) {
                peak.color = Rgb{part(random), part(random), part(random)};
            }
            peaks.push_back(peak);
        }
        const auto [density, emission] = errors(base, peaks);
        of_density = std::max(of_density, density);
        of_emission = std::max(of_emission, emission);
        add_peaks(peaks, base);
        most_points = std::max(most_points, base.color.size());
    }
    INFO("at most " << most_points << " points");
    CHECK(of_density < 1e-12);
    CHECK(of_emission < 2e-4);
    CHECK(most_points < 1500);
}

TEST_CASE("The default density leaves a twentieth of the light along the diagonal") {
    CHECK(std::exp(-default_density(3.5) * 3.5) == Approx(0.05));
    SceneVolumeRendering scene;
    const TransferFunction ramp = make_transfer_function(scene, {}, {-1, 3}, 3.5);
    REQUIRE(ramp.density.size() == 2);
    CHECK((ramp.density[0].value == -1 && ramp.density[0].density == 0));
    CHECK((ramp.density[1].value == 3 && ramp.density[1].density == default_density(3.5)));
    CHECK((ramp.color.front().value == -1 && ramp.color.back().value == 3));
    // A field that is constant is seen.
    const TransferFunction constant = make_transfer_function(scene, {}, {2, 2}, 3.5);
    CHECK(cut_at_breakpoints(constant).piece_at(2).density == default_density(3.5));
    CHECK(cut_at_breakpoints(constant).piece_at(std::nextafter(2.0, 0.0)).density == default_density(3.5));
    // Peaks alone are all there is.
    scene.peaks = {{1, 0.5, 3, std::nullopt}};
    CHECK(density_at(make_transfer_function(scene, {}, {-1, 3}, 3.5), 3) == 0);
}

TEST_CASE("Colours beyond a map's range are those for below and above") {
    SceneVolumeRendering scene;
    scene.density = {{0, 1}};
    SceneColorMap map;
    map.points = {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
    map.below = Rgb{1, 0, 0};
    map.above = Rgb{0, 0, 1};
    const TransferFunction transfer = make_transfer_function(scene, map, {2, 4}, 1);
    CHECK(color_at(transfer, 1.999, 0) == 1);
    CHECK(color_at(transfer, 2, 0) == 0);
    CHECK(color_at(transfer, 3, 0) == 0.5);
    CHECK(color_at(transfer, 4.001, 0) == 0);
    CHECK(color_at(transfer, 4.001, 2) == 1);
}
