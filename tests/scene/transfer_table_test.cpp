// Transfer functions, cut at their breakpoints.

#include "fixture.hpp"

#include <core/scene/color/color_map.hpp>

#include <limits>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;

namespace {

/** Up to eight points from -2 to 3 on a grid, so that values of both lists often coincide, and steps occur. */
template <class Point> std::vector<Point> random_points(std::mt19937& random) {
    std::uniform_int_distribution<int> count(1, 8), place(-8, 12);
    std::vector<double> values(static_cast<std::size_t>(count(random)));
    for (double& value : values) {
        value = place(random) / 4.0;
    }
    std::sort(values.begin(), values.end());
    std::vector<Point> points;
    for (const double value : values) {
        points.push_back({value, {}});
    }
    return points;
}

/** Densities that are zero, flat or a ramp, each often. */
TransferFunction random_transfer(std::mt19937& random) {
    std::uniform_int_distribution<int> level(0, 3);
    TransferFunction transfer;
    transfer.density = random_points<TransferFunction::DensityPoint>(random);
    for (auto& point : transfer.density) {
        point.density = 1.7 * std::max(0, level(random) - 1);
    }
    transfer.color = random_points<TransferFunction::ColorPoint>(random);
    for (auto& point : transfer.color) {
        point.rgb = {level(random) / 3.0, level(random) / 3.0, level(random) / 3.0};
    }
    return transfer;
}

double density_in(const TransferPiece& piece, double value) {
    return piece.density + (value - piece.from) * piece.density_slope;
}

std::array<double, 3> white() { return {1, 1, 1}; }

} // namespace

TEST_CASE("Pieces of a table agree with the functions they were cut from") {
    std::mt19937 random(20240607);
    std::uniform_real_distribution<double> anywhere(-3, 4);
    std::uniform_int_distribution<int> on_grid(-12, 16);
    for (int round = 0; round < 2000; ++round) {
        const TransferFunction transfer = random_transfer(random);
        const TransferTable table = cut_at_breakpoints(transfer);
        REQUIRE(table.pieces.size() == table.breakpoints.size() + 1);
        REQUIRE(std::is_sorted(table.breakpoints.begin(), table.breakpoints.end()));
        REQUIRE(std::adjacent_find(table.breakpoints.begin(), table.breakpoints.end()) == table.breakpoints.end());
        for (int sample = 0; sample < 40; ++sample) {
            // On the grid lie the points, where a step's value belongs to the upper side.
            const double value = sample % 4 == 0 ? on_grid(random) / 4.0 : anywhere(random);
            const TransferPiece& piece = table.piece_at(value);
            const double density = density_at(transfer, value);
            REQUIRE(std::abs(density_in(piece, value) - density) < 1e-13);
            if (piece.density == 0 && piece.density_slope == 0) {
                REQUIRE(piece.rgb == std::array<double, 3>{});
                REQUIRE(piece.rgb_slope == std::array<double, 3>{});
            }
            for (std::size_t channel = 0; channel < 3 && density > 0; ++channel) {
                const double color = piece.rgb[channel] + (value - piece.from) * piece.rgb_slope[channel];
                REQUIRE(std::abs(color - color_at(transfer, value, channel)) < 1e-13);
            }
        }
    }
}

TEST_CASE("Colours of fewer breakpoints are within the error they are allowed") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> anywhere(-3, 4), channel(0, 1);
    double worst = 0;
    for (int round = 0; round < 1000; ++round) {
        TransferFunction transfer = random_transfer(random);
        // Something between the points, too, and the steps that there are.
        for (int i = 0; i < 40; ++i) {
            const double value = anywhere(random), shade = 0.5 + 0.4 * std::sin(3 * value) + 0.02 * channel(random);
            transfer.color.push_back({value, {shade, shade * shade, 1 - shade}});
        }
        std::stable_sort(transfer.color.begin(), transfer.color.end(), [](auto& a, auto& b) { return a.value < b.value; });
        const double error = round % 2 == 0 ? 0.01 : 0.1;
        const TransferTable table = cut_at_breakpoints(transfer, error);
        for (int sample = 0; sample < 100; ++sample) {
            const double value = sample < 40 ? transfer.color[static_cast<std::size_t>(sample)].value : anywhere(random);
            const TransferPiece& piece = table.piece_at(value);
            REQUIRE(std::abs(density_in(piece, value) - density_at(transfer, value)) < 1e-13);
            for (std::size_t c = 0; c < 3 && density_at(transfer, value) > 0; ++c) {
                const double color = piece.rgb[c] + (value - piece.from) * piece.rgb_slope[c];
                worst = std::max(worst, std::abs(color - color_at(transfer, value, c)) / error);
            }
        }
    }
    std::cout << "colours of fewer breakpoints: at most " << worst << " of the error allowed\n";
    CHECK(worst < 1 + 1e-9);
    CHECK(worst > 0.5);
}

TEST_CASE("A smooth colour map needs few breakpoints") {
    TransferFunction transfer;
    transfer.density = {{0, 0}, {1, 2}};
    for (const SceneColorMap::Point& point : piecewise_linear(built_in_color_map("coolwarm"), surface_table_tolerance)) {
        transfer.color.push_back({point.position, point.rgb});
    }
    const std::size_t all = cut_at_breakpoints(transfer).pieces.size(),
                      few = cut_at_breakpoints(transfer, 2.5e-4).pieces.size();
    std::cout << "coolwarm: " << all << " pieces, " << few << " within 1/4 of a thousandth\n";
    CHECK(few < 70);
    CHECK(all > 200);
}

TEST_CASE("Every breakpoint of a table changes something") {
    std::mt19937 random(7);
    int dropped = 0;
    for (int round = 0; round < 2000; ++round) {
        const TransferFunction transfer = random_transfer(random);
        const TransferTable table = cut_at_breakpoints(transfer);
        dropped += static_cast<int>(transfer.density.size() + transfer.color.size() - table.breakpoints.size());
        for (std::size_t i = 0; i < table.breakpoints.size(); ++i) {
            const TransferPiece &below = table.pieces[i], &above = table.pieces[i + 1];
            const double value = table.breakpoints[i];
            CHECK(above.from == value);
            double change =
                std::abs(density_in(below, value) - above.density) + std::abs(below.density_slope - above.density_slope);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                change += std::abs(below.rgb[channel] + (value - below.from) * below.rgb_slope[channel] - above.rgb[channel]) +
                          std::abs(below.rgb_slope[channel] - above.rgb_slope[channel]);
            }
            REQUIRE(change > 1e-3);
        }
    }
    CHECK(dropped > 2000);
}

TEST_CASE("The first and the last pieces are constant, and a step has two sides") {
    TransferFunction transfer;
    transfer.density = {{0, 1}, {1, 3}, {1, 5}, {2, 4}};
    transfer.color = {{0.5, {0, 0.25, 1}}, {1.5, {1, 0.25, 0}}};
    const TransferTable table = cut_at_breakpoints(transfer);
    CHECK(table.breakpoints == std::vector<double>{0, 0.5, 1, 1.5, 2});
    CHECK(table.pieces.front().density == 1);
    CHECK(table.pieces.front().density_slope == 0);
    CHECK(table.pieces.back().density == 4);
    CHECK(table.pieces.back().density_slope == 0);
    CHECK(table.piece_at(-1e300).density == 1);
    CHECK(table.piece_at(1e300).density == 4);
    const double just_below = std::nextafter(1.0, 0.0);
    CHECK(density_in(table.piece_at(just_below), just_below) == Approx(3));
    CHECK(density_in(table.piece_at(1), 1) == 5);
    CHECK(table.piece_at(1.25).rgb[0] == 0.5);
    CHECK(table.piece_at(1.25).rgb_slope[0] == 1);
    CHECK(table.piece_at(std::numeric_limits<double>::quiet_NaN()).density == 4);
}

TEST_CASE("Breakpoints at which nothing changes are left out") {
    TransferFunction transfer;
    // On one line but for rounding; colours constant.
    for (int i = 0; i <= 255; ++i) {
        transfer.density.push_back({i / 255.0, 40 * (i / 255.0)});
        transfer.color.push_back({i / 255.0, {0.1, 0.2, 0.3}});
    }
    CHECK(cut_at_breakpoints(transfer).breakpoints == std::vector<double>{0, 1});

    // Colours that change where there is no density.
    transfer.density = {{0.4, 0}, {0.5, 2}, {0.6, 0}};
    transfer.color.clear();
    for (int i = 0; i <= 20; ++i) {
        transfer.color.push_back({i / 20.0, {i / 20.0, i % 2 * 1.0, 0}});
    }
    CHECK(cut_at_breakpoints(transfer).breakpoints == std::vector<double>{0.4, 0.45, 0.5, 0.55, 0.6});

    // One value everywhere has none.
    transfer.density = {{0, 1}};
    transfer.color = {{0, white()}, {1, white()}};
    CHECK(cut_at_breakpoints(transfer).breakpoints.empty());
    CHECK(cut_at_breakpoints(transfer).piece_at(17).density == 1);

    // The faintest change that is not rounding stays.
    transfer.density = {{0, 1}, {1, 1}, {1, 1 + 1e-9}};
    CHECK(cut_at_breakpoints(transfer).breakpoints == std::vector<double>{1});
}

TEST_CASE("Densities never start a piece below zero, and points that nearly coincide are a step") {
    TransferFunction transfer;
    transfer.color = {{0, white()}};
    for (int i = 1; i < 1000; ++i) {
        transfer.density = {{0, 0.1}, {i / 1000.0, 0}};
        transfer.color.push_back({i / 1000.0 * (1 - 1e-16), {0, 0, 0}});
        for (const TransferPiece& piece : cut_at_breakpoints(transfer).pieces) {
            REQUIRE(piece.density >= 0);
        }
        transfer.color = {{0, white()}};
    }
    transfer.density = {{0, 0}, {1e-320, 5}};
    const TransferTable table = cut_at_breakpoints(transfer);
    CHECK(table.piece_at(1).density == 5);
    CHECK(table.piece_at(-1).density == 0);
    for (const TransferPiece& piece : table.pieces) {
        CHECK(std::isfinite(piece.density));
        CHECK(std::isfinite(piece.density_slope));
    }
}

TEST_CASE("A transfer function that means nothing is refused") {
    const TransferFunction good{{{0, 1}}, {{0, white()}}};
    const auto error = [&](auto change) {
        TransferFunction bad = good;
        change(bad);
        return error_of([&] { cut_at_breakpoints(bad); });
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(error([](auto& bad) { bad.density.clear(); }), Contains("density has no points"));
    CHECK_THAT(error([](auto& bad) { bad.color.clear(); }), Contains("color has no points"));
    CHECK_THAT(error([](auto& bad) { bad.density.push_back({-1, 1}); }), Contains("do not ascend: -1 after 0"));
    CHECK_THAT(error([](auto& bad) { bad.density[0].density = -1e-9; }), Contains("density -1e-09 at the value 0"));
    CHECK_THAT(error([](auto& bad) { bad.density[0].density = nan; }), Contains("density nan"));
    CHECK_THAT(error([](auto& bad) { bad.color[0].value = nan; }), Contains("color has a point at a value that is not finite"));
    CHECK_THAT(error([](auto& bad) { bad.color[0].rgb[1] = nan; }), Contains("color at the value 0 is not finite"));
}
