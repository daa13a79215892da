#include "bench_suites.hpp"

#include <core/bench/roots.hpp>

#include <memory>

namespace elvis::commands {

namespace {

/** Smooth, and disturbed so much that many elements need the determinant's own form, and that many are negative. */
constexpr double jacobian_disturbances[] = {0, 0.1, 0.2, 0.4};

} // namespace

nlohmann::ordered_json run_hierarchy(const BenchArguments& arguments) {
    const HierarchyResult result = bench_hierarchy(2000000);
    say(arguments, "hierarchy of %llu boxes: %.0f ms, depth %u, %.2f boxes at a point\n",
        static_cast<unsigned long long>(result.n_items), result.wall_milliseconds, result.depth, result.boxes_a_query);
    return {{"n_items", result.n_items},
            {"wall_milliseconds", result.wall_milliseconds},
            {"depth", result.depth},
            {"boxes_a_query", result.boxes_a_query}};
}

nlohmann::ordered_json run_jacobian(const BenchArguments& arguments) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const std::uint32_t order : {1u, 2u}) {
        for (const double disturbance : jacobian_disturbances) {
            const JacobianResult result = bench_jacobian(arguments.n_jacobians, order, disturbance);
            list.push_back({{"n_elements", result.n_elements},
                            {"geometry_order", result.geometry_order},
                            {"disturbance", result.disturbance},
                            {"elements_a_second_a_core", result.elements_a_second},
                            {"n_negative", result.n_negative},
                            {"n_undecided", result.n_undecided}});
            say(arguments,
                "Jacobians of %llu hexahedra of geometry order %u, nodes disturbed by %.2f: %9.0f elements a second a "
                "core, %llu negative, %llu undecided\n",
                static_cast<unsigned long long>(result.n_elements), result.geometry_order, result.disturbance,
                result.elements_a_second, static_cast<unsigned long long>(result.n_negative),
                static_cast<unsigned long long>(result.n_undecided));
        }
    }
    return list;
}

nlohmann::ordered_json run_roots(const BenchArguments& arguments) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const Device device(arguments.device);
    say(arguments,
        "First roots on [0, 1] of %llu random polynomials, by the Bernstein form and by the colleague matrix\n"
        "times in ns: of a core, for 8 polynomials on the device, for one on the CPU\n",
        static_cast<unsigned long long>(arguments.n_polynomials));
    bench_roots(&device, arguments.n_polynomials, [&](const RootsResult& result) {
        const char* const precision = name_of(result.precision);
        const char* const place = result.on_device ? "device" : "cpu";
        list.push_back({{"degree", result.degree},
                        {"place", place},
                        {"precision", precision},
                        {"n_polynomials", result.n_polynomials},
                        {"n_with_root", result.n_with_root},
                        {"bernstein_missed", result.bernstein_missed},
                        {"colleague_missed", result.colleague_missed},
                        {"n_earlier", result.n_earlier},
                        {"bernstein_false", result.bernstein_false},
                        {"colleague_false", result.colleague_false},
                        {"n_touching", result.n_touching},
                        {"bernstein_error", result.bernstein_error},
                        {"bernstein_nanoseconds", result.bernstein_nanoseconds},
                        {"colleague_nanoseconds", result.colleague_nanoseconds}});
        say(arguments,
            "degree %2d %-6s %s  %6llu of %6llu have a root; missed %llu and %llu, false %llu and %llu, earlier %llu, "
            "touching %4llu; error %.1e; %6.0f and %6.0f ns\n",
            result.degree, place, precision, static_cast<unsigned long long>(result.n_with_root),
            static_cast<unsigned long long>(result.n_polynomials), static_cast<unsigned long long>(result.bernstein_missed),
            static_cast<unsigned long long>(result.colleague_missed), static_cast<unsigned long long>(result.bernstein_false),
            static_cast<unsigned long long>(result.colleague_false), static_cast<unsigned long long>(result.n_earlier),
            static_cast<unsigned long long>(result.n_touching), result.bernstein_error, result.bernstein_nanoseconds,
            result.colleague_nanoseconds);
    });
    return list;
}

nlohmann::ordered_json run_segments(const Bench& bench) {
    const BenchArguments& arguments = bench.arguments;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    bench_segments(
        bench.device, bench.registry, bench.folder, arguments.elements, arguments.sizes, [&](const SegmentsResult& result) {
            const char* precision = name_of(result.precision);
            list.push_back({{"elements_a_side", result.elements_a_side},
                            {"size", result.size},
                            {"precision", precision},
                            {"milliseconds", result.milliseconds},
                            {"n_segments", result.n_segments},
                            {"evaluations_a_segment", result.evaluations_a_segment},
                            {"seek_evaluations_a_ray", result.seek_evaluations_a_ray},
                            {"n_overlaps", result.n_overlaps},
                            {"n_failures", result.n_failures},
                            {"n_breaks", result.n_breaks},
                            {"n_undecided", result.n_undecided}});
            say(arguments,
                "%2u^3  %4u^2  %s  %8.1f ms %9.3g U   %llu segments, each %.2f evaluations, and %.2f a ray to begin; "
                "%llu overlaps, %llu failures, %llu walks broken, %llu rays undecided\n",
                result.elements_a_side, result.size, precision, result.milliseconds, 1e6 * result.milliseconds / bench.unit,
                static_cast<unsigned long long>(result.n_segments), result.evaluations_a_segment, result.seek_evaluations_a_ray,
                static_cast<unsigned long long>(result.n_overlaps), static_cast<unsigned long long>(result.n_failures),
                static_cast<unsigned long long>(result.n_breaks), static_cast<unsigned long long>(result.n_undecided));
        });
    return list;
}

} // namespace elvis::commands
