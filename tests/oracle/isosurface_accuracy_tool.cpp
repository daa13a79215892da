// elvis_isosurface_accuracy: isosurfaces of random fields against the oracle's, printed. See --help.
#include "isosurface_accuracy.hpp"
#include "root_finders.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace elvis::oracle {
namespace {

struct Arguments {
    std::uint64_t count = 1000, seed = 0;
    std::uint32_t size = 200, finder_stride = 50;
    std::vector<std::string> precisions{"float32", "float64"};
    std::string device, method = "interval";
};

const char* name_of(Precision precision) { return precision == Precision::float64 ? "float64" : "float32"; }

// What must hold in each precision.
bool holds(const IsosurfaceComparison& comparison, Precision precision) {
    return comparison.n_wrong + comparison.n_wrong_masks + comparison.n_other_element == 0 &&
           (precision == Precision::float32 || comparison.n_wrong_grazing == 0);
}

int run(const Arguments& arguments) {
    const Device device(arguments.device);
    const IsosurfaceMethod method = arguments.method == "interval"    ? IsosurfaceMethod::interval
                                    : arguments.method == "bernstein" ? IsosurfaceMethod::bernstein
                                                                      : IsosurfaceMethod::companion;
    std::vector<Precision> precisions;
    for (const std::string& name : arguments.precisions)
        if (name != "none")
            precisions.push_back(name == "float64" ? Precision::float64 : Precision::float32);
    std::vector<IsosurfaceComparison> sums(precisions.size());
    std::vector<double> milliseconds(precisions.size());
    std::uint64_t n_projected = 0, n_evaluations = 0;
    FinderComparison finders;
    double oracle_seconds = 0;
    std::uint64_t oracle_failures = 0;
    for (std::uint64_t seed = arguments.seed; seed < arguments.seed + arguments.count; ++seed) {
        const RandomVolume random = random_volume(seed);
        const RandomAccuracy one = measure_random(device, random, arguments.size, precisions, method);
        oracle_seconds += one.oracle_seconds;
        oracle_failures += one.oracle_failures;
        for (std::size_t i = 0; i < precisions.size(); ++i) {
            const IsosurfaceComparison& comparison = one.comparisons[i];
            if (!holds(comparison, precisions[i]))
                std::printf("seed %llu, %s: %s: %zu wrong, %zu grazing, %zu other elements; pixel %zu\n", static_cast<unsigned long long>(seed),
                            name_of(precisions[i]), random.description.c_str(), comparison.n_wrong, comparison.n_wrong_grazing,
                            comparison.n_other_element, comparison.worst_pixel);
            sums[i] += comparison;
            n_projected += one.counts[i].projected_pixels;
            n_evaluations += one.counts[i].field_evaluations;
            milliseconds[i] += one.render_milliseconds[i];
        }
        if (arguments.finder_stride != 0) {
            const Model model(random.data);
            const Isosurface isosurface{scalar_of_field(model.volume, 0), random.values, random.clip};
            const FinderComparison ways =
                compare_finders(model, isosurface, random.camera, arguments.size, arguments.size, arguments.finder_stride);
            if (ways.n_samples_differ + ways.n_companion_differ != 0)
                std::printf("seed %llu: the oracle's ways differ: %s\n", static_cast<unsigned long long>(seed), random.description.c_str());
            finders += ways;
        }
        std::fflush(stdout);
    }
    bool is_good = oracle_failures == 0 && finders.n_samples_differ + finders.n_companion_differ == 0;
    for (std::size_t i = 0; i < precisions.size(); ++i) {
        const bool is_held = holds(sums[i], precisions[i]);
        is_good = is_good && is_held;
        std::printf("%s, %llu fields, %.3g ms a picture: %s\n%s\n", name_of(precisions[i]),
                    static_cast<unsigned long long>(arguments.count), milliseconds[i] / static_cast<double>(arguments.count),
                    is_held ? "good" : "WRONG", to_text(sums[i]).c_str());
    }
    std::printf("%llu pixels drawn by projection, %llu evaluations\n", static_cast<unsigned long long>(n_projected),
                static_cast<unsigned long long>(n_evaluations));
    std::printf("oracle: %.3g rays a second, %llu failures\n"
                "its ways to find roots, on %zu rays, %zu of them with a crossing:\n"
                "  series and samples differ              %zu\n"
                "  series and companion matrix differ     %zu\n"
                "  apart by                               %.3g and %.3g of the range\n",
                static_cast<double>(arguments.count) * arguments.size * arguments.size / oracle_seconds,
                static_cast<unsigned long long>(oracle_failures), finders.n_rays, finders.n_hits, finders.n_samples_differ,
                finders.n_companion_differ, finders.samples_error, finders.companion_error);
    return is_good ? 0 : 1;
}

} // namespace
} // namespace elvis::oracle

int main(int argc, char** argv) {
    elvis::oracle::Arguments arguments;
    CLI::App app("Isosurfaces of random fields of orders 2 to 10 on straight and curved elements of all shapes, drawn by ElVis and compared "
                 "with the oracle pixel by pixel. Fails if a pixel is wrong and does not say so, except, in float32, at grazing rays.");
    app.add_option("--count", arguments.count, "Number of fields");
    app.add_option("--seed", arguments.seed, "Of the first field; the others follow");
    app.add_option("--size", arguments.size, "Side of the pictures in pixels")->check(CLI::PositiveNumber);
    app.add_option("--precision", arguments.precisions, "float32, float64 or both; none: the oracle alone")
        ->check(CLI::IsMember({"float32", "float64", "none"}));
    app.add_option("--finder-stride", arguments.finder_stride, "The oracle's ways are compared on every so many rays; 0: not at all");
    app.add_option("--method", arguments.method, "How crossings are found")->check(CLI::IsMember({"interval", "bernstein", "companion"}));
    app.add_option("--device", arguments.device, "Device by name or index");
    CLI11_PARSE(app, argc, argv);
    try {
        return elvis::oracle::run(arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis_isosurface_accuracy: %s\n", error.what());
        return 1;
    }
}
