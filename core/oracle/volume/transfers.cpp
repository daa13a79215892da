#include "transfers.hpp"

#include <core/oracle/samples/random.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace elvis::oracle {
namespace {

std::array<double, 3> random_color(Random& random) {
    return {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
}

/** Peaks at random values, narrower than half of the range and at most 30 times as dense. */
template <class Value>
void add_peaks(Random& random, const Value& value, int n_peaks, double range, double density, TransferFunction& transfer) {
    std::vector<double> middles;
    for (int i = 0; i < n_peaks; ++i)
        middles.push_back(value());
    std::sort(middles.begin(), middles.end());
    double reached = -std::numeric_limits<double>::infinity();
    for (const double middle : middles) {
        const double half = 0.5 * range * std::pow(10.0, random.between(-3, -0.7));
        // Peaks are empty beside; those that would overlap are left out.
        if (middle - half <= reached)
            continue;
        const double height = density * std::min(30.0, 0.5 * range / half);
        transfer.density.push_back({middle - half, 0});
        transfer.density.push_back({middle, height});
        transfer.density.push_back({middle + half, 0});
        reached = middle + half;
    }
}

/** At so many values, at least one; whether there is a step. */
template <class Value> bool add_colors(Random& random, const Value& value, int n_values, TransferFunction& transfer) {
    bool has_color_step = false;
    std::vector<double> values;
    for (int i = 0; i < std::max(n_values, 1); ++i)
        // Now and then at a breakpoint of the density.
        values.push_back(
            n_values <= 0 || random.one_in(3)
                ? transfer.density[static_cast<std::size_t>(random.whole(0, static_cast<int>(transfer.density.size()) - 1))]
                      .value
                : value());
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    for (const double at : values) {
        transfer.color.push_back({at, random_color(random)});
        if (random.one_in(4)) {
            transfer.color.push_back({at, random_color(random)});
            has_color_step = true;
        }
    }
    return has_color_step;
}

} // namespace

TransferFunction sphere_peaks(double width) {
    const double half = 0.5 * width * 18;
    TransferFunction transfer;
    // Along z the field's slope is 2 sqrt(value): a peak is as long as its width over that, and half as dense on average.
    for (const double value : {1.0, 4.0, 9.0}) {
        const double length = 2 * half / (2 * std::sqrt(value)), depth = 0.23;
        transfer.density.push_back({value - half, 0});
        transfer.density.push_back({value, 2 * depth / length});
        transfer.density.push_back({value + half, 0});
    }
    transfer.color = {{0, {0.9, 0.1, 0.05}}, {1, {0.95, 0.75, 0.1}}, {4, {0.1, 0.7, 0.3}}, {9, {0.15, 0.3, 0.9}}};
    return transfer;
}

RandomTransfer random_transfer(std::uint64_t seed, double low, double high, double size) {
    Random random(seed * 0xD1342543DE82EF95ull + 7);
    const double range = high - low;
    const auto value = [&] { return low + range * random.between(-0.1, 1.1); };
    RandomTransfer result;
    TransferFunction& transfer = result.transfer;
    const int kind = random.whole(0, 3);
    // Of a ray through all of the volume, if it were as dense everywhere.
    const double depth = std::pow(10.0, random.between(-1, 1.5));
    int n_left = random.whole(1, 12);
    const int n = n_left;
    bool has_density_step = false;
    if (kind == 0 || (kind == 3 && n_left < 3)) {
        result.description = "constant density";
        transfer.density = {{value(), depth / size}};
        --n_left;
    } else if (kind == 3) {
        result.description = "peaks";
        add_peaks(random, value, random.whole(1, std::min(4, n_left / 3)), range, depth / size, transfer);
        n_left -= static_cast<int>(transfer.density.size());
    } else {
        const int n_points = random.whole(1, n_left);
        result.description = kind == 1 ? "rough density" : "density with empty parts";
        std::vector<double> values;
        for (int i = 0; i < n_points; ++i)
            values.push_back(value());
        std::sort(values.begin(), values.end());
        for (const double at : values) {
            const auto density = [&] { return kind == 2 && random.one_in(2) ? 0 : depth / size * random.between(0, 1); };
            transfer.density.push_back({at, density()});
            if (random.one_in(6)) {
                transfer.density.push_back({at, density()});
                has_density_step = true;
            }
        }
        n_left -= n_points;
    }
    const bool has_color_step = add_colors(random, value, n_left, transfer);
    result.description += ", " + std::to_string(n) + " breakpoints at most" + (has_density_step ? ", steps of density" : "") +
                          (has_color_step ? ", steps of colour" : "");
    return result;
}

} // namespace elvis::oracle
